"""Anchors, and the uncertainty of differences, against the whole inverse."""

import math

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.files.results.results_file import read_results
from evenbreak.ratings import Beginning, Levels, Results, covariance, fit
from evenbreak.ratings.sources import rating_sources
from places import DATA

NAMES = tuple("ABCDEFGH")


def league(rng, matches=40, players=8):
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    names = NAMES if players == 8 else tuple(f"p{k:04d}" for k in range(players))
    form = rng.integers(4, 6, matches)  # a or b breaks throughout
    won, lost = rng.integers(0, 8, matches), rng.integers(0, 8, matches)
    return Results(names, a, b, won, lost, break_format=form)


def whole_covariance(results, ratings, breaks):
    """Return the inverse of the dense Hessian, game by game, in squared points."""
    n = len(results.players)
    log_odds = math.log(2) / ratings.scale.points_per_doubling
    skill, advantage = ratings.rating * log_odds, (ratings.break_advantage or 0) * log_odds
    hessian = np.diag([ratings.prior_sd**-2] * n + [math.log(2) ** -2])
    for a, b, won, lost, form in zip(
        results.player_a,
        results.player_b,
        results.score_a,
        results.score_b,
        results.break_format,
        strict=True,
    ):
        row = np.zeros(n + 1)
        row[[a, b, n]] = 1, -1, (1 if form == 4 else -1) if breaks else 0
        p = 1 / (1 + math.exp(-(row @ np.append(skill, advantage))))
        hessian += (won + lost) * p * (1 - p) * np.outer(row, row)
    return np.linalg.inv(hessian) / log_odds**2


@pytest.mark.parametrize("breaks", [None, "fit"])
def test_covariances_are_those_of_the_whole_inverse(breaks):
    results = league(np.random.default_rng(1))
    ratings = fit(results, break_advantage=breaks)
    whole = whole_covariance(results, ratings, breaks)
    np.testing.assert_allclose(ratings.standard_error, np.sqrt(np.diagonal(whole)[:8]), rtol=1e-9)
    np.testing.assert_allclose(ratings.covariance(NAMES), whole[:8, :8], rtol=1e-9)
    for i, j in ((0, 1), (3, 7), (5, 5)):
        expected = math.sqrt(max(whole[i, i] + whole[j, j] - 2 * whole[i, j], 0))
        got = ratings.difference_error(NAMES[i], NAMES[j])
        assert got == pytest.approx(expected, rel=1e-9, abs=1e-6)
    if breaks:
        assert ratings.break_error == pytest.approx(math.sqrt(whole[8, 8]), rel=1e-9)


@pytest.mark.parametrize("breaks", [None, "fit"])
def test_large_leagues_are_iterated_for(monkeypatch, breaks):
    results = league(np.random.default_rng(2), 400, 60)
    exact = fit(results, break_advantage=breaks)
    errors = [exact.difference_error("p0000", f"p{k:04d}") for k in range(1, 60)]
    monkeypatch.setattr(covariance, "_DENSE_UP_TO", 10)
    iterated = fit(results, break_advantage=breaks)
    again = [iterated.difference_error("p0000", f"p{k:04d}") for k in range(1, 60)]
    np.testing.assert_allclose(again, errors, rtol=1e-8)
    if breaks:
        assert iterated.break_error == pytest.approx(exact.break_error, rel=1e-8)


def test_a_difference_is_surer_than_two_ratings_alone():
    ratings = fit(league(np.random.default_rng(3), 60))
    error = ratings.difference_error("A", "B")
    assert error < math.hypot(*ratings.standard_error[:2])


def pairs_of(ratings):
    """Return of all linked pairs the sum of the two quasi-variances, and the difference's."""
    q = ratings.quasi_error**2
    whole = ratings.covariance(ratings.players)
    i, j = np.triu_indices(len(q), 1)
    linked = ratings.component[i] == ratings.component[j]
    i, j = i[linked], j[linked]
    return q[i] + q[j], whole[i, i] + whole[j, j] - 2 * whole[i, j]


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"prior_sd": 3.0},
        {"break_advantage": "fit"},
        {"anchor": {"C": 95}},
        {"anchor": {"A": 60, "D": 120}, "break_advantage": "fit"},
    ],
)
def test_quasi_variances_are_those_of_differences_on_average(options):
    ratings = fit(league(np.random.default_rng(8)), **options)
    assert ratings.component.max() == 1
    quasi, true = pairs_of(ratings)
    assert quasi.mean() == pytest.approx(true.mean(), rel=1e-10)


