"""How well the rating difference of each pair is known, and what that does to its race."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import pandas as pd

from evenbreak.answers.scale_words import decimals_of
from evenbreak.answers.wording import race
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import Scale


class SurePair(NamedTuple):
    """A pair's rating difference and its error, and P(A wins the race).

    `p_win` is averaged over the error; `low` and `high` are the chances two errors either way.
    """

    player_a: str
    player_b: str
    race: str
    difference: float
    error: float
    p_win: float
    low: float
    high: float


def sure_pairs(paired: pd.DataFrame, scale: Scale) -> list[SurePair]:
    """Return the pairs with a race, the best known first, of a frame of `roster_matchups`."""
    found = []
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        difference, error = pair.difference, pair.difference_error
        ends = [scale.win_probability(difference + 2 * side * error) for side in (-1, 1)]
        low, high = race_win_probability(ends, pair.race_a, pair.race_b).tolist()
        needs = race((pair.race_a, pair.race_b))
        found.append(
            SurePair(
                pair.player_a, pair.player_b, needs, difference, error, pair.p_win_a, low, high
            )
        )
    # Rounded, so that the last bits do not decide.
    return sorted(found, key=lambda pair: round(pair.error / scale.points_per_doubling, 9))


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
            f"{' or better' if several else ''}. So a race that looks even may really favour "
            "one of the two:"
        )


def three_pairs(pairs: Sequence[SurePair]) -> list[tuple[str, SurePair]]:
    """Return the best known, a typical and the least known pair, each once."""
    if len(pairs) < 2:
        return [("", pair) for pair in pairs]
    named = {(len(pairs) - 1) // 2: "typical", 0: "best known", len(pairs) - 1: "least known"}
    return [(name, pairs[k]) for k, name in sorted(named.items())]
