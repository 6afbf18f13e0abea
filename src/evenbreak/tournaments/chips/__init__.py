"""Chip tournaments: lose a rack, lose a chip; out when you have no chips left."""