def test_quasi_variances_with_decay_and_matches_known_by_their_winner():
    rng = np.random.default_rng(9)
    a = rng.integers(0, 6, 60)
    b = (a + rng.integers(1, 6, 60)) % 6
    bare = np.arange(60) % 3 == 0
    results = Results(
        NAMES[:6],
        a,
        b,
        np.where(bare, 0, rng.integers(0, 8, 60)),
        np.where(bare, 0, rng.integers(0, 8, 60)),
        date=np.datetime64("2024-01-01") + rng.integers(0, 300, 60),
        race_a=np.full(60, 7),
        race_b=np.full(60, 5),
        winner=rng.integers(1, 3, 60),
        unscored=bare,
    )
    ratings = fit(results, half_life=90)
    assert ratings.races_won.sum() == bare.sum()
    quasi, true = pairs_of(ratings)
    assert quasi.mean() == pytest.approx(true.mean(), rel=1e-10)


def test_quasi_errors_of_a_pair_are_exact_and_of_one_alone_the_priors():
    ratings = fit(Results.from_names(["A", "C"], ["B", "D"], [7, 0], [2, 0]))
    assert ratings.component.tolist() == [1, 1, 2, 3]
    assert math.hypot(*ratings.quasi_error[:2]) == pytest.approx(ratings.difference_error("A", "B"))
    assert ratings.quasi_error[2:] == pytest.approx([30, 30])


def test_quasi_errors_do_not_depend_on_the_anchor():
    results = league(np.random.default_rng(10))
    plain, named = fit(results), fit(results, anchor={"C": 95})
    np.testing.assert_allclose(named.quasi_error, plain.quasi_error, rtol=1e-12)


@pytest.mark.parametrize("options", [{}, {"prior_sd": 0.35}, {"half_life": 60}])
def test_quasi_errors_tell_every_difference_of_the_demo_league_closely(options):
    path = DATA / "demo_league.csv"
    ratings = fit(read_results(path).results, **options)
    quasi, true = pairs_of(ratings)
    assert np.abs(np.sqrt(quasi / true) - 1).max() < 0.05
    plain = np.sqrt(2) * ratings.standard_error.mean()
    assert plain > 1.1 * np.sqrt(true).mean()


def test_a_named_player_stands_where_he_is_put():
    results = league(np.random.default_rng(4))
    plain, named = fit(results), fit(results, anchor={"C": 95})
    assert named.rating[2] == pytest.approx(95, abs=1e-12)
    np.testing.assert_allclose(
        named.rating - named.rating[2], plain.rating - plain.rating[2], atol=1e-10
    )
    assert named.standard_error[2] == pytest.approx(0, abs=1e-5)
    for k in (0, 5):
        expected = plain.difference_error(NAMES[k], "C")
        assert named.standard_error[k] == pytest.approx(expected, rel=1e-9)
        assert named.difference_error(NAMES[k], "C") == pytest.approx(expected, rel=1e-9)


def test_several_named_players_have_their_ratings_on_average():
    results = league(np.random.default_rng(5))
    anchors = {"A": 60.0, "D": 120.0, "E": 90.0}
    ratings = fit(results, anchor=anchors)
    at = [0, 3, 4]
    assert ratings.rating[at].mean() == pytest.approx(90)
    assert ratings.named == tuple(anchors.items())
    whole = ratings.covariance(NAMES)
    np.testing.assert_allclose(np.sqrt(np.diagonal(whole)), ratings.standard_error, rtol=1e-7)
    # The mean of the three is certain, so that their covariances with anybody cancel.
    np.testing.assert_allclose(whole[at].sum(axis=0), 0, atol=1e-8)


def test_a_component_without_a_named_player_stays_at_the_center():
    results = Results.from_names(["A", "C"], ["B", "D"], [7, 7], [2, 3])
    plain, named = fit(results), fit(results, anchor={"A": 200})
    assert named.rating[0] == pytest.approx(200)
    assert (named.rating[2:] == plain.rating[2:]).all()
    assert (named.standard_error[2:] == plain.standard_error[2:]).all()


