"""Fitted ratings against a plain dense Newton method, closed forms and laws."""

import csv
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.ratings import Results, fit
from places import SHARED
from rows import each_of

SEASON = SHARED / "data" / "snooker_2016_17_results.csv"


def slow_fit(results, prior_sd):
    """Return skills and their standard deviations in log-odds, match by match, densely."""
    skill = np.zeros(len(results.players))
    for _ in range(100):
        gradient = -skill / prior_sd**2
        hessian = np.eye(len(skill)) / prior_sd**2
        for i, j, won, lost in zip(
            results.player_a, results.player_b, results.score_a, results.score_b, strict=True
        ):
            p = 1 / (1 + math.exp(skill[j] - skill[i]))
            surplus = won - (won + lost) * p
            gradient[i] += surplus
            gradient[j] -= surplus
            weight = (won + lost) * p * (1 - p)
            hessian[[i, j], [i, j]] += weight
            hessian[[i, j], [j, i]] -= weight
        step = np.linalg.solve(hessian, gradient)
        skill += step / max(1.0, np.abs(step).max())
        if np.abs(step).max() < 1e-13:
            break
    return skill, np.sqrt(np.diagonal(np.linalg.inv(hessian)))


def random_season(rng, players, matches, race=7):
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    names = tuple(f"p{k:03d}" for k in range(players))
    return Results(names, a, b, rng.integers(0, race + 1, matches), rng.integers(0, race, matches))


@each_of("prior_sd", [0.02, 1.0, 4.0, 100.0])
@each_of("players, matches", [(2, 1), (5, 4), (12, 60), (30, 31)])
def test_ratings_and_errors_equal_the_slow_way(players, matches, prior_sd):
    results = random_season(np.random.default_rng(players), players, matches)
    skill, sd = slow_fit(results, prior_sd)
    ratings = fit(results, prior_sd=prior_sd, scale=math.log(2), anchor=0)  # a point is a log-odd
    np.testing.assert_allclose(ratings.rating, skill, atol=1e-8)
    np.testing.assert_allclose(ratings.standard_error, sd, rtol=1e-8)
    assert ratings.gradient <= 1e-8


@pytest.mark.parametrize(("won", "lost"), [(7, 5), (11, 0), (0, 3), (4, 4), (900, 100)])
def test_two_players_solve_the_equation_of_the_mode(won, lost):
    sd = 0.8
    ratings = fit(Results.from_names(["A"], ["B"], [won], [lost]), prior_sd=sd, scale="fargo")
    half = (ratings.rating[0] - 500) * math.log(2) / 100
    assert ratings.rating[1] - 500 == pytest.approx(500 - ratings.rating[0], abs=1e-9)
    # Skills ±x: won - (won + lost) p(2x) = x / sd², the derivative of the log-posterior.
    p = 1 / (1 + math.exp(-2 * half))
    assert won - (won + lost) * p == pytest.approx(half / sd**2, abs=1e-8)
    # H = [h + τ, -h; -h, h + τ] has the inverse diagonal (h + τ) / (τ (τ + 2h)).
    h, tau = (won + lost) * p * (1 - p), sd**-2
    error = math.sqrt((h + tau) / (tau * (tau + 2 * h))) * 100 / math.log(2)
    assert ratings.standard_error == pytest.approx([error, error], rel=1e-10)


def test_the_default_prior_is_one_doubling_of_the_odds_wide():
    ratings = fit(Results.from_names(["A"], ["B"], [0], [0]), scale="fargo")
    assert ratings.standard_error == pytest.approx([100, 100])


def test_the_scale_only_rescales():
    results = random_season(np.random.default_rng(1), 20, 50)
    npl, fargo = fit(results, scale="npl", anchor=0), fit(results, scale="fargo", anchor=0)
    np.testing.assert_allclose(fargo.rating, npl.rating * (100 / 30), rtol=1e-13)
    np.testing.assert_allclose(fargo.standard_error, npl.standard_error * (100 / 30), rtol=1e-13)
    shifted = fit(results, scale="fargo", anchor=640)
    np.testing.assert_allclose(shifted.rating, fargo.rating + 640, rtol=1e-13)
    assert (shifted.standard_error == fargo.standard_error).all()


