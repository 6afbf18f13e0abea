"""Day-to-day form: a player may be better or worse than usual in all games of a match.

On a given day, the log-odds of every game are c + e, with the same e throughout the match and e ~
N(0, f²). The form f is the standard deviation of log-odds that `evenbreak rate` estimates. c is
such that the chance of winning a single game is the same as without form,

    E expit(c + e) = p,

since ratings are fitted to games. Given e the games are independent, so the distribution of the
score is that of the match without form, averaged over e by Gauss-Hermite quadrature. Games already
played show the players' form: at the score i:j, e has the density p(e)^i (1 - p(e))^j φ(e / f),
normalized.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import betainc, expit, log_expit, logit, logsumexp, roots_hermitenorm

from evenbreak.arrays import Floats
from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.rack import Rack
from evenbreak.matches.parameters import AnyMatch, checked_match, rack_in, unit_of, with_rack

MOST_FORM = 3.0
"""The largest form allowed, in natural log-odds."""

MOST_NODES, MOST_NODES_OF_SETS = 1000, 60
"""Nodes of the average, for a race and for other matches: enough for six digits, or for four."""

_FEWEST_GAMES = 6  # shorter races need as many nodes as these
_CLOSE = 1e-7  # a step of Newton's method whose successor is a rounding


def form_of(form: Any) -> float:
    """Return a day-to-day form if it is valid: the standard deviation of a game's log-odds."""
    wanted = f"0 to {MOST_FORM:g}, the standard deviation of the log-odds of a game"
    return number(form, "form", low=0.0, high=MOST_FORM, wanted=wanted)


def normal_rule(sd: float, longest: int, most: int) -> tuple[Floats, Floats]:
    """Return nodes and weights of N(0, 1) that average chances to 1e-9, unless `most` are too few.

    `sd` is the largest standard deviation of log-odds, `longest` the games that both players
    together need. The number of nodes depends on the deviation compared with the width of W's rise,
    about 2 / sqrt(m + n) in log-odds; it was found by trial against adaptive quadrature.
    """
    if sd == 0.0:
        return np.zeros(1), np.ones(1)
    ratio = sd * math.sqrt(max(longest, _FEWEST_GAMES)) / 2.0
    return _hermite(min(most, 24 + math.ceil(14.0 * ratio**2)))


@cache
def _hermite(number: int) -> tuple[Floats, Floats]:
    nodes, weights = roots_hermitenorm(number)
    weights = weights / weights.sum()
    # The outermost nodes have no weight: dropping them drops most of a large rule.
    kept = weights > 1e-18
    return nodes[kept], weights[kept]


def center_of_form(mean: ArrayLike, sd: ArrayLike, form: float) -> Floats:
    """Return the c for which a game is won as often with form as without it.

    That is, E expit(N(c, sd² + form²)) = E expit(N(mean, sd²)), to rounding, in log-odds of a game.

    >>> center_of_form([0.0, 1.0], 0.0, 0.5).round(4)
    array([0.    , 1.0552])
    """
    mean, sd = np.broadcast_arrays(np.asarray(mean, dtype=float), np.asarray(sd, dtype=float))
    if form == 0.0:
        return mean
    low = -np.abs(mean)  # so that the chances are small ones, known to all their digits
    around = np.hypot(sd, form)
    wanted, _ = _game(low, sd)
    possible = wanted > np.finfo(float).tiny
    center = low * np.sqrt((1.0 + 0.35 * around**2) / (1.0 + 0.35 * sd**2))
    for _ in range(50):
        chance, slope = _game(center, around)
        # Newton's method for the logarithm of the chance, which is concave in c.
        away = np.log(np.where(possible, chance / np.where(possible, wanted, 1.0), 1.0))
        step = np.where(possible, away * chance / np.where(possible, slope, 1.0), 0.0)
        center = center - step
        if np.abs(step).max(initial=0.0) < _CLOSE:
            break
    return np.where(possible, -np.sign(mean) * center, mean)


def _game(mean: Floats, sd: Floats) -> tuple[Floats, Floats]:
    """Return the chance in a game whose log-odds are N(mean, sd²), and its slope."""
    chance, slope = np.zeros(mean.shape), np.zeros(mean.shape)
    for node, weight in zip(*normal_rule(float(sd.max(initial=0.0)), 2, MOST_NODES), strict=True):
        p = expit(mean + sd * node)
        chance += weight * p
        slope += weight * p * (1.0 - p)
    return chance, slope