@pytest.mark.parametrize(
    ("anchor", "words"),
    [
        ({"X": 80}, "'X'"),
        ({"A": math.nan}, "anchor of 'A' must be a finite number of points; you gave nan"),
        ({"A": "high"}, "anchor of 'A' must be a finite number of points; you gave 'high'"),
        ("high", "anchor must be a finite number of points; you gave 'high'"),
    ],
)
def test_wrong_anchors_are_refused(anchor, words):
    with pytest.raises(InputError, match=words):
        fit(league(np.random.default_rng(6)), anchor=anchor)


def test_players_who_never_met_have_no_difference():
    ratings = fit(Results.from_names(["A", "C"], ["B", "D"], [7, 7], [2, 3]))
    with pytest.raises(InputError, match="aren't connected"):
        ratings.difference_error("A", "C")


@pytest.mark.parametrize("value", ["yes", math.nan, math.inf])
def test_a_break_advantage_is_points_or_fit(value):
    with pytest.raises(InputError, match="break_advantage"):
        fit(league(np.random.default_rng(7)), break_advantage=value)


@pytest.mark.parametrize("scale", ["npl", 0.01, 1e6])
def test_the_strongest_come_first_on_any_scale(scale):
    season = Results.from_names(["Ann", "Bo", "Di"], ["Bo", "Cy", "Ed"], [3, 4, 5], [7, 7, 5])
    ratings = fit(season, scale=scale)
    order = ratings.strongest_first()
    assert [ratings.players[k] for k in order] == ["Cy", "Bo", "Di", "Ed", "Ann"]


def test_everybody_is_in_the_frame_the_strongest_first():
    season = Results.from_names(
        ["Bo", "Bo", "Cy", "Di", "Ann"],
        ["Ann", "Cy", "Ann", "Ed", "Cy"],
        [4, 7, 3, 0, 0],
        [7, 5, 7, 5, 0],
        forfeit=[False, False, False, True, False],
    )
    ratings = fit(season, scale="fargo")
    frame = ratings.to_frame()
    assert set(frame["scale"]) == {"fargo"}
    # Di and Ed, who only forfeited, have no place, and keep the order of names.
    assert frame["player"].tolist() == ["Ann", "Bo", "Cy", "Di", "Ed"]
    assert frame["games"].tolist() == [21, 23, 22, 0, 0]
    assert (frame["won"] + frame["lost"]).tolist() == frame["games"].tolist()
    assert frame["component"].tolist() == [1, 1, 1, 2, 3]
    assert frame["provisional"].tolist() == [False, False, False, True, True]
    assert dict(zip(frame["player"], frame["standard_error"], strict=True)) == dict(
        zip(ratings.players, ratings.standard_error, strict=True)
    )


# What a rating is made of.


SEASON = Results.from_names(
    ["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [17, 12, 9], [10, 14, 8], date=["2026-01-05"] * 3
)
OLD = Beginning(["Ann", "Bo"], [95, 65], [10, 20])


@pytest.mark.parametrize("levels", [Levels(), Levels(beginning=OLD)])
def test_a_rating_is_the_mean_of_what_its_sources_say(levels):
    ratings = fit(SEASON, levels=levels)
    for player, name in enumerate(ratings.players):
        sources = rating_sources(ratings, player)
        assert sum(one.weight for one in sources) == pytest.approx(1.0)
        mean = sum(one.weight * one.rating for one in sources if one.rating is not None)
        assert mean == pytest.approx(float(ratings.rating[player]))
        brought = [one for one in sources if one.source == "brought"]
        assert bool(brought) == (levels.beginning is not None and name != "Cy")


def test_a_brought_rating_says_what_stands_in_the_list():
    ratings = fit(SEASON, levels=Levels(beginning=OLD))
    prior, brought, results = rating_sources(ratings, 0)
    assert (brought.rating, brought.standard_error) == pytest.approx((95.0, 10.0))
    assert prior.standard_error == pytest.approx(ratings.scale.points(ratings.prior_sd))
    assert 0.0 < results.weight < 1.0


def test_a_player_without_results_has_the_rating_that_was_assumed():
    season = Results.from_names(
        ["Ann", "Di"], ["Bo", "Ann"], [7, 0], [5, 0], date=np.array(["2026-01-05"] * 2, "M8[D]")
    )
    ratings = fit(season)
    prior, results = rating_sources(ratings, ratings.players.index("Di"))
    assert prior.weight == pytest.approx(1.0)
    assert results.rating is None
