"""Rating scales: how many points double the odds.

A difference of d points on a scale with s points per doubling gives the game probability p = 1 / (1
+ 2^(-d/s)), so the odds p / (1 - p) are 2^(d/s).

If ratings come without a scale, the numbers decide, or the user must: 612 can only be a Fargo
rating, and 92 only an NPL rating. If a list doesn't fit exactly one scale, no guess is made,
because a wrong one could turn a 59% favorite into a 76% favorite. Nor are ratings read on a chart's
or a system's own scale if they look like those of another scale.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias, overload

from evenbreak.checks import probability
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.words import Sentence, joined, say

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Many: TypeAlias = Sequence[float] | NDArray[Any]
    Floats: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Scale:
    """A rating scale: `points_per_doubling` points of difference double the odds.

    Its methods take a number and return a float, or take an array and return an array.

    Parameters
    ----------
    points_per_doubling
        points, above zero.
    center
        the rating of an average player, in points: the anchor of ratings if the user gives none.
        Differences do not depend on it.

    Raises
    ------
    InputError
        if a number is not finite, or points_per_doubling is not above zero.

    Notes
    -----
    Source: the two equations of the National Pool League's ratings before Table 5.6,
    with 30 points for the NPL, 100 for Fargo and 400·log10(2) for Elo (1978).

    >>> SCALES["npl"].win_probability(30.0)
    0.6666666666666666
    >>> round(SCALES["elo"].difference(10 / 11), 9)
    400.0
    """

    name: str
    points_per_doubling: float
    center: float = 0.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.points_per_doubling) and self.points_per_doubling > 0):
            raise InputError(
                "{points_per_doubling} must be a number above 0; you gave {value!r}",
                value=self.points_per_doubling,
            )
        if not math.isfinite(self.center):
            raise InputError(
                "{center} must be a finite number; you gave {value!r}", value=self.center
            )

    @property
    def text(self) -> str:
        """The scale's name in files, or its points if it has none; `scale_of` reads it.

        >>> SCALES["fargo"].text, Scale("of my club", 40.0).text
        ('fargo', '40')
        """
        if SCALES.get(self.name) == self:
            return self.name
        return f"{self.points_per_doubling!r}".removesuffix(".0")

    def same_points(self, other: Scale) -> bool:
        """Return whether rating differences mean the same on another scale."""
        return math.isclose(self.points_per_doubling, other.points_per_doubling, rel_tol=1e-6)

    @property
    def points_per_log_odds(self) -> float:
        """Points per unit of natural log-odds."""
        return self.points_per_doubling / math.log(2.0)

    @overload
    def log_odds(self, difference: float) -> float: ...
    @overload
    def log_odds(self, difference: Many) -> Floats: ...
    def log_odds(self, difference: float | Many) -> float | Floats:
        """Return the natural log-odds of winning a game, given a difference in points."""
        return _numbers(difference, "difference") / self.points_per_log_odds

    @overload
    def points(self, log_odds: float) -> float: ...
    @overload
    def points(self, log_odds: Many) -> Floats: ...
    def points(self, log_odds: float | Many) -> float | Floats:
        """Return the difference in points that corresponds to these natural log-odds."""
        return _numbers(log_odds, "log_odds") * self.points_per_log_odds

    @overload
    def win_probability(self, difference: float) -> float: ...
    @overload
    def win_probability(self, difference: Many) -> Floats: ...
    def win_probability(self, difference: float | Many) -> float | Floats:
        """Return P(player 1 wins a game | rating 1 - rating 2 = difference).

        Both players' chances have full relative precision: the weaker player's is
        `win_probability(-difference)`, as accurate as the favorite's, however small it is.

        Parameters
        ----------
        difference
            in points; it may be infinite.

        Raises
        ------
        InputError
            if a difference is not a number.

        >>> scale_of("fargo").win_probability(-10_000.0)
        7.888609052210118e-31
        """
        doublings = _numbers(difference, "difference") / self.points_per_doubling
        if isinstance(doublings, float):
            odds: float = 2.0 ** -abs(doublings)  # at most 1, so that nothing overflows
            return (odds if doublings < 0 else 1.0) / (1.0 + odds)
        import numpy as np

        small = np.exp2(-np.abs(doublings))
        chances: Floats = np.where(doublings < 0, small, 1.0) / (1.0 + small)
        return chances

    @overload
    def rack(self, difference: float) -> Rack[float]: ...
    @overload
    def rack(self, difference: Many) -> Rack[Floats]: ...
    def rack(self, difference: float | Many) -> Rack[Any]:
        """Return one rack between two players, given their rating difference in points.

        Both chances have full relative precision, however small one of them is.

        >>> SCALES["npl"].rack(1600.0).chance(2)
        8.811845986046434e-17
        """
        points = _numbers(difference, "difference")
        return Rack(self.win_probability(points), q1=self.win_probability(-points))

    @overload
    def difference(self, p: float) -> float: ...
    @overload
    def difference(self, p: Many) -> Floats: ...
    def difference(self, p: float | Many) -> float | Floats:
        """Return the rating difference, in points, at which player 1 wins a game with chance p.

        Parameters
        ----------
        p
            P(player 1 wins a game); 0 and 1 give infinite points.

        Raises
        ------
        InputError
            if p is not a probability.

        >>> round(scale_of("npl").difference(2 / 3), 9)
        30.0
        """
        chance = probability(p, "p")
        if isinstance(chance, float):
            if chance in (0.0, 1.0):
                return math.copysign(math.inf, chance - 0.5)
            if 0.25 <= chance <= 0.75:  # 2p - 1 is exact here, and log(p / (1 - p)) loses digits
                return self.points(2.0 * math.atanh(2.0 * chance - 1.0))
            return self.points_per_doubling * math.log2(chance / (1.0 - chance))
        import numpy as np

        with np.errstate(divide="ignore"):
            tails = self.points_per_doubling * (np.log2(chance) - np.log2(1.0 - chance))
        middle = (chance >= 0.25) & (chance <= 0.75)
        near = self.points(2.0 * np.arctanh(np.where(middle, 2.0 * chance - 1.0, 0.0)))
        return np.where(middle, near, tails)


# Beyond these, ratings printed with two decimals say nothing, or run into dozens of digits.
_FEWEST_POINTS, _MOST_POINTS = 0.01, 1e6

SCALES: dict[str, Scale] = {
    "npl": Scale("npl", 30.0, 80.0),
    "fargo": Scale("fargo", 100.0, 500.0),
    "elo": Scale("elo", 400.0 * math.log10(2.0), 1500.0),
}
"""The supported scales, by name."""

NAMES = {"npl": "NPL", "fargo": "Fargo", "elo": "Elo"}
"""Other names for the scales."""


def scale_of(text_or_number: Any) -> Scale:
    """Return a scale by its name or by the number of points that double the odds.

    Parameters
    ----------
    text_or_number
        'npl', 'fargo', 'elo' (in any case), a `Scale`, or a number of points.

    Raises
    ------
    InputError
        if it is none of these.

    >>> scale_of("Fargo").points_per_doubling
    100.0
    >>> scale_of("40")
    Scale(name='40 points', points_per_doubling=40.0, center=0.0)
    """
    if isinstance(text_or_number, Scale):
        return text_or_number
    name = str(text_or_number).strip().lower()
    if name in SCALES:
        return SCALES[name]
    try:
        points = float(name)
    except ValueError:
        points = math.nan
    if not _FEWEST_POINTS <= points <= _MOST_POINTS:
        listed = ", ".join(SCALES)
        raise InputError(
            "scale must be {listed}, or the points that double the odds, from "
            "{fewest_points:g} to {most_points:,.0f}; you gave {text_or_number!r}",
            text_or_number=text_or_number,
            listed=listed,
            fewest_points=_FEWEST_POINTS,
            most_points=_MOST_POINTS,
        )
    return Scale(f"{points:g} points", points)


@overload
def _numbers(value: float, name: str) -> float: ...
@overload
def _numbers(value: Many, name: str) -> Floats: ...
def _numbers(value: float | Many, name: str) -> float | Floats:
    """Return a float for a number and a float array for an array; either may be infinite."""
    if not hasattr(value, "__len__") and not hasattr(value, "ndim"):
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if math.isnan(number):
            raise InputError("{name} must be a number; you gave {value!r}", name=name, value=value)
        return number
    if isinstance(value, (str, bytes)):
        raise InputError(
            "{name} must be a number, not text; you gave {value!r}", name=name, value=value
        )
    import numpy as np

    array = np.asarray(value, dtype=float)
    if np.isnan(array).any():
        raise InputError("{name} must hold finite numbers; one value isn't", name=name)
    return float(array) if array.ndim == 0 else array


DEFAULT_SCALE = "npl"
"""The scale of ratings estimated from results, and of lists without any rating."""

USUAL = {"npl": (-50.0, 150.0), "fargo": (150.0, 950.0), "elo": (1000.0, 3000.0)}
"""Where ratings on a scale lie, from the weakest beginners to the best players."""


HIGHEST_LEVEL = 9
"""Whole numbers from 1 to this one can be skill levels (APA nine-ball goes up to it)."""


def unstated_scale(
    ratings: Iterable[float], names: Sequence[str], remedy: str, source: str = "", levels: str = ""
) -> Scale:
    """Return the only scale that all ratings can be on; without any rating, the default scale.

    NaN means no rating. Raises InputError if they fit no scale, or more than one: the message
    starts with their source, says what they would mean on each scale, and ends with the remedy. Two
    or more ratings that all look like skill levels are also an error, which ends with the remedy
    for `levels`.
    """
    rated = [(rating, k) for k, rating in enumerate(ratings) if not math.isnan(rating)]
    if not rated:
        return SCALES[DEFAULT_SCALE]
    (low, last), (high, first) = min(rated), max(rated)
    where = f"{source}: " if source else ""
    if len(rated) > 1 and {rating for rating, _ in rated} <= {*range(1, HIGHEST_LEVEL + 1)}:
        where = f"{source}: " if source else ""
        raise InputError(
            "{where}{low:g} to {high:g} look like skill levels, not ratings. {remedy}",
            where=where,
            low=low,
            high=high,
            remedy=levels or remedy,
        )
    possible = [name for name, (least, most) in USUAL.items() if least <= low <= high <= most]
    if len(possible) == 1:
        return SCALES[possible[0]]
    if low == high:
        raise InputError(
            "{where}the rating {high:g} doesn't show which scale it's on. {remedy}",
            where=where,
            high=high,
            remedy=remedy,
        )
    raise InputError(
        "{where}the ratings from {low:g} to {high:g} don't show which scale they're on: {best} "
        "wins a game against {worst} {readings}. {remedy}",
        where=where,
        low=low,
        high=high,
        best=names[first],
        worst=names[last],
        readings=_readings(high - low, SCALES),
        remedy=remedy,
    )


def refuse_contradicted(
    scale: Scale, ratings: Iterable[float], names: Sequence[str], *, whose: str, remedy: str
) -> None:
    """Raise an error if ratings don't look like those of the known scale that would be used.

    A typo can put one rating far off, so the median decides (NaN means no rating). `whose` is where
    the scale comes from, such as 'the chart npl_10'. The InputError says what the ratings would
    mean on this scale and on the scales that they fit, and ends with the remedy.

    >>> refuse_contradicted(
    ...     SCALES["npl"], [612, 521], ["Ann", "Bo"], whose="the chart npl_10", remedy="Say which."
    ... )
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: the ratings from 521 to 612 don't look like NPL ratings (the scale
        of the chart npl_10): Ann wins a game against Bo 89% of the time by NPL ratings, 65% by
        Fargo ratings. Say which.
    """
    rated = [(rating, k) for k, rating in enumerate(ratings) if not math.isnan(rating)]
    if scale.name not in USUAL or not rated:
        return
    middle = statistics.median(rating for rating, _ in rated)
    like = [name for name, (least, most) in USUAL.items() if least <= middle <= most]
    if scale.name in like:
        return
    (low, last), (high, first) = min(rated), max(rated)
    title = NAMES[scale.name]
    if low == high:
        looks = " or ".join(NAMES[name] for name in like or set(USUAL) - {scale.name})
        raise InputError(
            "the rating {high:g} looks like {looks}, not {title} (the scale of {whose}). {remedy}",
            high=high,
            title=title,
            whose=whose,
            looks=looks,
            remedy=remedy,
        )
    raise InputError(
        "the ratings from {low:g} to {high:g} don't look like {title} ratings (the scale of "
        "{whose}): {best} wins a game against {worst} {readings}. {remedy}",
        low=low,
        high=high,
        title=title,
        whose=whose,
        best=names[first],
        worst=names[last],
        readings=_readings(high - low, [scale.name, *(like or set(USUAL) - {scale.name})]),
        remedy=remedy,
    )


def _readings(gap: float, scales: Iterable[str]) -> Sentence:
    """Return how often a player this far ahead wins a game on each of the given scales."""
    shares = [(name, SCALES[name].win_probability(gap)) for name in scales]
    (first, share), *rest = shares
    said = [say("{p:.0%} of the time by {scale} ratings", p=float(share), scale=NAMES[first])]
    said += [say("{p:.0%} by {scale} ratings", p=float(p), scale=NAMES[name]) for name, p in rest]
    return joined(said, ", ")
