"""Chains from observed sequences of states, with their uncertainty.

With c_ij steps seen from j to i, and n_j = sum_i c_ij, the most likely chances are

    p_ij = c_ij / n_j,   standard error sqrt(p_ij (1 - p_ij) / n_j).

What follows from the chances, such as a limit, is as uncertain as it is over chains whose
columns are drawn from Dirichlet(c_j): the posterior under Haldane's prior.

References: Anderson and Goodman 1957, "Statistical inference about Markov chains"; Rubin 1981,
"The Bayesian bootstrap".
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array, csc_array

from evenbreak.arrays import Floats, array_values
from evenbreak.chains.chain import Chain, check_present
from evenbreak.checks import generator_of
from evenbreak.errors import ChainError

if TYPE_CHECKING:


@array_values
@dataclass(frozen=True, eq=False)
class FittedChain:
    """The most likely chain of observed sequences.

    Parameters
    ----------
    chain
        the chain with the most likely chances. A state that was never seen to be left absorbs.
    counts
        shape (n, n): entry [i, j] is the number of steps seen from state j to state i.
    """

    chain: Chain
    counts: csc_array

    @property
    def standard_errors(self) -> csc_array:
        """The standard error of each chance, shape (n, n); 0 where no step was seen."""
        seen = self._seen()
        p = self.counts.data / seen
        return self._with(np.sqrt(p * (1.0 - p) / seen))

    def draw(self, rng: np.random.Generator | int) -> Chain:
        """Return a chain drawn from those that may lie behind the sequences.

        Only steps that were seen have a chance. Draw several hundred chains; whatever is
        calculated from the chain is as uncertain as its values spread over them. `rng` is a
        generator, or a seed for a single chain.

        >>> fitted = fit_chain([["rack", "won"]] * 60 + [["rack", "lost"]] * 40)
        >>> rng = np.random.default_rng(1)
        >>> won = [fitted.draw(rng).matrix[1, 0] for _ in range(1000)]
        >>> np.round([np.mean(won), np.std(won)], 2)
        array([0.6 , 0.05])
        """
        draw = generator_of(rng)
        weights = self._with(draw.standard_gamma(self.counts.data))
        total = weights.sum(axis=0)
        left = np.repeat(total, np.diff(self.counts.indptr))
        return Chain(
            self.chain.states, _absorbing(self._with(weights.data / left)), self.chain.start
        )

    def _seen(self) -> Floats:
        """Return the number of steps seen from the state of each entry of `counts`."""
        return np.repeat(self.counts.sum(axis=0), np.diff(self.counts.indptr))

    def _with(self, data: Floats) -> csc_array:
        return csc_array((data, self.counts.indices, self.counts.indptr), shape=self.counts.shape)


def fit_chain(
    sequences: Iterable[Iterable[Hashable]], *, start: Hashable | None = None
) -> FittedChain:
    """Return the most likely chain of observed sequences of states.

    Parameters
    ----------
    sequences
        each a sequence of states, one for each step; no step leads from one sequence to the
        next. The states are numbered as they appear.
    start
        the start of the chain, or None.

    Raises
    ------
    ChainError
        if no step was seen, a sequence is text, a state is NaN or cannot be hashed, or the start
        is not a state.

    >>> fitted = fit_chain([["A", "B", "A", "A", "won"], ["B", "A", "lost"]])
    >>> fitted.chain.states
    ['A', 'B', 'won', 'lost']
    >>> fitted.chain.matrix.toarray()[:, 0], fitted.standard_errors.toarray()[:, 0].round(3)
    (array([0.25, 0.25, 0.25, 0.25]), array([0.217, 0.217, 0.217, 0.217]))
    """
    position: dict[Hashable, int] = {}
    sources: list[int] = []
    targets: list[int] = []
    if isinstance(sequences, Mapping) or hasattr(sequences, "columns"):
        raise ChainError(
            f"sequences is a {type(sequences).__name__}; give a list of sequences, such as "
            "frame.to_numpy() of a DataFrame with one sequence in each row"
        )
    for sequence in sequences:
        if isinstance(sequence, str):
            raise ChainError(
                f"a sequence is the text {sequence!r:.60}; give lists of states, "
                "list(text) if each letter is one"
            )
        try:
            path = [position.setdefault(state, len(position)) for state in sequence]
        except TypeError:
            raise ChainError(
                f"a sequence is {sequence!r:.60}; give lists of states that can be hashed"
            ) from None
        sources += path[:-1]
        targets += path[1:]
    if not sources:
        raise ChainError("the sequences hold no step; give sequences of at least two states")
    if start is not None and start not in position:
        raise ChainError(f"start is {start!r}, which is in none of the sequences")
    check_present(position)
    n = len(position)
    counts = coo_array((np.ones(len(sources)), (targets, sources)), shape=(n, n)).tocsc()
    chances = counts.data / np.repeat(counts.sum(axis=0), np.diff(counts.indptr))
    likely = csc_array((chances, counts.indices, counts.indptr), shape=(n, n))
    return FittedChain(Chain(list(position), _absorbing(likely), start), counts)


def _absorbing(matrix: csc_array) -> csc_array:
    """Return the matrix with a self-loop of 1 for each state without arcs."""
    ends = np.flatnonzero(np.diff(matrix.indptr) == 0)
    loops = coo_array((np.ones(len(ends)), (ends, ends)), shape=matrix.shape)
    return csc_array(matrix + loops.tocsc())
