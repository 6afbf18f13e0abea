"""All eigenpairs of a chain whose classes are reversible, put together from those of its classes.

It serves chains without transient states, and chains of one transient class between absorbing
states, such as n-ahead matches. With T = D S D^-1 the arcs within the transient class, B the
arcs into the absorbing states and S q = lambda q, the pairs of M are

    R = (D q, B D q / (lambda - 1)),    L = (q^T D^-1, 0);

the pairs of eigenvalue 1 are the absorbing states and the chances of ending there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.chains.eigenpairs import DENSE, EPS, UnitPairs
from evenbreak.chains.reversible import SymmetricForm, symmetric_form

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain


@dataclass(frozen=True, eq=False)
class ReversiblePairs:
    """Eigenvalues of a chain, those of eigenvalue 1 first, and their vectors.

    Parameters
    ----------
    values
        shape (k,).
    orthonormal
        shape (n, k): the vectors Q of the symmetric forms of the classes.
    right, left
        shapes (n, k) and (k, n); an entry of `left` that no float can hold is infinite.
    missed
        the largest entry of S Q - Q diag(values) and of Q^T Q - I.
    limit_error
        a bound on the sum of the absolute errors of the limit by eigenvalue 1.
    """

    values: NDArray[np.float64]
    orthonormal: NDArray[np.float64]
    right: NDArray[np.float64]
    left: NDArray[np.float64]
    missed: float
    limit_error: float


def reversible_classes(chain: Chain) -> list[SymmetricForm] | None:
    """Return the symmetric forms of the classes, or None if this module does not serve the chain.

    >>> from evenbreak.chains import chain_of
    >>> reversible_classes(chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)])) is None
    True
    """
    structure = chain.structure
    sizes = np.diff(structure.offsets)
    open_classes = structure.count - int(structure.closed.sum())
    if open_classes > 1 or (open_classes and (sizes[structure.closed] > 1).any()):
        return None
    forms = []
    for label in range(structure.count):
        form = symmetric_form(chain, np.sort(structure.members(label)))
        if form is None:
            return None
        forms.append(form)
    return sorted(forms, key=lambda form: not structure.recurrent[form.states[0]])


def reversible_pairs(chain: Chain, forms: list[SymmetricForm], k: int) -> ReversiblePairs:
    """Return k eigenpairs of a chain from the symmetric forms of its classes, closed ones first.

    Raises
    ------
    AccuracyError
        if the iteration for a large class does not converge.
    """
    n = len(chain)
    recurrent, periods = chain.structure.recurrent, chain.structure.periods
    values, vectors, known, missed = [], [], [], 0.0
    scale = np.ones(n, dtype=np.longdouble)
    for form in forms:
        states = form.states
        scale[states] = form.roots
        period = int(periods[chain.structure.label[states[0]]])
        found, Q = form.pairs(min(k, len(states)))
        if recurrent[states[0]]:
            found, Q = _with_known(form, found, Q, period, chain.structure.phases[states])
        missed = max(missed, form.missed(found, Q))
        spread = np.zeros((n, len(found)))
        spread[states] = Q
        values.append(found)
        vectors.append(spread)
        known.append(np.arange(len(found)) == (0 if recurrent[states[0]] else -1))
    value, Q, ones = np.concatenate(values), np.hstack(vectors), np.concatenate(known)
    size = np.abs(value).round(10) if k == n or n <= DENSE else value
    order = np.lexsort((-value, -size, ~ones))[:k]
    value, Q, ones = value[order], Q[:, order], ones[order]
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        right = (scale[:, None] * Q).astype(np.float64)
        left = np.where(Q == 0.0, 0.0, Q / scale[:, None]).astype(np.float64).T
    into = chain.arcs.matrix()[:, ~recurrent]
    turning = ~ones & (np.abs(Q[~recurrent]).max(axis=0, initial=0.0) > 0.0)
    flow = into @ right[~recurrent][:, turning] / (value[turning] - 1.0)
    right[np.ix_(recurrent, turning)] = flow[recurrent]
    units = np.flatnonzero(ones)
    errors = [form.height_error for form in forms]
    if recurrent.all() and None not in errors:
        error = 2.0 * max(e for e in errors if e is not None) + 8.0 * EPS
        for u, form in zip(units, forms, strict=True):
            right[form.states, u], left[u, form.states] = form.law, 1.0
    else:
        pairs = UnitPairs(chain)
        right[:, units], left[units], error = pairs.right, pairs.left, pairs.error
    return ReversiblePairs(value, Q, right, left, missed, error)


def _with_known(
    form: SymmetricForm,
    values: NDArray[np.float64],
    Q: NDArray[np.float64],
    period: int,
    phases: Places,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Put in what the structure knows of a closed class, the pair of eigenvalue 1 first.

    Its vector is D itself; in a class of period 2 that of eigenvalue -1 is D with the signs of
    the phases. The others are made orthogonal to these, which matters only where an eigenvalue
    is very close.
    """
    root = form.roots.astype(np.float64)
    known, places = [root], [len(values) - 1]
    if period == 2 and len(values) == len(root) > 1:
        known.append(np.where(phases % 2, -root, root))
        places.append(0)
    others = np.delete(np.arange(len(values)), places)
    K, rest = np.stack(known, axis=1), Q[:, others]
    rest = rest - K @ (K.T @ rest)
    rest /= np.linalg.norm(rest, axis=0)
    ends = np.array([1.0, -1.0])[: len(known)]
    return np.concatenate((ends, values[others])), np.hstack((K, rest))
