"""Descriptions of runs, validated once, then frozen."""
