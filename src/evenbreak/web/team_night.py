"""The team night as the pages show it: its state, and what is calculated in the background."""

from __future__ import annotations

import asyncio
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from starlette.requests import Request

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.team.clock import clock_words, night_clock
from evenbreak.answers.team.lineup import lineup_answer, sealed_answer
from evenbreak.files.store.team_night import read_team_events, team_night_of
from evenbreak.teams.advice import Advice, advice
from evenbreak.teams.evening.events import Event
from evenbreak.teams.evening.fold import EVERYBODY, TeamEvening
from evenbreak.teams.evening.outlook import Side, chance, point_of, side_of
from evenbreak.teams.sealed import SealedNight
from evenbreak.teams.solve import SolvedNight
from evenbreak.web.beside import Beside
from evenbreak.web.guard import RefusalError
from evenbreak.web.night import mark_of

_WAIT = 0.7  # seconds that a page waits for what is being worked out
_KEPT = 12  # answers, and solved nights


class TeamNow(NamedTuple):
    """The current team night, and the events of all team nights in the file."""

    events: list[Event]
    state: TeamEvening


@dataclass(frozen=True)
class Advised:
    """Advice for a captain; `found` is each pick, or sealed lineup, with its worth."""

    answer: Answer
    found: Advice | SealedNight


class TeamNights:
    """The team nights in a file; `beside` is the thread that calculates."""

    def __init__(self, path: Path, beside: Beside) -> None:
        self.path = path
        self.beside = beside
        self._read: tuple[object, TeamNow | None] | None = None
        self._tasks: OrderedDict[object, asyncio.Task[Any]] = OrderedDict()
        self._sides: OrderedDict[tuple[int, int], Side] = OrderedDict()

    async def now(self) -> TeamNow | None:
        """Return the current or last night; None if there is none."""
        return await asyncio.to_thread(self._now)

    def _now(self) -> TeamNow | None:
        mark = mark_of(self.path)
        if self._read is None or self._read[0] != mark:
            events = read_team_events(self.path)
            state = team_night_of(self.path, events)
            self._read = mark, None if state is None else TeamNow(events, state)
        return self._read[1]

    @property
    def names(self) -> set[str]:
        """The teams and their players, as of the last reading of the file."""
        night = self._read[1] if self._read else None
        sheets = night.state.plan.teams if night else ()
        return {name for sheet in sheets for name in (sheet.name, *sheet.players)}

    async def chances(self, now: TeamNow) -> tuple[float, float] | None:
        """Return both teams' chances of winning the night; None while they are being calculated."""

        def work() -> tuple[float, float]:
            ours = chance(self._side(now.state, 0), now.state)
            return ours, 1.0 - ours

        found: tuple[float, float] | None = await self._worked_out((len(now.events),), work)
        return found

    async def times(self, now: TeamNow, at: str) -> list[str]:
        """Return when the next set starts and the night ends; nothing while calculating."""

        def work() -> list[str]:
            seen = now.state.seen_by(EVERYBODY)  # the times must not give away an unseen pick
            return list(clock_words(seen, night_clock(seen, at)))

        found: list[str] | None = await self._worked_out((len(now.events), at[:16], "times"), work)
        return found or []

    async def advised(self, now: TeamNow, team: int) -> Advised | None:
        """Return the advice for a team's captain; None while it is being calculated or not known.

        It isn't known during a set whose winner or loser names first in the next set.
        """

        def work() -> Advised:
            seen = now.state.seen_by(team)
            side = self._side(seen, team)
            if not isinstance(side.solution, SolvedNight):
                return Advised(sealed_answer(side.meeting, (), side.solution), side.solution)
            point = point_of(seen, team)
            answer = lineup_answer(side.meeting, point, solution=side.solution)
            return Advised(answer, advice(side.solution, point))

        if not now.state.due:
            return None
        found: Advised | None = await self._worked_out((len(now.events), team), work)
        return found

    async def _worked_out(self, key: object, work: Callable[[], Any]) -> Any:
        """Return what a function finds, once for each key; None if not ready yet."""
        if key not in self._tasks:
            self._tasks[key] = asyncio.create_task(self.beside.run(work))
            while len(self._tasks) > _KEPT:
                self._tasks.popitem(last=False)
        task = self._tasks[key]
        await asyncio.wait({task}, timeout=_WAIT)
        return task.result() if task.done() else None

    def _side(self, state: TeamEvening, team: int) -> Side:
        """Return the solved night as seen by a team; only called in the background thread."""
        key = state.began, team
        if key not in self._sides:
            found = self._side(state, 0).mirrored() if team else side_of(state)
            self._sides[key] = found
            while len(self._sides) > _KEPT // 3:
                self._sides.popitem(last=False)
        return self._sides[key]


async def night_on(request: Request) -> TeamNow:
    """Return a request's team night; raise an error if there is none."""
    now: TeamNow | None = await request.app.state.site.teams.now()
    if now is None:
        raise RefusalError("No team night is running yet.", status=404)
    return now
