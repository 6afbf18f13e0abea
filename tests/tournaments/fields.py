"""Fields of players that several tests use."""

from __future__ import annotations

import numpy as np

from evenbreak.ratings.scale import scale_of


def by_strength(strengths) -> np.ndarray:
    """Return P(i beats j) = strength of i over the sum of the two."""
    s = np.asarray(strengths, dtype=float)
    return s[:, None] / (s[:, None] + s)


def by_seed(count: int) -> np.ndarray:
    """Return the chances of players whose strengths are n, n - 1, ..., 1."""
    return by_strength(range(count, 0, -1))


def by_fargo(ratings) -> np.ndarray:
    """Return the chances of one game by Fargo ratings."""
    rated = np.asarray(ratings, dtype=float)
    return scale_of("fargo").win_probability(rated[:, None] - rated)


def one_favorite(count: int, p: float, at: int = 0) -> np.ndarray:
    """Return a field of equals but for one who beats each of them with chance p."""
    win = np.full((count, count), 0.5)
    win[at, :], win[:, at] = p, 1.0 - p
    win[at, at] = 0.5
    return win
