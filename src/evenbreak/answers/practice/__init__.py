"""Drills, practice scores and runs."""
