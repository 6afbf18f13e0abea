"""Whether each game of a match has the same chance, whatever went before, as the model says.

From scores alone: are they as spread about the predictions as they should be? From racks:
are wins in streaks? And who has an advantage that ratings do not know: the side that is
written first, the first breaker, the breaker?
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit, log_expit, logit, logsumexp, ndtr

from evenbreak.ratings.calibration import Estimate, logistic_coefficient, with_error
from evenbreak.ratings.results import FORMATS
from evenbreak.ratings.walk_forward import NODES, Forecasts

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

REPLICAS = 300
"""Seasons that chance plays."""

MOST_ADVANTAGE = 5.0
"""How far the search for an advantage of the breaker goes, in log-odds."""


class Dispersion(NamedTuple):
    """How far scores are from what was predicted, beside seasons that the model plays.

    Parameters
    ----------
    seen
        the sum over races of (games won - p games)², over the sum of p (1 - p) games.
    by_chance
        its mean over seasons played by the model, each match at a rating difference drawn
        from its posterior: what the ratings do not know spreads scores too.
    p_value
        P(chance goes as far from `by_chance` as the season did), two-sided.
    races
        the races that were counted.
    """

    seen: float
    by_chance: float
    p_value: float
    races: int


class Streaks(NamedTuple):
    """The runs of racks won by one player, beside those of the same racks in any order.

    Parameters
    ----------
    runs, expected
        runs seen, and their mean where every order is equally likely.
    z, p_value
        how many standard deviations apart, and the two-sided chance of that; fewer runs
        than expected, z below 0, are streaks.
    matches
        those whose racks are known and not all one player's.
    """

    runs: int
    expected: float
    z: float
    p_value: float
    matches: int


class FirstBreaks(NamedTuple):
    """How often the first breaker won the race, beside what was predicted.

    Parameters
    ----------
    won, expected
        races won by the first breaker, and the sum of their predicted chances.
    p_value
        the two-sided chance of as large a difference.
    matches
        races of which the first breaker is known.
    """

    won: int
    expected: float
    p_value: float
    matches: int


def dispersion(told: Forecasts, rng: np.random.Generator) -> Dispersion | None:
    """Compare the spread of scores about the predictions with seasons that the model plays.

    Returns None where there is no race with games after the first date. A value above
    what chance plays tells of good and bad days, or of ratings that lag behind; one
    below it of matches that are kept close.
    """
    rows = (told.race_a > 0) & (told.date_of > 0)
    if not rows.any():
        return None
    p = told.p_game_integrated[rows]
    m, n = told.race_a[rows], told.race_b[rows]
    seen = _spread(told.results.score_a[rows], told.games[rows], p)
    played = np.empty(REPLICAS)
    for k in range(REPLICAS):
        drawn = expit(told.difference[rows] + told.sd[rows] * rng.standard_normal(len(p)))
        won, games = play_races(drawn, m, n, rng)
        played[k] = _spread(won, games, p)
    mean = float(played.mean())
    # Seasons of the model share no errors of a player's rating from match to match.
    z = (seen - mean) / max(float(played.std(ddof=1)), 1e-300)
    return Dispersion(seen, mean, _two_sided(z), int(rows.sum()))


def play_races(p: Floats, m: Ints, n: Ints, rng: np.random.Generator) -> tuple[Ints, Ints]:
    """Return the games that player 1 won, and the games played, of races that chance plays."""
    most = int((m + n).max()) - 1
    won = (rng.random((len(p), most)) < p[:, None]).cumsum(1)
    lost = np.arange(1, most + 1) - won
    end = ((won >= m[:, None]) | (lost >= n[:, None])).argmax(1)
    return won[np.arange(len(p)), end], end + 1


def _spread(won: Ints, games: Ints, p: Floats) -> float:
    return float(((won - p * games) ** 2).sum() / (p * (1.0 - p) * games).sum())


def streaks(told: Forecasts) -> Streaks | None:
    """Compare the runs in the racks with those of the same scores in any order.

    Given a race's score, every order of the racks that ends with the winner's is equally
    likely if each rack has the same chance, whatever that chance: so the last rack is
    left out, and no rating is needed. A break that is worth something makes streaks under
    winner breaks and the opposite under alternate breaks.

    Notes
    -----
    Wald & Wolfowitz (1940), "On a test whether two samples are from the same population",
    within each match.
    """
    racks = told.results.racks
    if racks is None:
        return None
    runs, expected, variance, matches = 0, 0.0, 0.0, 0
    for text, race in zip(racks, told.race_a > 0, strict=True):
        free = text[:-1] if race else text
        a, b = free.count("a"), free.count("b")
        if not (a and b):
            continue
        matches += 1
        runs += 1 + sum(one != other for one, other in pairwise(free))
        expected += 1.0 + 2.0 * a * b / (a + b)
        variance += 2.0 * a * b * (2.0 * a * b - a - b) / ((a + b) ** 2 * (a + b - 1.0))
    if not variance:
        return None
    z = (runs - expected) / math.sqrt(variance)
    return Streaks(runs, expected, z, _two_sided(z), matches)


def side_advantage(told: Forecasts) -> Estimate | None:
    """Return the advantage in log-odds of the player who is written first, if any.

    Where the first column is the home player that is the home advantage; elsewhere it
    says whether the order of the columns has a meaning.
    """
    ones = np.ones(len(told))
    won, games = told.results.score_a.astype(float), told.games.astype(float)
    # Each match a cluster: dates may be too few to tell how much they differ.
    each = np.arange(len(told))
    return logistic_coefficient(ones, won, games, each, offset=_log_odds(told))


def first_breaks(told: Forecasts) -> FirstBreaks | None:
    """Compare the races that the first breaker won with those that he was expected to win."""
    if told.results.first_break is None:
        return None
    rows = (told.results.first_break > 0) & (told.race_a > 0)
    if not rows.any():
        return None
    breaks_a = told.results.first_break[rows] == 1
    p = np.where(breaks_a, told.p_match_integrated[rows], 1.0 - told.p_match_integrated[rows])
    won = np.where(breaks_a, told.won[rows], 1.0 - told.won[rows])
    z = float((won - p).sum()) / math.sqrt(float((p * (1.0 - p)).sum()))
    return FirstBreaks(int(won.sum()), float(p.sum()), _two_sided(z), int(rows.sum()))


def break_advantage(told: Forecasts) -> Estimate | None:
    """Return the advantage of the breaker in log-odds, where it is known who broke each rack.

    None where no match states its racks, who broke first and who broke next, or where
    the breaker won every rack, or none.

    Notes
    -----
    Under winner breaks the stronger player breaks more often, by how much stronger he is
    on the day. So the difference of each match is integrated out: normal about that of
    the ratings, its variance theirs and that of good and bad days, which is estimated too.
    The standard error is the sandwich's, a match a cluster.
    """
    from scipy.optimize import minimize

    tally = _tally(told)
    rows = tally.sum((1, 2)) > 0
    if not rows.any():
        return None
    won, lost = tally[rows, :, 0].T[:, :, None], tally[rows, :, 1].T[:, :, None]
    points, weights = np.polynomial.hermite_e.hermegauss(NODES)
    breaks = np.array([1.0, -1.0])[:, None, None]

    def at(b: float, days: float) -> tuple[Floats, Floats]:
        """Return the log-likelihood of each match and its slope in b."""
        spread = np.sqrt(told.sd[rows] ** 2 + days**2)
        x = told.difference[rows, None] + spread[:, None] * points + b * breaks
        log = (won * log_expit(x) + lost * log_expit(-x)).sum(0) + np.log(weights)
        whole = logsumexp(log, axis=1)
        slope = (breaks * (won - (won + lost) * expit(x))).sum(0)
        return whole, (np.exp(log - whole[:, None]) * slope).sum(1)

    def loss(x: Floats) -> float:
        return -float(at(x[0], x[1])[0].sum())

    box = [(-MOST_ADVANTAGE, MOST_ADVANTAGE), (0.0, MOST_ADVANTAGE)]
    b, days = map(float, minimize(loss, np.array([0.0, 0.1]), method="L-BFGS-B", bounds=box).x)
    curvature = float((at(b - 1e-4, days)[1] - at(b + 1e-4, days)[1]).sum()) / 2e-4
    if abs(b) > 0.99 * MOST_ADVANTAGE or curvature <= 0.0:
        return None
    return with_error(b, math.sqrt(float((at(b, days)[1] ** 2).sum())) / curvature)


def known_breaks(told: Forecasts) -> int:
    """Return how many racks are known with who broke them, which `break_advantage` counts."""
    return int(_tally(told).sum())


def _tally(told: Forecasts) -> Floats:
    """Return the racks of each match, by who broke and who won: 0 for a, 1 for b."""
    results = told.results
    tally = np.zeros((len(told), 2, 2))
    if results.racks is None or results.first_break is None or results.break_format is None:
        return tally
    for row in np.flatnonzero((results.first_break > 0) & (results.break_format > 0)):
        text = results.racks[row]
        broke = _breakers(text, int(results.first_break[row]), FORMATS[results.break_format[row]])
        for breaker, letter in zip(broke, text, strict=True):
            tally[row, breaker - 1, "ab".index(letter)] += 1.0
    return tally


def _breakers(racks: str, first: int, breaks: str) -> list[int]:
    """Return who broke each rack, 1 or 2."""
    broke = [first]
    for letter in racks[:-1]:
        winner = 1 if letter == "a" else 2
        broke.append(
            {"winner": winner, "loser": 3 - winner, "alternate": 3 - broke[-1], "a": 1, "b": 2}[
                breaks
            ]
        )
    return broke[: len(racks)]


def _log_odds(told: Forecasts) -> Floats:
    return np.asarray(logit(told.p_game_integrated.clip(1e-12, 1.0 - 1e-12)))


def _two_sided(z: float) -> float:
    return float(2.0 * ndtr(-abs(z)))
