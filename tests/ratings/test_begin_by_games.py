"""What a list with games and no errors says to `rate --begin`, exactly and in simulated leagues."""

import math

import numpy as np
import pytest

from evenbreak.ratings import Beginning, Results, fit
from evenbreak.ratings.levels import BESIDES_GAMES, BROUGHT_SD, begun
from evenbreak.ratings.scale import scale_of

UNIT = scale_of("npl").points_per_log_odds
WIDTH = math.log(2.0)


def test_games_are_information_a_quarter_each() -> None:
    games = np.array([1.0, 12.0, 200.0, 0.0])
    old = Beginning("ABCD", [95, 70, 80, 60], games=games)
    known = old.known("ABCD", brought_sd=1e-9)
    assert known.information[:3] == pytest.approx(games[:3] / 4.0)
    mean = old.rating.mean()
    assert known.pull[:3] == pytest.approx(games[:3] / 4.0 * (old.rating[:3] - mean) / UNIT)
    besides = old.known("ABCD", brought_sd=0.3).information
    assert besides == pytest.approx([1 / (0.09 + 4 / n) if n else 1 / 0.09 for n in games])
    assert not old.known("ABCD").information.any()


def test_a_prior_that_the_list_states_is_not_in_its_games() -> None:
    plain = Beginning("AB", [95, 70], games=[50, 20])
    made = Beginning("AB", [95, 70], games=[50, 20], prior_sd=30.0, prior_mean=80.0)
    one, other = (old.known("AB", brought_sd=0.05) for old in (plain, made))
    assert one.information == pytest.approx(other.information)
    # The rating is nearer to the prior's mean than what its games alone say.
    assert (np.abs(other.pull) > np.abs(one.pull)).all()


def test_errors_count_before_games_and_games_before_nothing() -> None:
    stated = Beginning("AB", [95, 70], [9, 9], games=[5, 5])
    assert not stated.by_games.any()
    assert begun(stated).brought_sd == 0.0
    assert begun(Beginning("AB", [95, 70], games=[5, 5])).brought_sd == BESIDES_GAMES
    assert begun(Beginning("AB", [95, 70], games=[5, 0])).brought_sd == BROUGHT_SD
    assert begun(Beginning("AB", [95, 70])).brought_sd == BROUGHT_SD


def matches_of(
    rng: np.random.Generator, skill: np.ndarray, many: int, weight: np.ndarray
) -> Results:
    """Return races to 7 between players drawn by weight."""
    pairs = rng.choice(len(skill), (2, many), p=weight / weight.sum())
    a, b = pairs[:, pairs[0] != pairs[1]]
    p = 1.0 / (1.0 + np.exp(skill[b] - skill[a]))
    racks = rng.random((len(a), 13)) < p[:, None]
    won, lost = racks.cumsum(1), (~racks).cumsum(1)
    over = ((won == 7) | (lost == 7)).argmax(1)
    rows = np.arange(len(a))
    names = tuple(f"p{k:02d}" for k in range(len(skill)))
    return Results(names, a, b, won[rows, over], lost[rows, over])


def loss_of(seed: int, spread: float, width: float) -> dict[str, float]:
    """Return the log-loss a game of the next season, by what the list of the last one states."""
    rng, players = np.random.default_rng(seed), 40
    skill, even = rng.normal(0.0, spread, players), np.ones(players)
    last = fit(matches_of(rng, skill, 400, rng.lognormal(0.0, 1.2, players)), prior_sd=width)
    start, test = matches_of(rng, skill, 20, even), matches_of(rng, skill, 400, even)
    here = last.games > 0
    names = [name for name, played in zip(last.players, here, strict=True) if played]
    rating, games = last.rating[here], last.games[here]
    prior = {"prior_sd": width * UNIT, "prior_mean": 80.0}
    lists = {
        "errors": Beginning(names, rating, last.quasi_error[here], games=games, **prior),
        "games": Beginning(names, rating, games=games),
        "neither": Beginning(names, rating),
    }
    found = {}
    for what, beginning in lists.items():
        ratings = fit(start, levels=begun(beginning))
        error = ratings.difference_variances(test.player_a, test.player_b)
        apart = (ratings.rating[test.player_a] - ratings.rating[test.player_b]) / UNIT
        odds = apart / np.sqrt(1.0 + math.pi * error / 8.0)
        lost = test.score_a * np.logaddexp(0.0, -odds) + test.score_b * np.logaddexp(0.0, odds)
        found[what] = float(lost.sum() / (test.score_a + test.score_b).sum())
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spread", "width"),
    [(0.7, WIDTH), (0.4, 0.4), (0.7, 3.0)],
    ids=["usual prior", "a narrow league", "hardly any prior"],
)
def test_games_predict_nearly_as_well_as_the_errors_themselves(spread: float, width: float) -> None:
    leagues = 40
    found = [loss_of(seed, spread, width) for seed in range(leagues)]
    behind = 1e4 * np.array([one["games"] - one["errors"] for one in found])
    gained = 1e4 * np.array([one["neither"] - one["games"] for one in found])
    error = math.sqrt(leagues)
    assert behind.mean() < 15.0 + 2.0 * behind.std() / error
    assert gained.mean() > 3.0 * gained.std() / error
