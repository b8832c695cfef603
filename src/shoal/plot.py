"""Publication-ready figures of records and sweeps (extra: plots)."""
