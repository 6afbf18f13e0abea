"""How the stochastic limit responds to small changes of the probabilities.

F = c . P v is a weighted sum of the limit's entries, with P the projection on eigenvalue 1.
If M changes by dM (columns that sum to 0; no class opened or joined to another),

    dF = c . (P dM A + A dM P) v,    A = (I - M)^# the group inverse,

so dF is the sum over arcs j -> i of dM_ij G_ij with

    G_ij = x_j a_i   for transient j:  x the expected visits, a_i the value of F from i;
    G_ij = pi_j h_i  for recurrent j:  pi the limit, (I - M^T) h = c - a on its class.

One solve forwards (x, pi) and one backwards (a, h) serve all arcs.

References: Meyer 1975 and Schweitzer 1968 for the group inverse; Kato, Perturbation Theory,
ch. II for dP; Caswell 2019 for compensation in proportion.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csc_array

from evenbreak.arrays import Floats, array_values
from evenbreak.chains.arcs import sums
from evenbreak.chains.chain import Chain, check_chain
from evenbreak.chains.limits import stochastic_limit
from evenbreak.chains.stationary import stationary_laws
from evenbreak.chains.transient import TransientPart
from evenbreak.errors import ChainError


@array_values
@dataclass(frozen=True, eq=False)
class Sensitivity:
    """The derivatives of a weighted sum of a stochastic limit.

    Parameters
    ----------
    value
        the weighted sum itself.
    matrix
        shape (n, n), sparse, with the arcs of the chain: entry [i, j] is the derivative of
        `value` with respect to the probability of the arc from j to i, with j's other arcs reduced
        in proportion; 0 if j has no other arc.
    """

    chain: Chain
    value: float
    matrix: csc_array
    _sides: tuple[Floats, Floats, Floats] = field(repr=False)

    def __getitem__(self, arc: tuple[Hashable, Hashable]) -> float:
        j, i = (self.chain.index(state) for state in arc)
        if self.chain.matrix[i, j] == 0.0:
            raise ChainError(f"there's no arc {arc[0]!r} -> {arc[1]!r} in the chain")
        return float(self.matrix[i, j])

    def to_dict(self) -> dict[tuple[Hashable, Hashable], float]:
        """Return the derivative with respect to each arc, by (source, target)."""
        states, entries = self.chain.states, self.matrix.tocoo()
        arcs = zip(entries.col.tolist(), entries.row.tolist(), entries.data.tolist(), strict=True)
        return {(states[j], states[i]): derivative for j, i, derivative in arcs}

    def along(self, change: Mapping[tuple[Hashable, Hashable], float]) -> float:
        """Return the derivative with respect to a parameter on which several arcs depend.

        Parameters
        ----------
        change
            the derivative of each arc's probability with respect to the parameter, by
            (source, target); those of a source sum to 0. Where an arc of probability 0
            opens, the result is the one-sided derivative.

        Raises
        ------
        ChainError
            if a state is unknown, the changes of a source do not sum to 0, or an arc
            leads out of a closed class, where the limit would jump.

        >>> from evenbreak.chains import chain_of
        >>> duel = chain_of([("S1", "W", 0.5), ("S1", "S2", 0.5),
        ...                  ("S2", "L", 0.5), ("S2", "S1", 0.5)])
        >>> won = sensitivity(duel, "W", "S1")
        >>> round(won.along({("S1", "W"): 1, ("S1", "S2"): -1}), 12)
        0.888888888889
        """
        label, recurrent = self.chain.structure.label, self.chain.structure.recurrent
        derivative = 0.0
        total = np.zeros(len(self.chain))
        scale = np.zeros(len(self.chain))
        for (source, target), slope in change.items():
            j, i = self.chain.index(source), self.chain.index(target)
            if recurrent[j] and label[i] != label[j] and slope:
                raise ChainError(
                    f"the arc {source!r} -> {target!r} leads out of a closed class, where the "
                    "limit jumps and has no derivative"
                )
            total[j] += slope
            scale[j] += abs(slope)
            derivative += slope * float(_slopes(self.chain, self._sides, j, i))
        off = np.flatnonzero(~(np.abs(total) <= 1e-9 * scale))
        if len(off):
            raise ChainError(
                f"the changes to the arcs out of {self.chain.states[off[0]]!r} must sum to 0; "
                f"they sum to {total[off[0]]:.6g}"
            )
        return float(derivative)


def sensitivity(chain: Chain, weights: Any, start: Any = None) -> Sensitivity:
    """Return the derivatives of a weighted sum of the limit with respect to every arc.

    Parameters
    ----------
    weights
        the weights of the sum: a state (its limit probability), a mapping from states to weights (0
        for those not named), or an array of shape (n,).
    start
        as in `stochastic_limit`; it is held fixed.

    Raises
    ------
    ChainError
        if a state is unknown or a weight is not finite.
    AccuracyError
        if the limit, or a relative value, cannot be guaranteed.

    Notes
    -----
    For periodic chains these are derivatives of the long-run average. A derivative is a
    difference of nonnegative sums, so it may lose digits where these nearly cancel.

    >>> from evenbreak.chains import chain_of
    >>> winner_breaks = chain_of([(1, 1, 0.75), (1, 2, 0.25), (2, 1, 0.5), (2, 2, 0.5)])
    >>> share = sensitivity(winner_breaks, 1, 1)
    >>> round(share.value, 12), round(share[1, 1], 12)
    (0.666666666667, 0.888888888889)
    """
    check_chain(chain)
    c = chain.vector(weights, "weights")
    structure, part = chain.structure, chain.transient
    recurrent = structure.recurrent
    limit = stochastic_limit(chain, start)

    mean = sums(structure.label, stationary_laws(chain) * c, structure.count)
    ends = np.where(recurrent, mean[structure.label], 0.0)
    arcs = chain.arcs
    entered = sums(arcs.sources, arcs.chances * ends[arcs.targets], len(chain))
    ends[part.states] = _signed_values(part, entered[part.states])
    forward = limit.probability.copy()
    forward[part.states] = part.visits(chain.density(start)[part.states])
    relative = _relative_values(chain, np.where(recurrent, c - ends, 0.0))
    sides = forward, ends, relative
    value = float((limit.probability * c).sum())
    return Sensitivity(chain, value, _in_proportion(chain, sides), sides)


def _slopes(chain: Chain, sides: tuple[Floats, Floats, Floats], j: Any, i: Any) -> Floats:
    """Return G above, up to a constant for each source, which does not affect any change of M."""
    forward, ends, relative = sides
    backward = np.where(chain.structure.recurrent[j], relative[i], ends[i])
    return np.asarray(forward[j] * backward)


def _signed_values(part: TransientPart, r: Floats) -> Floats:
    """Return the expected sum of r over the visits, where r may have either sign."""
    return np.asarray(part.values(np.maximum(r, 0.0)) - part.values(np.maximum(-r, 0.0)))


def _relative_values(chain: Chain, surplus: Floats) -> Floats:
    """Return h with (I - M^T) h = surplus on closed classes, 0 in their first states."""
    structure = chain.structure
    rest = structure.recurrent.copy()
    rest[structure.order[structure.offsets[:-1][structure.closed]]] = False
    states = np.flatnonzero(rest)
    h = np.zeros(len(chain))
    h[states] = _signed_values(TransientPart(chain.arcs, states), surplus[states])
    return h


def _in_proportion(chain: Chain, sides: tuple[Floats, Floats, Floats]) -> csc_array:
    """Return the derivative for each arc, with its source's other arcs reduced in proportion.

    For each source it is G_i - sum_{k != i} p_k G_k / sum_{k != i} p_k. Leaving out the
    largest arc is done by not adding it, leaving out another by subtraction, which is safe.
    """
    M = chain.matrix
    n = len(chain)
    j, i, p = np.repeat(np.arange(n), np.diff(M.indptr)), M.indices, M.data
    G = _slopes(chain, sides, j, i)
    first = np.lexsort((-p, j))[M.indptr[:-1]]
    small = p.copy()
    small[first] = 0.0
    rest, rest_slope = sums(j, small, n), sums(j, small * G, n)
    top, top_slope = p[first], (p * G)[first]
    others = top[j] + rest[j] - p
    others_slope = top_slope[j] + rest_slope[j] - p * G
    others[first], others_slope[first] = rest, rest_slope
    alone = others <= 0.0
    derivative = np.where(alone, 0.0, G - others_slope / np.where(alone, 1.0, others))
    return csc_array((derivative, M.indices, M.indptr), shape=M.shape)