def test_every_component_has_the_anchor_as_its_mean():
    results = Results.from_names(
        ["A", "B", "D", "F", "G"], ["B", "C", "E", "D", "H"], [7, 7, 9, 0, 5], [2, 3, 1, 0, 4]
    )
    ratings = fit(results, anchor=70)
    # F has only a 0-0: there is nobody to compare him with.
    members = dict(zip(ratings.players, ratings.component.tolist(), strict=True))
    assert members == dict(zip("ABCDEFGH", [1, 1, 1, 2, 2, 4, 3, 3], strict=True))
    for number in (1, 2, 3, 4):
        assert ratings.rating[ratings.component == number].mean() == pytest.approx(70)
    assert ratings.games[ratings.players.index("F")] == 0
    assert ratings.standard_error[ratings.players.index("F")] == pytest.approx(30)


def test_players_of_different_components_are_not_compared():
    ratings = fit(Results.from_names(["A", "C"], ["B", "D"], [7, 7], [2, 3]))
    with pytest.raises(InputError, match="'A' and 'D' aren't connected"):
        ratings.win_probability("A", "D")
    with pytest.raises(InputError, match="'X'"):
        ratings.win_probability("A", "X")
    assert ratings.win_probability("A", "B") + ratings.win_probability("B", "A") == 1


def test_perfect_records_stay_finite_and_a_wider_prior_lets_them_go_further():
    results = Results.from_names(["A", "B"], ["B", "C"], [50, 50], [0, 0])
    narrow, wide = (fit(results, prior_sd=sd).rating for sd in (0.5, 5.0))
    assert np.isfinite(wide).all()
    assert wide[0] - wide[2] > narrow[0] - narrow[2] > 0


def test_a_narrow_prior_holds_everybody_at_the_anchor():
    results = random_season(np.random.default_rng(2), 10, 40)
    ratings = fit(results, prior_sd=1e-3, scale="npl")
    assert np.abs(ratings.rating - 80).max() < 0.05


def test_forfeits_and_empty_rows_change_nothing_but_their_counts():
    rows = [("A", "B", 7, 5, False), ("B", "C", 7, 3, False)]
    more = [*rows, ("A", "C", 7, 0, True), ("C", "B", 0, 0, False), ("A", "C", 0, 0, True)]

    def rated(season):
        a, b, score_a, score_b, forfeit = zip(*season, strict=True)
        return fit(Results.from_names(a, b, score_a, score_b, forfeit=forfeit))

    plain, padded = rated(rows), rated(more)
    assert (padded.matches, padded.forfeits, padded.empty) == (2, 2, 1)
    assert (padded.rating == plain.rating).all()
    assert (padded.won.tolist(), padded.lost.tolist()) == ([7, 12, 3], [5, 10, 7])
    assert (padded.games == padded.won + padded.lost).all()


def test_no_games_leave_the_prior():
    ratings = fit(Results.from_names(["A"], ["B"], [0], [0]), scale="elo")
    assert ratings.rating.tolist() == [1500, 1500]
    assert ratings.component.tolist() == [1, 2]
    assert fit(Results.from_names([], [], [], [])).standard_error.shape == (0,)


seasons = st.lists(
    st.tuples(st.integers(0, 5), st.integers(1, 5), st.integers(0, 9), st.integers(0, 9)),
    min_size=1,
    max_size=25,
).map(lambda rows: [(a, (a + step) % 6, won, lost) for a, step, won, lost in rows])


def of_rows(rows):
    a, b, won, lost = (np.array(column) for column in zip(*rows, strict=True))
    return Results(tuple("ABCDEF"), a, b, won, lost)


@given(seasons, st.permutations(range(6)))
def test_relabelling_the_players_permutes_their_ratings(rows, order):
    plain = fit(of_rows(rows))
    other = fit(of_rows([(order[a], order[b], won, lost) for a, b, won, lost in rows]))
    np.testing.assert_allclose(other.rating[list(order)], plain.rating, atol=1e-6)
    np.testing.assert_allclose(other.standard_error[list(order)], plain.standard_error, rtol=1e-7)
    same = plain.component[:, None] == plain.component
    moved = other.component[list(order)]
    assert (same == (moved[:, None] == moved)).all()


