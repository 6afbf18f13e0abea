"""Dates of matches that were probably mistyped: in the future, or years from all the others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

YEARS_APART = 5
"""Dates this many years from all the others are doubted."""

FEW = 0.1
"""The largest share of the matches that can be far from all the others."""

MOST_LISTED = 10
"""How many doubtful dates are listed; the rest are counted."""

_GAP = np.timedelta64(round(365.25 * YEARS_APART), "D")


def date_warnings(
    dates: NDArray[np.datetime64],
    lines: NDArray[np.int64],
    source: str,
    today: np.datetime64 | None = None,
) -> list[str]:
    """Return a warning for each match with a doubtful date.

    Parameters
    ----------
    dates, lines
        of the matches; NaT where no date is stated.
    source
        what the file is called.
    today
        the present day if not that of the clock. The day after it is not yet the future: it
        has begun in other time zones.

    >>> days = np.array(["2024-09-03", "2204-09-10", "2024-09-17"], dtype="datetime64[D]")
    >>> date_warnings(days, np.array([2, 3, 4]), "r.csv")
    ['r.csv:3: date 2204-09-10 is in the future; correct it if it was mistyped']
    """
    today = np.datetime64("today", "D") if today is None else today
    future = dates > today + 1
    far, others = _far(dates, ~future & ~np.isnat(dates))
    found = []
    for row in np.flatnonzero(future | far):
        why = "in the future" if future[row] else f"{YEARS_APART} years or more from {others}"
        found.append(
            f"{source}:{lines[row]}: date {dates[row]} is {why}; correct it if it was mistyped"
        )
    more = len(found) - MOST_LISTED
    return [
        *found[:MOST_LISTED],
        *([f"{source}: and {more:,} more such dates"] if more > 0 else []),
    ]


def _far(
    dates: NDArray[np.datetime64], considered: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], str]:
    """Return which of the dates are far from all the others, and from when to when those are."""
    far = np.zeros(len(dates), dtype=bool)
    days = np.sort(dates[considered])
    if len(days) < 2:
        return far, ""
    starts = np.flatnonzero(np.diff(days) >= _GAP) + 1
    parts = np.split(days, starts)
    most = max(parts, key=len)
    if len(days) - len(most) > max(1, FEW * len(days)) or len(most) == len(days) / 2:
        return far, ""
    far[considered] = (dates[considered] < most[0]) | (dates[considered] > most[-1])
    return far, f"all others ({most[0]} to {most[-1]})"
