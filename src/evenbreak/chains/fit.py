"""Chains from observed sequences of states, with their uncertainty.

With c_ij steps seen from j to i, and n_j = sum_i c_ij, the most likely chances are

    p_ij = c_ij / n_j,   standard error sqrt(p_ij (1 - p_ij) / n_j).

The uncertainty of anything derived from the chances, such as a limit, is its spread over chains
whose columns are drawn from Dirichlet(c_j): the posterior under Haldane's prior.

References: Anderson and Goodman 1957, "Statistical inference about Markov chains"; Rubin 1981,
"The Bayesian bootstrap".
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csc_array

from evenbreak.arrays import Floats, array_values
from evenbreak.chains.chain import Chain, check_present
from evenbreak.chains.explore import chain_from_arrays
from evenbreak.checks import generator_of
from evenbreak.errors import ChainError


@array_values
@dataclass(frozen=True, eq=False)
class FittedChain:
    """Maximum likelihood chain for observed sequences.

    Parameters
    ----------
    chain
        the chain with the most likely chances. A state that was never seen to be left is absorbing.
    counts
        shape (n, n): entry [i, j] is the number of steps seen from state j to state i.
    """

    chain: Chain
    counts: csc_array

    @property
    def standard_errors(self) -> csc_array:
        """The standard error of each chance, shape (n, n); 0 if no step was seen."""
        seen = np.repeat(self.counts.sum(axis=0), np.diff(self.counts.indptr))
        p = self.counts.data / seen
        errors = self.counts.copy()
        errors.data = np.sqrt(p * (1.0 - p) / seen)
        return errors

    def draw(self, rng: np.random.Generator | int) -> Chain:
        """Return a chain drawn from the posterior, given the sequences.

        Only steps that were seen have a positive chance. Draw several hundred chains: the spread of
        any quantity over them is its uncertainty. `rng` is a generator, or a seed for a single
        chain.

        >>> fitted = fit_chain([["rack", "won"]] * 60 + [["rack", "lost"]] * 40)
        >>> rng = np.random.default_rng(1)
        >>> won = [fitted.draw(rng).matrix[1, 0] for _ in range(1000)]
        >>> np.round([np.mean(won), np.std(won)], 2)
        array([0.6 , 0.05])
        """
        weights = generator_of(rng).standard_gamma(self.counts.data)
        return _chain(self.chain.states, self.counts, weights, self.chain.start)


def fit_chain(
    sequences: Iterable[Iterable[Hashable]], *, start: Hashable | None = None
) -> FittedChain:
    """Return the maximum likelihood chain for observed sequences of states.

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
        if no step was seen, a sequence is a string, a state is NaN or cannot be hashed, or the
        start is not a state.

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
            f"sequences is a {type(sequences).__name__}. Give a list of sequences, such as "
            "frame.to_numpy() if a DataFrame has one sequence in each row."
        )
    for sequence in sequences:
        if isinstance(sequence, str):
            raise ChainError(
                f"a sequence must be a list of states; you gave the string {sequence!r:.60}. If "
                "each letter is a state, give list(text)."
            )
        try:
            path = [position.setdefault(state, len(position)) for state in sequence]
        except TypeError:
            raise ChainError(
                f"a sequence must be a list of hashable states; you gave {sequence!r:.60}"
            ) from None
        sources += path[:-1]
        targets += path[1:]
    if not sources:
        raise ChainError("the sequences have no steps. Give sequences of at least two states.")
    check_present(position)
    n = len(position)
    counts = coo_array((np.ones(len(sources)), (targets, sources)), shape=(n, n)).tocsc()
    states = list(position)
    return FittedChain(_chain(states, counts, counts.data, start), counts)


def _chain(
    states: Sequence[Hashable], counts: csc_array, weights: Floats, start: Hashable | None
) -> Chain:
    """Return the chain whose chances are proportional to weights, one for each entry of counts."""
    sources = np.repeat(np.arange(len(states)), np.diff(counts.indptr))
    chances = weights / np.bincount(sources, weights)[sources]
    return chain_from_arrays(states, sources, counts.indices, chances, start)
