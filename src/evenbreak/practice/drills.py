"""Progressive drills: where a player settles, and which level is worth practicing.

The levels of a drill are in a line, so between two levels that communicate, as many attempts go up
as down, law[i] p[i] = law[i + 1] q[i + 1], and the long-run distribution is a product of quotients.
The gain of a level follows from the climbs D[i] = h[i + 1] - h[i], where h[i] is the total lead
over the long-run mean, summed over all time, for a player who is now at level i:

    q[i] D[i - 1] - p[i] D[i] = i - mean,    D[0] = D[n] = 0,
    d mean / d p[i] = law[i] (D[i - 1] + D[i]).

The climbs are solved from the top for levels above the mean, from the bottom for those below:
then all terms are positive and no digits are lost.

References: Schweitzer 1968; Karlin and McGregor 1957.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.chains.limits import limit_of
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.games.drill import Drill
from evenbreak.stats.summary import Distribution


@dataclass(frozen=True)
class DrillStatistics:
    """Long-run behavior of a drill that starts at level 1.

    Parameters
    ----------
    distribution
        the distribution of the level attempted: the stochastic limit of the drill, with its
        mean, median, mode and standard deviation.
    gain
        for each level, the derivative of the mean level with respect to the chance of
        success there: raising it by 0.01 lifts the mean by about 0.01 times the gain.
        It is one-sided if the chance is 0 or 1, inf if the mean jumps, and 0 if the level is not
        visited in the long run.
    lift
        for each level, the rise in the mean level if the chance of success there is 0.05 higher (or
        1, if it is already above 0.95).
    period
        1 if the distribution also holds for a single late attempt; 2 if odd-numbered and
        even-numbered attempts differ forever, and it is their average.
    """

    drill: Drill
    distribution: Distribution
    gain: tuple[float, ...]
    lift: tuple[float, ...]
    period: int

    @property
    def practice_next(self) -> int | None:
        """The level with the greatest lift, the lowest such level; None if all lifts are 0."""
        return int(np.argmax(self.lift)) + 1 if any(self.lift) else None


def drill_statistics(drill: Drill, *, via: Way | None = None) -> DrillStatistics:
    """Return the long run of a drill, and the value of practice at each level.

    Parameters
    ----------
    drill
        P(success | an attempt at level i) for each level; the player starts at level 1.
    via
        the method: the closed form for levels in a line ('kernel', or None), 'elimination' or
        'eigen' (see `evenbreak.chains.limit_of`).

    Raises
    ------
    InputError
        if `via` is unknown.

    Notes
    -----
    Source: P5.26, Fig. 5.8, Table 5.5 and exercise 5.1.

    >>> from evenbreak.games import Drill
    >>> nine_ball = drill_statistics(Drill.progressive(0.8))
    >>> round(nine_ball.distribution.mean, 3), nine_ball.distribution.median
    (4.354, 4)
    >>> nine_ball.practice_next, round(nine_ball.gain[3], 1), round(nine_ball.lift[3], 3)
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


MORE = 0.05
"""The increase in a chance by which levels are compared: five more successes in 100."""


def chances_seen(attempts: Ints, successes: Ints) -> Floats:
    """Return the success rate at each level, with a convention for untried levels.

    Untried levels below all those tried count as always succeeding: a player who starts at level 4
    and never falls below 3 would not get stuck at level 1. All others count as never succeeding.
    Counts have shape (..., n), one log per row.

    >>> chances_seen(np.array([0, 2, 4, 0]), np.array([0, 2, 1, 0]))
    array([1.  , 1.  , 0.25, 0.  ])
    """
    tried = attempts > 0
    below_all = ~np.logical_or.accumulate(tried, axis=-1)
    return np.where(tried, successes / np.maximum(attempts, 1), below_all)


def level_laws(success: Floats) -> Floats:
    """Return the limits of drills that start at level 1: the long-run share of each level.

    `success` is P(success | an attempt at level i), shape (..., n), one drill per row.
    """
    n = success.shape[-1]
    level = np.arange(n)
    failure = 1.0 - success
    # The player stays between the last level that always succeeds and the first that never does.
    stuck = success == 0.0
    last = np.where(stuck.any(-1), stuck.argmax(-1), n - 1)[..., None]
    sure = (failure == 0.0) & (level > 0) & (level <= last)
    first = np.where(sure, level, 0).max(-1, keepdims=True)
    up, down = success[..., :-1], failure[..., 1:]
    moves = (up > 0.0) & (down > 0.0)
    steps = np.zeros_like(success)
    with np.errstate(divide="ignore", invalid="ignore"):
        steps[..., 1:] = np.where(moves, np.log(up) - np.log(down), 0.0)
    height = np.where((first <= level) & (level <= last), steps.cumsum(-1), -np.inf)
    law = np.exp(height - height.max(-1, keepdims=True))
    return np.asarray(law / law.sum(-1, keepdims=True))


def level_gains(success: Floats, law: Floats) -> Floats:
    """Return the derivative of the mean level with respect to the chance at each level.

    At a chance of 0 or 1 it is one-sided. It is inf if the mean jumps (level i never succeeds and
    level i + 1 always does), and 0 at levels not visited in the long run. Shapes are as in
    `level_laws`.

    >>> success = np.array([0.5, 0.5])
    >>> level_gains(success, level_laws(success))
    array([0.5, 0.5])
    """
    n = success.shape[-1]
    failure = 1.0 - success
    mean = law @ np.arange(1.0, n + 1)
    climb = np.zeros((*mean.shape, n + 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        for i in range(n, 1, -1):
            p, q = success[..., i - 1], failure[..., i - 1]
            above = np.where(p > 0.0, p * climb[..., i], 0.0)
            climb[..., i - 1] = np.where(i > mean, (i - mean + above) / q, 0.0)
        for i in range(1, n):
            p, q = success[..., i - 1], failure[..., i - 1]
            from_below = (mean - i + q * climb[..., i - 1]) / p
            climb[..., i] = np.where(i + 1 > mean, climb[..., i], from_below)
        gain = law * (climb[..., :-1] + climb[..., 1:])
    return np.where(law > 0.0, gain, 0.0)


def level_lifts(success: Floats) -> Floats:
    """Return how much the mean level rises with five more successes in 100 at each level.

    Each entry is the rise if only the chance at that level is 0.05 higher (or 1, if it is already
    above 0.95), so it is 0 for a level that always succeeds. The shape is as in `level_laws`.

    >>> level_lifts(np.array([1.0, 0.5])).round(6)
    array([0.      , 0.022989])
    """
    level = np.arange(1.0, success.shape[-1] + 1)
    mean = level_laws(success) @ level
    lifts = np.zeros_like(success)
    for i in range(len(level)):
        more = success.copy()
        more[..., i] = np.minimum(more[..., i] + MORE, 1.0)
        lifts[..., i] = level_laws(more) @ level - mean
    # A rise smaller than rounding may come out negative.
    return np.maximum(lifts, 0.0)
