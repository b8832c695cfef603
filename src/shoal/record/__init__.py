"""What runs leave behind, in memory and on disk."""
