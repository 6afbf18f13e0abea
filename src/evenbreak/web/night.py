"""The evening as the pages show it: its state, and what is calculated from it in the background.

The state is read again when the file has changed. Odds and finish time are calculated in a thread;
a page waits for them only a moment, and shows what is known so far.
"""

from __future__ import annotations

import asyncio
import gc
import logging
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from evenbreak.answers.tournament.night import begun_at, next_calls, night_answer
from evenbreak.errors import EvenbreakError, InputError
from evenbreak.files.store.desk import Phones, phone_entries, phones_in
from evenbreak.files.store.evening_file import holds
from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import keep_prizes, night_of, read_night
from evenbreak.tournaments.evening.events import Event, Late, Opened
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.story import Story, story_of
from evenbreak.tournaments.money.payouts import PrizeMoney
from evenbreak.tournaments.odds.races import race_chance
from evenbreak.tournaments.odds.title import PlaceOdds
from evenbreak.web.beside import Beside
from evenbreak.words import say

_LOG = logging.getLogger(__name__)
_STALE = 30.0  # seconds after which the finish is worked out again
_MONEY_STALE = 5.0  # seconds after which the prizes are looked up again
_TICK = 20_000_000  # nanoseconds: longer than a step of the clock that files are stamped by
_WAIT = 0.03  # seconds that a page waits for what is being worked out


def now() -> str:
    """Return the current time, such as 2025-03-01T19:30:00."""
    return datetime.now().replace(microsecond=0).isoformat()


@dataclass(frozen=True)
class Known:
    """What has been calculated from a state.

    `at` is in seconds on the event loop's clock. `data` is the evening's JSON answer, with `calls`,
    pairs of table and match; `queue` has callable matches with their events, best first. `start` is
    in minutes after the midnight of `day`; `next_starts` and `starts` are early, middle and late
    minutes since then, by player and by match. `means` are mean ratings given tonight's games.
    `problem` is why none of this could be calculated.
    """

    of: Evening
    at: float
    data: dict[str, Any] = field(default_factory=dict)
    calls: list[tuple[int, str]] = field(default_factory=list)
    queue: tuple[tuple[int, str], ...] = ()
    start: int = 0
    day: str = ""
    odds: PlaceOdds | None = None
    next_starts: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    means: Mapping[str, float] = field(default_factory=dict)
    starts: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    problem: str = ""

    @property
    def order(self) -> tuple[str, ...]:
        """The event's callable matches, best first."""
        return tuple(match for event, match in self.queue if event == self.of.event)


