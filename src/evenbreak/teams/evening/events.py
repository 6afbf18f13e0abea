"""The plan of a team night, and its events, which are only ever added.

An event is a frozen value; `KINDS` converts it to JSON and back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Any, Protocol, TypeAlias, get_args

import numpy as np
from msgspec import Meta

from evenbreak.checks import column, one_of, whole
from evenbreak.errors import InputError
from evenbreak.evenings import log
from evenbreak.evenings.log import Kinds
from evenbreak.evenings.log import Undone as Undone
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.charts.chart_of import named_chart
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.charts.level_skills import LevelSkills, Source, level_skills
from evenbreak.handicaps.charts.race_of_pair import Fairest
from evenbreak.matches.form import MOST_FORM
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.teams.meeting import SEALED, Meeting
from evenbreak.teams.night import order_of
from evenbreak.teams.pairs import SetRace
from evenbreak.teams.sealed import sealed
from evenbreak.teams.set_laws import count_by
from evenbreak.teams.solve import refuse_large
from evenbreak.teams.squad import Squad, caps_of

Points: TypeAlias = Annotated[float, Meta(ge=-1e9, le=1e9)]
Whole: TypeAlias = Annotated[int, Meta(ge=-(10**9), le=10**9)]


@dataclass(frozen=True)
class TeamSheet:
    """A team as entered.

    Errors are 0 if not stated; weights are each player's value under a cap, the skill level or the
    rating, which a chart by skill level uses too.
    """

    name: str
    players: tuple[str, ...]
    ratings: tuple[Annotated[float, Meta(ge=-1_000_000, le=1_000_000)], ...]
    errors: tuple[Annotated[float, Meta(ge=0, le=1_000_000)], ...]
    weights: tuple[Points, ...]

    @property
    def roster(self) -> Roster:
        """The players with their ratings."""
        return Roster(self.players, self.ratings, self.errors, level=self.weights)


Unknown: TypeAlias = Points | None
"""A standard error; None if its size is unknown."""


@dataclass(frozen=True)
class LevelsTonight:
    """The `LevelSkills` of a night, as known at its start."""

    gaps: tuple[tuple[Points, ...], ...]
    errors: tuple[tuple[Unknown, ...], ...]
    points: tuple[Points, ...]
    standard_error: tuple[Unknown, ...]
    spread: Annotated[float, Meta(ge=0, le=1_000_000)]
    source: str
    matches: Annotated[int, Meta(ge=0, le=1_000_000)] = 0

    @classmethod
    def of(cls, skills: LevelSkills) -> LevelsTonight:
        """Return the data that a night stores about the strength of levels."""
        unknown: Any = None
        errors, own = (
            np.where(np.isnan(one), unknown, one).tolist()
            for one in (skills.errors, skills.standard_error)
        )
        return cls(
            tuple(map(tuple, skills.gaps.tolist())),
            tuple(map(tuple, errors)),
            tuple(skills.points.tolist()),
            tuple(own),
            float(skills.spread),
            skills.source,
            skills.matches,
        )

    def skills(self, chart: LevelChart) -> LevelSkills:
        """Return the strengths of a chart's levels; InputError if these aren't its levels."""
        many = len(chart.levels)

        def each(values: Sequence[Unknown], name: str) -> Any:
            known = [np.nan if one is None else one for one in values]
            return column(known, name, many, "levels")

        def pairs(rows: Sequence[Sequence[Unknown]], name: str) -> Any:
            each([len(row) for row in rows], name)
            return np.array([each(row, name) for row in rows])

        return LevelSkills(
            chart,
            pairs(self.gaps, "gaps"),
            pairs(self.errors, "errors"),
            each(self.points, "points"),
            each(self.standard_error, "standard_error"),
            self.spread,
            one_of(self.source, "source", get_args(Source)),
            self.matches,
        )


@dataclass(frozen=True)
class NightPlan:
    """The plan of a team night: what is played, and by whom.

    `handicapped`: the stronger player needs `race` games, and the weaker player gets the fairest
    number; with a built-in chart, `race` is 0. `order` is an order for `order_of`, or 'sealed';
    `count` is sets, games or points; `doubles` are the numbers of the doubles sets. `cap` is the
    largest sum of a lineup's weights; `at_most` is how many players with at least a given weight
    may play; `times` is how often a player may be put up. `match_form` is the standard deviation of
    a game's log-odds from set to set. `by_level`: chances come from skill levels, whose strengths
    by a chart of races are `levels`; None in files from earlier versions, whose chances are those
    of `level_skills` without results.
    """

    teams: tuple[TeamSheet, TeamSheet]
    sets: Annotated[int, Meta(ge=1, le=100)]
    race: Annotated[int, Meta(ge=0, le=1_000)] = 0
    handicapped: bool = False
    chart: str = ""
    order: str = "alternate"
    count: str = "sets"
    doubles: tuple[Whole, ...] = ()
    cap: Points | None = None
    at_most: tuple[Whole, Points] | None = None
    times: Annotated[int, Meta(ge=1, le=100)] = 1
    scale: str = "fargo"
    match_form: Annotated[float, Meta(ge=0, le=MOST_FORM)] = 0.0
    discipline: str = "8-ball"
    tables: Annotated[int, Meta(ge=1, le=100)] = 1
    by_level: bool = False
    levels: LevelsTonight | None = None


@lru_cache(maxsize=8)
def meeting_of(plan: NightPlan) -> Meeting:
    """Return a plan's meeting from team A's point of view; InputError if the plan is invalid."""
    first, second = (team.roster for team in plan.teams)
    race = _race(plan)
    return meeting_by(
        plan,
        (first, second),
        [team.weights for team in plan.teams],
        race=race,
        scale=scale_of(plan.scale),
        sets=plan.sets,
        form=plan.match_form,
        levels=_levels(plan, race),
    )


class Rules(Protocol):
    """The rules of a team night, from a plan or a question; see `NightPlan`."""

    @property
    def order(self) -> str: ...  # noqa: D102
    @property
    def count(self) -> str: ...  # noqa: D102
    @property
    def doubles(self) -> tuple[int, ...]: ...  # noqa: D102
    @property
    def cap(self) -> float | None: ...  # noqa: D102
    @property
    def at_most(self) -> tuple[int, float] | None: ...  # noqa: D102
    @property
    def times(self) -> int: ...  # noqa: D102


def meeting_by(
    rules: Rules,
    sides: tuple[Roster, Roster],
    weights: Sequence[Sequence[float]],
    *,
    race: SetRace,
    scale: Scale,
    sets: int,
    form: float = 0.0,
    levels: LevelSkills | None = None,
) -> Meeting:
    """Return the meeting between two rosters under the rules of a night.

    Weights are each player's value under a cap; `form` is the standard deviation of a game's
    log-odds from set to set; with `levels`, chances come from their strengths, not ratings. Raises
    InputError if the rules are invalid.
    """
    whole(sets, "sets", at_least=1)
    wrong = [k for k in rules.doubles if not 1 <= k <= sets]
    if wrong:
        raise InputError(
            "set {n} can't be doubles: the sets are 1 to {sets}", n=wrong[0], sets=sets
        )
    first, second = (
        Squad(side.players, caps_of(counted, rules.cap, rules.at_most), rules.times)
        for side, counted in zip(sides, weights, strict=True)
    )
    order = rules.order.strip().lower()
    return Meeting(
        *sides,
        (first, second),
        race,
        scale,
        tuple(2 if k in rules.doubles else 1 for k in range(1, sets + 1)),
        order if order == SEALED else order_of(rules.order, sets, [SEALED]),
        count_by(rules.count, race),
        form,
        levels,
    )


def check_plan(plan: NightPlan) -> None:
    """Raise an error if a plan can't be played, or is too large to calculate.

    It is an InputError if a team cannot fill its sets within the caps, two players have the same
    name, or no race is given.
    """
    first, second = (team.name for team in plan.teams)
    if first.casefold() == second.casefold():
        raise InputError("both teams are called {name}. Give them different names.", name=first)
    meeting = meeting_of(plan)
    night = meeting.night()
    if meeting.order == SEALED:
        sealed(night)
    else:
        refuse_large(night)


def _levels(plan: NightPlan, race: SetRace) -> LevelSkills | None:
    if not plan.by_level or not isinstance(race, LevelChart):
        return None
    return level_skills(race) if plan.levels is None else plan.levels.skills(race)


def _race(plan: NightPlan) -> SetRace:
    if plan.chart:
        return named_chart(plan.chart) or chart(plan.chart)
    race = whole(plan.race, "race", at_least=1)
    return Fairest(race) if plan.handicapped else race


Pick: TypeAlias = tuple[str, ...]
"""Who plays a set: one player, or the pair of a doubles set."""

Team: TypeAlias = Annotated[int, Meta(ge=0, le=1)]
Number: TypeAlias = Annotated[int, Meta(ge=1, le=100)]
Games: TypeAlias = Annotated[int, Meta(ge=0, le=10_000)]

Score: TypeAlias = tuple[Games, Games]
"""The games of team A and team B."""


@dataclass(frozen=True)
class Begun:
    """A night starts; one in progress is put aside."""

    plan: NightPlan


@dataclass(frozen=True)
class PutUp:
    """A team (0: A, 1: B) puts up a pick in a set, counted from 1."""

    team: Team
    number: Number
    pick: Pick


@dataclass(frozen=True)
class HandedIn:
    """A team hands in its whole lineup, if lineups are sealed."""

    team: Team
    picks: tuple[Pick, ...]


@dataclass(frozen=True)
class Proposed:
    """A team reports a set's result, which counts once the other team reports the same."""

    team: Team
    number: Number
    score: Score


@dataclass(frozen=True)
class Result:
    """The director enters a set's result, or corrects it."""

    number: Number
    score: Score


What: TypeAlias = Begun | PutUp | HandedIn | Proposed | Result | Undone
KINDS: Kinds[What] = Kinds(
    {
        "begun": Begun,
        "put up": PutUp,
        "handed in": HandedIn,
        "proposed": Proposed,
        "result": Result,
        "undone": Undone,
    }
)
"""The kinds of events, each by the name under which it is stored."""


@dataclass(frozen=True)
class Event(log.Event):
    """An event of a team night."""

    what: What
