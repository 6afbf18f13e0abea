"""Ladders: how far ratings stray from the skill they stand for, in the long run."""
