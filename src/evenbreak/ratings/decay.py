"""Weight of older matches: it halves every fixed number of days."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Floats
from evenbreak.checks import column, positive
from evenbreak.errors import InputError
from evenbreak.ratings.results import Results


def day_of(value: Any) -> np.datetime64:
    """Return the day of a date, a `numpy.datetime64`, or a string such as '2026-01-31'.

    Anything else raises InputError.

    >>> day_of("2026-01-31")
    np.datetime64('2026-01-31')
    """
    try:
        day = column([value], "as_of", 1, "days", "datetime64[D]")[0]
    except InputError:
        day = np.datetime64("NaT", "D")
    if np.isnat(day):
        raise InputError(
            "as_of must be a date, such as 2026-01-31; you gave {value!r}", value=value
        )
    return np.datetime64(day)


def last_day(results: Results) -> np.datetime64 | None:
    """Return the day of the last match, or None if no match has a date."""
    if results.date is None or np.isnat(results.date).all():
        return None
    return np.datetime64(results.date[~np.isnat(results.date)].max())


def until(results: Results, as_of: np.datetime64) -> Bools:
    """Return which matches were played by the end of a day; InputError if any has no date."""
    date = _dated(results)
    return np.asarray(date <= as_of)


def match_weights(results: Results, half_life: float, as_of: np.datetime64 | None = None) -> Floats:
    """Return the weight of each match: 1 on the day `as_of`, 1/2 `half_life` days before.

    A game of weight w enters the likelihood with the power w, so it counts as w games. Without
    `as_of`, age is counted back from the last date; a match after `as_of` has the weight 1. Raises
    InputError if half_life is not above 0 or a match has no date.
    """
    days = positive(half_life, "half_life", wanted="a number of days above 0")
    date = _dated(results)
    if not len(date):
        return np.zeros(0)
    today = date.max() if as_of is None else as_of
    age = np.maximum((today - date) / np.timedelta64(1, "D"), 0.0)
    return np.asarray(np.exp2(-age / days))


def _dated(results: Results) -> NDArray[np.datetime64]:
    undated = len(results) if results.date is None else int(np.isnat(results.date).sum())
    if results.date is None or undated:
        if not len(results):
            return np.zeros(0, dtype="datetime64[D]")
        raise InputError(
            "{undated:,} of {n_results:,} matches have no date. Add the dates, or rate without "
            "a half-life or a date.",
            undated=undated,
            n_results=len(results),
        )
    return results.date
