"""A round's races: who plays who, what races they may play, and when it ends."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenbreak.answers.league.roster_matchups import OfferedRaces, RosterMatchups, roster_matchups
from evenbreak.arrays import own_arrays
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.matches.evening import evening
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale

AnyChart: TypeAlias = Chart | LevelChart

AT_A_TIME = 20_000
"""How many pairs are calculated together; larger rounds are only partly in memory."""


class EveningEnd(NamedTuple):
    """When all matches that have a race end, in minutes.

    `races` is chart or best; `runs` is how often the evening was simulated, or 0 if the answer is
    calculated, and the errors are the resulting standard errors.
    """

    races: str
    matches: int
    tables: int
    mean_minutes: float
    minutes_p90: float
    exact: bool
    runs: int
    mean_minutes_error: float
    minutes_p90_error: float


@own_arrays
@dataclass(frozen=True, eq=False, kw_only=True)
class Round:
    """The pairs in a round, and the races requested.

    Parameters
    ----------
    file
        the list of players as read.
    pairs
        places in the roster, shape (k, 2).
    scale, chart, levels, offered, pace
        as for `roster_matchups`.
    tables
        the number of tables the round is played on, if its end is requested, which needs a pace.
    turnover
        the time between matches on a table.
    seed
        the seed for an evening that must be simulated.
    form
        how much a game's log-odds vary from match to match (standard deviation).
    listed
        whether the pairs are a list of matches; otherwise they are all pairs.
    """

    file: RosterFile
    roster: Roster
    pairs: NDArray[Any]
    scale: Scale
    chart: AnyChart | None = None
    levels: LevelSkills | None = None
    offered: OfferedRaces | None = None
    pace: Pace | None = None
    tables: int | None = None
    turnover: Turnover = field(default_factory=Turnover)
    seed: int = 0
    form: float = 0.0
    listed: bool = False

    def __repr__(self) -> str:
        return f"<Round of {len(self.pairs):,} pairs of {len(self.roster):,} players>"

    @property
    def kinds(self) -> dict[str, AnyChart | OfferedRaces]:
        """The sources of the races, by the first word of their columns: races to play first."""
        by_chart: dict[str, AnyChart | OfferedRaces] = {}
        if self.chart is not None:
            by_chart["chart_"] = self.chart
        return by_chart if self.offered is None else {**by_chart, "": self.offered}

    def in_parts(self) -> Iterator[RosterMatchups]:
        """Yield the races, a limited number of pairs at a time to save memory."""
        for first in range(0, len(self.pairs), AT_A_TIME):
            yield self._matchups(self.pairs[first : first + AT_A_TIME])

    @cached_property
    def matchups(self) -> RosterMatchups:
        """All pairs' races at once."""
        return self._matchups(self.pairs)

    def _matchups(self, pairs: NDArray[Any]) -> RosterMatchups:
        return roster_matchups(
            self.roster,
            pairs,
            scale=self.scale,
            chart=self.chart,
            levels=self.levels,
            offered=self.offered,
            pace=self.pace,
            form=self.form,
        )

    @cached_property
    def evening(self) -> list[EveningEnd]:
        """When everything ends, for each kind of race; empty if not requested."""
        if self.tables is None or self.pace is None:
            return []
        answer = self.matchups
        players = [(int(a), int(b)) for a, b in self.pairs[answer.linked]]
        ends = []
        for kind, lengths in (("chart", answer.chart_lengths), ("best", answer.best_lengths)):
            if not lengths:
                continue
            rng = np.random.default_rng(self.seed)
            end = evening(
                lengths,
                self.pace,
                turnover=self.turnover,
                tables=self.tables,
                players=players,
                rng=rng,
            )
            ends.append(
                EveningEnd(
                    kind,
                    len(lengths),
                    self.tables,
                    end.mean,
                    end.p90,
                    end.exact,
                    end.runs,
                    end.mean_error,
                    end.p90_error,
                )
            )
        return ends