class Night:
    """An event in a night's file; its number is 1 unless it was started alongside others."""

    def __init__(self, path: Path, event: int = 1, *, clock: Callable[[], str] = now) -> None:
        self.path = path
        self.event = event
        self.clock = clock
        self.known: Known | None = None
        self._read: tuple[tuple[int, int, int], dict[int, list[Event]], Evening] | None = None
        self._phones: tuple[tuple[int, int, int], Evening, Phones] | None = None
        self._money: PrizeMoney | None = None
        self._money_at = -math.inf
        self._begun = False
        self._work: asyncio.Task[None] | None = None
        self._story: Story | None = None
        self._telling: asyncio.Task[None] | None = None
        self.beside = Beside()

    @property
    def exists(self) -> bool:
        """Whether the tournament has been started."""
        self._begun = self._begun or holds(self.path, str(self.event))
        return self._begun and self.path.exists()

    def forget(self) -> None:
        """Forget the tournament, which is no longer in the file."""
        self._begun, self._read, self.known = False, None, None
        self._know(None)

    @property
    def begun_at(self) -> str:
        """When the tournament was started; '' if there is none."""
        return self.state().events[0].at if self.exists else ""

    def state(self) -> Evening:
        """Return the evening's state: the same object until something happens."""
        mark, read = mark_of(self.path), self._read
        if read is None or read[0] != mark:
            night = read_night(self.path, self.event)
            same = read is not None and read[1] == night
            state = read[2] if read and same else night_of(self.path, night)[self.event]
            # Another thread may keep what it read before; what is returned is what was read here.
            read = self._read = mark, night, state
        return read[2]

    def phones(self) -> Phones:
        """Return whose phones are whose, and what they propose."""
        mark, state, read = mark_of(self.path), self.state(), self._phones
        if read is None or read[0] != mark or read[1] is not state:
            phones = phones_in(phone_entries(self.path), state, self.event)
            read = self._phones = mark, state, phones
        return read[2]

    @property
    def names(self) -> set[str]:
        """Everyone who has entered, including earlier names, as of the last reading of the file."""
        events = self._read[1].get(self.event, []) if self._read else []
        begun = [
            entrant
            for one in events
            if isinstance(one.what, Opened)
            for entrant in one.what.entrants
        ]
        late = [one.what.entrant for one in events if isinstance(one.what, Late)]
        return {entrant.name for entrant in (*begun, *late)}

    @property
    def means(self) -> Mapping[str, float]:
        """The average ratings, given tonight's games, as far as calculated."""
        return self.known.means if self.known else {}

    def prizes(self) -> list[float]:
        """Return the money for first place, second, ...

        None is known if the director hasn't stored any, or the table has no row for this many
        players. The file is only checked once in a while.
        """
        if time.monotonic() - self._money_at > _MONEY_STALE:
            self._know(kept_prizes(self.path, self.event))
        try:
            state = self.state()
            known = self._money
            return known.amounts(len(state.entrants), state.payers) if known else []
        except InputError:
            return []

    @property
    def unit(self) -> float:
        """What prizes are rounded down to, as of the last call to `prizes`."""
        return self._money.unit if self._money else 0.0

    def keep_prizes(self, money: PrizeMoney) -> None:
        """Store the prize money with the tournament."""
        keep_prizes(self.path, money, self.event)
        self._know(money)

    def _know(self, money: PrizeMoney | None) -> None:
        self._money, self._money_at = money, time.monotonic()

    async def outlook(self) -> Known | None:
        """Return what is known about the odds and the finish; None: nothing yet, or no draw."""
        state = await asyncio.to_thread(self.state)
        if not state.drawn:
            return None
        clock = asyncio.get_running_loop().time()
        fresh = self.known and self.known.of is state and clock - self.known.at < _STALE
        if not fresh:
            if self._work is None or self._work.done():
                self._work = asyncio.create_task(self._work_out(state))
            await asyncio.wait({self._work}, timeout=_WAIT)
        same_tournament = self.known and self.known.of.events[0] == state.events[0]
        return self.known if same_tournament else None

    async def story(self) -> Story | None:
        """Return the night's story as far as it is calculated; None if there is nothing yet."""
        state = await asyncio.to_thread(self.state)
        if not state.drawn:
            return None
        if self._telling is None or self._telling.done():
            self._telling = asyncio.create_task(self._tell(state))
        await asyncio.wait({self._telling}, timeout=_WAIT)
        return self._story

    async def _tell(self, state: Evening) -> None:
        """Calculate the story step by step, so that current odds don't have to wait for it."""
        try:
            while self._read and self._read[2] is state:
                earlier = self._story
                self._story = await self.beside.run(partial(story_of, state, earlier, within=0.2))
                if self._story.whole:
                    break
        except Exception as error:  # the wall goes on without
            _LOG.exception("the story of the night could not be worked out", exc_info=error)

    async def _work_out(self, state: Evening) -> None:
        def work() -> Known:
            night = Outlook(state, self.clock())
            data = night_answer(night).to_dict()
            to_play = bool(state.standing.to_play)
            calls = next_calls(night) if to_play else []
            queue = tuple(night.queue) if to_play and state.plan.form != "chips" else ()
            starts = _next_starts(night) if to_play else {}
            later = _starts(night) if to_play else {}
            begun, day = begun_at(night), night.start.date().isoformat()
            when: Any = {"start": begun, "day": day, "next_starts": starts, "starts": later}
            means = means_of(night)
            return Known(state, 0.0, data, calls, queue, odds=night.odds, means=means, **when)

        try:
            found = await self.beside.run(work)
        except Exception as error:  # the pages go on without: the director has to mend it there
            _LOG.exception("the odds could not be worked out", exc_info=error)
            found = Known(state, 0.0, problem=problem_of(error))
        if gc.get_freeze_count():
            # What was worked out for earlier states refers to itself, tens of megabytes. To look
            # for it takes no time where all that was there before is left out, as the command does.
            gc.collect()
        clock = asyncio.get_running_loop().time()
        self.known = replace(found, at=clock)


