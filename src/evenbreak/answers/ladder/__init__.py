"""Handicap ladders: how far ratings wander in the long run."""
