"""Progressive drills: where a player settles, and which level is worth practising."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from evenbreak.chains.limits import limit_of
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.games.drill import Drill
from evenbreak.practice.levels import level_gains, level_lifts
from evenbreak.stats.summary import Distribution


@dataclass(frozen=True)
class DrillStatistics:
    """Where a drill that begins at level 1 settles in the long run.

    Parameters
    ----------
    drill
        the drill.
    distribution
        the distribution of the level attempted: the stochastic limit of the drill, with its
        mean, median, mode and standard deviation.
    gain
        for each level, the derivative of the mean level with respect to the chance of
        success there: raising it by 0.01 lifts the mean by about 0.01 times the gain.
        One-sided where the chance is 0 or 1; inf where the mean jumps; 0 where the level is
        not visited in the long run.
    lift
        for each level, by how much the mean level rises if the chance of success there is
        0.05 higher (or 1, if it is above 0.95 already).
    period
        1 where the distribution is also that of a single late attempt; 2 where odd-numbered
        and even-numbered attempts differ for ever and it is the average of both.
    """

    drill: Drill
    distribution: Distribution
    gain: tuple[float, ...]
    lift: tuple[float, ...]
    period: int

    @property
    def practise_next(self) -> int | None:
        """The level with the greatest lift, the lowest such level; None if all lifts are 0."""
        return int(np.argmax(self.lift)) + 1 if any(self.lift) else None


def drill_statistics(drill: Drill, *, via: Way | None = None) -> DrillStatistics:
    """Return where a drill settles, and what practice at each level is worth.

    Parameters
    ----------
    drill
        P(success | an attempt at level i) for each level; the player begins at level 1.
    via
        the way to the distribution: the closed form for levels in a line ('kernel', or None),
        'elimination' or 'eigen' (see `evenbreak.chains.limit_of`).

    Raises
    ------
    InputError
        if there is no such way.

    Notes
    -----
    Source: P5.26, Fig. 5.8, Table 5.5 and exercise 5.1.

    >>> from evenbreak.games import Drill
    >>> nine_ball = drill_statistics(Drill.progressive(0.8))
    >>> round(nine_ball.distribution.mean, 3), nine_ball.distribution.median
    (4.354, 4)
    >>> nine_ball.practise_next, round(nine_ball.gain[3], 1), round(nine_ball.lift[3], 3)
    (4, 2.3, 0.114)
    """
    limit = limit_of(drill, via=way_of_limit(via))
    levels = range(1, len(drill.success) + 1)
    # The chain has only the levels that can be reached from level 1.
    law = np.array([limit.get(level, 0.0) for level in levels])
    success = np.array(drill.success)
    gain = level_gains(success, law)
    return DrillStatistics(
        drill,
        Distribution(tuple(levels), tuple(law.tolist())),
        tuple(gain.tolist()),
        tuple(level_lifts(success).tolist()),
        limit.period,
    )
