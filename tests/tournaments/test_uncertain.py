"""Odds averaged over uncertain ratings."""

from __future__ import annotations

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    chances_given,
    double_elimination,
    groups_then_knockout,
    over_ratings,
    single_elimination,
    title_odds,
)
from evenbreak.tournaments.odds.uncertain import drawn_ratings
from tournaments.fields import by_fargo

RATINGS = [640, 600, 560, 520, 480, 440, 400, 360]


def test_it_is_the_mean_over_draws() -> None:
    bracket = single_elimination(2)
    found = over_ratings(bracket, by_fargo, [550, 500], [60, 30], samples=4000)
    nodes, weights = np.polynomial.hermite_e.hermegauss(60)
    gaps = 50 + np.hypot(60, 30) * nodes
    want = (weights / weights.sum()) @ (1 / (1 + 2 ** (-gaps / 100)))
    assert found.averaged.title[0] == pytest.approx(want, abs=5 * found.averaged.error[0, 0])
    assert found.as_if_sure.title[0] == pytest.approx(1 / (1 + 2**-0.5))


@pytest.mark.parametrize("bracket", [double_elimination(8), groups_then_knockout(8, 2)])
def test_sure_ratings_change_nothing(bracket) -> None:
    found = over_ratings(bracket, by_fargo, RATINGS, [0.0] * 8, samples=4)
    assert found.averaged.p_place == pytest.approx(found.as_if_sure.p_place)
    for name, meeting in found.as_if_sure.meetings.items():
        again = found.averaged.meetings[name]
        assert again.played == pytest.approx(meeting.played)
    assert found.averaged.p_second_final == pytest.approx(found.as_if_sure.p_second_final)


def test_doubt_brings_odds_nearer_to_equal() -> None:
    found = over_ratings(double_elimination(8), by_fargo, RATINGS, [80.0] * 8)
    assert found.averaged.title[0] < found.as_if_sure.title[0]
    assert found.averaged.title[-1] > found.as_if_sure.title[-1]
    assert found.averaged.p_place.sum(axis=1) == pytest.approx(np.ones(8))
    assert 0 < found.averaged.error[0, 0] < 0.02


def test_errors_that_all_share_change_nothing() -> None:
    """A covariance that moves all ratings together leaves the differences alone."""
    together = np.full((8, 8), 40.0**2)
    found = over_ratings(double_elimination(8), by_fargo, RATINGS, together, samples=10)
    assert found.averaged.title == pytest.approx(found.as_if_sure.title, abs=1e-9)


def test_draws_do_not_depend_on_the_eigenvectors_chosen(monkeypatch) -> None:
    """Equal eigenvalues leave a library the choice, which is another on other machines."""
    mean, spread = np.array([600.0, 550.0, 500.0]), np.array([50.0, 30.0, 30.0])
    asked = mean, np.diag(spread**2), 50
    want = drawn_ratings(*asked, np.random.default_rng(0))
    assert want == pytest.approx(drawn_ratings(mean, spread, 50, np.random.default_rng(0)))
    tenth = np.cos(0.1), np.sin(0.1)
    turned = np.array([[tenth[0], tenth[1], 0], [-tenth[1], tenth[0], 0], [0, 0, -1]])
    monkeypatch.setattr("numpy.linalg.eigh", lambda _: (spread[::-1] ** 2, other))
    other = np.eye(3)[:, ::-1] @ turned
    assert drawn_ratings(*asked, np.random.default_rng(0)) == pytest.approx(want)


def test_races_stay_those_of_the_chart() -> None:
    bracket = double_elimination(8)
    chances = chances_given(bracket, RATINGS, 7)
    found = over_ratings(bracket, chances, RATINGS, [50.0] * 8, results={"W1.1": "8"})
    assert found.as_if_sure.title == pytest.approx(
        title_odds(bracket, chances(np.array(RATINGS, dtype=float)), results={"W1.1": "8"}).title
    )
    assert found.averaged.meetings["W1.1"].first_wins.tolist() == [0.0]


def test_large_brackets_are_drawn_for_each_draw(monkeypatch) -> None:
    monkeypatch.setattr("evenbreak.tournaments.odds.uncertain._MOST_STATES", 0)
    bracket = double_elimination(8)
    rough = over_ratings(bracket, by_fargo, RATINGS, [0.0] * 8, samples=8).averaged
    assert rough.title == pytest.approx(title_odds(bracket, by_fargo(RATINGS)).title, abs=0.02)


@pytest.mark.parametrize(
    ("spread", "named"),
    [([1.0] * 7, "shape"), ([-1.0] * 8, "deviations,"), (-np.eye(8), "covariance")],
)
def test_what_is_no_spread_is_refused(spread, named: str) -> None:
    with pytest.raises(InputError, match=named):
        over_ratings(double_elimination(8), by_fargo, RATINGS, spread)
