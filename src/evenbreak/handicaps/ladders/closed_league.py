"""Closed leagues, which no one joins or leaves.

A ladder has an endless supply of opponents whose errors are independent of the player's own. In a
closed league, every point that one player wins is a point that another loses, and players who
started together move together:

- two players who meet only each other: the sum of their ratings stays the same, so the two errors
  are opposite, and the rating difference is a chain on a line;
- many players who started with the right ratings and all play every night: with moves of one
  point either way all errors are even after an even number of nights and odd after an odd one, so
  rating differences are always even.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.ladders.error_chain import error_on
from evenbreak.handicaps.ladders.error_walk import long_run_law
from evenbreak.handicaps.systems.catalog import steps_of
from evenbreak.handicaps.systems.match_table import MatchTable, match_table
from evenbreak.stats.summary import Distribution

_SETTLED = 1e-14
_ROUNDS = 1000


@dataclass(frozen=True)
class ClosedPair:
    """Two players who play only each other, match after match.

    This is a game without an end: a state is player 1's rating minus player 2's, in whole points,
    from -widest to widest; a match that would go beyond that range moves no one.

    Parameters
    ----------
    system
        how the ratings move: a `System` or its name.
    chart
        the races by rating difference; None: the system's own chart.
    skill_difference
        player 1's skill minus player 2's, in points.
    start
        the rating difference at the start, in whole points.
    widest
        the largest difference, in points; None: the default of `match_table`.

    Raises
    ------
    InputError
        if there is no such system, or a number has an invalid value.

    Notes
    -----
    For a pair of equal players who start with equal ratings, the standard deviation is 3.04 on
    chart 10, compared with 4.63 for an open ladder: one player is overrated by as much as the other
    is underrated, so the chart sees twice the error.

    >>> from evenbreak.handicaps import chart
    >>> pair = ClosedPair("npl", chart("npl_10"))
    >>> round(pair.moves(0)[2], 3), round(pair.moves(6)[8], 3)
    (0.5, 0.363)
    >>> round(pair.error_law().sd, 2)
    3.04
    """

    system: Any
    chart: Chart | str | None = None
    _: KW_ONLY
    skill_difference: float = 0.0
    start: int = 0
    widest: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "system", steps_of(self.system))
        object.__setattr__(self, "skill_difference", float(self.skill_difference))
        if not np.isfinite(self.skill_difference):
            raise InputError(
                "{skill_difference} must be a finite number of points; you gave {value!r}",
                value=self.skill_difference,
            )
        begun = error_on(self.table.widest, self.start, "rating difference")
        object.__setattr__(self, "start", begun)

    @cached_property
    def table(self) -> MatchTable:
        """The possible matches, by rating difference."""
        return match_table(self.system, self.chart, widest=self.widest)

    @cached_property
    def _chances(self) -> Floats:
        return self.table.chances(self.system.scale.win_probability(self.skill_difference))

    def moves(self, state: int) -> Mapping[int, float]:
        """Return the probability of each next rating difference, given the difference `state`.

        Raises
        ------
        InputError
            if the state is beyond an end.
        """
        size = self.table.widest
        if not -size <= state <= size:
            raise InputError(
                "{state} must be a rating difference from {size} to {size_2}; you gave {value!r}",
                value=state,
                size=-size,
                size_2=size,
            )
        apart = self.table.moves[state + size] @ [1, -1]
        led_to = np.where(np.abs(state + apart) > size, state, state + apart)
        nexts, place = np.unique(led_to, return_inverse=True)
        chances = np.bincount(place.reshape(-1), self._chances[state + size])
        return {
            int(after): float(chance)
            for after, chance in zip(nexts, chances, strict=True)
            if chance > 0.0
        }

    def winner(self, state: int) -> None:  # noqa: ARG002
        """Return None: the two players go on forever."""
        return

    def law(self) -> Distribution:
        """Return the stochastic limit of the rating difference, from `start`."""
        limit: dict[Any, float] = dict(stochastic_limit(chain_of(self)))
        ordered = sorted(limit.items())
        return Distribution(tuple(x for x, _ in ordered), tuple(chance for _, chance in ordered))

    def error_law(self) -> Distribution:
        """Return the stochastic limit of player 1's rating error, in points.

        The sum of the two ratings is assumed to equal the sum of the two skills, so player 2's
        error is the opposite of player 1's.

        Raises
        ------
        InputError
            if the sum of the ratings changes under the system.
        """
        if not self.system.conserving:
            raise InputError(
                "{system} is {name}, but in that system a match can change the sum of the two "
                "ratings. Use law(), the distribution of their difference.",
                name=self.system.name,
            )
        law = self.law()
        errors = tuple((float(x) - self.skill_difference) / 2.0 for x in law.values)
        return Distribution(errors, law.probability)


def in_step_law(
    system: Any, chart: Chart | str | None = None, *, widest: Any = None
) -> Distribution:
    """Return the rating errors in a closed league whose players all started correctly rated.

    Many equal players start with the right ratings, and every night all of them play someone
    drawn at random. Two errors share only their parity: given a player's error, the opponent's
    differs from it by an even number of steps.

    Parameters
    ----------
    system, chart
        as in `ClosedPair`.
    widest
        errors range from -widest to widest points; None: the default of `match_table`.

    Raises
    ------
    InputError
        if moves may be even multiples of the smallest step, so that nothing keeps the players
        in step, or the sum of ratings changes under the system.
    AccuracyError
        if the iteration does not converge.

    Notes
    -----
    The result is the symmetric fixed point, as for `Ladder` with equally skilled opponents,
    averaged over even and odd nights.

    >>> from evenbreak.handicaps import chart
    >>> round(in_step_law("npl", chart("npl_10")).sd, 2)
    4.3
    """
    by = steps_of(system)
    size = match_table(by, chart, widest=widest).widest
    table = match_table(by, chart, widest=2 * size)
    steps = np.unique(table.moves[..., 0][table.games[..., 0] >= 0])
    unit = int(np.gcd.reduce(steps))
    if not by.conserving or unit == 0 or not (steps // unit % 2).all():
        raise InputError(
            "{system} is {by}, in which players don't stay in step. Give a system that moves "
            "both players in a match by the same odd number of points, or use a Ladder.",
            by=by.name,
        )
    chances = table.chances(0.5)
    moved = np.stack([np.where(table.moves[..., 0] == step, chances, 0).sum(1) for step in steps])
    errors = np.arange(-(size // unit), size // unit + 1) * unit
    apart = errors[:, None] - errors[None, :]
    in_step = apart // unit % 2 == 0
    by_pair = np.where(in_step, moved[:, apart + 2 * size], 0.0)
    law = np.full(len(errors), 1.0 / len(errors))
    for _ in range(_ROUNDS):
        met = in_step @ law
        after = long_run_law(steps // unit, ((by_pair @ law) / met).T)
        # Rounding would make it lopsided, and that grows: see docs/explanation/ladder.md.
        after = (after + after[::-1]) / 2.0
        if np.abs(after - law).max() <= _SETTLED:
            return Distribution(tuple(errors.tolist()), tuple(after.tolist()))
        law = after
    raise AccuracyError(
        "the errors are still changing after {rounds} rounds. Use another chart.", rounds=_ROUNDS
    )
