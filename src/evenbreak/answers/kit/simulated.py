"""How far simulated figures would move with another seed."""

from collections.abc import Iterable

import numpy as np


def error_of_share(share: float, runs: int) -> float:
    """Return the standard error of a share of independent runs.

    >>> error_of_share(0.5, 400)
    0.025
    """
    return float(np.sqrt(share * (1.0 - share) / runs))


def luck_words(errors: Iterable[float], figures: str = "share") -> str:
    """Return by how much other luck would move the figures of one simulation, 19 times in 20.

    Parameters
    ----------
    errors
        their standard errors, as shares of 1.
    figures
        what one of them is called.

    >>> luck_words([0.01, 0.02], "title odds")
    'other luck would move no title odds by more than about 4.0 percentage points'
    """
    points = f"{200.0 * max(errors):.1f}"
    unit = "point" if points == "1.0" else "points"
    return f"other luck would move no {figures} by more than about {points} percentage {unit}"
