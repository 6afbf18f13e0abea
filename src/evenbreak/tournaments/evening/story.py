"""A night's story: each player's title odds after each match, and what stood out.

The log is folded again up to each result, so that the story is the same wherever and whenever it is
calculated. A corrected result counts as if it had been right the first time; scores in matches
still in play are left out.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from evenbreak.tournaments.evening.events import Drawn, Event, Result, Scored
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.matches import Pairing
from evenbreak.tournaments.evening.outlook import Outlook

MOST_STEPS = 64
"""The most steps in a story: if a night has more results, some in between are left out."""


class Step(NamedTuple):
    """A result (None: the draw), and the title odds after it.

    `chance` is the winner's chance in that match before it started, None if unknown, as for a
    forfeit; `minutes` are counted from its call.
    """

    at: str
    result: Result | None
    chance: float | None
    title: dict[str, float]
    minutes: float | None = None

    @property
    def hill(self) -> bool:
        """Whether both players needed one more game when the last game started."""
        one = self.result
        return one is not None and one.race is not None and _is_hill(one.score, one.race)


@dataclass(frozen=True)
class Story:
    """A night's story so far, from the draw on if `whole`.

    `folded` has the events up to each step, for a later story that continues this one.
    """

    steps: tuple[Step, ...]
    folded: tuple[tuple[Event, ...], ...] = ()
    whole: bool = True

    @property
    def leaders(self) -> list[str]:
        """Everyone, sorted by current title odds, then by their best title odds ever."""
        last, best = self.steps[-1].title, self.highest
        return sorted(best, key=lambda name: (-last[name], -best[name]))

    @property
    def over(self) -> bool:
        """Whether someone has won the title."""
        return max(self.steps[-1].title.values()) > 1.0 - 1e-9

    @property
    def highest(self) -> dict[str, float]:
        """Each player's best title odds so far."""
        names = self.steps[-1].title
        return {name: max(step.title.get(name, 0.0) for step in self.steps) for name in names}

    @property
    def upset(self) -> Step | None:
        """The match whose winner had the lowest chance, if that was below even."""
        found = [one for one in self.steps if one.chance is not None and one.chance < 0.5]
        return min(found, key=lambda one: one.chance or 0.0, default=None)

    @property
    def climb(self) -> tuple[str, float, float] | None:
        """The player whose title odds have grown most since the draw: from what, to what."""
        first, last = self.steps[0].title, self.steps[-1].title
        name = max(last, key=lambda one: last[one] - first.get(one, 0.0))
        start = first.get(name, 0.0)
        return (name, start, last[name]) if last[name] - start >= 0.01 else None

    @property
    def closest(self) -> Step | None:
        """The match that went to the last game and moved the title odds most."""
        moved = [(self.moved(k), k) for k, one in enumerate(self.steps) if one.hill]
        return self.steps[max(moved)[1]] if moved else None

    @property
    def turn(self) -> Step | None:
        """The match that moved the title odds most, apart from the night's last match."""
        moved = [(self.moved(k), k) for k in range(1, len(self.steps) - self.over)]
        return self.steps[max(moved)[1]] if moved else None

    def moved(self, step: int) -> float:
        """Return the share of the title odds moved by a step."""
        before, after = self.steps[step - 1].title, self.steps[step].title
        return 0.5 * sum(abs(after[name] - before.get(name, 0.0)) for name in after)


def _is_hill(score: Sequence[int], race: Sequence[int]) -> bool:
    short = [need - won for need, won in zip(race, score, strict=True)]
    return sorted(short) == [0, 1]


def story_of(
    state: Evening,
    earlier: Story | None = None,
    *,
    within: float = math.inf,
) -> Story:
    """Return a night's story so far, continuing an `earlier` one.

    After `within` seconds no second step is started; the story then isn't `whole`, and lacks its
    beginning, which takes longest.
    """
    known = {} if earlier is None else dict(zip(earlier.folded, earlier.steps, strict=True))
    folded, latest = _prefixes(state), time.monotonic() + within
    steps: list[Step] = []
    begun = False
    for events in reversed(folded):
        step = known.get(events)
        if step is None:
            if begun and time.monotonic() > latest:
                break
            begun, step = True, _step(events)
        steps.append(step)
    first = len(folded) - len(steps)
    return Story(tuple(reversed(steps)), tuple(folded[first:]), not first)


def _prefixes(state: Evening) -> list[tuple[Event, ...]]:
    """Return the events up to the draw and up to each counted result, at most `MOST_STEPS`."""
    counted: dict[Pairing, Result] = {
        (name, frozenset(one.players)): one for name, one in state.counted.items()
    }
    events: list[Event] = []
    ends: list[int] = []
    for event in state.events:
        what = event.what
        if isinstance(what, Scored):
            continue
        if isinstance(what, Result):
            settled = counted.pop((what.match, frozenset(what.players)), None)
            if settled is None:
                continue
            event = replace(event, what=settled)
        events.append(event)
        if isinstance(what, Result) or (isinstance(what, Drawn) and not ends):
            ends.append(len(events))
    # A later story has the steps of an earlier one, which need not be worked out again.
    every = 1
    while len(ends) > every * MOST_STEPS:
        every *= 2
    kept = [end for k, end in enumerate(ends) if k % every == 0 or k == len(ends) - 1]
    return [tuple(events[:end]) for end in kept]


def _step(events: tuple[Event, ...]) -> Step:
    """Return how the last of some events changed the title odds."""
    last = events[-1]
    outlook = Outlook(evening(events), last.at)
    odds = outlook.odds
    title = dict(zip(outlook.state.order, odds.title.tolist(), strict=True))
    if not isinstance(last.what, Result):
        return Step(last.at, None, None, title)
    before = Outlook(evening(events[:-1]), last.at)
    state, result = before.state, last.what
    minutes = None
    if result.match in state.on_tables:
        minutes = before.minutes(last.at) - before.minutes(state.on_tables[result.match].at)
    chance = None
    if not result.forfeit and result.match in state.standing.to_play:
        race = state.needed(result.match, result.players)
        if result.race is None:
            result = replace(result, race=race)
        one, other = (state.order.index(name) for name in result.players)
        win = before.chances(before.skills[0])[result.match]
        chance = float(win[one, other] if result.winner == result.players[0] else win[other, one])
    return Step(last.at, result, chance, title, minutes)
