"""The mode of the posterior where results differ in what they say and how much they weigh.

The likelihood is that of `evenbreak.ratings.likelihood_terms`. Its logarithm is concave in
(θ, β), and those of the priors strictly so: there is one mode, and Newton's method finds it
with a step that is halved until it goes down, or for games alone shortened so that it does. Where
the score alone says how many racks each player broke, the sum is still concave in θ, though not
necessarily in β.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.ratings.likelihood_terms import LikelihoodTerms
from evenbreak.ratings.newton import (
    GRADIENT_TOLERANCE,
    Mode,
    damped,
    find_zero,
    step_accuracy,
    tolerance,
)
from evenbreak.ratings.prior_means import PriorMeans

_FULL_STEP = 1e-6
"""Newton steps shorter than this are taken whole: the value can no longer measure their gain."""


def find_mixed_mode(
    terms: LikelihoodTerms,
    precision: float,
    *,
    advantage: float = 0.0,
    break_precision: float | None = None,
    means: PriorMeans | None = None,
    start: Floats | None = None,
    gradient: float = GRADIENT_TOLERANCE,
) -> Mode:
    """Return the skills, levels and break advantage, in this order, most likely a posteriori.

    Parameters
    ----------
    terms
        what was played.
    precision
        τ, the prior precision of a skill, 1/sd² in log-odds.
    advantage
        the break advantage in log-odds: known, or where to begin.
    break_precision
        the prior precision of the advantage, about 0; None: it is known.
    means
        the means of the skills' priors and the levels that players share; None: all 0, and none.
    start
        skills from which to begin.
    gradient
        how small the gradient has to become, in games, times τ where that is below 1.

    Raises
    ------
    AccuracyError
        if the gradient does not come down to that, or to rounding.
    """
    players = terms.players
    known = PriorMeans.none(players) if means is None else means

    def cost(point: Floats) -> float:
        skill, level, advantage = point[:players], point[players:-1], float(point[-1])
        prior = 0.5 * (break_precision or 0.0) * advantage**2
        prior -= known.log_density(skill, level, precision)
        return prior - terms.log_likelihood(skill, advantage)

    skill = known.mean if start is None else start
    begin = np.concatenate([skill, np.zeros(len(known.level_sd)), [advantage]])
    # Games alone need no search for the length of a step.
    games_alone = not len(terms.race_pair) and break_precision is None
    value = 0.0 if games_alone else cost(begin)

    def gradient_at(point: Floats) -> tuple[Floats, Callable[[], Floats]]:
        skill, level, advantage = point[:players], point[players:-1], float(point[-1])
        pull, slope = terms.derivatives(skill, advantage)
        of_skill, of_level = known.slopes(skill, level, precision)
        pull = np.append(pull + of_skill, of_level)
        slope = slope + break_precision * advantage if break_precision is not None else 0.0
        whole = np.append(pull, slope)

        def step() -> Floats:
            nonlocal value
            curvature = terms.curvature(skill, advantage, precision, break_precision, means)
            full = np.append(*curvature.newton_step(pull, slope, step_accuracy(whole)))
            if games_alone:
                return damped(full, terms.low, terms.high)
            length, longest = 1.0, float(np.abs(full).max())
            while True:
                new = cost(point + length * full)
                if new <= value or longest * length < _FULL_STEP:
                    break
                length *= 0.5
            value = new
            return length * full

        return whole, step

    known_best = float(known.information.max(initial=0.0))
    most = max(float(terms.race_m.max(initial=0)), terms.amount, known_best)
    return find_zero(begin, gradient_at, tolerance(precision, most, gradient))
