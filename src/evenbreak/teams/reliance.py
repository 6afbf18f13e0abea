"""How far the best pick depends on ratings that may be off."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import whole
from evenbreak.ratings.roster import Roster
from evenbreak.teams.advice import Point, advice
from evenbreak.teams.night import TeamNight
from evenbreak.teams.solve import solved

Laws = Callable[[Floats, Floats], Sequence[Floats]]
"""From the skills of our players and theirs to the laws of all sets."""


def best_by_skills(
    night: TeamNight,
    laws: Laws,
    ours: Roster,
    theirs: Roster,
    point: Point | None = None,
    *,
    draws: int = 100,
    rng: np.random.Generator,
) -> dict[tuple[str, ...], float]:
    """Return how often each pick would be the best if the ratings are off as they may be.

    Parameters
    ----------
    night
        the night.
    laws
        from the skills of both squads to the laws of the sets, as `TeamNight` takes them.
    ours, theirs
        the ratings and their standard errors; where none is stated, the rating is taken as right.
    point
        the point of the night; None: before the first nomination.
    draws
        how many times the skills are drawn. Each draw is solved as if everybody knew them.
    rng
        numpy's random generator.

    Returns
    -------
    dict
        the share of the draws in which a pick is the best for whoever names now.

    >>> from evenbreak.teams import Squad, set_laws
    >>> us = Roster(["Ann", "Bo"], [600, 560], [0, 0])
    >>> them = Roster(["Cy", "Di"], [580, 570], [30, 30])
    >>> def laws(mine, others):
    ...     return [set_laws(us, them, 5, skills=(mine, others))]
    >>> night = TeamNight(Squad(us.players), Squad(them.players), laws(us.rating, them.rating))
    >>> best_by_skills(night, laws, us, them, rng=np.random.default_rng(1))
    {('Ann',): 1.0}
    """
    found: dict[tuple[str, ...], int] = {}
    for _ in range(whole(draws, "draws", at_least=1)):
        skills = (
            each.rating + np.nan_to_num(each.standard_error) * rng.standard_normal(len(each))
            for each in (ours, theirs)
        )
        best = advice(solved(night.with_laws(laws(*skills))), point).best.names
        found[best] = found.get(best, 0) + 1
    return {names: count / draws for names, count in sorted(found.items(), key=lambda one: -one[1])}
