"""The stationary distribution of every closed class, and the mean times between its states.

Cut one state c out of the class. If T holds the arcs among the others, which are all left
eventually, and b the arcs out of c,

    (I - T) x = b,   law = (1, x) / (1 + sum x):

x is the expected number of visits to the others between two visits to c. The solve is free of
subtraction (see `transient`). If the whole chain is one small or dense class, c is the state that
is eliminated last: if L U = I - T for the whole class, the distribution is the last column of U^-1.

The mean time m_j from j to a target solves, over the states that are certain to reach it and with
w_j = 1 the time that a step from j takes,

    m_j = w_j + sum_i T[i, j] m_i.

The targets of a closed class are all solved for at once, by halves. Let A be one half of the
states and B the other, P = T_BA (I - T_AA)^-1 the chances of where the chain enters B from each
state of A, and h = (I - T_AA)^-T w_A the mean times until it does. Watched only while it is in
B, the chain has the arcs and times

    T_BB + P T_AB,   w_B + T_AB^T h,

from which its means to all targets in B follow in the same way. From a state of A they are
m_A = h + P^T m_B, and the targets in A follow with A and B exchanged. Nothing is subtracted:
I - T_AA is factored as in `dense_elimination`, and the rest adds up products of positive numbers.
Each level of halving costs a quarter of the one before: 1.1 n^3 multiplications and as many
additions in all, about as many as it takes to invert a matrix. Each state's arcs and its time are
multiplied by a random number, which changes no mean: otherwise hundreds of identical states would
all round in the same direction.

A transient state t is certain to be reached from j if and only if every path from j into a
closed class passes through t: t dominates j. What the chain does after t does not matter. So the
states that a state r dominates, if no other dominates r, make a closed class with it once r has
arcs to all of them: before they reach a target other than r, they do not meet r.

Underflow takes at most 2^-1074 away from an arc. As a step takes a time of 1 or more, the visits
to all states before the target come to m_j or fewer, so m_j has a relative loss of at most n
2^-1074 max m, which is negligible unless a mean is close to the largest float. Then the target is
solved for alone (see `transient`).

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993; Kemeny and Snell 1960, Finite
Markov Chains, sections 4.4 and 4.5; Meyer 1989, "Stochastic complementation, uncoupling Markov
chains, and the theory of nearly reducible systems"; Allen and Cocke 1972, "Graph theoretic
constructs for program control flow analysis", for the search for dominators.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg.blas import dasum, dtrsv

from evenbreak.arrays import Bools, Floats
from evenbreak.chains.arcs import Arcs, Places, put_back, sums, tree_from
from evenbreak.chains.birth_death import birth_death_law, line_of
from evenbreak.chains.certified import spread
from evenbreak.chains.chain import Chain, check_chain, labels
from evenbreak.chains.dense_elimination import MOST_ENTRIES, factored, is_dense, less, solved
from evenbreak.chains.elimination import decimal_law
from evenbreak.chains.factorization import SMALL
from evenbreak.chains.transient import TransientPart
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    import pandas as pd


_LARGE = 500
"""Number of states above which classes may be solved by iteration."""
_FAR = 1e290
"""Ratio of numbers above which the general method is used, which accounts for underflow."""


def stationary_laws(chain: Chain) -> Floats:
    """Return the stationary distribution of every closed class in one vector; shape (n,).

    Each entry is conditional on being in the closed class of its state, so the entries of
    a class sum to 1. Transient states have 0.

    Raises
    ------
    AccuracyError
        if a distribution cannot be guaranteed: it spans more decades than floats do and its class
        is too large for decimal numbers, or its class is too large and mixes too slowly.

    >>> from evenbreak.chains import chain_of
    >>> stationary_laws(chain_of([(1, 2, 0.5), (1, 1, 0.5), (2, 1, 1.0), (0, 1, 1.0)]))
    array([0.66666667, 0.33333333, 0.        ])
    """
    check_chain(chain)
    return laws_of(chain, chain.structure.closed)[0]


def laws_of(chain: Chain, classes: Bools) -> tuple[Floats, float | None]:
    """Return the distributions of the closed classes among `classes`, and a bound if there is one.

    One state of each class is cut out; the visits to the others between two visits to it are
    proportional to the distribution.
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
    """Whether there are so few states, or so many arcs, that a dense array is best."""
    n = arcs.size
    return n <= SMALL or (n * n <= MOST_ENTRIES and is_dense(n, len(arcs.chances)))


