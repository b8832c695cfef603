"""What is measured: one file per metric, updated once per step."""
