"""Odds before a redraw: the losers' qualifiers are drawn to those of the winners' side."""

from __future__ import annotations

from itertools import permutations
from math import factorial
from typing import Any

import numpy as np

from evenbreak.checks import whole
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.double import losers_qualifiers, redrawn
from evenbreak.tournaments.brackets.standing import Results
from evenbreak.tournaments.odds.chances import Wins
from evenbreak.tournaments.odds.title import PlaceOdds, title_odds

_ALL = 24


def redraw_odds(
    bracket: Bracket,
    win: Wins,
    *,
    results: Results | None = None,
    samples: int = 40,
    rng: np.random.Generator | None = None,
    **asked: Any,
) -> PlaceOdds:
    """Return who finishes where if the losers' qualifiers are still to be drawn.

    Parameters
    ----------
    bracket
        a double elimination down to qualifiers; how its losers' qualifiers are placed does not
        matter.
    win, results
        as in `title_odds`, before the knock-out begins.
    samples
        how many redraws are sampled if there are more than 24.
    rng
        where pseudo-random numbers come from then; None: a generator with the seed 0.
    asked
        other parameters of `title_odds`.

    Raises
    ------
    InputError
        if the bracket has no such qualifiers.

    >>> from evenbreak.tournaments import double_elimination
    >>> coin = np.full((8, 8), 0.5)
    >>> odds = redraw_odds(double_elimination(8, qualifiers=4), coin)
    >>> odds.title.round(3).tolist(), odds.samples
    ([0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125], 0)
    """
    qualifiers = losers_qualifiers(bracket)
    if factorial(len(qualifiers)) <= _ALL:
        orders = list(permutations(qualifiers))
    else:
        rng = rng or np.random.default_rng(0)
        many = whole(samples, "samples", at_least=2)
        seats = [rng.permutation(len(qualifiers)).tolist() for _ in range(many)]
        orders = [tuple(qualifiers[k] for k in seat) for seat in seats]
    found = [title_odds(redrawn(bracket, order), win, results=results, **asked) for order in orders]
    laws = np.stack([odds.p_place for odds in found])
    inner = np.stack([odds.error for odds in found])
    variance = (inner**2).mean(axis=0) / len(found)
    if len(orders) < factorial(len(qualifiers)):
        variance = laws.var(axis=0, ddof=1) / len(found)
    samples = 0 if not variance.any() else max(len(orders), sum(odds.samples for odds in found))
    return PlaceOdds(bracket, laws.mean(axis=0), np.sqrt(variance), samples)
