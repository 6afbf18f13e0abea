"""Shots, strokes and the table."""