_FARTHEST, _GRID = 20.0, 801  # log-odds beyond which a game is won for sure, and places up to them


@lru_cache(maxsize=256)
def chance_in_form(
    needs: tuple[int, int], form: float, score: tuple[int, int] = (0, 0)
) -> Callable[[ArrayLike], Floats]:
    """Return a function from the log-odds of a game to P(player 1 wins a race).

    It agrees to 1e-6 with averaging each of many chances over form, a standard deviation above 0,
    but takes no longer than without form. `needs` are total games; the score shows some of the
    form.

    >>> chance_in_form((5, 5), 0.5)([0.0, 1.0]).round(4)
    array([0.5   , 0.8987])
    """
    at = np.linspace(-_FARTHEST, _FARTHEST, _GRID)
    nodes, weights = normal_rule(form, sum(needs), MOST_NODES)
    days = center_of_form(at, 0.0, form)[:, None] + form * nodes
    won, lost = score
    log = np.log(weights) + won * log_expit(days) + lost * log_expit(-days)
    likely = np.exp(log - logsumexp(log, axis=1, keepdims=True))
    chance = (betainc(needs[0] - won, needs[1] - lost, expit(days)) * likely).sum(1)
    from scipy.interpolate import CubicSpline  # takes long to load

    curve = CubicSpline(at, chance)
    return lambda log_odds: np.clip(curve(np.clip(log_odds, -_FARTHEST, _FARTHEST)), 0.0, 1.0)


def on_days(match: AnyMatch, form: float) -> tuple[AnyMatch, Floats]:
    """Return a match on many days, and how likely each day is given the score.

    Its chances get another axis at the end, one entry per day; the weights of the days sum to 1
    over the last axis. `form` is a standard deviation above 0. Raises InputError if games were
    played and the chances depend on who broke them.
    """
    match = checked_match(match)
    rack = rack_in(match)
    nodes, weights = rule_for(match, form)
    # A good day of player 1 is a bad one of player 2.
    both = zip((rack.p1, rack.p2), (nodes, -nodes), strict=True)
    many = with_rack(match, Rack(*(_on_days(p, form, e) for p, e in both if p is not None)))
    return many, given_score(many, weights)


def _on_days(p: Any, form: float, nodes: Floats) -> Floats:
    """Return the chance on each day; a chance of 0 or 1 is the same on all days."""
    log_odds = np.asarray(logit(p))
    sure = np.isinf(log_odds)
    center = center_of_form(np.where(sure, 0.0, log_odds), 0.0, form)
    days = expit(center[..., None] + form * nodes)
    return np.where(sure[..., None], np.asarray(p)[..., None], days)


def rule_for(match: Match, sd: float) -> tuple[Floats, Floats]:
    """Return the rule that averages a match's odds over log-odds that vary by `sd`."""
    if isinstance(match.rack, Rack) and getattr(match, "win_by", 0) == 1:
        return normal_rule(sd, match.m + match.n, MOST_NODES)
    return normal_rule(sd, (match.m + match.n) ** 2, MOST_NODES_OF_SETS)


def given_score(match: Match, weights: Floats) -> Floats:
    """Return how likely each day is, given the games or sets that were played.

    The days are the last axis of the match's chances; `weights` are their chances beforehand.
    """
    won, lost = match.score
    if won == lost == 0:
        return weights
    if match.break_matters:
        raise InputError(
            "the games already played can show day-to-day form only if it's known who broke. "
            "Leave out either the score or form."
        )
    unit = unit_of(match)
    if isinstance(unit, Rack):
        p, q = unit.chance(1), unit.chance(2)
    else:
        from evenbreak.matches.win import win_probability

        unit = replace(unit, score=(0, 0))
        p, q = (win_probability(unit, player=player) for player in (1, 2))
    with np.errstate(divide="ignore", invalid="ignore"):
        log = np.log(weights) + _times(won, np.log(p)) + _times(lost, np.log(q))
    likely = np.exp(log - np.nan_to_num(log.max(axis=-1, keepdims=True), neginf=0.0))
    total = likely.sum(axis=-1, keepdims=True)
    # A score that has no chance says nothing.
    return np.asarray(np.where(total > 0.0, likely / np.where(total > 0.0, total, 1.0), weights))


def _times(count: int, log: Floats) -> Any:
    return count * log if count else 0.0
