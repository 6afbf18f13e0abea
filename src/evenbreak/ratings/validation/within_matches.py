"""Test of the model's claim that every game of a match has the same chance, whatever came before.

From scores alone: do they vary around the predictions as much as they should? From racks: do wins
come in streaks?

The effect of day-to-day form on deciders, sweeps and games is compared with what happened.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.special import expit

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.matches.form import center_of_form
from evenbreak.ratings.day_form import FEWEST, LONGEST, NODES, log_odds_of
from evenbreak.ratings.doubtful_scores import doubtful_scores
from evenbreak.ratings.estimates import Estimate, bootstrap_ratio, two_sided
from evenbreak.ratings.fitted import DayForm
from evenbreak.ratings.integrated import normal_nodes
from evenbreak.ratings.validation.walk_forward import Forecasts

REPLICAS = 300
"""Simulated seasons."""

MOST_SIMULATED = 5_000_000
"""Matches in all simulated seasons: the more a season has, the fewer seasons are needed."""

LONGEST_SIMULATED = 1000
"""Games in the longest race that is simulated: each game takes memory."""


class Dispersion(NamedTuple):
    """How far scores are from the predictions, compared with simulated seasons.

    `seen` is the sum over races of (games won - p games)², over the sum of p (1 - p) games;
    `by_chance` is its mean over seasons simulated from the model, with a rating difference for each
    match drawn from its posterior, and its own form, both of which also spread scores. The p-value
    is two-sided.
    """

    seen: float
    by_chance: float
    p_value: float
    races: int


class Streaks(NamedTuple):
    """The runs of racks won by one player, compared with the same racks in random order.

    z below 0, fewer runs than expected, means streaks; the p-value is two-sided. Matches are those
    whose racks are known and were not all won by one player.
    """

    runs: int
    expected: float
    z: float
    p_value: float
    matches: int


def dispersion(forecasts: Forecasts, rng: np.random.Generator) -> Dispersion | None:
    """Compare the spread of scores around the predictions with that of simulated seasons.

    None if there is no race to 1,000 games or fewer after the first date. More spread than by
    chance suggests good and bad days beyond `form`, or ratings that lag behind; less spread
    suggests matches that are kept close.
    """
    longest = np.maximum(forecasts.race_a, forecasts.race_b)
    rows = (longest > 0) & (longest <= LONGEST_SIMULATED) & (forecasts.date_of > 0)
    rows &= ~doubtful_scores(forecasts.results)
    if not rows.any():
        return None
    p = forecasts.p_game_integrated[rows]
    m, n = forecasts.race_a[rows], forecasts.race_b[rows]
    seen = _spread(forecasts.results.score_a[rows], forecasts.games[rows], p)
    sd, form = forecasts.sd[rows], forecasts.form
    center, around = center_of_form(forecasts.difference[rows], sd, form), np.hypot(sd, form)
    played = np.empty(min(REPLICAS, MOST_SIMULATED // len(p) + 2))
    for k in range(len(played)):
        drawn = expit(center + around * rng.standard_normal(len(p)))
        won, games = play_races(drawn, m, n, rng)
        played[k] = _spread(won, games, p)
    mean = float(played.mean())
    # In simulated seasons a rating's error is drawn again for every match.
    z = (seen - mean) / max(float(played.std(ddof=1)), 1e-300)
    return Dispersion(seen, mean, two_sided(z), int(rows.sum()))


def play_races(p: Floats, m: Ints, n: Ints, rng: np.random.Generator) -> tuple[Ints, Ints]:
    """Return the games that player 1 won, and the games played, in simulated races."""
    most = int((m + n).max()) - 1
    won = (rng.random((len(p), most)) < p[:, None]).cumsum(1)
    lost = np.arange(1, most + 1) - won
    end = ((won >= m[:, None]) | (lost >= n[:, None])).argmax(1)
    return won[np.arange(len(p)), end], end + 1


def _spread(won: Ints, games: Ints, p: Floats) -> float:
    return float(((won - p * games) ** 2).sum() / (p * (1.0 - p) * games).sum())


def streaks(forecasts: Forecasts) -> Streaks | None:
    """Compare the runs in the racks with those of the same racks in random order.

    If every rack in a match has the same chance, whatever it is, then given the score, all orders
    of the racks that end with a rack for the winner are equally likely. So the last rack is left
    out, and no rating is needed. If the break is an advantage, there are streaks under winner
    breaks and the opposite under alternate breaks.

    Wald & Wolfowitz (1940), "On a test whether two samples are from the same population", within
    each match.
    """
    racks = forecasts.results.racks
    if racks is None:
        return None
    runs, expected, variance, matches = 0, 0.0, 0.0, 0
    for text, race in zip(racks, forecasts.race_a > 0, strict=True):
        free = text[:-1] if race else text
        a, b = free.count("a"), free.count("b")
        if not (a and b):
            continue
        matches += 1
        runs += 1 + sum(winner != next_winner for winner, next_winner in pairwise(free))
        expected += 1.0 + 2.0 * a * b / (a + b)
        variance += 2.0 * a * b * (2.0 * a * b - a - b) / ((a + b) ** 2 * (a + b - 1.0))
    if not variance:
        return None
    z = (runs - expected) / math.sqrt(variance)
    return Streaks(runs, expected, z, two_sided(z), matches)


class ScoreShape(NamedTuple):
    """A feature of scores: how often it was seen and expected, as a mean over races.

    'deciders' went to the last possible game, in 'sweeps' the loser won no game, 'games' is the
    length. `said` is from the forecasts, with the ratings' uncertainty integrated out;
    `said_with_form` adds day-to-day form.
    """

    of: str
    seen: Estimate
    said: float
    said_with_form: float


@dataclass(frozen=True)
class MatchForm(DayForm):
    """Day-to-day form, and its effect on scores: deciders, sweeps and games."""

    shapes: tuple[ScoreShape, ...]


def match_form(
    forecasts: Forecasts, form: DayForm | None, cluster: Ints, rng: np.random.Generator
) -> MatchForm | None:
    """Return the effect of day-to-day form on scores; None if it was not estimated.

    Also None with fewer than 100 races of at least two games. The first date is left out; matches
    in the same cluster, such as a date, may depend on each other.
    """
    rows = _judged(forecasts)
    if form is None or rows.sum() < FEWEST:
        return None
    shapes = _shapes(forecasts, rows, form.variance.value, cluster[rows], rng)
    return MatchForm(form.variance, form.races, tuple(shapes))


def _judged(forecasts: Forecasts) -> Bools:
    fewest = np.minimum(forecasts.race_a, forecasts.race_b)
    most = np.maximum(forecasts.race_a, forecasts.race_b)
    judged = (fewest > 1) & (most <= LONGEST) & (forecasts.date_of > 0)
    return np.asarray(judged & ~doubtful_scores(forecasts.results))


def _shapes(
    forecasts: Forecasts, rows: Bools, v: float, cluster: Ints, rng: np.random.Generator
) -> list[ScoreShape]:
    m, n = forecasts.race_a[rows], forecasts.race_b[rows]
    a, b = forecasts.results.score_a[rows], forecasts.results.score_b[rows]
    seen = np.array([a + b == m + n - 1, np.minimum(a, b) == 0, a + b], dtype=float)
    said = np.zeros((2, 3))
    difference, sd = forecasts.difference[rows], forecasts.sd[rows]
    for row, extra in enumerate((0.0, v)):
        mean, spread = log_odds_of(difference, sd, extra), np.sqrt(sd**2 + extra)
        for point, weight in zip(*normal_nodes(NODES), strict=True):
            p = expit(mean + spread * point)
            said[row] += weight * score_shapes(p, m, n).mean(1)
    ones = np.ones(len(m))
    _, cluster = np.unique(cluster, return_inverse=True)
    return [
        ScoreShape(of, bootstrap_ratio(share, ones, cluster, rng), float(plain), float(formed))
        for of, share, plain, formed in zip(
            ("deciders", "sweeps", "games"), seen, *said, strict=True
        )
    ]


def score_shapes(p: Floats, m: Ints, n: Ints) -> Floats:
    """Return the chances of a decider and of a sweep, and the mean number of games, in races m:n.

    >>> score_shapes(np.array([0.5]), np.array([2]), np.array([2])).ravel().tolist()
    [0.5, 0.5, 2.5]
    """
    shapes = np.zeros((3, len(p)))
    for mine, needed, their_need in ((p, m, n), (1.0 - p, n, m)):
        chance = mine**needed
        shapes[1] += chance
        for lost in range(int(their_need.max())):
            if lost:
                chance = chance * (1.0 - mine) * (needed + lost - 1) / lost
            counts = np.where(lost < their_need, chance, 0.0)
            shapes[0] += np.where(lost == their_need - 1, counts, 0.0)
            shapes[2] += counts * (needed + lost)
    return shapes
