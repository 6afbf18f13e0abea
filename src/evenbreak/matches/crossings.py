"""Where a match is even, and where two matches give a player the same chance.

If the break does not matter, both questions ask for the zeros of a polynomial with integer
coefficients, which are counted exactly, so none is missed. If it does, the log-odds of the two
matches are compared on a fine grid, and every change of sign is refined.

By Descartes' rule, the changes of sign in the coefficients of p^k q^(N-k) bound the number of zeros
for 0 < p < 1: if there is no change, there is no zero, and if there is one change, there is one
zero. If there are more changes, the interval is halved and the form rewritten for each half
(Vincent; Collins & Akritas 1976). Everything is done in integers, so rounding neither creates a
zero nor loses one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.special import expit

from evenbreak.checks import number_probability, one_of
from evenbreak.errors import InputError
from evenbreak.games.breaks import BREAK_FORMATS, BreakFormat
from evenbreak.games.match import Match
from evenbreak.games.rack import Rack
from evenbreak.matches.formats import MatchFormat, match_format
from evenbreak.matches.parameters import rack_in
from evenbreak.matches.win import win_probability
from evenbreak.matches.win_formula import Form, degree_of, product, value_at, win_forms

_HIGHEST_DEGREE = 500
"""Largest degree of a polynomial that is solved exactly; a higher one would take seconds."""
_P1 = expit(np.linspace(-14.0, 14.0, 2801))
"""The grid: steps of a hundredth in the log-odds of p1, of 0.0025 in p1 near 1/2."""
_NOISE = 1e-10
"""Differences in log-odds below this may be due to rounding."""


class Crossing(NamedTuple):
    """A point where a match is even, or where two matches give the same chance.

    Parameters
    ----------
    p1
        P(player 1 wins a rack | player 1 breaks); P(player 1 wins a rack) if the break does
        not matter.
    p2
        P(player 2 wins a rack | player 2 breaks); None if the break does not matter.
    p_win_1
        P(player 1 wins the match) there.
    """

    p1: float
    p2: float | None
    p_win_1: float


class Crossings(NamedTuple):
    """All points where two matches give the same chance, and which is better between them.

    Parameters
    ----------
    points
        the points, by increasing p1.
    better
        the better match for player 1, 1 or 2: below the first point, between successive points, and
        above the last; 0 if the matches give the same chance everywhere.
    exact
        whether the points were counted exactly, so that none is missed. If not, two points
        closer together than a hundredth in the log-odds of p1 may be missed, as may curves
        that touch without crossing, and a point where a probability is below 1e-308.
    """

    points: tuple[Crossing, ...]
    better: tuple[int, ...]
    exact: bool


def even_probability(
    played: MatchFormat | str,
    *,
    p2: float | None = None,
    break_odds: float | None = None,
    breaks: BreakFormat | str | None = None,
    first_breaker: int = 1,
) -> tuple[Crossing, ...]:
    """Return every game probability at which a match is even: none, one or several.

    Parameters
    ----------
    played
        a match format, or a string such as "9:5" (see `match_format`).
    p2
        P(player 2 wins a rack | player 2 breaks it), which stays fixed as p1 varies.
    break_odds
        instead of p2: the advantage of the break, which stays fixed as p1 varies. It is the ratio
        of player 1's odds of winning a rack on player 1's break to those on player 2's: p1/(1 - p1)
        × p2/(1 - p2). With neither p2 nor break_odds the break does not matter, and p1 is P(player
        1 wins a rack).
    breaks
        who breaks, if the break matters and the format does not say.

    Returns
    -------
    tuple of Crossing
        by increasing p1. If the break does not matter, there is exactly one.

    Raises
    ------
    InputError
        if a parameter is invalid, both `p2` and `break_odds` are
        given, or the break matters and the break format is missing.

    Notes
    -----
    Source: problem P5.7, where 4:2 is even at .686. `Crossings.exact` says what may be missed
    if the break matters.

    >>> [round(point.p1, 7) for point in even_probability("4:2")]
    [0.6861898]
    >>> even_probability("5:1", p2=0.9, breaks="alternate")
    ()
    """
    line = _Line(p2, break_odds, breaks, first_breaker)
    match = _read(played)
    if not line.break_matters and degree_of(match) <= _HIGHEST_DEGREE:
        win, lose = win_forms(match)
        roots = form_roots([x - y for x, y in zip(win, lose, strict=True)]) or []
    else:
        roots, _ = _changes_of_sign(partial(line.log_odds, match))
    return tuple(line.point(match, p1) for p1 in roots)


def crossings(
    format_1: MatchFormat | str,
    format_2: MatchFormat | str,
    *,
    p2: float | None = None,
    break_odds: float | None = None,
    breaks: BreakFormat | str | None = None,
    first_breaker: int = 1,
) -> Crossings:
    """Return every game probability at which two matches give player 1 the same chance.

    Parameters
    ----------
    format_1, format_2
        match formats, or strings such as "2:1" (see `match_format`).
    p2, break_odds, breaks, first_breaker
        as for `even_probability`.

    Raises
    ------
    InputError
        as `even_probability` does.

    Notes
    -----
    Source: problem P5.7, whose curves 2:1 and 4:2 cross at p = .6404 (.641 is printed).

    >>> found = crossings("2:1", "4:2")
    >>> [round(p, 6) for p in found.points[0] if p is not None], found.better, found.exact
    ([0.640388, 0.410097], (1, 2), True)
    >>> crossings("5:5, winner breaks", "5:5, loser breaks", p2=0.7).better
    (0,)
    """
    line = _Line(p2, break_odds, breaks, first_breaker)
    first, second = _read(format_1), _read(format_2)
    exact = not line.break_matters and degree_of(first) + degree_of(second) <= _HIGHEST_DEGREE
    if exact:
        form = _difference(first, second)
        roots = form_roots(form) or []
        ends = [0.0, *roots, 1.0] if any(form) else []
        signs = [sign_at(form, 0.5 * (low + high)) for low, high in pairwise(ends)]
    else:
        roots, signs = _changes_of_sign(partial(line.difference, first, second))
    better = tuple(1 if sign > 0 else 2 for sign in signs) or (0,)
    return Crossings(tuple(line.point(first, p1) for p1 in roots), better, exact)


def rack_along(p1: Any, *, p2: float | None = None, break_odds: float | None = None) -> Rack:
    """Return the rack that `crossings` compares at p1, a number or an array.

    >>> rack_along(0.6, break_odds=2.25)
    Rack(p1=0.6, p2=0.6)
    """
    if p2 is not None:
        if break_odds is not None:
            raise InputError("p2 and break_odds can't both stay fixed. Leave one out.")
        return Rack(p1, number_probability(p2, "p2"))
    if break_odds is None:
        return Rack(p1)
    if not 0.0 < break_odds < np.inf:
        raise InputError(
            "{break_odds} must be a finite number above 0; you gave {value!r}", value=break_odds
        )
    lost = break_odds * (1.0 - np.asarray(p1))
    return Rack(p1, lost / (lost + p1))


def _read(played: MatchFormat | str) -> MatchFormat:
    return played if isinstance(played, MatchFormat) else match_format(played)


def _difference(first: MatchFormat, second: MatchFormat) -> Form:
    """Return a form with the sign of W in the first match minus W in the second."""
    (win_1, lose_1), (win_2, lose_2) = win_forms(first), win_forms(second)
    pairs = zip(product(win_1, lose_2), product(win_2, lose_1), strict=True)
    return [x - y for x, y in pairs]


@dataclass(frozen=True)
class _Line:
    """The pairs of players for whom matches are compared: one pair for each p1."""

    p2: float | None
    break_odds: float | None
    breaks: BreakFormat | str | None
    first_breaker: int

    def __post_init__(self) -> None:
        one_of(self.first_breaker, "first_breaker", (1, 2))
        if isinstance(self.breaks, str):
            one_of(self.breaks, "breaks", tuple(BREAK_FORMATS))
        rack_along(0.5, p2=self.p2, break_odds=self.break_odds)

    @property
    def break_matters(self) -> bool:
        return self.p2 is not None or self.break_odds is not None

    def match(self, played: MatchFormat, p1: Any) -> Match:
        rack = rack_along(p1, p2=self.p2, break_odds=self.break_odds)
        breaks = BREAK_FORMATS[self.breaks] if isinstance(self.breaks, str) else self.breaks
        return played.match(rack, breaks=breaks, first_breaker=self.first_breaker)

    def log_odds(self, played: MatchFormat, p1: Any) -> Any:
        """Return the log-odds of the match, accurate in both tails; NaN where a chance is 0."""
        if p1 is _P1:
            return _log_odds_on_grid(self, played)
        match = self.match(played, p1)
        wins = [np.asarray(win_probability(match, player=player)) for player in (1, 2)]
        of_1, of_2 = (np.log(win, out=np.full(win.shape, np.nan), where=win > 0.0) for win in wins)
        return of_1 - of_2

    def difference(self, first: MatchFormat, second: MatchFormat, p1: Any) -> Any:
        return self.log_odds(first, p1) - self.log_odds(second, p1)

    def point(self, played: MatchFormat, p1: float) -> Crossing:
        match = self.match(played, p1)
        return Crossing(p1, rack_in(match).p2, win_probability(match))


@lru_cache(maxsize=64)
def _log_odds_on_grid(line: _Line, played: MatchFormat) -> Any:
    """Return the log-odds of a match on the grid, calculated once for all comparisons."""
    return line.log_odds(played, _P1.copy())


def _changes_of_sign(function: Callable[[Any], Any]) -> tuple[list[float], list[int]]:
    """Return where a function of p1 changes sign, and its signs in between; empty if all is noise.

    The signs are those on the grid: halfway between two zeros both probabilities may underflow.
    """
    values = function(_P1)
    clear = np.abs(values) > _NOISE  # false for NaN too
    if not clear.any():
        return [], []
    places, signs = _P1[clear], np.sign(values[clear]).astype(int)
    turns = np.flatnonzero(signs[1:] != signs[:-1])
    roots = [
        float(brentq(function, places[i], places[i + 1], xtol=1e-14, rtol=1e-14)) for i in turns
    ]
    return roots, [int(signs[0]), *signs[turns + 1].tolist()]


_FINEST = 48
"""Number of halvings after which zeros that are still together count as one."""
_BITS = 64
"""Number of halvings of an interval with one zero: more than a float can resolve."""


def form_roots(form: Sequence[int]) -> list[float] | None:
    """Return the zeros of a form in 0 < p < 1, ascending; None if it is zero everywhere.

    Zeros closer together than 2^-48 count as one.

    >>> form_roots([-1, 1]), form_roots([1, 1]), form_roots([0, 0])
    ([0.5], [], None)
    """
    if not any(form):
        return None
    roots: list[float] = []
    queue = [(_stripped(list(form)), 0, 0)]
    while queue:
        part, place, depth = queue.pop()
        changes = _changes(part)
        if changes == 1:
            roots.append(_refined(part, place, depth))
        elif changes and depth == _FINEST:
            roots.append((place + 0.5) / 2**depth)
        elif changes:
            left, right = _halves(part)
            if right[0] == 0:
                roots.append((2 * place + 1) / 2 ** (depth + 1))
            queue.append((_stripped(left), 2 * place, depth + 1))
            queue.append((_stripped(right), 2 * place + 1, depth + 1))
    return sorted(roots)


def sign_at(form: Sequence[int], p: float) -> int:
    """Return the sign of a form at p: -1, 0 or 1, exactly.

    >>> sign_at([-1, 1], 0.5), sign_at([-1, 1], 0.5000000000000001)
    (0, 1)
    """
    numerator, denominator = p.as_integer_ratio()
    value = value_at(form, numerator, denominator - numerator)
    return (value > 0) - (value < 0)


def _stripped(form: Form) -> Form:
    """Return the form without its factors p and q, which are zero only at the ends."""
    places = [k for k, c in enumerate(form) if c]
    return form[places[0] : places[-1] + 1]


def _changes(form: Form) -> int:
    signs = [c > 0 for c in form if c]
    return sum(sign != next_sign for sign, next_sign in pairwise(signs))


def _refined(form: Form, place: int, depth: int) -> float:
    """Return the single zero of a form that is written for interval number `place` of 2^depth."""
    low, rising = 0, form[-1] > 0
    for bit in range(1, _BITS + 1):
        low *= 2
        middle = value_at(form, low + 1, 2**bit - low - 1)
        if middle == 0:
            low, bits = low + 1, bit
            break
        low += (middle < 0) == rising
    else:
        low, bits = 2 * low + 1, _BITS + 1
    # A quotient of whole numbers is the nearest float to it.
    return ((place << bits) + low) / (1 << (bits + depth))


def _halves(form: Form) -> tuple[Form, Form]:
    """Return the forms as p and q run over the lower half and over the upper half."""
    left = _moved(form[::-1])[::-1]
    return left, _moved(form)


def _moved(form: Form) -> Form:
    """Return the coefficients of f(1 + 2x), from those of f(x)."""
    shifted = list(form)
    for i in range(len(form) - 1):
        for k in range(len(form) - 2, i - 1, -1):
            shifted[k] += shifted[k + 1]
    return [c << k for k, c in enumerate(shifted)]
