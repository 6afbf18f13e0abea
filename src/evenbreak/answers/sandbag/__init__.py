"""Sandbagging: what it gains, and who may be doing it."""
