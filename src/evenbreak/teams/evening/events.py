"""What is played on a team night, and what happens on it: events, which are only ever added.

An event is a frozen value; `KINDS` turns it into JSON and back.
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
    """A team as it came in.

    Errors are 0 where not stated; weights are what each player counts for under a cap, the skill
    level or the rating, which a chart by skill level reads too.
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
"""A standard error; None where nothing says how large it is."""


@dataclass(frozen=True)
class LevelsTonight:
    """The `LevelSkills` of a night, as known when it started."""

    gaps: tuple[tuple[Points, ...], ...]
    errors: tuple[tuple[Unknown, ...], ...]
    points: tuple[Points, ...]
    standard_error: tuple[Unknown, ...]
    spread: Annotated[float, Meta(ge=0, le=1_000_000)]
    source: str
    matches: Annotated[int, Meta(ge=0, le=1_000_000)] = 0

    @classmethod
    def of(cls, skills: LevelSkills) -> LevelsTonight:
        """Return what a night keeps of how strong levels are."""
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
        """Return the strengths of a chart's levels; an InputError if these aren't its levels."""
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
    """What is played on a team night, and by whom.

    `handicapped`: the stronger player needs `race` games, the weaker gets the fairest number; with
    one of the package's charts, `race` is 0. `order` is as `order_of` reads it, or 'sealed';
    `count` is sets, games or points; `doubles` are numbers of sets. `cap` is the largest sum of a
    lineup's weights; `at_most` is how many players of a weight or more may play; `times` is how
    often a player may be put up. `match_form` is the standard deviation of a game's log-odds from
    set to set. `by_level`: chances come from skill levels, whose strengths by a chart of races are
    `levels`; None in the file of an earlier version, whose chances are those of `level_skills`
    without results.
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
    """Return the meeting of a plan, as team A sees it; an InputError if the plan makes no sense."""
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
    """The rules of a team night, as a plan and a question state them; see `NightPlan`."""

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
    """Return the meeting of two rosters by the rules of a night.

    Weights are what each player counts for under a cap; `form` is the standard deviation of a
    game's log-odds from set to set; with `levels`, chances come from their strengths, not ratings.
    An InputError if the rules make no sense.
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
    """Refuse a plan that can't be played, or is too large to calculate.

    An InputError if a team cannot fill its sets within the caps, two names are one, or no race is
    given.
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
    """A night starts; one that was under way is put aside."""

    plan: NightPlan


@dataclass(frozen=True)
class PutUp:
    """A team (0: A, 1: B) puts up a pick in a set, counted from 1."""

    team: Team
    number: Number
    pick: Pick


@dataclass(frozen=True)
class HandedIn:
    """A team hands in its whole lineup, where lineups are sealed."""

    team: Team
    picks: tuple[Pick, ...]


@dataclass(frozen=True)
class Proposed:
    """A team says how a set ended; it counts once the other says the same."""

    team: Team
    number: Number
    score: Score


@dataclass(frozen=True)
class Result:
    """The director says how a set ended, for the first time or as a correction."""

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
"""What can happen, each kind by the name under which it is kept."""


@dataclass(frozen=True)
class Event(log.Event):
    """Something that happened on a team night."""

    what: What
