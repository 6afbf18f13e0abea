"""Sandbagging: what it brings, and who may be doing it."""
