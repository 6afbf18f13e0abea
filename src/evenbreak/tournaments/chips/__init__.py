"""Chip tournaments: lose a rack, lose a chip; out without chips."""
