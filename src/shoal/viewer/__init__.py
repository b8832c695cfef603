"""See a run in a browser: scenes and frames, a server for live runs, a page that replays records (extra: viewer)."""
