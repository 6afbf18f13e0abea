"""The chain: states and a sparse column-stochastic matrix.

M[i, j] = P(next state is i | state is j), as in the source text: a density v becomes M v
after one step. Everything else in this package is a function of a `Chain`.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.arcs import Arcs, arcs_of
from evenbreak.chains.birth_death import BirthDeath, birth_death_of
from evenbreak.chains.structure import Structure, structure_of
from evenbreak.chains.transient import TransientPart
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csc_array

_SUM_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class Chain:
    """States and the transition matrix between them.

    Build it with `chain_of`, from a game, a graph or arcs.

    Parameters
    ----------
    states
        the states, in the order of the matrix; hashable and distinct.
    matrix
        sparse CSC of shape (n, n), column-stochastic; an absorbing state has the self-loop 1.
    start
        the state in which the game begins, or None.

    Raises
    ------
    ChainError
        if the matrix is not column-stochastic; the message names the state and its sum.
    """

    states: Sequence[Hashable]
    matrix: csc_array
    start: Hashable | None = None

    def __post_init__(self) -> None:
        if isinstance(self.states, str):
            object.__setattr__(self, "states", tuple(self.states))
        n, matrix = len(self.states), self.matrix
        if n == 0 or matrix.shape != (n, n):
            raise ChainError(
                f"the matrix has shape {matrix.shape} for {n} states; give one row and one "
                "column for each state, and at least one state"
            )
        if not ((matrix.data >= 0.0) & (matrix.data <= 1.0)).all():
            raise ChainError("the matrix has entries outside 0 to 1; give probabilities")
        check_sums(self.states, matrix.T @ np.ones(n))

    def __len__(self) -> int:
        return len(self.states)

    def __repr__(self) -> str:
        n, arcs = len(self), self.matrix.nnz
        return (
            f"<Chain of {n} state{'s' * (n != 1)}, {arcs} arc{'s' * (arcs != 1)}, "
            f"start {self.start!r}>"
        )

    @cached_property
    def position(self) -> dict[Hashable, int]:
        """The position of each state in the matrix."""
        return {state: i for i, state in enumerate(self.states)}

    @cached_property
    def arcs(self) -> Arcs:
        """The arcs between different states, and the outflow of each state."""
        return arcs_of(self.matrix)

    @cached_property
    def birth_death(self) -> BirthDeath | None:
        """The chain as a line of states, if each moves to its neighbours only."""
        return birth_death_of(self.matrix)

    @cached_property
    def structure(self) -> Structure:
        """The communicating classes: which are closed, their kinds and periods."""
        return structure_of(self.arcs, self.matrix.diagonal() > 0.0)

    @cached_property
    def transient(self) -> TransientPart:
        """The transient states, with the solves `visits` and `values`."""
        return TransientPart(self.arcs, np.flatnonzero(~self.structure.recurrent))

    def density(self, start: Any = None) -> NDArray[np.float64]:
        """Return the start as a density: a vector of length n that sums to 1.

        Parameters
        ----------
        start
            a state; a mapping from states to probabilities; an array of n
            probabilities; or None for the chain's own start.

        Raises
        ------
        ChainError
            if a state is unknown, no start is known, or the density has a negative entry
            or does not sum to 1 within 1e-9.
        """
        v = self.vector(self._own_start() if start is None else start, "start")
        if (v < 0.0).any():
            state = self.states[int(np.flatnonzero(v < 0.0)[0])]
            raise ChainError(
                f"the start density of state {state!r} is negative; give probabilities"
            )
        if not abs(v.sum() - 1.0) <= 1e-9:
            raise ChainError(
                f"the start density sums to {v.sum():.12g}; give probabilities that sum to 1"
            )
        return v

    def vector(self, given: Any, name: str) -> NDArray[np.float64]:
        """Return a number for each state, shape (n,).

        Parameters
        ----------
        given
            an array of n numbers; a mapping from states to numbers, 0 for the others; or a
            state, which gets 1.
        name
            what it is called, for the error message.

        Raises
        ------
        ChainError
            if a state is unknown, the shape is not (n,), or a number is not finite.
        """
        v = np.zeros(len(self))
        if isinstance(given, np.ndarray):
            if given.shape != v.shape:
                raise ChainError(f"{name} has shape {given.shape}; give {v.shape}")
            v += given
        elif isinstance(given, Mapping):
            for state, value in given.items():
                v[self.index(state)] = value
        else:
            v[self._search(given)] = 1.0
        if not np.isfinite(v).all():
            first = int(np.flatnonzero(~np.isfinite(v))[0])
            held = f"{float(v[first])!r} for state {self.states[first]!r}"
            raise ChainError(f"{name} holds {held}; give finite numbers")
        return v

    def _own_start(self) -> Hashable:
        if self.start is None:
            raise ChainError("the chain has no start of its own; give a start state")
        return self.start

    def start_index(self, start: Any = None) -> int | None:
        """Return the position of the start state, or None if the start is a density."""
        if start is None:
            start = self._own_start()
        return None if isinstance(start, (Mapping, np.ndarray)) else self._search(start)

    def _search(self, state: Hashable) -> int:
        """Return the position of one state, without making a dictionary of all of them."""
        if "position" in self.__dict__:
            return self.index(state)
        try:
            return self.states.index(state)
        except ValueError:
            raise self._unknown(state) from None

    def index(self, state: Hashable) -> int:
        """Return the position of `state` in the matrix.

        Raises
        ------
        ChainError
            if the chain has no such state.
        """
        try:
            return self.position[state]
        except (KeyError, TypeError):
            raise self._unknown(state) from None

    def _unknown(self, state: Hashable) -> ChainError:
        known = ", ".join(repr(known) for known in self.states[:5])
        return ChainError(f"state {state!r} is not in the chain; its states begin {known}")


def check_sums(states: Sequence[Hashable], sums: NDArray[np.float64]) -> None:
    """Raise a ChainError unless the arcs out of each state sum to 1 within 1e-9."""
    wrong = np.flatnonzero(~(np.abs(sums - 1.0) <= _SUM_TOLERANCE))
    if wrong.size:
        first = wrong[0]
        more = f" (and so for {wrong.size - 1} more)" if wrong.size > 1 else ""
        raise ChainError(
            f"the arcs out of state {states[first]!r} sum to {sums[first]:.12g}{more}; "
            "give probabilities that sum to 1 within 1e-9, a self-loop included"
        )
