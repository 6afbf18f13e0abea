"""A tournament: odds, times, prizes, its moves from the draw to the final."""
