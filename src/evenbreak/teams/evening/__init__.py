"""A team night in progress: its events, one after another, and the resulting state."""
