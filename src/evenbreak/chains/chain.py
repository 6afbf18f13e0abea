"""The chain: states and a sparse column-stochastic matrix.

M[i, j] = P(next state is i | state is j), as in the source text: a probability vector v becomes M v
after one step. Everything else in this package is a function of a `Chain`.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike, NDArray
from scipy.sparse import csc_array

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.chains.arcs import Arcs, Places, arcs_of
from evenbreak.chains.birth_death import BirthDeath, birth_death_of, line_of
from evenbreak.chains.matrices import adding_up, csc_of
from evenbreak.chains.structure import Structure, structure_of
from evenbreak.chains.transient import TransientPart
from evenbreak.checks import generator_of, whole
from evenbreak.errors import ChainError
from evenbreak.game import ArcArrays, graph_of_arcs

if TYPE_CHECKING:
    from fractions import Fraction

    import networkx as nx
    import pandas as pd


_MOST_BYTES = 2e9
"""Limit for a dense matrix."""


@own_arrays
@dataclass(frozen=True, eq=False)
class Chain:
    """States and the transition matrix between them.

    Build it with `chain_of`, from a game, a graph or arcs.

    Parameters
    ----------
    states
        the states, in the order of the matrix; hashable and distinct.
    matrix
        shape (n, n), column-stochastic: entry [i, j] is the chance of i, given j. It is kept in
        sparse CSC form, to which numpy arrays and other sparse matrices are converted. An absorbing
        state has the self-loop 1. If the arcs of a state do not sum exactly to 1, its self-loop
        becomes the remainder of the others; without a self-loop, all arcs are scaled.
    start
        the state in which the game starts, or None.
    given
        the arcs whose chances are known as fractions, by the positions (source, target), for
        exact answers.

    Raises
    ------
    ChainError
        if the matrix does not have one row and one column for each state, a state is listed twice,
        or the matrix is not column-stochastic; the message names the state and its sum.
    """

    states: Sequence[Hashable]
    matrix: csc_array
    start: Hashable | None = None
    given: Mapping[tuple[int, int], Fraction] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if isinstance(self.states, (str, list)):
            copied = tuple if isinstance(self.states, str) else list
            object.__setattr__(self, "states", copied(self.states))
        n, matrix = len(self.states), csc_of(self.matrix)
        if n == 0 or matrix.shape != (n, n):
            raise ChainError(
                "the matrix must have one row and one column for each state, and at "
                f"least one state; its shape is {matrix.shape} for {n} states"
            )
        # Lazy sequences of states are distinct by construction.
        if isinstance(self.states, (list, tuple)) and len(set(self.states)) < n:
            raise ChainError("a state is listed twice. List each state once.")
        if not ((matrix.data >= 0.0) & (matrix.data <= 1.0)).all():
            raise ChainError("every entry in the matrix must be from 0 to 1; some aren't")
        if self.start is not None and self.start not in self.states:
            raise ChainError(f"start is {self.start!r}, which isn't a state of the chain")
        object.__setattr__(self, "matrix", adding_up(matrix, self.states))
        object.__setattr__(self, "given", dict(self.given))

    def __len__(self) -> int:
        return len(self.states)

    def __repr__(self) -> str:
        n, arcs = len(self), self.matrix.nnz
        return (
            f"<Chain of {n} state{'s' * (n != 1)}, {arcs} arc{'s' * (arcs != 1)}, "
            f"start {self.start!r}>"
        )

    def to_frame(self) -> pd.DataFrame:
        """Return the matrix as a DataFrame: a column per source state, a row per target state.

        >>> from evenbreak.chains import chain_of
        >>> chain_of([("rain", "rain", 0.75), ("rain", "sun", 0.25), ("sun", "rain", 1)]).to_frame()
        from  rain  sun
        to
        rain  0.75  1.0
        sun   0.25  0.0
        """
        import pandas as pd

        left, entered = labels(self.states, "from"), labels(self.states, "to")
        return pd.DataFrame(np.asarray(self), index=entered, columns=left)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        """Return the matrix as a new dense array, column-stochastic; for `np.asarray(chain)`.

        Raises ChainError if the array would take more than 2 GB, and ValueError if `copy` is False,
        since no dense array exists that could be shared.

        >>> from evenbreak.chains import chain_of
        >>> np.asarray(chain_of([("S", "W", 0.25), ("S", "S", 0.75)]))
        array([[0.75, 0.  ],
               [0.25, 1.  ]])
        """
        if copy is False:
            raise ValueError(
                "a chain has no dense matrix to share, so it must be copied. Leave out copy=False."
            )
        n = len(self)
        if 8 * n * n > _MOST_BYTES:
            raise ChainError(
                f"the dense matrix of {n:,} states would take {8e-9 * n * n:,.0f} GB. Use the "
                "sparse matrix, chain.matrix."
            )
        return self.matrix.toarray().astype(np.float64 if dtype is None else dtype, copy=False)

    def to_networkx(self) -> nx.DiGraph[Any]:
        """Return the chain as a directed graph, which `chain_of` reads back.

        As in `graph_of`, arcs carry `probability` and nodes `kind`: 'start', 'terminal' for an
        absorbing state, which then has no arcs, or else 'transient'. Chances are floats, even if
        `given` has fractions.

        >>> from evenbreak.chains import chain_of
        >>> graph = chain_of([("S", "W", 0.25), ("S", "S", 0.75)], start="S").to_networkx()
        >>> list(graph.edges(data="probability"))
        [('S', 'S', 0.75), ('S', 'W', 0.25)]
        >>> dict(graph.nodes(data="kind"))
        {'S': 'start', 'W': 'terminal'}
        """
        arcs = self.matrix.tocoo()
        kept = (arcs.data > 0.0) & (self.arcs.outflow[arcs.col] > 0.0)
        return graph_of_arcs(
            ArcArrays(self.states, arcs.col[kept], arcs.row[kept], arcs.data[kept]), self.start
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
        """The chain as a line of states, if each moves only to its neighbors in the matrix."""
        return birth_death_of(self.matrix)

    @cached_property
    def line(self) -> tuple[Places, BirthDeath] | None:
        """The order that puts the states in a line, and the chain in that order; see `line_of`."""
        return line_of(self.matrix)

    @cached_property
    def structure(self) -> Structure:
        """The communicating classes: which ones are closed, their kinds and periods."""
        return structure_of(self.arcs, self.matrix.diagonal() > 0.0)

    @cached_property
    def transient(self) -> TransientPart:
        """The transient states, with the solves `visits` and `values`."""
        return TransientPart(self.arcs, np.flatnonzero(~self.structure.recurrent))

    def density(self, start: Any = None) -> Floats:
        """Return the start as a probability vector with length n and sum 1.

        Parameters
        ----------
        start
            a state; a mapping from states to probabilities; an array of n
            probabilities; or None for the chain's own start.

        Raises
        ------
        ChainError
            if a state is unknown, no start is known, or a probability is negative, or they don't
            sum to 1 within 1e-9.
        """
        v = self.vector(self._own_start() if start is None else start, "start")
        if (v < 0.0).any():
            state = self.states[int(np.flatnonzero(v < 0.0)[0])]
            raise ChainError(
                f"the start vector must have probabilities; the one for state {state!r} is negative"
            )
        if not abs(v.sum() - 1.0) <= 1e-9:
            raise ChainError(f"the start vector must sum to 1; it sums to {v.sum():.12g}")
        return v

    def vector(self, values: Any, name: str) -> Floats:
        """Return a number for each state, shape (n,).

        Parameters
        ----------
        values
            an array of n numbers; a mapping or a pandas Series from states to numbers, with 0 for
            states not listed; or a single state, which gets 1.
        name
            its name, for the error message.

        Raises
        ------
        ChainError
            if a state is unknown, the shape is not (n,), or a number is not finite.
        """
        v = np.zeros(len(self))
        values = by_label(values, name)
        if isinstance(values, np.ndarray):
            if values.shape != v.shape:
                raise ChainError(f"{name} must have shape {v.shape}; its shape is {values.shape}")
            v += values
        elif isinstance(values, Mapping):
            for state, value in values.items():
                v[self.index(state)] = value
        else:
            v[self._search(values)] = 1.0
        if not np.isfinite(v).all():
            first = int(np.flatnonzero(~np.isfinite(v))[0])
            held = f"{float(v[first])!r} for state {self.states[first]!r}"
            raise ChainError(f"{name} must have finite numbers; one is {held}")
        return v

    def simulate(
        self, steps: int, rng: np.random.Generator | int, *, start: Any = None, paths: int = 1
    ) -> Ints:
        """Return random paths of the chain, as positions in `states`.

        Parameters
        ----------
        rng
            the random numbers: a generator or a seed.
        start
            as in `density`; each path draws its own first state.

        Returns
        -------
        array
            shape (paths, steps + 1); column t holds the states after t steps.

        Raises
        ------
        ChainError
            if the start is not one.
        InputError
            if `steps` or `paths` is not a whole number from 0.

        >>> from evenbreak.chains import chain_of
        >>> weather = chain_of({"rain": {"rain": 0.5, "sun": 0.5}, "sun": {"rain": 1}}, start="sun")
        >>> week = weather.simulate(6, 1)[0]
        >>> [weather.states[i] for i in week]
        ['sun', 'rain', 'rain', 'sun', 'rain', 'rain', 'sun']
        """
        steps, paths = whole(steps, "steps"), whole(paths, "paths")
        begin, draw = self.density(start), generator_of(rng)
        return random_paths(self.matrix, begin, steps, paths, draw)

    def _own_start(self) -> Hashable:
        if self.start is None:
            raise ChainError(
                "the chain has no start state. Give one, such as start={state}, or set one for "
                "all questions with chain_of(graph, start=...).",
                state=repr(self.states[0]),
            )
        return self.start

    def start_index(self, start: Any = None) -> int | None:
        """Return the position of the start state, or None if the start is a probability vector."""
        if start is None:
            start = self._own_start()
        return None if isinstance(start, (Mapping, np.ndarray)) else self._search(start)

    def _search(self, state: Hashable) -> int:
        """Return the position of one state without building a dictionary of all of them."""
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
        first = ", ".join(map(repr, self.states[:5]))
        return ChainError(f"state {state!r} isn't in the chain, whose first states are {first}")


def check_chain(chain: object) -> None:
    """Raise an error unless the argument is a chain; used by every function that takes one.

    >>> check_chain([("A", "B", 1.0)])
    Traceback (most recent call last):
    ...
    evenbreak.errors.ChainError: this is list [('A', 'B', 1.0)], not a chain. Make a chain with
        chain_of.
    """
    if not isinstance(chain, Chain):
        raise ChainError(
            f"this is {type(chain).__name__} {chain!r:.60}, not a chain. Make a chain with "
            "chain_of."
        )


def by_label(values: Any, name: str) -> Any:
    """Return a pandas Series as a dict keyed by its labels, anything else unchanged."""
    if not (
        hasattr(values, "to_dict") and hasattr(values, "index") and getattr(values, "ndim", 0) == 1
    ):
        return values
    if not values.index.is_unique:
        raise ChainError(f"{name} has the same label twice. Give each state one number.")
    return values.to_dict()


def check_present(states: Iterable[Hashable]) -> None:
    """Raise an error for NaN as a state: it is a gap in the data, and NaN does not equal itself."""
    for state in states:
        if isinstance(state, float) and math.isnan(state):
            raise ChainError(
                "a state is nan, which stands for missing data. Leave it out, or give it a name."
            )


def labels(states: Sequence[Any], name: str) -> pd.Index[Any]:
    """Return the states as a pandas index, in which tuples stay tuples."""
    import pandas as pd

    index: pd.Index[Any] = pd.Index(list(states), name=name, tupleize_cols=False)
    return index


def random_paths(
    matrix: csc_array, begin: Floats, steps: int, paths: int, rng: np.random.Generator
) -> Ints:
    """Return positions of states, shape (paths, steps + 1); the first are drawn from `begin`.

    Each step compares one uniform number with the cumulative chances of the column, by
    bisection over all paths at once. An arc of chance 0 is never taken.

    >>> from scipy.sparse import csc_array
    >>> swap = csc_array([[0.0, 1.0], [1.0, 0.0]])
    >>> random_paths(swap, np.array([1.0, 0.0]), 3, 2, np.random.default_rng(1))
    array([[0, 1, 0, 1],
           [0, 1, 0, 1]])
    """
    places = np.empty((paths, steps + 1), dtype=np.int64)
    cumulative = np.cumsum(begin)
    places[:, 0] = np.searchsorted(cumulative, rng.random(paths) * cumulative[-1], side="right")
    first, last = matrix.indptr[:-1].astype(np.int64), matrix.indptr[1:].astype(np.int64) - 1
    total = np.cumsum(matrix.data)
    cumulative = total - np.repeat(total[first] - matrix.data[first], last - first + 1)
    for t in range(steps):
        low, high = first[places[:, t]], last[places[:, t]]
        u = rng.random(paths) * cumulative[high]
        while (low < high).any():
            middle = (low + high) // 2
            beyond = u >= cumulative[middle]
            low, high = np.where(beyond, middle + 1, low), np.where(beyond, high, middle)
        places[:, t + 1] = matrix.indices[low]
    return places
