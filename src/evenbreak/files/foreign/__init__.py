"""Tournaments saved by other programs: a parser for each, then their results or events."""
