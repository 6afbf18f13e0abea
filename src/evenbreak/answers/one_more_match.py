"""Where two players stand, and where one more match between them would take them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from evenbreak.answers.fair_pairs import matchups_frame
from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results

Refit = Callable[[Results], Ratings]
"""Rates other results in the same way."""


@dataclass(frozen=True)
class Standing:
    """Two ratings, and the fairest race between them; no race where they cannot be compared."""

    ratings: tuple[float, float]
    difference_error: float | None
    race: tuple[int, int] | None
    p_win: float | None

    @classmethod
    def of(cls, ratings: Ratings, pair: tuple[int, int], offered: OfferedRaces) -> Standing:
        """Return where two players stand (positions in `ratings.players`)."""
        both = float(ratings.rating[pair[0]]), float(ratings.rating[pair[1]])
        (row,) = matchups_frame(ratings, pair, offered).to_dict("records")
        if row["note"] and not row["p_win_a"] >= 0.0:  # not a number: there is no race
            return cls(both, None, None, None)
        needs, p_win = (int(row["race_a"]), int(row["race_b"])), float(row["p_win_a"])
        if row["player_a"] != ratings.players[pair[0]]:
            needs, p_win = needs[::-1], 1.0 - p_win
        return cls(both, float(row["difference_error"]), needs, p_win)


@dataclass(frozen=True)
class OneMore:
    """One more match between the two: who wins it how, and where they stand then."""

    winner: str
    score: str
    then: Standing


def one_more_match(
    results: Results,
    ratings: Ratings,
    pair: tuple[int, int],
    now: Standing,
    offered: OfferedRaces,
    refit: Refit,
) -> list[OneMore]:
    """Return what changes if either wins their fair race by the most likely score."""
    if now.race is None:
        return []
    p = ratings.scale.win_probability(now.ratings[0] - now.ratings[1])
    day = ratings.as_of
    if day is None and results.date is not None:
        day = np.fmax.reduce(results.date[results.counted])
    found = []
    for winner in (0, 1):
        needs, other = now.race[winner], now.race[1 - winner]
        score = (needs, _likeliest_loss(needs, other, 1.0 - p if winner == 0 else p))
        a_first = score if winner == 0 else score[::-1]
        again = refit(results.with_match(*pair, *a_first, date=day))
        then = replace(again, form=ratings.form)
        found.append(
            OneMore(
                ratings.players[pair[winner]],
                f"{score[0]}-{score[1]}",
                Standing.of(then, pair, offered),
            )
        )
    return found


def _likeliest_loss(needs: int, other: int, p_loser: float) -> int:
    """Return the games that the loser most likely has when the winner gets the last of `needs`.

    >>> _likeliest_loss(7, 7, 0.5), _likeliest_loss(7, 5, 0.2)
    (6, 1)
    """
    return max(range(other), key=lambda k: math.comb(needs - 1 + k, k) * p_loser**k + k * 1e-12)
