"""Each date is predicted from the dates before it, as a fit of those dates alone would."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import expit

from evenbreak.errors import InputError
from evenbreak.matches import race_win_probability
from evenbreak.ratings import Results, fit
from evenbreak.ratings.covariance import count_pairs
from evenbreak.ratings.posterior import find_mode
from evenbreak.ratings.validation.daily_refit import DailyRefit
from evenbreak.ratings.validation.walk_forward import even_races, walk_forward
from tiers import examples


def season(seed: int = 1, *, players: int = 8, matches: int = 60, days: int = 10) -> Results:
    rng = np.random.default_rng(seed)
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    day = np.datetime64("2024-09-03") + rng.integers(0, days, matches)
    loser = rng.integers(0, 5, matches)
    a_wins = rng.random(matches) < 0.5
    return Results(
        tuple(f"p{k}" for k in range(players)),
        a,
        b,
        np.where(a_wins, 5, loser),
        np.where(a_wins, loser, 5),
        date=day,
    )


def test_predictions_are_those_of_a_fit_of_the_earlier_dates():
    results = season()
    told = walk_forward(results, prior_sd=0.6)
    dates = told.results.date
    for day in np.unique(dates)[1:]:
        ratings = fit(results.select(results.date < day), prior_sd=0.6)
        skill = ratings.scale.log_odds(ratings.rating - ratings.anchor)
        today = dates == day
        a, b = told.results.player_a[today], told.results.player_b[today]
        assert told.difference[today] == pytest.approx(skill[a] - skill[b], abs=2e-6)


def test_the_spread_is_that_of_the_inverse_hessian():
    results = season(2)
    told = walk_forward(results, prior_sd=0.6)
    day = told.results.date[-1]
    before = results.select(results.date < day)
    ratings = fit(before, prior_sd=0.6)
    skill = ratings.scale.log_odds(ratings.rating - ratings.anchor)
    hessian = np.eye(len(skill)) / 0.6**2
    for a, b, m, n in zip(
        before.player_a, before.player_b, before.score_a, before.score_b, strict=True
    ):
        p = expit(skill[a] - skill[b])
        unit = np.zeros(len(skill))
        unit[a], unit[b] = 1.0, -1.0
        hessian += (m + n) * p * (1 - p) * np.outer(unit, unit)
    covariance = np.linalg.inv(hessian)
    today = told.results.date == day
    a, b = told.results.player_a[today], told.results.player_b[today]
    variance = covariance[a, a] + covariance[b, b] - 2 * covariance[a, b]
    assert told.sd[today] ** 2 == pytest.approx(variance, rel=1e-6)


def test_the_first_date_is_a_toss_up():
    told = walk_forward(season())
    first = told.date_of == 0
    assert (told.p_game[first] == 0.5).all()
    assert told.p_match_integrated[first] == pytest.approx(0.5, abs=1e-12)
    assert told.sd[first] == pytest.approx(np.sqrt(2) * told.prior_sd)
    assert told.new[first].all()


def test_chances_are_integrated_over_the_posterior():
    told = walk_forward(season(), prior_sd=1.2)
    k = len(told) - 1
    mean, sd = told.difference[k], told.sd[k]

    def average(chance):
        density = lambda z: np.exp(-z * z / 2) / np.sqrt(2 * np.pi)  # noqa: E731
        return quad(lambda z: density(z) * chance(expit(mean + sd * z)), -10, 10, epsabs=1e-13)[0]

    assert told.p_game_integrated[k] == pytest.approx(average(lambda p: p), abs=1e-10)
    m, n = told.race_a[k], told.race_b[k]
    expected = average(lambda p: race_win_probability(p, m, n))
    assert told.p_match_integrated[k] == pytest.approx(expected, abs=1e-8)


def test_a_date_says_nothing_of_itself():
    """Whatever happens on a date, its own predictions stay and only later ones change."""
    results = season(3)
    last = results.date == results.date.max()
    turned = Results(
        results.players,
        results.player_a,
        results.player_b,
        np.where(last, results.score_b, results.score_a),
        np.where(last, results.score_a, results.score_b),
        date=results.date,
    )
    assert walk_forward(turned).p_game == pytest.approx(walk_forward(results).p_game, abs=0)


def test_rows_that_predict_nothing_are_counted():
    results = Results.from_names(
        ["Ann"] * 5,
        ["Bo"] * 5,
        [7, 7, 0, 0, 5],
        [2, 4, 0, 0, 7],
        date=["2024-09-03", "2024-09-10", "2024-09-10", "2024-09-11", "NaT"],
        forfeit=[False, False, True, False, False],
    )
    told = walk_forward(results)
    assert (len(told), told.undated, told.forfeits, told.empty) == (2, 1, 1, 1)


def test_games_fade_with_their_half_life():
    """After one half-life each game counts half, as the same results of half the games do."""
    days = ["2024-09-03", "2024-09-13", "2024-09-13"]
    old = Results.from_names(["Ann", "Ann"], ["Bo", "Bo"], [8, 1], [4, 0], date=days[:2])
    half = Results.from_names(["Ann", "Ann"], ["Bo", "Bo"], [4, 1], [2, 0], date=days[:2])
    faded = walk_forward(old, half_life=10.0)
    assert faded.p_game[1] == pytest.approx(walk_forward(half).p_game[1], abs=1e-6)
    assert faded.sd[1] == pytest.approx(walk_forward(half).sd[1], rel=1e-6)


def test_what_is_no_race_is_not_taken_for_one():
    drawn = Results.from_names(
        ["Ann", "Ann", "Bo"], ["Bo", "Cy", "Cy"], [4, 5, 6], [4, 3, 7],
        race_a=[0, 0, 8], race_b=[0, 0, 7],
    )  # fmt: skip
    race_a, race_b, won = even_races(drawn)
    assert (race_a.tolist(), race_b.tolist()) == ([0, 0, 8], [0, 0, 7])
    assert np.isnan(won[:2]).all()
    assert won[2] == 0.0


def test_an_unfinished_race_has_no_winner():
    lone = Results.from_names(["Ann"], ["Bo"], [4], [5], race_a=[7], race_b=[7])
    assert np.isnan(even_races(lone)[2]).all()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"date": None}, "no dates"),
        ({"date": ["2024-09-03"] * 2}, "1 date"),
        ({"date": ["NaT"] * 2}, "0 dates"),
    ],
)
def test_without_an_order_in_time_nothing_can_be_validated(change, words):
    results = Results.from_names(["Ann", "Ann"], ["Bo", "Bo"], [7, 7], [2, 4], **change)
    with pytest.raises(InputError, match=words):
        walk_forward(results)


@pytest.mark.parametrize("name", ["prior_sd", "half_life"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), "much"])
def test_settings_out_of_range_are_refused(name, value):
    with pytest.raises(InputError, match=name):
        walk_forward(season(), **{name: value})


@given(st.integers(0, 10_000))
@settings(max_examples=examples(20))
def test_which_player_is_called_a_does_not_matter(seed):
    results = season(seed, matches=20, days=4)
    turned = Results(
        results.players,
        results.player_b,
        results.player_a,
        results.score_b,
        results.score_a,
        date=results.date,
    )
    one, other = walk_forward(results), walk_forward(turned)
    assert one.p_game == pytest.approx(1.0 - other.p_game, abs=1e-6)
    assert one.p_match_integrated == pytest.approx(1.0 - other.p_match_integrated, abs=1e-5)


# Refitting day by day against a fit of all results at once.


RNG = np.random.default_rng(4)
PLAYERS, MATCHES = 12, 60
A = RNG.integers(0, PLAYERS, MATCHES)
B = (A + RNG.integers(1, PLAYERS, MATCHES)) % PLAYERS
WON, LOST = RNG.integers(0, 8, MATCHES), RNG.integers(0, 8, MATCHES)


def refitted(until, times=1):
    league = DailyRefit(PLAYERS, A, B, 2.0)
    for start in range(0, until, 10):
        rows = slice(start, start + 10)
        league.learn(rows, times * WON[rows], times * LOST[rows])
        league.begin_day()
    return league


def test_day_by_day_ends_where_one_fit_does():
    league = refitted(MATCHES)
    mode = find_mode(count_pairs(PLAYERS, A, B, WON, LOST), 2.0)
    np.testing.assert_allclose(league.skill, mode.point, atol=1e-6)


def test_the_variance_of_a_difference_is_that_of_the_inverse_hessian():
    league = refitted(40)
    pairs = count_pairs(PLAYERS, A[:40], B[:40], WON[:40], LOST[:40])
    covariance = np.linalg.inv(pairs.curvature(league.skill, 0.0, 2.0, None).matrix.toarray())
    a, b = np.array([0, 3, 5]), np.array([1, 7, 5])
    exact = covariance[a, a] + covariance[b, b] - 2 * covariance[a, b]
    np.testing.assert_allclose(league.difference_variance(a, b), exact, rtol=1e-6, atol=1e-12)


def test_before_any_game_the_prior_alone_is_known():
    league = DailyRefit(PLAYERS, A, B, 2.0)
    variance = league.difference_variance(np.array([0, 1]), np.array([1, 1]))
    np.testing.assert_allclose(variance, [1.0, 0.0], rtol=1e-6)


def test_faded_games_count_for_part_of_themselves():
    faded = refitted(MATCHES, times=2)
    faded.fade(0.5)
    faded.begin_day()
    np.testing.assert_allclose(faded.skill, refitted(MATCHES).skill, atol=1e-6)
