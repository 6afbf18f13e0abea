"""A season: who plays, by which system, against whom in which week, and for how long."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from evenbreak.arrays import Ints
from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.catalogue import system_of
from evenbreak.handicaps.systems.match_table import MatchTable, match_table
from evenbreak.handicaps.systems.system import System
from evenbreak.league.lookup import Lookup, lookup_of
from evenbreak.league.players import LeaguePlayers
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from evenbreak.league.tally import fifths_of

_DOUBLINGS = 3.0
"""The narrowest table of races and moves: to where the odds of a game are 8 to 1."""

_SDS = 5.0
"""A league's skills are assumed to lie within this many standard deviations."""


@dataclass(frozen=True, eq=False)
class Season:
    """A season to be simulated.

    In each week a player's skill of the day is the true skill plus the form of that day, in whole
    points, and holds for all of the player's matches. The ratings before the week set its races,
    and all moves are added at its end, as `evenbreak.handicaps.apply_results` does for a night.
    Then skills drift.

    Parameters
    ----------
    players
        who plays.
    system
        the handicap system, or its name.
    chart
        which sets the races, or its name; None: the system's own.
    schedule
        who meets whom; None: a round robin, over and over.
    weeks
        how many weeks are played.
    play
        'matches': the winner of each match is drawn with the exact chance. 'racks': it is played
        rack by rack, which gives final scores too. Both have the same distribution.

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have.

    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", "npl_10", weeks=12)
    >>> season.chart.name, season.schedule
    ('npl_10', RoundRobin(players=4, matches_a_week=1))
    """

    players: LeaguePlayers
    system: Any
    chart: Any = None
    schedule: Any = None
    weeks: int = 30
    play: str = "matches"

    def __post_init__(self) -> None:
        if not isinstance(self.players, LeaguePlayers):
            raise InputError(f"players is {self.players!r}; give LeaguePlayers")
        put = object.__setattr__
        if not isinstance(self.system, System):
            put(self, "system", system_of(self.system))
        if self.chart is None:
            put(self, "chart", self.system.usual_chart())
        else:
            put(self, "chart", chart_of(self.chart))
        if self.schedule is None:
            put(self, "schedule", RoundRobin(len(self.players)))
        put(self, "weeks", whole(self.weeks, "weeks", at_least=1))
        put(self, "play", one_of(self.play, "play", ("matches", "racks")))
        _check_schedule(self.schedule, len(self.players))

    @cached_property
    def table(self) -> MatchTable:
        """The races, moves and chances of the season's matches."""
        doubling = self.system.scale.points_per_doubling
        least = max(self.chart.rows[-1].difference_from, round(_DOUBLINGS * doubling))
        # If no two ratings are further apart than the table is wide, none need be clipped.
        spread = int(self.players.rating.max() - self.players.rating.min()) + round(doubling)
        return match_table(self.system, self.chart, widest=max(least, min(spread, 2 * least)))

    @cached_property
    def lookup(self) -> Lookup:
        """The same as flat tables of whole numbers, for fast draws."""
        return lookup_of(self.table, self.widest_gap)

    @cached_property
    def widest_gap(self) -> int:
        """The largest difference of two skills of the day, five standard deviations included."""
        players = self.players
        around = _SDS * np.hypot(players.skill_sd, players.day_sd)
        drifted = players.drift * (self.weeks - 1)
        high = players.skill + np.maximum(drifted, 0.0) + around
        low = players.skill + np.minimum(drifted, 0.0) - around
        # One point more, since drift is added up in another order.
        return int(np.rint(high.max()) - np.rint(low.min())) + 1

    @cached_property
    def longest_move(self) -> int:
        """The most points that a match may move a rating."""
        steps = self.system.newcomer_steps
        anybody_new = (self.players.played < sum(matches for matches, _ in steps)).any()
        factors = [factor for _, factor in steps] if anybody_new else []
        return int(np.abs(self.table.moves).max()) * max(factors, default=1)

    @cached_property
    def fifths(self) -> Ints:
        """Each player's fifth by skill at the start, 0 the weakest; one column."""
        return fifths_of(self.players.skill[:, None])

    def __reduce__(self) -> Any:
        # Tables are not sent: they are larger than what they are made from.
        given = (self.players, self.system, self.chart, self.schedule, self.weeks, self.play)
        return Season, given


def _check_schedule(schedule: Any, players: int) -> None:
    """Find out before the first week what would stop the season in a later week."""
    if isinstance(schedule, RandomPairing):
        return
    if isinstance(schedule, RoundRobin | FixedSchedule):
        schedule.pairs(1, np.random.default_rng(0), players)
    elif not hasattr(schedule, "pairs"):
        raise InputError(
            f"schedule is {schedule!r}; give RoundRobin, RandomPairing or FixedSchedule"
        )
