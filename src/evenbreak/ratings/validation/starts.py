"""How much of the difference between players a league's head starts make up for.

A race m:n makes up for the difference at which it is even (see `evenbreak.ratings.levels`). The
games show the actual difference: on average over all handicap matches, for each size of the start,
and per class, if the results state the players' classes (see `evenbreak.ratings.handicap_slope`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import betaincinv, logit

from evenbreak.arrays import Floats
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.handicap_slope import handicap_slope, race_share
from evenbreak.ratings.levels import implied_difference
from evenbreak.ratings.results import Results

FEWEST = 100
"""Handicap matches needed to judge starts."""

FEWEST_ALIKE = 30
"""Matches needed to judge one size of start."""

LARGEST_LEVEL = 1e6

MOST_CLASSES = 12
"""A league with more levels than this has ratings rather than classes."""


class StartGroup(NamedTuple):
    """Matches between players who are the same number of classes, or games given, apart.

    `race` is the most frequent one, with the higher player's games first. `stronger` and `taken`
    are the difference, in log-odds, and how much the races make up for on average.
    """

    apart: int
    matches: int
    race: tuple[int, int]
    stronger: Estimate
    taken: float


class Starts(NamedTuple):
    """How much of the difference between players starts make up for, in log-odds.

    `share` is the difference per unit that races make up for: 1 if starts are right, above 1 if
    they are too small. Classes, from the lowest up, are empty if unknown; `a_class` is the value of
    one class.
    """

    matches: int
    stronger: Estimate
    taken: float
    share: Estimate
    classes: tuple[str, ...]
    a_class: Estimate | None
    groups: tuple[StartGroup, ...]

    @property
    def numbered(self) -> bool:
        """Whether the classes are numbers, such as skill levels."""
        return not np.isnan(level_numbers(np.array(self.classes, dtype=str))).any()


def starts(results: Results) -> Starts | None:
    """Return the effect of starts; None with fewer than 100 uneven races.

    >>> season = Results.from_names(["A", "A"], ["B", "B"], [7, 5], [2, 6], race_a=[7, 7],
    ...     race_b=[6, 6])
    >>> starts(season) is None
    True
    """
    season = results.played().results
    implied = implied_difference(season)
    season, implied = season.select(~np.isnan(implied)), implied[~np.isnan(implied)]
    gives = season.races[0] - season.races[1]
    uneven = gives != 0
    if uneven.sum() < FEWEST:
        return None
    share = race_share(season)
    stronger = handicap_slope(season.select(uneven), np.sign(gives[uneven]).astype(float))
    if share is None or stronger is None:
        return None
    classes, above = class_steps(season, implied)
    stated = np.isfinite(above)
    a_class = handicap_slope(season.select(stated), above[stated]) if classes else None
    apart = gives if a_class is None else np.where(stated, above, 0).astype(np.int64)
    return Starts(
        int(uneven.sum()),
        stronger,
        float(np.abs(implied[uneven]).mean()),
        share,
        () if a_class is None else classes,
        a_class,
        tuple(_groups(season, apart, implied)),
    )


def even_start(race: int, difference: float) -> int:
    """Return the games that the weaker player should need; the difference is in log-odds.

    >>> even_start(7, 0.0), even_start(7, 0.53)
    (7, 4)
    """
    needs = np.arange(1, race + 1)
    return int(needs[np.abs(logit(betaincinv(race, needs, 0.5)) - difference).argmin()])


def class_steps(results: Results, implied: Floats) -> tuple[tuple[str, ...], Floats]:
    """Return the classes from the lowest up, and how many classes a is above b in each match.

    Classes that aren't numbers are sorted by the races between them. The list is empty if `level_a`
    and `level_b` hold no classes, or too many; the difference is NaN if a match doesn't state them.
    """
    none: tuple[str, ...] = ()
    a, b = levels(results)
    stated = (a != "") & (b != "")
    names, code = np.unique(np.concatenate([a[stated], b[stated]]), return_inverse=True)
    if not 2 <= len(names) <= MOST_CLASSES:
        return none, np.full(len(results), np.nan)
    of_a, of_b = np.split(code.ravel(), 2)
    numbers = level_numbers(names)
    if np.isnan(numbers).any():
        numbers = np.argsort(np.argsort(_strengths(of_a, of_b, implied[stated]))).astype(float)
    elif (numbers % 1.0 != 0.0).any():
        return none, np.full(len(results), np.nan)
    above = np.full(len(results), np.nan)
    above[stated] = numbers[of_a] - numbers[of_b]
    return tuple(names[np.argsort(numbers)].tolist()), above


def levels(results: Results) -> tuple[NDArray[np.str_], NDArray[np.str_]]:
    """Return the class, skill level or rating of a and b in each match, '' where not stated."""
    columns = (results.level_a, results.level_b)
    if any(column is None for column in columns):
        columns = (np.full(len(results), ""),) * 2
    a, b = (np.asarray(column).astype(str) for column in columns)
    return a, b


def level_numbers(texts: NDArray[np.str_]) -> Floats:
    """Parse strings as numbers; NaN for anything that isn't a number up to a million.

    >>> level_numbers(np.array(["87", "B", "4.5", "inf"]))
    array([87. ,  nan,  4.5,  nan])
    """

    def number(text: str) -> float:
        try:
            found = float(text.replace(",", "."))
        except ValueError:
            return math.nan
        return found if abs(found) <= LARGEST_LEVEL else math.nan

    return np.array([number(text) for text in texts.tolist()])


def _strengths(of_a: NDArray[np.intp], of_b: NDArray[np.intp], implied: Floats) -> Floats:
    """Return each class's strength according to the races, by least squares."""
    contrast = np.zeros((len(of_a), int(max(of_a.max(), of_b.max())) + 1))
    np.add.at(contrast, (np.arange(len(of_a)), of_a), 1.0)
    np.add.at(contrast, (np.arange(len(of_b)), of_b), -1.0)
    return np.asarray(np.linalg.lstsq(contrast, implied)[0])


def _groups(season: Results, apart: NDArray[np.int64], implied: Floats) -> list[StartGroup]:
    groups = []
    sign = np.sign(apart)
    for size in np.unique(np.abs(apart[sign != 0])).tolist():
        rows = np.abs(apart) == size
        if rows.sum() < FEWEST_ALIKE:
            continue
        stronger = handicap_slope(season.select(rows), sign[rows].astype(float))
        if stronger is None:
            continue
        race_a, race_b = (race[rows] for race in season.races)
        ahead = sign[rows] > 0
        races = np.column_stack([np.where(ahead, race_a, race_b), np.where(ahead, race_b, race_a)])
        played, often = np.unique(races, axis=0, return_counts=True)
        needs, gets = played[often.argmax()].tolist()
        taken = float((sign[rows] * implied[rows]).mean())
        groups.append(StartGroup(size, int(rows.sum()), (needs, gets), stronger, taken))
    return groups
