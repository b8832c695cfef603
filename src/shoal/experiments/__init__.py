"""Many runs, safely: a design, a store that survives anything, and workers."""
