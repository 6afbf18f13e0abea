"""The stochastic limits from all states at once, as one sparse matrix."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array

from evenbreak.chains.arcs import summed
from evenbreak.chains.chain import check_chain
from evenbreak.chains.stationary import stationary_laws
from evenbreak.errors import InputError

if TYPE_CHECKING:
    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain

_COLUMNS = 64

MOST_ENTRIES = 50_000_000
"""Entries that a matrix of limits may have; they take 12 bytes each, and more on the way."""


def limit_matrix(chain: Chain) -> csc_array:
    """Return the limits from all states; shape (n, n), column j is the limit from state j.

    For states in a line, with absorbing states at its ends, there is a closed form. Otherwise
    time and memory are those of one solve for each closed class that is entered from outside,
    and of the entries that are not 0. The accuracy is that of `stochastic_limit`.

    Raises
    ------
    AccuracyError
        if an entry cannot be guaranteed.
    InputError
        if more than 50 million entries are not 0, as in a closed class of 7,000 states.

    >>> from evenbreak.chains import chain_of
    >>> chain = chain_of([(1, 0, 0.5), (1, 2, 0.5), (2, 1, 0.25), (2, 3, 0.75)])
    >>> chain.states, limit_matrix(chain).toarray()[[1, 3]]
    ([1, 0, 2, 3], array([[0.57142857, 1.        , 0.14285714, 0.        ],
                          [0.42857143, 0.        , 0.85714286, 1.        ]]))
    """
    check_chain(chain)
    limits = None if chain.birth_death is None else chain.birth_death.limits()
    if limits is not None:
        return limits
    n, structure = len(chain), chain.structure
    law = stationary_laws(chain)
    inside = np.flatnonzero(structure.recurrent)
    home = structure.label[inside]
    spread = csc_array((law[inside], (inside, home)), shape=(n, structure.count))
    ends = _ends_from_all(chain, inside, home)
    sizes, starts = np.diff(spread.indptr), np.diff(ends.tocsr().indptr)
    entries = int(sizes.astype(np.int64) @ starts.astype(np.int64))
    if entries > MOST_ENTRIES:
        raise InputError(
            f"the limits from all {n:,} states have {entries:,} entries that are not 0, more than "
            f"{MOST_ENTRIES:,}; use stochastic_limit for the states you want to start from"
        )
    return csc_array(spread @ ends)


def _ends_from_all(chain: Chain, inside: Places, home: Places) -> csc_array:
    """Return the chance of ending in each class, from each state; shape (classes, n)."""
    arcs, structure, part = chain.arcs, chain.structure, chain.transient
    shape = structure.count, len(chain)
    ends = csc_array((np.ones(len(inside)), (home, inside)), shape=shape)
    entering = structure.recurrent[arcs.targets] & ~structure.recurrent[arcs.sources]
    into = structure.label[arcs.targets[entering]]
    entries = summed(into, arcs.sources[entering], arcs.chances[entering], shape)
    entered = np.unique(into)
    for first in range(0, len(entered), _COLUMNS):
        classes = entered[first : first + _COLUMNS]
        chances = part.values(entries[classes].toarray().T[part.states])
        row, column = np.nonzero(chances)
        values = chances[row, column]
        ends = ends + csc_array((values, (classes[column], part.states[row])), shape=shape)
    return ends
