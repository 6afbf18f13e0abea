"""The races nearest to a target, when the ratings of the two players have errors."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenbreak.checks import number, probability, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.fair import Candidate, FairRace, longest_matches, shortest_of_ties
from evenbreak.handicaps.charts.given_ratings import length_given_ratings, win_given_ratings
from evenbreak.ratings.scale import scale_of
from evenbreak.ratings.unstated_scale import DEFAULT_SCALE

MOST_RACES = 20_000
"""Races among which the nearest are sought: all of up to 200 games."""


def nearest_races_given_ratings(
    difference: float,
    standard_error: float,
    *,
    games: tuple[int, int] | None = None,
    race_to: int | None = None,
    target: float = 0.5,
    top: int = 5,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> list[FairRace]:
    """Return the races in which player 1's chance is nearest to `target`, the nearest first.

    Chances and lengths are averaged over the possible differences; the first race is that of
    `fair_races_given_ratings`.

    Parameters
    ----------
    difference, standard_error, scale, form
        as for `win_given_ratings`.
    games, race_to, target, top
        as for `fair_races`.

    Raises
    ------
    InputError
        if a parameter is out of range, not exactly one of `games` and `race_to` is given, or
        more than 20,000 races are offered.

    >>> for race in nearest_races_given_ratings(91, 80, race_to=7, top=2, scale="fargo"):
    ...     print(race.race_1, race.race_2, round(race.p_win_1, 3), round(race.mean_games, 2))
    7 4 0.512 8.06
    7 3 0.372 6.81
    """
    scale, difference = scale_of(scale), number(difference, "difference")
    target, top = probability(target, "target"), whole(top, "top", at_least=1)
    low, high = longest_matches(games, race_to)
    if race_to is not None:
        other = np.arange(1, low + 1)
        own = np.full(low, low)
        m, n = (own, other) if difference >= 0.0 else (other, own)
    else:
        if (many := (high * (high + 1) - low * (low - 1)) // 2) > MOST_RACES:
            raise InputError(
                f"games {low}..{high} offers {many:,} races, and {MOST_RACES:,} are the most; give "
                "fewer games"
            )
        longest = np.repeat(np.arange(low, high + 1), np.arange(low, high + 1))
        m = np.concatenate([np.arange(1, games + 1) for games in range(low, high + 1)])
        n = longest + 1 - m
    way: dict[str, Any] = {"scale": scale, "form": form}
    chances = win_given_ratings(difference, standard_error, m, n, **way)
    rows = zip(np.abs(chances - target).tolist(), m.tolist(), n.tolist(), strict=True)
    ordered = shortest_of_ties(
        sorted(Candidate(away, one + two - 1, one, two) for away, one, two in rows)
    )
    found = []
    for _, _, one, two in ordered[:top]:
        length = length_given_ratings(difference, standard_error, one, two, **way)
        p_win = win_given_ratings(difference, standard_error, one, two, **way)
        found.append(FairRace(one, two, p_win, length.mean, length.quantile(0.9) or 0))
    return found