def dense_law(arcs: Arcs) -> Floats | None:
    """Return the distribution of the class that these arcs form; None if floats may be too short.

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
    """Return the distribution of one closed class, even if it spans more decades than floats do."""
    line = line_of(arcs.matrix())
    if line is None:
        return decimal_law(arcs)
    order, walk = line
    return put_back(birth_death_law(walk.up, walk.down), order)


MOST_STATES = 4000
"""Limit on the size of a chain. The largest takes about 5 seconds and 600 MB."""
_LARGEST = 2.0**960
"""Largest mean for which no underflow or overflow can have occurred."""
_FEW = 16
"""Number of states up to which they are eliminated one by one, for all targets at once."""


def mean_first_passages(chain: Chain) -> pd.DataFrame:
    """Return the mean number of steps until each state is first visited, from each state.

    As in `Chain.to_frame`, there is a column for each starting state, and a row for each state to
    be visited. The mean is 0 from a state to itself, and inf if the state may never be reached. For
    a single target, or the distribution, see `first_passage`.

    Raises
    ------
    ChainError
        if the chain has more than 4000 states.
    AccuracyError
        if a mean is larger than any float, or cannot be guaranteed.

    Notes
    -----
    No matter how stiff the chain is, each mean is accurate to a few units in the last place. Along
    a line of n identical states, rounding errors add up like the square root of n (seen: 1e-14 for
    n = 1000).

    >>> from evenbreak.chains import chain_of
    >>> mean_first_passages(chain_of([(1, 0, 0.25), (1, 2, 0.75), (2, 1, 1.0)]))
    from    1    0    2
    to
    1     0.0  inf  1.0
    0     7.0  0.0  8.0
    2     inf  inf  0.0
    """
    import pandas as pd

    check_chain(chain)
    n = len(chain)
    if n > MOST_STATES:
        raise ChainError(
            f"the chain must have at most {MOST_STATES} states; it has {n}. For a larger chain, "
            "use first_passage for each target you need."
        )
    means = np.full((n, n), np.inf)
    np.fill_diagonal(means, 0.0)
    transient, certain = _certain_visits(chain)
    closed = np.flatnonzero(chain.structure.closed).tolist()
    for label, visited in zip(closed, certain.T, strict=False):
        inside, before = chain.structure.members(label), transient[visited]
        within = _means_among(chain, inside)
        means[np.ix_(inside, inside)] = within
        if len(before):
            entries = chain.arcs.matrix()[:, before][inside]
            then = TransientPart(chain.arcs, before).values(1.0 + entries.T @ within.T)
            means[np.ix_(inside, before)] = then.T
    dominated = certain[:, len(closed) :]
    for root in np.flatnonzero(dominated.sum(axis=1) == 1):
        group = np.flatnonzero(dominated[:, root])
        if len(group) > 1:
            states, asked = transient[group], dominated[np.ix_(group, group)].T
            within = _means_among(chain, states, root=int(transient[root]))
            means[np.ix_(states, states)] = np.where(asked, within, np.inf)
    return pd.DataFrame(means, labels(chain.states, "to"), labels(chain.states, "from"))


def kemeny_constant(chain: Chain) -> float:
    """Return the mean number of steps to a state drawn from the stationary distribution.

    The number doesn't depend on the recurrent state in which the chain starts, and counts 0 steps
    if that state itself is drawn. It is small if the chain soon visits all states that matter.

    Raises
    ------
    ChainError
        if the chain has more than one closed class, or a closed class of more than 4000 states.
    AccuracyError
        if a mean is larger than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> kemeny_constant(chain_of([(1, 2, 0.5), (1, 1, 0.5), (2, 1, 0.25), (2, 2, 0.75)]))
    1.3333333333333333
    """
    check_chain(chain)
    recurrent = np.flatnonzero(chain.structure.recurrent)
    if chain.structure.closed.sum() > 1:
        raise ChainError(
            f"the chain has {chain.structure.closed.sum()} closed classes, but Kemeny's constant "
            "needs a chain with just one"
        )
    if len(recurrent) > MOST_STATES:
        raise ChainError(
            f"the closed class must have at most {MOST_STATES} states; it has {len(recurrent)}"
        )
    law = stationary_laws(chain)[recurrent]
    return float((law * _means_among(chain, recurrent)[:, law.argmax()]).sum())


def _certain_visits(chain: Chain) -> tuple[Places, Bools]:
    """Return the transient states, and the classes and states that each is certain to meet.

    Entry [j, c] of the second array says whether the j-th transient state is certain to get to the
    c-th closed class; the closed classes' columns are followed by those of the transient states
    themselves.
    """
    structure, arcs = chain.structure, chain.arcs
    inside, closed = structure.recurrent, np.flatnonzero(structure.closed)
    transient, count = np.flatnonzero(~inside), len(closed)
    n = count + len(transient)
    if n == count:
        return transient, np.empty((0, n), dtype=bool)
    place = np.empty(len(chain), dtype=np.int64)
    place[inside] = np.searchsorted(closed, structure.label[inside])
    place[transient] = np.arange(count, n)
    begun = ~inside[arcs.sources]
    sources, targets = place[arcs.sources[begun]], place[arcs.targets[begun]]
    onward = np.split(targets, np.searchsorted(sources, np.arange(count + 1, n)))
    # A state meets itself, and what all the states that may follow it meet: a bit for each.
    following = [near.tolist() for near in onward]
    meets = [1 << k for k in range(count)] + [-1] * len(transient)
    order = tree_from(n, targets, sources, np.arange(count))[0][count:].tolist()
    settled = False
    while not settled:
        settled = True
        for j in order:
            common = -1
            for i in following[j - count]:
                common &= meets[i]
                if not common:
                    break
            common |= 1 << j
            if common != meets[j]:
                meets[j], settled = common, False
    width = n // 8 + 1
    packed = b"".join(bits.to_bytes(width, "little") for bits in meets[count:])
    rows = np.frombuffer(packed, dtype=np.uint8).reshape(len(transient), width)
    return transient, np.unpackbits(rows, axis=1, count=n, bitorder="little").astype(bool)


def _means_among(chain: Chain, states: Places, root: int = -1) -> Floats:
    """Return the means among states that never leave each other, except for a root that may."""
    n = len(states)
    if n == 1:
        return np.zeros((1, 1))
    place = np.full(len(chain), -1)
    place[states] = np.arange(n)
    sources, targets = place[chain.arcs.sources], place[chain.arcs.targets]
    own = (sources >= 0) & (targets >= 0)
    A = np.zeros((n + 1, n), order="F")
    A[targets[own], sources[own]] = -chain.arcs.chances[own]
    A[n] = -1.0
    if root >= 0:
        A[:n, place[root]] = -1.0 / n
    A *= 1.0 + np.random.default_rng(0).random(n)
    with np.errstate(all="ignore"):
        means = _by_halves(A)
    for k in np.flatnonzero(~(means.max(axis=1) < _LARGEST)):
        others = np.flatnonzero((states != states[k]) & (states != root))
        part = TransientPart(chain.arcs, states[others])
        means[k, others] = part.values(np.ones(len(others)))
    return means


def _by_halves(A: Floats) -> Floats:
    """Return the means among all states of a chain; shape (n, n).

    A has shape (n + 1, n): the arcs, and the time of a step as the last row, all with a minus sign;
    the diagonal is ignored.
    """
    n = A.shape[1]
    if n <= _FEW:
        return _one_by_one(A)
    means = np.empty((n, n))
    halves = slice(0, n // 2), slice(n // 2, n)
    for here, gone in (halves, halves[::-1]):
        entering = np.concatenate((A[here, gone], A[-1:, gone]))
        among = np.concatenate((A[gone, gone], entering[:-1].sum(axis=0)[None]))
        block = factored(np.asfortranarray(among))
        onward = solved(block, entering.T, "U", transposed=True)
        P = solved(block, onward, "L", transposed=True).T  # minus P and, as its last row, minus h
        watched = np.concatenate((A[here, here], A[-1:, here]))
        within = _by_halves(less(watched, P, A[gone, here]))
        means[here, here] = within
        means[here, gone] = less(np.tile(-P[-1], (len(within), 1)), within, P[:-1])
    return means


def _one_by_one(A: Floats) -> Floats:
    """Return the means as `_by_halves` does, state by state for all targets at once."""
    n = A.shape[1]
    # Column t of `others` has the states other than t; each target has a copy of its own.
    others = np.arange(n - 1)[:, None]
    others = others + (others >= np.arange(n))
    rows = np.vstack((others, np.arange(n), np.full(n, n)))
    copies = -A[rows[:, None], others]
    for k in range(n - 1):
        onward = copies[k + 1 :, k] / copies[k + 1 : -1, k].sum(axis=0)
        copies[k + 1 :] += onward[:, None] * copies[k]
        copies[k + 1 :, k] = onward
    means = np.zeros((n, n))
    means[np.arange(n), others] = copies[-1]
    return means
