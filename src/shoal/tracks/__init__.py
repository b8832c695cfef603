"""Files of recorded tracks that people bring: one reader per format, one rule that chooses, one that cleans."""
