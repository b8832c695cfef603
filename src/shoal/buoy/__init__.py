"""One buoy without a simulator: what its instruments and its radio say in, what it wants and tells out."""
