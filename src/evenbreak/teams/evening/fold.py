"""The state of a team night, computed from its events."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

from evenbreak.evenings.log import Log
from evenbreak.teams.evening.events import (
    Begun,
    Event,
    HandedIn,
    NightPlan,
    Pick,
    Proposed,
    PutUp,
    Result,
    Score,
    What,
    meeting_of,
)
from evenbreak.teams.meeting import SEALED, Meeting
from evenbreak.teams.night import BOTH, LOSER, OURS, THEIRS, WINNER
from evenbreak.teams.set_laws import brought
from evenbreak.teams.solve import names_first

EVERYBODY = None
"""Any viewer: sees no pick until both are in, if picks are unseen."""


@dataclass(frozen=True)
class SetLine:
    """A set in the night, numbered from 1.

    `picks` are () before the nomination; `said` is the result that each team reported, and `hidden`
    is the team whose pick is in, but not shown here. Times are '' until then.
    """

    number: int
    picks: tuple[Pick, Pick] = ((), ())
    said: tuple[Score | None, Score | None] = (None, None)
    score: Score | None = None
    hidden: tuple[bool, bool] = (False, False)
    named_at: str = ""
    over_at: str = ""

    @property
    def missing(self) -> tuple[int, ...]:
        """The teams whose picks are not in."""
        return tuple(team for team in (0, 1) if not (self.picks[team] or self.hidden[team]))

    @property
    def named(self) -> bool:
        """Whether both teams have put someone up."""
        return all(self.picks)


@dataclass(frozen=True, eq=False)
class TeamEvening:
    """State of a team night; `began` is the number, from 1, of its first event.

    `last` is the event that an undo would take back.
    """

    plan: NightPlan
    began: int
    sets: tuple[SetLine, ...]
    last: Event

    @cached_property
    def meeting(self) -> Meeting:
        """The plan of the night, from team A's point of view."""
        return meeting_of(self.plan)

    @property
    def teams(self) -> tuple[str, str]:
        """The names of the two teams."""
        return self.plan.teams[0].name, self.plan.teams[1].name

    @property
    def sealed(self) -> bool:
        """Whether both lineups are handed in before the night."""
        return self.meeting.order == SEALED

    def unseen(self, number: int) -> bool:
        """Whether a set's picks are shown only once both are in."""
        return self.sealed or self.meeting.order[number - 1] == BOTH

    def open(self, number: int) -> bool:
        """Whether everyone may see the picks for a set."""
        return not self.unseen(number) or self.sets[number - 1].named

    @property
    def to_name(self) -> SetLine | None:
        """The set that is nominated for next; None if every set has its players."""
        return next((line for line in self.sets if not line.named), None)

    @property
    def due(self) -> tuple[int, ...]:
        """The teams that may put up a player now (0: A, 1: B)."""
        line = self.to_name
        if line is None:
            return ()
        if self.unseen(line.number) or len(line.missing) == 1:
            return line.missing
        first = self.first(line.number)
        return () if first is None else (first,)

    def first(self, number: int) -> int | None:
        """Return the team that names first in a set; None: both at once, or not known yet."""
        letter = OURS if self.sealed else self.meeting.order[number - 1]
        if self.unseen(number):
            return None
        if letter in (WINNER, LOSER):
            won = self.winner(number - 1)
            if won is None:
                return None
            letter = names_first(letter, won == 0)
        return 0 if letter == OURS else 1 if letter == THEIRS else None

    def winner(self, number: int) -> int | None:
        """Return the team that won a set; None if it is not over."""
        line = self.sets[number - 1]
        if line.score is None:
            return None
        return 0 if line.score[0] == self.needs(line)[0] else 1

    def needs(self, line: SetLine) -> Score:
        """Return the games that each side needs in a set."""
        return self.meeting.needs(*line.picks)

    def brought(self, line: SetLine) -> Score:
        """Return what each team got from a finished set: sets, games or points."""
        return brought(self.needs(line), line.score or (0, 0), self.meeting.count)

    @cached_property
    def score(self) -> Score:
        """The score of the night: sets, games or points, whichever count."""
        each = [self.brought(line) for line in self.sets if line.score]
        return sum(a for a, _ in each), sum(b for _, b in each)

    @property
    def playing(self) -> list[SetLine]:
        """The sets in play."""
        return [line for line in self.sets if line.named and line.score is None]

    @property
    def over(self) -> bool:
        """Whether all sets have been played."""
        return all(line.score for line in self.sets)

    def used(self, team: int) -> Pick:
        """Return who is playing or has played for a team, once per set."""
        return tuple(name for line in self.sets if line.named for name in line.picks[team])

    def put_up(self, team: int) -> Pick:
        """Return who has been put up for a team, once per set, answered or not."""
        return tuple(name for line in self.sets for name in line.picks[team])

    def seen_by(self, viewer: int | None) -> TeamEvening:
        """Return the state as seen by a team's captain, or by `EVERYBODY`.

        The other team's unseen picks are left out until both are in or, if lineups are sealed,
        until both lineups are handed in.
        """
        lines = tuple(
            line if self.open(line.number) else _without(line, viewer) for line in self.sets
        )
        return replace(self, sets=lines)


