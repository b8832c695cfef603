"""The papers, reproduced: their figures, their claims with verdicts, and what depends on what they do not say."""