@given(seasons)
def test_it_does_not_matter_who_is_called_a(rows):
    plain = fit(of_rows(rows))
    turned = fit(of_rows([(b, a, lost, won) for a, b, won, lost in rows]))
    assert (turned.rating == plain.rating).all()
    assert (turned.standard_error == plain.standard_error).all()


@given(seasons)
def test_winning_one_more_game_never_lowers_a_rating(rows):
    a, b, won, lost = rows[0]
    before = fit(of_rows(rows)).rating
    after = fit(of_rows([(a, b, won + 1, lost), *rows[1:]])).rating
    assert after[a] > before[a]
    assert after[b] < before[b]


def test_standard_errors_cover_as_often_as_they_say():
    """Skills drawn from the prior lie within one and two errors as often as a normal does."""
    rng = np.random.default_rng(11)
    inside = []
    for _ in range(40):
        skill = rng.normal(0, 1, 60)
        results = random_season(rng, 60, 240)
        games = results.score_a + results.score_b
        chance = 1 / (1 + np.exp(skill[results.player_b] - skill[results.player_a]))
        won = rng.binomial(games, chance)
        played = Results(results.players, results.player_a, results.player_b, won, games - won)
        ratings = fit(played, prior_sd=1.0, scale=math.log(2), anchor=0)
        inside.append(np.abs(ratings.rating - skill) / ratings.standard_error)
    z = np.concatenate(inside)
    assert np.mean(z < 1) == pytest.approx(0.683, abs=0.03)
    assert np.mean(z < 2) == pytest.approx(0.954, abs=0.015)


@pytest.mark.parametrize("prior_sd", [0, -1, 1e-4, 101, math.nan, math.inf, "wide"])
def test_a_prior_needs_a_width(prior_sd):
    with pytest.raises(InputError, match="prior_sd"):
        fit(Results.from_names(["A"], ["B"], [7], [5]), prior_sd=prior_sd)


def test_an_anchor_is_a_number():
    with pytest.raises(InputError, match="anchor"):
        fit(Results.from_names(["A"], ["B"], [7], [5]), anchor=math.nan)


@pytest.mark.parametrize(
    ("names", "scores", "words"),
    [(("A", "B"), (-1, 5), "negative score"), (("A", "A"), (7, 5), "only one player")],
)
def test_results_that_cannot_be_are_refused(names, scores, words):
    with pytest.raises(InputError, match=words):
        fit(Results.from_names([names[0]], [names[1]], [scores[0]], [scores[1]]))


def test_a_long_chain_of_whitewashes_converges():
    names = [f"p{k:04d}" for k in range(400)]
    results = Results.from_names(names[:-1], names[1:], [40] * 399, [0] * 399)
    ratings = fit(results, prior_sd=10.0)
    assert ratings.gradient <= 1e-8
    assert (np.diff(ratings.rating) < 0).all()


@pytest.mark.slow
@pytest.mark.skipif(not SEASON.exists(), reason="the season's results are not beside this checkout")
def test_a_real_season():
    with SEASON.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    results = Results.from_names(
        [row["player_a"] for row in rows],
        [row["player_b"] for row in rows],
        [int(row["score_a"]) for row in rows],
        [int(row["score_b"]) for row in rows],
        forfeit=[row["forfeit"] == "yes" for row in rows],
    )
    ratings = fit(results, scale="fargo", prior_sd=1.0)
    assert (ratings.matches, ratings.forfeits, len(ratings.players)) == (2412, 49, 335)
    assert ratings.gradient <= 1e-8
    skill, sd = slow_fit(results.played().results, 1.0)
    points = 100 / math.log(2)
    np.testing.assert_allclose(ratings.rating, 500 + points * skill, atol=1e-6)
    np.testing.assert_allclose(ratings.standard_error, points * sd, rtol=1e-8)
    best = [ratings.players[k] for k in np.argsort(-ratings.rating)[:10]]
    assert {"Ronnie O'Sullivan", "Judd Trump", "Mark Selby"} <= set(best)
