"""Handicap systems, one per file: a scale, the charts that set its races, and an update rule."""
