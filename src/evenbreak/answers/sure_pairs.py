"""How well the rating difference of each pair is known, and what that does to its race."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak.answers.scale_words import decimals_of
from evenbreak.answers.wording import race
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd


class SurePair(NamedTuple):
    """A pair's rating difference, and P(A wins the race) there and two errors either way."""

    player_a: str
    player_b: str
    race: str
    difference: float
    error: float
    p_win: float
    low: float
    high: float


def sure_pairs(ratings: Ratings, paired: pd.DataFrame) -> list[SurePair]:
    """Return the pairs with a race, the best known first.

    The errors of two ratings in one league are partly shared and cancel, so the standard
    error of a difference is smaller than the two errors suggest.
    """
    names = sorted({*paired["player_a"], *paired["player_b"]})
    covariance = ratings.covariance(names)
    row = {name: k for k, name in enumerate(names)}
    rating = dict(zip(ratings.players, ratings.rating.tolist(), strict=True))
    found = []
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        a, b = row[pair.player_a], row[pair.player_b]
        difference = rating[pair.player_a] - rating[pair.player_b]
        error = math.sqrt(covariance[a, a] + covariance[b, b] - 2 * covariance[a, b])
        low, p_win, high = (
            float(race_win_probability(ratings.scale.win_probability(d), pair.race_a, pair.race_b))
            for d in (difference - 2 * error, difference, difference + 2 * error)
        )
        needs = race((pair.race_a, pair.race_b))
        found.append(
            SurePair(pair.player_a, pair.player_b, needs, difference, error, p_win, low, high)
        )
    # Rounded, so that the last bits do not decide.
    return sorted(found, key=lambda pair: round(pair.error / ratings.scale.points_per_doubling, 9))


def how_sure(scale: Scale, pairs: Sequence[SurePair]) -> Iterator[str]:
    """Yield what the standard errors mean for a rating and for a race."""
    yield (
        "Each bar reaches two standard errors either side of the rating. If the model below "
        "holds, a player's true strength lies within the bar about 19 times in 20."
    )
    if pairs:
        middle = pairs[(len(pairs) - 1) // 2]
        several = len(pairs) > 1
        yield (
            f"{'For half of the pairs, the' if several else 'The'} rating difference is known to "
            f"within {2 * middle.error:.{decimals_of(scale)}f} points (two standard errors)"
            f"{' or better' if several else ''}. So a race that looks even may in truth favour "
            "one of the two:"
        )


def three_pairs(pairs: Sequence[SurePair]) -> list[tuple[str, SurePair]]:
    """Return the best known, a typical and the least known pair, each once."""
    if len(pairs) < 2:
        return [("", pair) for pair in pairs]
    named = {(len(pairs) - 1) // 2: "typical", 0: "best known", len(pairs) - 1: "least known"}
    return [(name, pairs[k]) for k, name in sorted(named.items())]
