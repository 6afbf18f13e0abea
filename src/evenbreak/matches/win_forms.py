"""The chance of winning as polynomials in p and q = 1 - p, if the break does not matter.

A form of degree N is the list of coefficients c[k] of p^k q^(N-k), whole numbers. Every match
has two forms without negative coefficients, F1 and F2, and W(p) = F1 / (F1 + F2). For a race
they are sums over its scores, for an n-ahead match those of the gambler's ruin, and a match of
sets has the forms of the set in place of p and q. Questions about W become questions about the
signs of whole numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from math import comb

from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.formats import MatchFormat

Form = list[int]
WinForms = tuple[Form, Form]


def win_forms(played: MatchFormat) -> WinForms:
    """Return the forms F1 and F2 of a match: P(player 1 wins) = F1 / (F1 + F2).

    Notes
    -----
    Source: problems P5.5, P5.8 and P5.27.

    >>> from evenbreak.matches.formats import match_format
    >>> win_forms(match_format("2:1"))
    ([0, 0, 1], [1, 2, 0])
    """
    if played.ahead:
        own = _ahead(played.m, played.n)
    elif played.win_by > 1:
        own = _win_by(played.m, played.n, played.win_by)
    else:
        last = played.m + played.n - 1
        ways = [comb(last, k) for k in range(last + 1)]
        own = [0] * played.m + ways[played.m :], ways[: played.m] + [0] * played.n
    if played.set_ is None:
        return own
    inside = win_forms(played.set_)
    return _composed(own[0], inside), _composed(own[1], inside)


def degree_of(played: MatchFormat) -> int:
    """Return the degree of the forms of a match.

    >>> from evenbreak.matches.formats import match_format
    >>> degree_of(match_format("3:1 of 3:3"))
    15
    """
    own = played.m + played.n - 1
    if played.win_by > 1 and not played.ahead:
        own += 4 * played.win_by
    return own * (degree_of(played.set_) if played.set_ else 1)


def product(one: Form, two: Form) -> Form:
    """Return the product of two forms.

    >>> product([1, 1], [1, 1])
    [1, 2, 1]
    """
    result = [0] * (len(one) + len(two) - 1)
    for i, x in enumerate(one):
        if x:
            for j, y in enumerate(two):
                result[i + j] += x * y
    return result


def value_at(form: Sequence[int], p: int, q: int) -> int:
    """Return the value of a form, exactly.

    >>> value_at([1, 2, 0], 1, 3)
    15
    """
    value, power = 0, 1
    for coefficient in form:  # Horner's rule in q, with the powers of p collected on the way
        value, power = value * q + coefficient * power, power * p
    return value


def _ahead(m: int, n: int) -> WinForms:
    return [0] * m + [1] * n, [1] * m + [0] * n


def _win_by(m: int, n: int, by: int) -> WinForms:
    """Return the forms of a race win-by-K: ways to reach a score, times what follows it."""
    race = Race(m, n, Rack(0.5), win_by=by)
    over = [1] * (2 * by)
    ways = {(0, 0): 1}
    ends: list[tuple[int, int, int, WinForms]] = []
    while ways:
        after: dict[tuple[int, int], int] = {}
        for (a, b), count in ways.items():
            winner = race.decided(a, b)
            if winner is not None:
                ends.append((a, b, count, (over, [0]) if winner == 1 else ([0], over)))
            elif a >= m - by and b >= n - by:  # from here on only the lead matters
                lead = (a - m) - (b - n)
                ends.append((a, b, count, _ahead(by - lead, by + lead)))
            else:
                for score in ((a + 1, b), (a, b + 1)):
                    after[score] = after.get(score, 0) + count
        ways = after
    longest = max(a + b for a, b, _, _ in ends)
    result = [0] * (longest + 2 * by), [0] * (longest + 2 * by)
    for a, b, count, forms in ends:
        spare = longest - a - b
        padding = [count * comb(spare, k) for k in range(spare + 1)]
        for total, form in zip(result, forms, strict=True):
            for k, c in enumerate(product(padding, form)):
                total[a + k] += c
    return result


def _composed(outer: Form, inside: WinForms) -> Form:
    """Return a form with the forms of a set in place of p and q."""
    won, lost = inside
    result, power = [0], [1]
    for place, coefficient in enumerate(reversed(outer)):
        if place:
            result, power = product(result, won), product(power, lost)
        term = [coefficient * c for c in power]
        result = [x + y for x, y in zip_longest(result, term, fillvalue=0)]
    return result
