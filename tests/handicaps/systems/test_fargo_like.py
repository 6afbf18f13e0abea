"""Fargo-like ratings: the maximum of the likelihood, by another optimizer and by known truth."""

from functools import partial

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.special import log_expit

from evenbreak.errors import InputError
from evenbreak.handicaps import FargoLike, broken_laws, system_of
from evenbreak.handicaps.systems import fargo_like
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.handicaps.systems.laws import entries_for, played_nights
from evenbreak.ratings.scale import SCALES

UNIT = 100.0 / np.log(2.0)


def loss(at, who, games, weight, start, counted):
    """Minus the log-likelihood: games as (player, opponent, won) and half-won ones at the start."""
    apart = at[who[:, 0]] - at[who[:, 1]]
    of_games = weight @ (games[:, 0] * log_expit(apart) + games[:, 1] * log_expit(-apart))
    off = at - start
    return -of_games - counted / 2.0 @ (log_expit(off) + log_expit(-off))


def loss_of_one(at, only, own, *games):
    return loss(np.where(only, own, at), *games)


@pytest.mark.parametrize("half_life", [3.0, 0.05])
def test_ratings_are_the_maximum_that_a_general_optimizer_finds(half_life):
    system, rng = FargoLike(half_life=half_life), np.random.default_rng(4)
    entries = entries_for(system, rng)
    *_, (history, published) = played_nights(system, rng, entries=entries)
    age = (7.0 * history.night - 7.0 - history.day) / 365.25
    behind = np.where(entries.matches < 0, 200, np.minimum(7 * entries.matches, 500))
    faded = 0.5 ** (7.0 * (history.night - 1) / 365.25 / half_life)
    for replica in range(published.shape[1]):
        one = history.one(replica).matches
        rows = np.flatnonzero(one.played)
        who = np.column_stack([one.a, one.b])[rows]
        games = np.column_stack([one.score_a, one.score_b])[rows]
        weight = 0.5 ** (age[rows] / half_life)
        start = history.initial[:, replica] / UNIT
        counted = 2.0 + behind[:, replica] * faded
        fit = minimize(loss, start, (who, games, weight, start, counted), tol=1e-12).x
        n = behind[:, replica] + np.bincount(who.ravel(), np.repeat(games.sum(axis=1), 2), len(fit))
        lacking = np.maximum(200.0 - n, 0.0)
        for player in range(len(fit)):
            mine = (who == player).any(axis=1)
            only = np.arange(len(fit)) == player
            own = np.where(only, counted + lacking, 0.0)
            expected = minimize(
                partial(loss_of_one, fit, only),
                fit[player],
                (who[mine], games[mine], weight[mine], start, own),
                tol=1e-12,
            ).x[0]
            assert published[player, replica] == pytest.approx(expected * UNIT, abs=0.01)


def test_many_games_against_known_players_find_the_truth():
    """2,000 games: a standard error of 288.5 / sqrt(2000) = 6.5 points, shared with the others."""
    rng, truth = np.random.default_rng(1), np.array([450.0, 520.0, 560.0, 640.0])
    entries = Entries.of(np.full(4, 525.0), games=np.zeros(4, dtype=int))
    system = FargoLike()
    pairs = np.array([(a, b) for a in range(4) for b in range(a)])
    p = 1.0 / (1.0 + 2.0 ** ((truth[pairs[:, 1]] - truth[pairs[:, 0]]) / 100.0))
    won = rng.binomial(700, p)
    initial = system.initial(entries)
    night = Matches.of_night(
        1, *pairs.T, won, 700 - won, np.zeros(6, int), np.zeros(6, int), *initial[pairs].T
    )
    ratings = system.update(History(entries, initial, initial, 1, night))
    off = (ratings - ratings.mean()) - (truth - truth.mean())
    assert np.abs(off).max() < 3.5 * 6.5


def test_a_starter_counts_for_the_games_that_lack_and_moves_nobody_else():
    """Two leagues that differ only in the starter of a newcomer without a game behind."""
    system = FargoLike()
    night = partial(
        Matches.of_night,
        1,
        [0, 1],
        [1, 2],
        [5, 5],
        [3, 4],
        [5, 5],
        [5, 5],
        [600.0] * 2,
        [500.0] * 2,
    )
    after = []
    for starter in (400.0, 700.0):
        entries = Entries.of([starter, 525.0, 560.0], games=[0, 400, 400])
        initial = system.initial(entries)
        after.append(system.update(History(entries, initial, initial, 1, night())))
    # 2 pseudo-games of some 400 are all that the others feel of it.
    assert np.abs(after[0][1:] - after[1][1:]).max() < 2.0
    # 8 games, and 192 more (and the 2) against the starter.
    assert after[0][0] == pytest.approx(400.0 + 8 / 202 * 200, abs=12.0)


def test_large_leagues_are_solved_as_small_ones_are(monkeypatch):
    found = []
    for most in (0, 20_000):
        monkeypatch.setattr(fargo_like, "_DENSE", most)
        *_, (_, published) = played_nights(FargoLike(), np.random.default_rng(9))
        found.append(published)
    np.testing.assert_allclose(found[0], found[1], atol=1e-6)


def test_a_performance_is_the_rating_at_which_a_score_is_expected():
    """The published table of ten games against 550."""
    shown = [233, 350, 428, 492, 550, 608, 672, 750, 867]
    assert [
        round(550.0 + float(SCALES["fargo"].difference(won / 10))) for won in range(1, 10)
    ] == shown


def test_races_are_of_the_chart_or_the_most_even_of_a_length():
    assert FargoLike().chart.name == "fargo_r6_hot"
    system = system_of("fargo-like games=9")
    assert sum(map(int, system.race(600.0, 500.0))) == 10
    assert broken_laws(system) == []
    with pytest.raises(InputError, match="games is 8"):
        FargoLike(games=8)
