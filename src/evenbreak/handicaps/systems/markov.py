"""Level systems with a finite Markov state: each match moves a player from state to state."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.handicaps.systems.history import History, Matches, positions
from evenbreak.handicaps.systems.system import System


class MarkovSystem(System):
    """Level system in which each match moves a player between finitely many states.

    A state is a whole number from 0 up. Where the next state depends only on the last one and on
    whether the match was won, the long run can be solved: `LevelLadder` does, and `evenbreak
    ladder` with it.
    """

    publishes = "levels"

    @property
    @abstractmethod
    def states(self) -> Ints:
        """The published level of each state."""

    @abstractmethod
    def first_state(self, levels: Any) -> Ints:
        """Return the state in which players at these levels start, elementwise."""

    @abstractmethod
    def move(self, state: Any, *, won: Any) -> Any:
        """Return the state after a match, elementwise."""

    def update(self, history: History) -> Floats:
        """Return the levels after the night's matches, played one after the other."""

        def add(state: Ints, matches: Matches) -> Ints:
            flat = state.reshape(-1)
            won = matches.won_a
            for row in range(len(matches)):
                there = np.atleast_1d(matches.played[row])
                for who, has_won in ((matches.a, won), (matches.b, ~won)):
                    place = np.atleast_1d(positions(who, state.shape)[row])[there]
                    flat[place] = self.move(flat[place], won=np.atleast_1d(has_won[row])[there])
            return flat.reshape(state.shape)

        states = history.fold("states", lambda: self.first_state(history.initial), add)
        return np.asarray(self.states[states], dtype=float)
