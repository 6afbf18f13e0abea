"""How registry entries are declared, and how values are shown if plain digits aren't enough."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

from evenbreak.answers.kit.parts import Column, Show
from evenbreak.answers.kit.wording import clock, decimals, range_words, share_at_a_glance
from evenbreak.words import joined, say

plain: Show = "{:g}".format
"""A number as it was typed."""

_LARGE = 1_000_000
_WORTH_SAYING = 3.0  # minutes
_ROUNDING = 1e-14  # differences up to this vary from computer to computer


def in_hundred(places: int) -> Show:
    """Return a share as shown under a heading that says percent."""
    return lambda value: f"{100.0 * value:.{places}f}"


def signed_percent(change: float) -> str:
    """Return a difference in chances, with its sign."""
    return f"{100.0 * change:+.1f}%"


def percent_or_blank(cost: float) -> str:
    """Return a difference in chances, if it's large enough to show.

    >>> percent_or_blank(0.041), percent_or_blank(0.0)
    ('4.1%', '')
    """
    return f"{100.0 * cost:.1f}%" if cost >= 5e-4 else ""


def four(value: float) -> str:
    """Return a number with four decimals, or four digits if it is huge."""
    return f"{value:.4g}" if abs(value) >= _LARGE else decimals(4)(value)


def amount(value: float) -> str:
    """Return a number with three decimals, or three digits if it is huge.

    >>> amount(2.3014), amount(5.56e299), amount(float("inf"))
    ('2.301', '5.56e+299', 'inf')
    """
    return f"{value:.3f}" if value < _LARGE else f"{value:.3g}"


def evidence(e: float) -> str:
    """Return the evidence, with as many digits as it needs.

    >>> evidence(0.0123), evidence(34.5), evidence(62_671.0), evidence(1.23e9)
    ('0.012', '34.5', '62,671', '1.2e+09')
    """
    if e >= 1e6 or 0.0 < e < 1e-3:
        return f"{e:.1e}"
    return f"{e:,.0f}" if e >= 100 else f"{e:.3g}" if e >= 1 else f"{e:.2g}"


def rounding(difference: float) -> str:
    """Return how far two calculations are apart."""
    return f"{difference:.1e}" if difference > _ROUNDING else "rounding only"


def small_p(p: float) -> str:
    """Return a p-value."""
    return f"{p:.2g}" if p >= 0.0001 else "< 0.0001"


def imaginary(part: float) -> str:
    """Return an imaginary part; nothing for a real number."""
    return f"{part:+.6f}i" if part else ""


def band(ends: tuple[float, float]) -> str:
    """Return two chances as a range.

    >>> print(band((0.021, 0.19)))
    2.1%-19%
    """
    low, high = map(share_at_a_glance, ends)
    return say("{low}-{high}", low=low, high=high)


def yes_or_blank(truth: bool) -> str:
    """Return 'yes', or nothing."""
    return "yes" if truth else ""


def provisional_or_blank(truth: bool) -> str:
    """Return 'provisional', or nothing."""
    return say("provisional") if truth else ""


def no_time(match: str) -> str:
    """Return a match as written in CSV, because spreadsheets take a bare 9:5 for a time of day."""
    return f"race {match}" if match[0].isdigit() else match


def who_breaks(breaks: str) -> str:
    """Return a break format."""
    return f"always {breaks.upper()}" if breaks in ("a", "b") else breaks


def versus(levels: Sequence[Any]) -> str:
    """Return two levels."""
    return f"{levels[0]} v {levels[1]}"


def span(ends: tuple[int, int | None]) -> str:
    """Return a range of differences, given its ends."""
    return range_words(*ends)


def even_race(ends: tuple[int, int] | None) -> str:
    """Return the races for equal players, which a points chart doesn't have."""
    if ends is None:
        return "points"
    first, last = ends
    return str(first) if first == last else f"{first} to {last}"


def points_or_new(rating: float) -> str:
    """Return a rating as leagues print it; an unknown rating is "new"."""
    if math.isnan(rating):
        return "new"
    return f"{rating:.0f}" if rating == round(rating) else f"{rating:.1f}"


def signed_points(points: float) -> str:
    """Return a change in rating."""
    return f"{points:+g}" if points else "0"


def or_safe(points: float) -> str:
    """Return the points a team needs; 'safe' if it needs none."""
    return "safe" if points == 0.0 else f"{points:g}"


def moves(minutes: float) -> str:
    """Return how much later or earlier the evening ends.

    >>> moves(-72.0), moves(0.2)
    ('1 h 12 earlier', '0 min')
    """
    if abs(minutes) < 0.5:
        return clock(0.0)
    if minutes > 0:
        return say("{time} later", time=clock(minutes))
    return say("{time} earlier", time=clock(-minutes))


def pair(names: Sequence[str]) -> str:
    """Return who plays who, for a table.

    >>> pair(["Ann", "Bo"])
    'Ann - Bo'
    """
    return joined(names, " - ")


def later(minutes: float) -> str:
    """Return how much later or earlier the evening ends, if it's worth mentioning."""
    if abs(minutes) < _WORTH_SAYING:
        return ""
    if minutes > 0:
        return say("{n:.0f} min later", n=minutes)
    return say("{n:.0f} min earlier", n=-minutes)


def with_range(digits: int, to: str = " to ") -> Show:
    """Return an estimate with its interval."""

    def show(estimate: Sequence[float]) -> str:
        value, low, high = (f"{part:z.{digits}f}" for part in estimate)
        return f"{value}  {low}{to}{high}"

    return show


def interval(ends: tuple[float, float]) -> str:
    """Return an interval for a chance."""
    return f"{ends[0]:.3f} to {ends[1]:.3f}"


def percent_interval(ends: tuple[float, float]) -> str:
    """Return an interval for a chance, in percent.

    >>> percent_interval((0.482, 0.579))
    '48 to 58%'
    """
    return f"{100 * ends[0]:.0f} to {100 * ends[1]:.0f}%"


Entry = tuple[str, Column]


def number(
    key: str, words: str | None = None, show: Show | int = str, name: Any = None, **how: Any
) -> Entry:
    """Return an entry in the registry: a column by its key.

    `words` may have fields that only an answer fills in; without words, the column is in files
    only. If `show` is a number, it is the number of decimals.
    """
    reads = decimals(show) if isinstance(show, int) else show
    return key, Column(key if name is None else name, words, reads, **how)


text = partial(number, left=True)
"""An entry that is shown flush left."""

detail = partial(number, detail=True)
"""An entry shown only with the details."""


def registry(*entries: Entry, files_only: str = "") -> tuple[Entry, ...]:
    """Return entries, plus entries that are only names in files."""
    return (*entries, *(number(name) for name in files_only.split()))
