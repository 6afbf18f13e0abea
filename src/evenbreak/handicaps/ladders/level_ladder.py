r"""Ladder of skill levels: the levels of a player with a known strength in the long run.

A level system with finitely many states moves a player by matches won and lost. Against an opponent
at level j, who is met with the chance q_j and is as strong as that level, a player of strength s in
a state at level i wins with the chance W(p; race of i and j), p = 1 / (1 + 2^(-(s - s_j) / 100)).
So the state is a Markov chain,

    P(state -> after a win) = sum over j of q_j W,   P(state -> after a loss) = the rest,

whose stochastic limit is the share of time at each level.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.chains.explore import chain_of
from evenbreak.chains.limits import limit_of
from evenbreak.chains.passage_times import first_passage
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.charts.level_skills import FARGO, LevelSkills, level_skills
from evenbreak.handicaps.systems.markov import MarkovSystem
from evenbreak.matches.win import race_win_probability


@dataclass(frozen=True, eq=False)
class LevelLadder:
    """A player's state in a level system, as a game without an end.

    Parameters
    ----------
    strength
        the player's strength, in points of `skills`.
    opponents
        how often the player meets opponents at each level of the chart; any positive weights.
    skills
        the strength of the levels; None: the default of `level_skills`.
    start_level
        the level at which the player starts; None: the one closest to the strength.

    >>> from evenbreak.handicaps import system_of
    >>> ladder = LevelLadder(system_of("level-steps"), 238.0, (1, 1, 1, 1, 1, 1))
    >>> ladder.level, {level: round(share, 3) for level, share in ladder.shares.items()}
    (5, {2: 0.0, 3: 0.0, 4: 0.096, 5: 0.655, 6: 0.244, 7: 0.004})
    """

    system: MarkovSystem
    strength: float
    opponents: tuple[float, ...]
    skills: LevelSkills | None = None
    start_level: int | None = None

    def __post_init__(self) -> None:
        chart = self.system.chart
        if not isinstance(chart, LevelChart):
            raise InputError("the system {name} has no level chart", name=self.system.name)
        if len(self.opponents) != len(chart.levels) or not sum(self.opponents) > 0.0:
            raise InputError(
                "{opponents} must be a weight for each of the levels {levels}; you gave {value!r}",
                value=self.opponents,
                levels=", ".join(map(str, chart.levels)),
            )

    @cached_property
    def _skills(self) -> LevelSkills:
        chart: Any = self.system.chart
        return level_skills(chart) if self.skills is None else self.skills

    @property
    def level(self) -> int:
        """The level whose strength is closest to the player's."""
        return self._skills.levels[int(np.abs(self._skills.points - self.strength).argmin())]

    @property
    def start(self) -> int:
        """The state at the start."""
        level = self.level if self.start_level is None else self.start_level
        return int(self.system.first_state(level))

    @cached_property
    def wins(self) -> Floats:
        """P(the player wins the next match | state), shape (states,)."""
        skills = self._skills
        own, levels = np.asarray(self.system.states), np.asarray(skills.levels)
        m, n = self.system.race(own[:, None], levels)
        p = FARGO.win_probability(self.strength - skills.points)
        met = np.asarray(self.opponents, dtype=float) / sum(self.opponents)
        return np.asarray(race_win_probability(p[None, :], m, n) @ met, dtype=float)

    def moves(self, state: int) -> Mapping[int, float]:
        """Return the states after the next match, with their chances."""
        won, lost = (int(self.system.move(state, won=won)) for won in (True, False))
        p = float(self.wins[state])
        return {won: p, lost: 1.0 - p} if won != lost else {won: 1.0}

    def winner(self, state: int) -> None:  # noqa: ARG002
        """Return None: no state is the end."""
        return

    @cached_property
    def law(self) -> Floats:
        """The share of time in each state in the long run, shape (states,)."""
        limit = limit_of(self)
        return np.array([limit.get(state, 0.0) for state in range(len(self.system.states))])

    @property
    def shares(self) -> dict[int, float]:
        """The share of time at each level in the long run."""
        sums = np.bincount(np.asarray(self.system.states), self.law)
        return {level: float(sums[level]) for level in self._skills.levels}

    @property
    def long_run_wins(self) -> float:
        """P(the player wins a match) in the long run."""
        return float(self.law @ self.wins)

    def matches_to_level(self) -> float:
        """Return the mean number of matches until the player first reaches their own level."""
        target = [k for k, level in enumerate(self.system.states) if level == self.level]
        if self.start in target:
            return 0.0
        return float(first_passage(chain_of(self), self.start, target).mean or np.inf)

    def dumping(self, most: int, earnest: int, in_a_row: int = 3) -> list[Dumping]:
        """Return the exact gain from 0, 1, ..., `most` matches lost on purpose.

        As in `sandbagging`, a player at the start loses them, then plays `earnest` honest matches,
        and is compared with one who plays all of them honestly.
        """
        states = len(self.system.states)
        up, down = (self.system.move(np.arange(states), won=won) for won in (True, False))

        def after(law: Floats, wins: Any) -> Floats:
            won = np.bincount(up, law * wins, states)
            return np.asarray(won + np.bincount(down, law * (1.0 - wins), states), dtype=float)

        honest = [np.eye(states)[self.start]]
        for _ in range(most + earnest):
            honest.append(after(honest[-1], self.wins))
        expected = np.array([law @ self.wins for law in honest[:-1]])
        rows, dumped_law = [], honest[0]
        for dumped in range(most + 1):
            law, won = dumped_law, 0.0
            for _ in range(earnest):
                won += float(law @ self.wins)
                law = after(law, self.wins)
            published = np.asarray(self.system.states, dtype=float)
            rows.append(
                Dumping(
                    dumped,
                    float((dumped_law - honest[dumped]) @ published),
                    float(expected[:dumped].sum()),
                    float(dumped_law @ self.wins),
                    float(dumped_law @ self.wins**in_a_row),
                    won - float(expected[dumped : dumped + earnest].sum()),
                    0.0,
                )
            )
            dumped_law = after(dumped_law, 0.0)
        return rows


class Dumping(NamedTuple):
    """Effect of losing some matches on purpose, compared with an honest player.

    Parameters
    ----------
    dumped
        matches lost on purpose before the first that counts.
    published
        mean difference between the published number and the honest player's; negative if lower.
    given_away
        mean number of the dumped matches that the honest player would win.
    p_first, p_in_a_row
        P(the first match that counts is won), and P(a given number of them are won in a row).
    extra_wins, error
        mean number of additional wins in matches that count, compared with the honest player, and
        its standard error: 0 if exact.
    """

    dumped: int
    published: float
    given_away: float
    p_first: float
    p_in_a_row: float
    extra_wins: float
    error: float

    def profit(self, stake: float, dumped_stake: float, prize: float, honest_prize: float) -> float:
        """Return the gain over an honest player, in the units of the stakes."""
        won = stake * self.extra_wins - dumped_stake * self.given_away
        return won + prize * (self.p_in_a_row - honest_prize)
