"""The value of a team night at each moment, to either team."""

from __future__ import annotations

from dataclasses import dataclass

from evenbreak.teams.advice import Point, leads_of, worth_at
from evenbreak.teams.evening.events import Pick
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.meeting import SEALED, Meeting
from evenbreak.teams.night import WINNER
from evenbreak.teams.sealed import SealedNight, sealed
from evenbreak.teams.solve import SolvedNight, solved


@dataclass(frozen=True, eq=False)
class Side:
    """A night solved for team 0 (A) or 1 (B), with that team as `ours`.

    The solution covers every point of the night; for sealed lineups, only the time before they are
    in.
    """

    team: int
    meeting: Meeting
    solution: SolvedNight | SealedNight

    def mirrored(self) -> Side:
        """Return the same night from the other team's point of view."""
        meeting = self.meeting.mirrored()
        if isinstance(self.solution, SolvedNight):
            found: SolvedNight | SealedNight = self.solution.mirrored(meeting.night())
        else:
            found = self.solution.mirrored()
        return Side(1 - self.team, meeting, found)


def side_of(state: TeamEvening) -> Side:
    """Return a night solved for team A; it stays valid as long as the plan does."""
    meeting = state.meeting
    night = meeting.night()
    return Side(0, meeting, sealed(night) if meeting.order == SEALED else solved(night))


def point_of(state: TeamEvening, team: int) -> Point:
    """Return the current point in a night, from a team's point of view."""
    other = 1 - team
    line = state.to_name
    last_won: bool | None = None
    pick: Pick = ()
    if line is not None and line.number > 1:
        won = state.winner(line.number - 1)
        last_won = None if won is None else won == team
    if line is not None and any(line.picks) and not state.unseen(line.number):
        first = 0 if line.picks[0] else 1
        pick = line.picks[first]
        # Whoever has named first did so, even if the result before has been corrected since.
        last_won = (first == team) == (state.meeting.order[line.number - 1] == WINNER)
    meeting = state.meeting if team == 0 else state.meeting.mirrored()
    return Point(
        state.used(team),
        state.used(other),
        state.score[team] - state.score[other],
        last_won,
        pick,
        tuple(meeting.law_in_play(one.picks[team], one.picks[other]) for one in state.playing),
    )


def chance(side: Side, state: TeamEvening) -> float:
    """Return a team's chance of winning the night from now on; a tie counts as half.

    The other team's hidden picks make no difference.

    >>> from evenbreak.teams.evening.events import Begun, Event, PutUp
    >>> from evenbreak.teams.evening.fold import team_evening
    >>> from evenbreak.teams.evening.events import NightPlan, TeamSheet
    >>> us = TeamSheet("Racks", ("Ann", "Bo"), (600.0, 500.0), (0.0, 0.0), (6.0, 5.0))
    >>> them = TeamSheet("Cues", ("Cy", "Di"), (560.0, 540.0), (0.0, 0.0), (6.0, 5.0))
    >>> what = [Begun(NightPlan((us, them), 1, race=5)), PutUp(0, 1, ("Ann",))]
    >>> state = team_evening(Event("2025-03-01T19:30:00", one) for one in what)
    >>> side = side_of(state)
    >>> [round(chance(one, state), 3) for one in (side, side.mirrored())]
    [0.665, 0.335]
    """
    point = point_of(state, side.team)
    if isinstance(side.solution, SolvedNight):
        return worth_at(side.solution, point)
    if state.to_name is not None:
        return side.solution.worth
    night = side.meeting.night()
    chances, leads = leads_of(point, night.reach, night.sets)
    return float(chances @ night.payoff(leads))
