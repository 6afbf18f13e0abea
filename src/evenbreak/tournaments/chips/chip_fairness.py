"""How fair a chip chart is, and the chips that make it fairer.

A fair chart gives each of n players the chance 1/n. The simulations that compare charts share their
luck, so differences of a few parts per thousand are real.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.checks import column, whole
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.chips.chip_charts import ChipChart, chip_chart
from evenbreak.tournaments.chips.play import ChipOdds, play_chips, rack_chances

_SEARCH_RUNS = 3_000
_MOST_STEPS = 60


@own_arrays
@dataclass(frozen=True, eq=False)
class ChipFairness:
    """A field's title odds with given chips."""

    ratings: Floats
    chips: Ints
    odds: ChipOdds

    @property
    def edge(self) -> Floats:
        """How many times an equal share each player's title odds are, minus 1: 0 is fair."""
        return np.asarray(len(self.chips) * self.odds.title - 1.0)

    @property
    def edge_error(self) -> Floats:
        """The standard errors of `edge`."""
        error: Floats = len(self.chips) * self.odds.error[:, 0]
        return error

    @property
    def spread(self) -> float:
        """The root mean square of the edges: 0 is fair to everyone."""
        return float(np.sqrt(np.mean(self.edge**2)))


def chip_fairness(
    ratings: ArrayLike,
    chips: ChipChart | str | Sequence[int],
    *,
    scale: Scale | str | float = "fargo",
    break_advantage: float = 0.0,
    tables: int = 1,
    runs: int = 10_000,
    seed: int = 0,
) -> ChipFairness:
    """Return how fair a chip chart is to a field of players.

    Parameters
    ----------
    chips
        the chart, its name, or each player's chips.
    scale, break_advantage
        as in `rack_chances`.
    tables, runs
        as in `play_chips`.
    seed
        two charts with the same seed get the same luck.

    >>> found = chip_fairness([650, 500, 400, 350], "hoboken")
    >>> found.chips, found.edge.round(1)
    (array([4, 6, 7, 8]), array([ 1.5, -0.3, -0.7, -0.5]))
    """
    rated = column(ratings, "ratings", np.size(ratings), "players")
    given = chip_chart(chips).chips(rated) if isinstance(chips, str | ChipChart) else chips
    counts = column(given, "chips", len(rated), "players", dtype=np.int64)
    racks = rack_chances(rated, scale=scale, break_advantage=break_advantage)
    rng = np.random.default_rng(seed)
    odds = play_chips(counts, racks, tables=tables, runs=runs, rng=rng)
    return ChipFairness(rated, counts, odds)


def fairest_chips(
    ratings: ArrayLike,
    *,
    bands: Sequence[float] | None = None,
    fewest: int = 2,
    most: int = 10,
    scale: Scale | str | float = "fargo",
    break_advantage: float = 0.0,
    tables: int = 1,
    runs: int = 10_000,
    seed: int = 0,
) -> ChipFairness:
    """Return the chips that make a field's title odds as equal as a search can make them.

    Parameters
    ----------
    bands
        the ratings at which chart rows start, not counting the lowest row; players in one row have
        the same chips. None: a row for each rating.
    fewest, most
        the fewest and the most chips a player can have. More chips make a longer and fairer event.
    scale, break_advantage, tables, runs, seed
        as in `chip_fairness`.

    Notes
    -----
    It starts in the middle of the range and moves one chip at a time, up for the row that is worst
    off or down for the row that is best off, and then for all weaker or all stronger rows together,
    as long as the spread of the title odds gets smaller. Stronger players never have more chips
    than weaker players.

    >>> found = fairest_chips([650, 500, 400, 350], most=8, runs=4000)
    >>> bool(found.spread < chip_fairness([650, 500, 400, 350], "hoboken").spread)
    True
    """
    rated = column(ratings, "ratings", np.size(ratings), "players")
    low, high = whole(fewest, "fewest", at_least=1), whole(most, "most", at_least=1)
    if low > high or len(rated) < 2:
        raise InputError(
            "{fewest} is {value!r} and most is {most!r}. {fewest} can't be larger, and there "
            "must be at least two players.",
            value=fewest,
            most=most,
        )
    row = _rows_of(rated, bands)
    counts = np.full(row.max() + 1, (low + high) // 2)

    def tried(chips: Ints, runs: int) -> ChipFairness:
        return chip_fairness(
            rated,
            chips[row].tolist(),
            scale=scale,
            break_advantage=break_advantage,
            tables=tables,
            runs=runs,
            seed=seed,
        )

    best = tried(counts, _SEARCH_RUNS)
    for _ in range(_MOST_STEPS):
        for chips in _steps(counts, row, best.edge, low, high):
            found = tried(chips, _SEARCH_RUNS)
            if found.spread < best.spread:
                best, counts = found, chips
                break
        else:
            break
    return tried(counts, runs)


def _rows_of(ratings: Floats, bands: Sequence[float] | None) -> Ints:
    """Return each player's row, 0 for the weakest."""
    if bands is None:
        _, row = np.unique(ratings, return_inverse=True)
        return row.astype(np.int64)
    starts = np.sort(np.asarray(bands, dtype=float))
    place = np.searchsorted(starts, ratings, side="right")
    _, row = np.unique(place, return_inverse=True)  # rows without players are left out
    return row.astype(np.int64)


def _steps(counts: Ints, row: Ints, edge: Floats, low: int, high: int) -> list[Ints]:
    """Return the charts one chip away, most promising first."""
    of_row = np.bincount(row, edge) / np.bincount(row)
    found = []
    for k in np.argsort(-np.abs(of_row)).tolist():
        step = -1 if of_row[k] > 0.0 else 1
        chips = counts.copy()
        chips[k] += step
        # Rows beyond it move along where they would stand against their rating.
        if step < 0:
            chips[k:] = np.minimum(chips[k:], chips[k])
        else:
            chips[: k + 1] = np.maximum(chips[: k + 1], chips[k])
        found.append(chips)
    for k in range(1, len(counts)):  # the weaker or the stronger rows together
        for rows in (slice(None, k), slice(k, None)):
            for step in (-1, 1):
                chips = counts.copy()
                chips[rows] += step
                found.append(chips)
    return [
        chips
        for chips in found
        if low <= chips.min() and chips.max() <= high and (np.diff(chips) <= 0).all()
    ]
