"""The vocabulary everybody shares; imports nothing of ours."""