def problem_of(error: Exception) -> str:
    """Return a page's message about an error in background work."""
    if isinstance(error, EvenbreakError):
        return error.sentence
    return say(str(error) or type(error).__name__)


def match_chances(state: Evening, known: Known | None) -> dict[str, float]:
    """Return the first player's chances in each playable match, from its current score on.

    The ratings are used as far as they are known: no one waits for the whole night's odds.
    """
    if state.plan.form == "chips" or not state.drawn:
        return {}
    means = known.means if known else {}
    return {
        name: win_chance(
            state,
            state.pair(name),
            state.needed(name, state.pair(name)),
            score_of(state, name) or (0, 0),
            means,
        )
        for name in state.standing.to_play
    }


def win_chance(
    state: Evening,
    pair: tuple[str, str],
    needs: tuple[int, int],
    won: tuple[int, int],
    means: Mapping[str, float],
    *,
    off: float = 0.0,
) -> float:
    """Return the first of two players' chances in a match, from its current score on.

    Their ratings are `means`, adjusted for tonight's games, or else the ratings entered. With
    `off`, the first player's is that many points higher.
    """
    one, other = (means.get(name, state.entrants[name].rating) for name in pair)
    gap = state.scale.log_odds(one - other + off)
    return float(race_chance(np.asarray(gap), needs, state.plan.match_form, won))


def score_of(state: Evening, match: str) -> tuple[int, int] | None:
    """Return the score so far in a match in play; None if nothing has been entered."""
    return state.live[match].of(state.pair(match)) if match in state.live else None


def means_of(night: Outlook) -> dict[str, float]:
    """Return each player's average rating, given tonight's games."""
    return dict(zip(night.state.order, night.skills[0].tolist(), strict=True))


def _next_starts(night: Outlook) -> dict[str, tuple[float, float, float]]:
    """Return the start of the next match of each player who isn't playing now."""
    if night.state.plan.form == "chips":
        return {}
    found, starts = night.as_things_are, {}
    busy = {name for one in night.state.on_tables.values() for name in one.call.players}
    for name in night.state.order:
        start = found.next_start(name)
        if name not in busy and start.p_played > 0.0:
            starts[name] = start.p10, start.p50, start.p90
    return starts


def _starts(night: Outlook) -> dict[str, tuple[float, float, float]]:
    """Return the start of each match that hasn't started."""
    if night.state.plan.form == "chips":
        return {}
    found = night.as_things_are
    starts = {name: found.start(name) for name in found.names if name not in night.state.on_tables}
    return {name: (at.p10, at.p50, at.p90) for name, at in starts.items() if at.p_played > 0.0}


def mark_of(path: Path) -> tuple[int, int, int]:
    """Return a stamp that changes whenever the database or its log does.

    A file that has just been written may change again within one tick of its clock, so the stamp is
    then different each time.
    """
    log = path.with_name(f"{path.name}-wal")
    try:
        main, beside = path.stat(), log.stat() if log.exists() else None
    except OSError:
        return 0, 0, 0
    last = max(main.st_mtime_ns, beside.st_mtime_ns if beside else 0)
    just_now = time.monotonic_ns() if time.time_ns() - last < _TICK else 0
    return last, beside.st_size if beside else 0, just_now
