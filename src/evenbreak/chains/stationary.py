"""The stationary law of every closed class: the density on it that M leaves unchanged.

Cut one state c out of the class. With T the arcs among the others, which are all left in the
end, and b the arcs out of c,

    (I - T) x = b,   law = (1, x) / (1 + sum x):

x is the expected number of visits to the others between two visits to c. The solve is free of
subtraction (see `transient`). Where the whole chain is one small or dense class, c is the state
that is eliminated last: with L U = I - T of the whole class, the law is the last column of U^-1.

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg.blas import dasum, dtrsv

from evenbreak.chains.arcs import put_back, sums
from evenbreak.chains.birth_death import birth_death_law, line_of
from evenbreak.chains.certified import spread
from evenbreak.chains.chain import check_chain
from evenbreak.chains.dense_elimination import MOST_ENTRIES, factored, is_dense
from evenbreak.chains.elimination import decimal_law
from evenbreak.chains.factorisation import SMALL
from evenbreak.chains.transient import TransientPart

if TYPE_CHECKING:
    from evenbreak.arrays import Bools, Floats
    from evenbreak.chains.arcs import Arcs
    from evenbreak.chains.chain import Chain


_LARGE = 500
"""Classes of so many states may be solved by iteration."""
_FAR = 1e290
"""Numbers so far apart are left to the general way, which knows what underflow costs."""


def stationary_laws(chain: Chain) -> Floats:
    """Return the stationary law of every closed class in one vector; shape (n,).

    Each entry is conditional on being in the closed class of its state, so the entries of
    a class sum to 1. Transient states have 0.

    Parameters
    ----------
    chain
        the chain.

    Raises
    ------
    AccuracyError
        if a law cannot be guaranteed: it spans more decades than floats do and its class is
        too large for decimal numbers, or its class is too large and mixes too slowly.

    >>> from evenbreak.chains import chain_of
    >>> stationary_laws(chain_of([(1, 2, 0.5), (1, 1, 0.5), (2, 1, 1.0), (0, 1, 1.0)]))
    array([0.66666667, 0.33333333, 0.        ])
    """
    check_chain(chain)
    return laws_of(chain, chain.structure.closed)[0]


def laws_of(chain: Chain, classes: Bools) -> tuple[Floats, float | None]:
    """Return the laws of those of `classes` that are closed, and a bound if there is one.

    One state of each class is cut out; the visits to the others between two visits to it
    are proportional to the law.
    """
    structure = chain.structure
    if structure.count == 1 and classes[0] and suits_array(chain.arcs):
        whole = dense_law(chain.arcs)
        if whole is not None:
            return whole, None
    wanted = classes & structure.closed
    law = np.zeros(len(chain))
    cut = structure.order[structure.offsets[:-1][wanted]]
    for k in np.flatnonzero(np.diff(structure.offsets)[wanted] > _LARGE).tolist():
        # Cut where the class spends much of its time, the others are soon left.
        members = np.sort(structure.members(int(np.flatnonzero(wanted)[k])))
        arcs, _ = chain.arcs.among(members)
        cut[k] = members[spread(arcs.matrix(), arcs.outflow).argmax()]
    law[cut] = 1.0
    inside = wanted[structure.label]
    rest = inside.copy()
    rest[cut] = False
    bound = None
    if rest.any():
        states = np.flatnonzero(rest)
        part = TransientPart(chain.arcs, states)
        x, doubtful = part.attempt((chain.arcs.matrix() @ law)[states, None])
        law[states] = x[:, 0]
        bound = part.bound
        for label in np.unique(structure.label[states[doubtful[:, 0]]]):
            members = structure.members(label)
            law[members] = _law_of(chain.arcs.among(members)[0])
    # Scaled to a largest entry of 1 first, so that the sum cannot overflow.
    top = np.zeros(structure.count)
    np.maximum.at(top, structure.label[inside], law[inside])
    law[inside] /= top[structure.label[inside]]
    total = sums(structure.label[inside], law[inside], structure.count)
    law[inside] /= total[structure.label[inside]]
    return law, bound


def suits_array(arcs: Arcs) -> bool:
    """Whether the states are so few, or the arcs so many, that a dense array is best."""
    n = arcs.size
    return n <= SMALL or (n * n <= MOST_ENTRIES and is_dense(n, len(arcs.chances)))


def dense_law(arcs: Arcs) -> Floats | None:
    """Return the law of the one class that the arcs make, or None if floats may be too short.

    >>> from scipy.sparse import csc_array
    >>> from evenbreak.chains.arcs import arcs_of
    >>> dense_law(arcs_of(csc_array([[0.5, 0.25], [0.5, 0.75]])))
    array([0.33333333, 0.66666667])
    """
    n = arcs.size
    many = n > SMALL
    A = np.zeros((n, n), order="C" if many else "F")
    A[arcs.targets, arcs.sources] = -arcs.chances
    block = factored(np.asfortranarray(A))
    law: Floats = np.zeros(n)
    law[-1] = 1.0
    law = dtrsv(block, law, 1, 0, 0, 0, 1, 1)  # with ones on the diagonal, overwriting
    block[-1, -1] = 1.0  # the last state is not left
    total = dasum(law)
    if not (total < _FAR and (law * block.diagonal()).min() * _FAR > n * total):
        return None
    if many:
        # The balance of a state with all others takes the mean of their rounding errors.
        law = (A * law).sum(axis=1) / arcs.outflow
    law /= law.sum()
    return law


def _law_of(arcs: Arcs) -> Floats:
    """Return the law of one closed class, also if it spans more decades than floats do."""
    line = line_of(arcs.matrix())
    if line is None:
        return decimal_law(arcs)
    order, walk = line
    return put_back(birth_death_law(walk.up, walk.down), order)
