"""The opponents on a ladder: how good they are, and how far off their ratings are.

An opponent has a skill, a rating, and an error: the rating minus the skill. Two of the three are
given by independent distributions; the third follows.

Source: the two assumptions after Fig. 5.9 (opponents rated exactly; the autocorrelated model),
and the distribution of actual and apparent ratings suggested there as a next step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.checks import floats, one_of
from evenbreak.errors import InputError
from evenbreak.stats.summary import Distribution

_NOTHING = Distribution((0,), (1.0,))


def _in_whole_points(law: Distribution, name: str) -> None:
    if not isinstance(law, Distribution):
        raise InputError(
            "{name} must be a Distribution of whole points; you gave {law!r}", name=name, law=law
        )
    for value in law.values:
        if value != int(value):
            raise InputError(
                "{name} must have whole numbers of points; one value is {value!r}",
                name=name,
                value=value,
            )


def farthest(law: Distribution) -> int:
    """Return the largest absolute value.

    >>> farthest(Distribution((-3, 2), (0.5, 0.5)))
    3
    """
    return max(abs(int(value)) for value in law.values)


@dataclass(frozen=True)
class Opponents:
    """The opponents of a player, relative to the player's own skill.

    Parameters
    ----------
    spread
        the distribution of an opponent's skill, or rating, minus the player's skill, in whole
        points.
    error
        the distribution of an opponent's rating error, rating minus skill, in whole points,
        independent of the spread. None: the distribution of the player's own error, made symmetric
        and found self-consistently.
    given
        'skill' or 'rating': which of the two `spread` describes.

    Raises
    ------
    InputError
        if a value in a distribution is not a whole number, or `given` is neither word.

    Notes
    -----
    If the skill is given, the rating is skill + error: two players of the same league, each rated
    slightly wrong. If the rating is given, the skill is rating - error: the opponent was chosen by
    rating, and how good they are is unknown.

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
        """The largest distance of the spread from the player's skill, in points."""
        return farthest(self.spread)


NATURAL = Opponents(error=_NOTHING)
"""Opponents as good as the player, correctly rated: the natural distribution of Fig. 5.9. 5.9."""

AUTOCORRELATED = Opponents(given="rating")
"""Opponents rated at the player's skill, with errors distributed like the player's (model A)."""

EQUAL_SKILL = Opponents()
"""Opponents as good as the player, with errors distributed like the player's (model B)."""


def opponents_of(
    ratings: ArrayLike,
    about: float,
    *,
    given: str = "rating",
    error: Distribution | None = None,
) -> Opponents:
    """Return a player's opponents in a league, where each rating is equally likely.

    Parameters
    ----------
    ratings
        the others' ratings (or skills, if `given` is 'skill'), in points.
    about
        the player's skill, in points.
    given
        'rating' or 'skill': what `ratings` holds.
    error
        the distribution of the opponents' rating errors; None: the player's own.

    Raises
    ------
    InputError
        if there is no rating, or one is not a finite number.

    Notes
    -----
    Ratings are rounded to whole points before they are subtracted. It is assumed that an opponent's
    error does not depend on their rating; in fact, among players of similar skill, those with the
    highest ratings are mostly overrated.

    >>> opponents_of([70, 80, 80, 95], 80).spread.values
    (-10, 0, 15)
    """
    points = np.rint(floats(ratings, "ratings")) - np.rint(floats(about, "about"))
    if not points.size:
        raise InputError("ratings must not be empty. Give the rating of at least one opponent.")
    values, counts = np.unique(points.ravel().astype(np.int64), return_counts=True)
    return Opponents(Distribution.of(values.tolist(), counts.tolist()), error, given)


def stretched(opponents: Opponents, factor: float) -> Opponents:
    """Return the same opponents on a scale with `factor` times as many points.

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
