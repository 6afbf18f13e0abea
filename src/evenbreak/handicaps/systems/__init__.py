"""Handicap systems, one per file: a scale, the charts by which it is played, an update rule."""
