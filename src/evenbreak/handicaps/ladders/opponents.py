"""Whom a player meets on a ladder: how good his opponents are, and how wrongly they are rated.

An opponent has a skill and a rating, and his error is the rating less the skill. Two of the
three are given, each by a law, and are independent of each other; the third follows.

Source: the two assumptions after Fig. 5.9 (opponents rated exactly; the autocorrelated model),
and the distribution of actual and apparent ratings that is named there as a next step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.checks import one_of
from evenbreak.errors import InputError
from evenbreak.stats.summary import Distribution

_NOTHING = Distribution((0,), (1.0,))


def _in_whole_points(law: Distribution, name: str) -> None:
    if not isinstance(law, Distribution):
        raise InputError(f"{name} is {law!r}; give a Distribution of whole points")
    for value in law.values:
        if value != int(value):
            raise InputError(f"{name} holds {value!r}; give whole points")


def farthest(law: Distribution) -> int:
    """Return the largest size of a value.

    >>> farthest(Distribution((-3, 2), (0.5, 0.5)))
    3
    """
    return max(abs(int(value)) for value in law.values)


@dataclass(frozen=True)
class Opponents:
    """The opponents of a player, relative to his own skill.

    Parameters
    ----------
    spread
        the law of an opponent's skill, or of his rating, less the player's skill, in whole
        points.
    error
        the law of an opponent's rating error, his rating less his skill, in whole points,
        whatever the spread says of him. None: the law that the player's own error has, made
        symmetric; it is found self-consistently.
    given
        'skill' or 'rating': which of the two the spread is the law of.

    Raises
    ------
    InputError
        if a value of a law is not a whole number, or `given` is neither word.

    Notes
    -----
    Given the skill, the rating is skill + error: two players of the same league, each rated a
    bit wrong. Given the rating, the skill is rating - error: who sits across the table was
    chosen by his rating, and nobody knows how good he is.

    >>> from evenbreak.stats import Distribution
    >>> around = Opponents(Distribution((-10, 0, 10), (0.25, 0.5, 0.25)))
    >>> around.given, around.error is None
    ('skill', True)
    """

    spread: Distribution = _NOTHING
    error: Distribution | None = None
    given: str = "skill"

    def __post_init__(self) -> None:
        one_of(self.given, "given", ("skill", "rating"))
        _in_whole_points(self.spread, "spread")
        if self.error is not None:
            _in_whole_points(self.error, "error")

    @property
    def farthest(self) -> int:
        """How far from the player's skill the spread goes, in points."""
        return farthest(self.spread)


NATURAL = Opponents(error=_NOTHING)
"""Opponents as good as the player and rated rightly: the natural law of Fig. 5.9."""

AUTOCORRELATED = Opponents(given="rating")
"""Opponents rated at the player's skill, and in truth off by an error of his own law (model A)."""

EQUAL_SKILL = Opponents()
"""Opponents as good as the player, each rated wrong by an error of his own law (model B)."""


def opponents_of(
    ratings: ArrayLike,
    about: float,
    *,
    given: str = "rating",
    error: Distribution | None = None,
) -> Opponents:
    """Return the opponents that a league offers a player: each of its ratings equally likely.

    Parameters
    ----------
    ratings
        the ratings (or skills, if that is what is given) of the others, in points.
    about
        the player's skill, in points on the same scale.
    given
        'rating' or 'skill': what `ratings` holds.
    error
        the law of the opponents' rating errors; None: the player's own.

    Raises
    ------
    InputError
        if there is no rating, or one is not a finite number.

    Notes
    -----
    Ratings are rounded to whole points before they are subtracted. That an opponent's error
    does not depend on his rating is an assumption: in a league of much the same skill those
    with the highest ratings are overrated more often than not.

    >>> opponents_of([70, 80, 80, 95], 80).spread.values
    (-10, 0, 15)
    """
    points = np.rint(_finite(ratings, "ratings")) - np.rint(_finite(about, "about"))
    if not points.size:
        raise InputError("ratings is empty; give the rating of one opponent or more")
    values, counts = np.unique(points.ravel().astype(np.int64), return_counts=True)
    return Opponents(Distribution.of(values.tolist(), counts.tolist()), error, given)


def stretched(opponents: Opponents, factor: float) -> Opponents:
    """Return the same opponents on a scale on which so many times the points mean the same.

    >>> stretched(opponents_of([60, 80, 95], 80), 4).spread.values
    (-80, 0, 60)
    """
    error = opponents.error
    return Opponents(
        _stretched(opponents.spread, factor),
        None if error is None else _stretched(error, factor),
        opponents.given,
    )


def _stretched(law: Distribution, factor: float) -> Distribution:
    return Distribution.of([round(value * factor) for value in law.values], law.probability)


def _finite(values: ArrayLike, name: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    try:
        array = np.asarray(values, dtype=float)
        right = bool(np.isfinite(array).all())
    except (TypeError, ValueError):
        right = False
    if not right:
        raise InputError(f"{name} is {values!r}; give finite numbers of points")
    return array
