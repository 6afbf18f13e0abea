"""Tournaments: odds, times, prizes, and every move from the draw to the final."""