def _without(line: SetLine, viewer: int | None) -> SetLine:
    """Return a set without the picks of teams other than the viewer's."""
    (ours, theirs), own = line.picks, (viewer == 0, viewer == 1)
    return replace(
        line,
        picks=(ours if own[0] else (), theirs if own[1] else ()),
        hidden=(bool(ours) and not own[0], bool(theirs) and not own[1]),
    )


def team_evening(events: Iterable[Event]) -> TeamEvening | None:
    """Return the state after the given events; None if no night has started.

    >>> from evenbreak.teams.evening.events import TeamSheet
    >>> us = TeamSheet("Racks", ("Ann", "Bo"), (600.0, 500.0), (0.0, 0.0), (6.0, 5.0))
    >>> them = TeamSheet("Cues", ("Cy", "Di"), (560.0, 540.0), (0.0, 0.0), (6.0, 5.0))
    >>> plan = NightPlan((us, them), 2, race=5)
    >>> what = [Begun(plan), PutUp(0, 1, ("Ann",)), PutUp(1, 1, ("Cy",)), Result(1, (5, 3))]
    >>> state = team_evening(Event("2025-03-01T19:30:00", one) for one in what)
    >>> state.score, state.due, state.used(1)
    ((1, 0), (1,), ('Cy',))
    """
    log: Log[Event] = Log()
    for number, event in enumerate(events, 1):
        log.take(number, event)
    kept = list(log.kept.items())
    begun = [k for k, (_, event) in enumerate(kept) if isinstance(event.what, Begun)]
    if not begun:
        return None
    began, first = kept[begun[-1]]
    assert isinstance(first.what, Begun)  # noqa: S101
    plan = first.what.plan
    lines = [SetLine(number) for number in range(1, plan.sets + 1)]
    for _, event in kept[begun[-1] + 1 :]:
        _take(lines, event.what)
        lines = [_stamped(line, event.at) for line in lines]
    return TeamEvening(plan, began, tuple(lines), kept[-1][1])


def _take(lines: list[SetLine], what: What) -> None:
    match what:
        case PutUp(team, number, pick):
            _put(lines, team, number, pick)
        case HandedIn(team, picks):
            for number, pick in enumerate(picks, 1):
                _put(lines, team, number, pick)
        case Proposed(team, number, score):
            line = lines[number - 1]
            if line.score is None:
                said = (score, line.said[1]) if team == 0 else (line.said[0], score)
                agreed = score if said[0] == said[1] else None
                lines[number - 1] = replace(line, said=said, score=agreed)
        case Result(number, score):
            lines[number - 1] = replace(lines[number - 1], score=score)


def _stamped(line: SetLine, at: str) -> SetLine:
    """Return a set with the time at which it reached its current stage."""
    named = line.named_at or (at if line.named else "")
    over = line.over_at or (at if line.score else "")
    return replace(line, named_at=named, over_at=over)


def _put(lines: list[SetLine], team: int, number: int, pick: Pick) -> None:
    old = lines[number - 1].picks
    picks = (pick, old[1]) if team == 0 else (old[0], pick)
    lines[number - 1] = replace(lines[number - 1], picks=picks)
