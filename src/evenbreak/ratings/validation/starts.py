"""What a league's starts take back of the difference between players, and what they should.

A race m:n takes back the difference at which it is even (see `evenbreak.ratings.levels`). How
large the difference is in fact, the games show: on average over all handicap matches, for each
size of the start, and for a class, where the results say in which class each player is.

How much stronger players are for each unit by which their league puts them ahead (a class, a
rating, or the race's own difference): in match i the games are won with the log-odds k x + e,
where x is what the league says and e, the same in all games of the match, is normal with mean 0
and variance v: players differ from what their league says, and from day to day. k and v are
estimated by maximum likelihood. When a race stops depends on its games alone, so races of any kind
may be mixed. Matches that share a player are not independent, so the standard error is the
sandwich's for pairs: products of slopes are summed over all pairs of matches with a player in
common (Aronow, Samii & Assenova 2015, "Cluster-robust variance estimation for dyadic data").
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import betaincinv, expit, log_expit, logit, logsumexp, ndtri, stdtrit

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.estimates import CONFIDENCE, Estimate, with_error
from evenbreak.ratings.integrated import normal_nodes
from evenbreak.ratings.levels import implied_difference
from evenbreak.ratings.results import Results

FEWEST = 100
"""Handicap matches from which starts are judged."""

FEWEST_ALIKE = 30
"""Matches from which one size of the start is judged."""

LARGEST_LEVEL = 1e6

MOST_CLASSES = 12
"""A league with more levels than this has ratings rather than classes."""


class StartGroup(NamedTuple):
    """Matches between players who are equally many classes apart, or with equal starts.

    Parameters
    ----------
    apart
        by how many classes one player is above the other, or how many games they give.
    matches
        how many there are.
    race
        the race that is played most: the games of the player above, and of the other.
    stronger
        by how much the player above is stronger, in log-odds.
    taken
        what the races take back of it on average.
    """

    apart: int
    matches: int
    race: tuple[int, int]
    stronger: Estimate
    taken: float


class Starts(NamedTuple):
    """What starts take back of the difference between players, in log-odds.

    Parameters
    ----------
    matches
        races that are not even.
    stronger
        by how much those who give games are stronger on average.
    taken
        what the races take back on average.
    share
        the difference between players for each unit that races take back: 1 where starts are
        right, above 1 where they are too small.
    classes
        the names of the classes, the lowest first; empty where they are not known.
    a_class
        what a class is worth; None where classes are not known.
    groups
        by classes apart where classes are known, or else by games given.
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
    """Return what starts take back; None with fewer than 100 races that are not even.

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
    share = handicap_slope(season, implied)
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
    """Return the games that the weaker player should need where the stronger one needs `race`.

    Parameters
    ----------
    race
        the games of the stronger player.
    difference
        by how much they are stronger, in log-odds.

    >>> even_start(7, 0.0), even_start(7, 0.53)
    (7, 4)
    """
    needs = np.arange(1, race + 1)
    return int(needs[np.abs(logit(betaincinv(race, needs, 0.5)) - difference).argmin()])


def class_steps(results: Results, implied: Floats) -> tuple[tuple[str, ...], Floats]:
    """Return the classes, the lowest first, and by how many of them a is above b in each match.

    Classes without numbers are put in order by the races between them. Where `level_a` and
    `level_b` hold no classes, or too many, there are none; where a match does not state them, NaN.
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
    """Return the numbers that texts are, NaN where they are none up to a million.

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
    """Return how strong the races say that each class is, by least squares."""
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


NODES = 15
"""Nodes of the Gauss-Hermite rule."""

_STEP = 1e-4
_BOX = [(-50.0, 50.0), (0.0, 3.0)]


def handicap_slope(results: Results, x: Floats) -> Estimate | None:
    """Return k with its 95% interval; None where the matches do not determine it.

    Parameters
    ----------
    results
        matches with games in them.
    x
        by how much a is said to be stronger than b in each.

    >>> season = Results.from_names(["Ann"] * 4, ["Bo", "Cy"] * 2, [7, 5, 7, 6], [5, 7, 4, 7])
    >>> round(handicap_slope(season, np.ones(4)).value, 3)
    0.083
    """
    size = float(np.abs(x).max(initial=0.0))
    if size == 0.0:
        return None
    games = results.score_a.astype(float), results.score_b.astype(float)
    rows, of_row = np.unique(np.column_stack([x / size, *games]), axis=0, return_inverse=True)
    many = np.bincount(of_row.ravel())
    model = _Model(*rows.T)

    def loss(at: Floats) -> tuple[float, Floats]:
        whole, slopes = model.at(at)
        return -float(many @ whole), -(many @ slopes)

    likeliest = minimize(loss, np.array([0.0, 0.3]), jac=True, method="L-BFGS-B", bounds=_BOX).x
    free = np.array([True, likeliest[1] > 10 * _STEP])
    bend = np.column_stack([_bend(model, many, likeliest, k) for k in range(2)])[np.ix_(free, free)]
    if abs(likeliest[0]) > 0.99 * _BOX[0][1] or not (np.linalg.eigvalsh(bend) > 0.0).all():
        return None
    slopes = model.at(likeliest)[1][of_row.ravel()][:, free]
    inverse = np.linalg.inv(bend)
    # Few players may make the first come out too small by luck, even below that of pairs alone.
    variance = max(
        float((inverse @ scores @ inverse)[0, 0]) for scores in _spreads(results, slopes)
    )
    # A few players vary more than their sum of squares shows: Student's t, in normal units.
    freedom = max(_players(results) - 2, 1)
    wider = stdtrit(freedom, 0.5 + CONFIDENCE / 2) / ndtri(0.5 + CONFIDENCE / 2)
    return with_error(float(likeliest[0]) / size, float(wider) * math.sqrt(variance) / size)


def _bend(model: _Model, many: Ints, at: Floats, k: int) -> Floats:
    """Return a column of minus the second derivatives of the log-likelihood."""
    step = np.zeros(2)
    step[k] = _STEP
    below = np.maximum(at - step, [low for low, _ in _BOX])
    change = model.at(below)[1] - model.at(at + step)[1]
    return np.asarray(many @ change / (at + step - below)[k])


class _Model:
    """The log-likelihood of matches: what is said of them, and the games won and lost."""

    def __init__(self, x: Floats, won: Floats, lost: Floats) -> None:
        self._x, self._won, self._lost = (column[:, None] for column in (x, won, lost))
        points, weights = normal_nodes(NODES)
        self._points, self._weights = points, np.log(weights)

    def at(self, k_and_sd: Floats) -> tuple[Floats, Floats]:
        """Return the log-likelihood of each match, and its slopes in k and in √v."""
        k, sd = k_and_sd
        d = k * self._x + sd * self._points
        log = self._won * log_expit(d) + self._lost * log_expit(-d) + self._weights
        whole = logsumexp(log, axis=1)
        pull = np.exp(log - whole[:, None]) * (self._won - (self._won + self._lost) * expit(d))
        return whole, np.column_stack([pull.sum(1) * self._x[:, 0], pull @ self._points])


def _spreads(results: Results, slopes: Floats) -> tuple[Floats, Floats]:
    """Return the covariance of the summed slopes, matches varying together that share a player.

    The second lets only matches of the same two players vary together.
    """
    a, b = results.player_a, results.player_b
    both = np.minimum(a, b) * len(results.players) + np.maximum(a, b)
    pairs, of_match = np.unique(both, return_inverse=True)
    of_pair = _summed(of_match, slopes, len(pairs))
    many = len(results.players)
    of_player = _summed(a, slopes, many) + _summed(b, slopes, many)
    players = _players(results)
    few = players / max(players - 2, 1)
    alone = few * of_pair.T @ of_pair
    return few * of_player.T @ of_player - alone, alone


def _summed(group: Ints, values: Floats, many: int) -> Floats:
    return np.column_stack([np.bincount(group, column, many) for column in values.T])


def _players(results: Results) -> int:
    return len(np.union1d(results.player_a, results.player_b))
