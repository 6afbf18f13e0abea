"""How many steps it takes to reach a target: distribution, mean and variance.

Let Q be the arcs among the states from which the target can be reached, h_j the chance of reaching
it from j, and x_t = Q^t v. Then the passage time T has P(T > t and the target is reached) = h .
x_t, hence

    P(reached) = h . v,   E[T; reached] = sum_t h . x_t = u . v,   u = (I - Q)^-T h,

which takes two solves without subtraction. The variance is the sum of the contributions of each
step, E sum_t (m(X_t+1) - m(X_t) + 1)^2 with m = u / h the mean time left: a sum of squares under
the chances given that the target is reached (Doob's transform). No digits are lost if the variance
is small compared with the squared mean. Given that the target is reached, the chain is

    P(i | j, target reached) = M[i, j] h_i / h_j.

Reference: Kemeny and Snell 1960, Finite Markov Chains, chapter III, and section 3.1 for the
conditional chain.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from scipy.sparse import csr_array

from evenbreak.arrays import Bools, Floats, own_arrays
from evenbreak.chains.arcs import Places, reachable, sums
from evenbreak.chains.chain import Chain, check_chain
from evenbreak.chains.exact import exact_passage
from evenbreak.chains.explore import chain_from_arrays
from evenbreak.chains.powers import evened
from evenbreak.chains.transient import TransientPart
from evenbreak.checks import number_probability, one_of, whole
from evenbreak.errors import AccuracyError, ChainError

TIE = 1e-12
"""Tolerance for a cumulative probability below q: sums of floats miss ties."""
MOST_STEPS = 100_000
"""Largest quantile; beyond it, an error is raised."""


@own_arrays
@dataclass(frozen=True, eq=False)
class PassageTime:
    """Number of steps it takes to reach a target, given the start.

    Parameters
    ----------
    p_reached, p_never
        the chances that the target is reached, and that it never is.
    mean, variance
        of the number of steps; None unless the target is certain to be reached.
    mean_if_reached, variance_if_reached
        of the number of steps, given that the target is reached; None if it cannot be.
        The variance is inf if it is larger than any float.
    certain
        whether the graph guarantees that the target is reached; then `p_never` is exactly 0.

    Notes
    -----
    The chances and moments come from linear solves, not from a truncated distribution;
    `distribution` and `quantile` follow the chain step by step.
    """

    p_reached: float
    p_never: float
    mean_if_reached: float | None
    variance_if_reached: float | None
    certain: bool
    _at_once: float = field(repr=False)
    _v: Floats = field(repr=False)
    _chain: Chain = field(repr=False)
    _states: Places = field(repr=False)
    _leak: Floats = field(repr=False)
    _hope: Floats = field(repr=False)

    @property
    def mean(self) -> float | None:
        """The mean number of steps; None if the target may never be reached."""
        return self.mean_if_reached if self.certain else None

    @property
    def variance(self) -> float | None:
        """The variance of the number of steps; None if the target may never be reached."""
        return self.variance_if_reached if self.certain else None

    def distribution(
        self, *, tail: float = 1e-12, max_steps: int = 100_000
    ) -> tuple[Floats, float]:
        """Return P(the target is reached in exactly t steps), t = 0, 1, ..., and the tail.

        Parameters
        ----------
        tail
            stop when the chance of reaching the target later is at most this.
        max_steps
            stop after this many steps.

        Returns
        -------
        array, float
            the probabilities, and the chance of reaching the target after the steps that they
            cover; together with `p_never`, these sum to 1.
        """
        tail, max_steps = number_probability(tail, "tail"), whole(max_steps, "max_steps")
        chances = []
        left = 0.0
        for t, chance, left in self._walk():
            chances.append(chance)
            if left <= tail or t == max_steps:
                break
        return np.array(chances), left

    def quantile(self, q: float) -> int | None:
        """Return the first t for which P(reached within t steps) >= q; None if there is none.

        A probability within 1e-12 of q counts as q, so that ties do not depend on rounding.
        If the time has no largest value, the quantile at 1 is the one at 1 - 1e-12.

        Raises
        ------
        InputError
            if q is not a probability.
        AccuracyError
            if t would be more than 100,000.
        """
        q = number_probability(q, "q")
        if q > self.p_reached + TIE:
            return None
        for t, _, left in self._walk():
            if left <= self.p_reached - q + TIE:
                return t
            if t == MOST_STEPS:
                break
        raise AccuracyError(
            f"the {q} quantile is more than {MOST_STEPS} steps; the mean, if the target is "
            f"reached, is {self.mean_if_reached:.6g}"
        )

    def _walk(self) -> Iterator[tuple[int, float, float]]:
        """Yield t, P(T = t) and P(t < T, and the target is reached), for t = 0, 1, ..."""
        # The matrix among the states from which the target can be reached.
        inside = csr_array(evened(self._chain)[:, self._states])[self._states]
        t, chance, x = 0, self._at_once, self._v
        last = np.flatnonzero(self._leak)
        leak = self._leak[last]
        while True:
            yield t, chance, float((self._hope * x).sum())
            t, chance, x = t + 1, float((leak * x[last]).sum()), inside @ x


def steps_to_absorption(
    chain: Chain,
    start: Any = None,
    *,
    into: Literal["absorbing", "closed"] = "absorbing",
    exact: bool = False,
) -> PassageTime | Any:
    """Return the number of steps until the chain is absorbed, given the start.

    Parameters
    ----------
    chain, start
        as in `propagate`.
    into
        'absorbing': until the chain reaches a state that is never left (the match is over);
        entering a closed class of several states then counts as never being absorbed. 'closed':
        until any closed class is entered, which always happens.
    exact
        whether to calculate the chances, mean and variance in fractions (see
        `stochastic_limit`); there is then no distribution, and an `ExactPassage` is returned.

    Raises
    ------
    InputError
        if `into` is neither.
    ChainError
        if the start is not one.
    AccuracyError
        if a mean is larger than any float, or cannot be guaranteed.

    Notes
    -----
    Source: Kemeny & Snell, Finite Markov Chains, chapter III.

    >>> from evenbreak.chains import chain_of
    >>> two_ahead = chain_of([(0, 1, 0.5), (0, -1, 0.5), (1, 2, 0.5), (1, 0, 0.5),
    ...                       (-1, 0, 0.5), (-1, -2, 0.5)])
    >>> racks = steps_to_absorption(two_ahead, 0)
    >>> racks.mean, racks.variance, racks.quantile(0.9), racks.p_never
    (4.0, 8.0, 8, 0.0)
    >>> steps_to_absorption(two_ahead, 0, exact=True).mean_if_reached
    Fraction(4, 1)
    """
    check_chain(chain)
    one_of(into, "into", ("absorbing", "closed"))
    structure = chain.structure
    ends = structure.recurrent
    if into == "absorbing":
        ends = ends & (np.diff(structure.offsets)[structure.label] == 1)
    if exact:
        return exact_passage(chain, start, ends)
    return _passage(chain, chain.density(start), ends)


def first_passage(chain: Chain, start: Any, target: Any) -> PassageTime:
    """Return the number of steps until the chain first visits a target, given the start.

    Parameters
    ----------
    chain, start
        as in `propagate`; a start of None is the chain's own.
    target
        a state, or a list or set of states. Starting in the target counts as 0 steps.

    Raises
    ------
    ChainError
        if a state is unknown, or no target is given.
    AccuracyError
        if a mean is larger than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> walk = chain_of([(1, 0, 0.25), (1, 2, 0.75), (2, 1, 1.0)])
    >>> walk_to_0 = first_passage(walk, 2, 0)
    >>> walk_to_0.p_reached, walk_to_0.mean
    (1.0, 8.0)
    """
    check_chain(chain)
    return _passage(chain, chain.density(start), target_of(chain, target))


def conditioned(chain: Chain, target: Any) -> Chain:
    """Return the chain conditioned on reaching the target, where it stops.

    It holds the states from which the target can be reached, with each step's chances conditional
    on eventually reaching the target.

    Parameters
    ----------
    chain
        the chain; its start is kept.
    target
        a state, or a list or set of states.

    Raises ------ ChainError if a state is unknown, no target is given, or the start cannot reach
    the target. AccuracyError if one of the chances of reaching the target is too small for a float,
    or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of, steps_to_absorption
    >>> race = chain_of({"0:0": {"1:0": 0.75, "0:1": 0.25}, "1:0": {"won": 0.75, "1:1": 0.25},
    ...                  "0:1": {"1:1": 0.75, "lost": 0.25}, "1:1": {"won": 0.75, "lost": 0.25}},
    ...                 start="0:0")
    >>> comeback = conditioned(race, "lost")
    >>> comeback.states
    ['0:0', '1:0', '0:1', '1:1', 'lost']
    >>> steps_to_absorption(race).mean, steps_to_absorption(comeback).mean
    (2.375, 2.6)
    """
    check_chain(chain)
    ends = target_of(chain, target)
    states, part, leak = approach(chain, ends, np.ones(len(chain), dtype=bool))
    h = ends.astype(np.float64)
    h[states] = part.values(leak)
    if not (h[states] > 0.0).all():
        raise AccuracyError("one of the chances of reaching the target is too small for a float")
    if chain.start is not None and not h[chain.index(chain.start)]:
        raise ChainError(f"the target {target!r} can't be reached from {chain.start!r}")
    kept = np.flatnonzero(h)
    place = np.full(len(chain), -1)
    place[kept] = np.arange(len(kept))
    arcs = chain.arcs
    inside = (h[arcs.sources] > 0.0) & ~ends[arcs.sources] & (h[arcs.targets] > 0.0)
    j, i, p = arcs.sources[inside], arcs.targets[inside], arcs.chances[inside]
    looped = states[chain.matrix.diagonal()[states] > 0.0]
    sources, targets = np.concatenate((j, looped)), np.concatenate((i, looped))
    chances = np.concatenate((p * (h[i] / h[j]), chain.matrix.diagonal()[looped]))
    names: list[Hashable] = [chain.states[k] for k in kept.tolist()]
    return chain_from_arrays(
        names, place[sources], place[targets], np.minimum(chances, 1.0), chain.start
    )


def target_of(chain: Chain, target: Any) -> Bools:
    """Return which states are the target, given as a state or a list or set of states.

    Raises ChainError if a state is unknown, or if there are none.
    """
    targets = target if isinstance(target, (list, set, frozenset)) else [target]
    if isinstance(target, Hashable) and target in chain.position:
        targets = [target]
    if not targets:
        raise ChainError("no target was given. Give a state or a list of states.")
    ends = np.zeros(len(chain), dtype=bool)
    ends[[chain.index(state) for state in targets]] = True
    return ends


def approach(chain: Chain, ends: Bools, met: Bools) -> tuple[Places, TransientPart, Floats]:
    """Return which of the states `met` can reach the `ends`, excluding the ends.

    The result is their positions, their solves, and the chance of stepping from each into the ends.
    """
    n, arcs = len(chain), chain.arcs
    before = ~ends[arcs.sources]
    hopeful = reachable(n, arcs.targets[before], arcs.sources[before], ends) & met & ~ends
    states = np.flatnonzero(hopeful)
    arrive = hopeful[arcs.sources] & ends[arcs.targets]
    leak = sums(arcs.sources[arrive], arcs.chances[arrive], n)[states]
    return states, TransientPart(arcs, states), leak


def _passage(chain: Chain, v: Floats, ends: Bools) -> PassageTime:
    arcs = chain.arcs
    before = ~ends[arcs.sources]
    met = reachable(len(chain), arcs.sources[before], arcs.targets[before], v > 0.0) & ~ends
    states, part, leak = approach(chain, ends, met)
    lost = met.copy()
    lost[states] = False
    certain = not lost.any()
    # Of each state: the visits to it, the chance of the target from it, and the steps left then.
    visits, hope, left = np.zeros((3, len(chain)))
    visits[states] = part.visits(v[states])
    hope[ends] = 1.0
    hope[states] = 1.0 if certain else part.values(leak)
    hopeful = states[hope[states] > 0.0]
    left[states] = part.values(hope[states])
    left[hopeful] /= hope[hopeful]
    at_once, p_reached, p_never = float(v[ends].sum()), 1.0, 0.0
    if not certain:
        p_reached = at_once + float((visits[states] * leak).sum())
        vanish = lost[arcs.targets]
        p_never = float(v[lost].sum())
        p_never += float((visits[arcs.sources[vanish]] * arcs.chances[vanish]).sum())
    mean = variance = None
    if p_reached > 0.0:
        with np.errstate(over="ignore", invalid="ignore"):
            mean = float((visits * hope).sum() / p_reached)
            i, j = arcs.targets, arcs.sources
            begun = v * hope * (left - mean) ** 2
            moved = visits[j] * arcs.chances * hope[i] * (left[i] - left[j] + 1.0) ** 2
            stayed = visits * chain.matrix.diagonal() * hope
            variance = float(begun.sum() + moved.sum() + stayed.sum()) / p_reached
        if mean == np.inf:
            raise AccuracyError("the mean number of steps is too large for a float")
        # A mean this large comes from a state that is hard to leave; the variance is its square.
        variance = variance if np.isfinite(variance) else np.inf
    walk = at_once, v[states], chain, states, leak, hope[states]
    return PassageTime(p_reached, p_never, mean, variance, certain, *walk)
