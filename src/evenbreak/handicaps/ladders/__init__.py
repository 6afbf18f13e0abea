"""Ladders: how far ratings stray from the skills that they stand for, in the long run."""
