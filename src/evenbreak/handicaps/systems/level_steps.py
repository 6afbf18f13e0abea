"""Level steps: skill levels divided into steps, one up for a match won and one down for a loss.

This is a TAP-*like* system with a finite state, so its long run can be solved exactly. Each level
has ten steps, as in TAP-like leagues.

A player who passes the top of a level enters the next one at step `entry`, and one who falls below
the first step enters the level below at the same distance from its top, so no one changes back
immediately. The published number is the level. Source: TAP leagues publish that a level has ten
steps and that a promoted player needs three to four losses to fall back; that a match moves one
step is an assumption.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.handicaps.charts.level_chart import LevelChart, level_chart
from evenbreak.handicaps.systems.history import Entries
from evenbreak.handicaps.systems.level_review import nearest_level
from evenbreak.handicaps.systems.markov import MarkovSystem


@dataclass(frozen=True)
class LevelSteps(MarkovSystem):
    """Levels in steps, moved by matches won and lost.

    Parameters
    ----------
    steps
        the number of steps in a level.
    entry
        the step, from 1, at which a promoted player enters a level.
    newcomer
        the level of a player without one.
    own_chart
        the chart that sets the races; None: `apa_8ball`.

    >>> LevelSteps(10, 3).move(19, won=True), LevelSteps(10, 3).move(20, won=False)
    (22, 17)
    """

    steps: int = 10
    entry: int = 3
    newcomer: int = 3
    own_chart: LevelChart | None = None
    name: str = "level-steps"

    publishes = "levels"
    winner_never_falls = True

    def __post_init__(self) -> None:
        whole(self.steps, "steps", at_least=1, at_most=100)
        whole(self.entry, "entry", at_least=1, at_most=self.steps)
        whole(self.newcomer, "newcomer", at_least=0)

    @property
    def in_words(self) -> str:  # type: ignore[override]
        """The rule in words."""
        return (
            f"one step up for a match won, one down for a match lost, {self.steps} steps to a level"
        )

    @property
    def chart(self) -> LevelChart:
        """The chart that sets the races."""
        return self.own_chart or level_chart("apa_8ball")

    @cached_property
    def states(self) -> Ints:
        """The published level of each state, from the lowest up."""
        return np.repeat(np.array(self.chart.levels), self.steps)

    def first_state(self, levels: Any) -> Ints:
        """Return the state in the middle of each level."""
        place = np.searchsorted(self.chart.levels, np.asarray(levels))
        return place * self.steps + self.steps // 2

    def move(self, state: Any, *, won: Any) -> Any:
        """Return the state after a match, elementwise; the end states stay."""
        state = np.asarray(state)
        inside = state % self.steps
        up = np.where(inside == self.steps - 1, state + self.entry, state + 1)
        down = np.where(inside == 0, state - self.entry, state - 1)
        after = np.where(won, up, down)
        after = np.where((after < 0) | (after >= len(self.states)), state, after)
        return int(after) if after.ndim == 0 else after

    def initial(self, entries: Entries) -> Floats:
        """Return the stated levels, or the newcomers' level if none is stated."""
        stated = np.where(np.isnan(entries.level), self.newcomer, entries.level)
        return nearest_level(self.chart, stated)


def level_steps(steps: int = 10) -> LevelSteps:
    """Return levels with this many steps; the entry is the third step, or the last if fewer.

    >>> level_steps(2).entry
    2
    """
    return LevelSteps(steps, min(3, whole(steps, "steps", at_least=1)))
