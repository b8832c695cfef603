"""Version numbers: of the package, and of the results that it gives."""

VERSION = "0.1.0"
RESULTS_VERSION = 3  # raised by every change that moves a number (CHANGELOG.md, "Results change")
