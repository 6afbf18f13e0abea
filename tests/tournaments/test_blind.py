"""Odds of a blind draw: sampled draws, against the mean over all of them."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from evenbreak.tournaments import (
    blind_draw_odds,
    double_elimination,
    groups_then_knockout,
    single_elimination,
    title_odds,
)
from tournaments.fields import by_seed, by_strength, one_favorite


def mean_of_draws(bracket, win) -> np.ndarray:
    laws = []
    for order in permutations(range(len(win))):
        line = np.argsort(order)
        laws.append(title_odds(bracket, win[np.ix_(order, order)]).p_place[line])
    return np.mean(laws, axis=0)


@pytest.mark.parametrize(
    "bracket",
    [
        single_elimination(4),
        single_elimination(5),
        single_elimination(6),
        single_elimination(5, third_place=True),
        double_elimination(5),
    ],
    ids=lambda bracket: f"{bracket.format} {len(bracket.players)}",
)
def test_all_draws(bracket) -> None:
    win = by_seed(len(bracket.players))
    odds = blind_draw_odds(bracket, win)
    assert odds.samples == 400
    assert (odds.error[:, 0] > 0.0).all()
    assert odds.error.max() < 0.02
    assert (np.abs(odds.p_place - mean_of_draws(bracket, win)) <= 5 * odds.error).all()


def test_sixteen_players() -> None:
    bracket = single_elimination(16)
    odds = blind_draw_odds(bracket, one_favorite(16, 2 / 3))
    assert odds.title[0] == pytest.approx(16 / 81, rel=1e-12)
    assert (np.abs(odds.title[1:] - 13 / 243) < 5 * odds.error[1:, 0]).all()
    assert odds.p_place.sum(axis=0) == pytest.approx([1, 1, 2, 4, 8])


def test_a_double_elimination() -> None:
    odds = blind_draw_odds(double_elimination(8), one_favorite(8, 2 / 3, 3))
    assert odds.title[3] == pytest.approx(800 / 2187, rel=1e-12)
    assert odds.error[:, 0].max() < 0.01


@pytest.mark.slow
def test_the_same_seed_the_same_draws_and_more_of_them_are_closer() -> None:
    bracket, win = double_elimination(11), by_seed(11)
    few, again, many = (blind_draw_odds(bracket, win, samples=n) for n in (100, 100, 1600))
    assert (few.p_place == again.p_place).all()
    assert many.error[:, 0].max() < few.error[:, 0].max() / 2.5
    assert (np.abs(few.title - many.title) < 5 * few.error[:, 0]).all()


@pytest.mark.thorough
def test_a_bracket_too_large_to_be_exact() -> None:
    bracket, win = double_elimination(32), by_seed(32)
    odds = blind_draw_odds(bracket, win, samples=60)
    draws = np.random.default_rng(1).permuted(np.tile(np.arange(32), (12, 1)), axis=1)
    sample = [
        title_odds(bracket, win[np.ix_(order, order)], samples=400).title[np.argsort(order)]
        for order in draws
    ]
    error = np.hypot(np.std(sample, axis=0) / np.sqrt(11), odds.error[:, 0])
    assert odds.p_place.sum(axis=0) == pytest.approx(
        [place.last - place.first + 1 for place in bracket.places]
    )
    assert (np.abs(np.mean(sample, axis=0) - odds.title) < 5 * error + 1e-4).all()


def test_races_by_round() -> None:
    bracket = single_elimination(6)
    weak, strong = by_seed(6), by_strength([2.0**k for k in range(6, 0, -1)])
    chances = {match.name: strong if match.round > 1 else weak for match in bracket.matches}
    odds = blind_draw_odds(bracket, chances)
    laws = []
    for order in permutations(range(6)):
        seated = {name: win[np.ix_(order, order)] for name, win in chances.items()}
        laws.append(title_odds(bracket, seated).p_place[np.argsort(order)])
    assert (np.abs(odds.p_place - np.mean(laws, axis=0)) <= 5 * odds.error).all()


def test_many_draws_are_sampled() -> None:
    odds = blind_draw_odds(groups_then_knockout(6, 2), by_seed(6), samples=500)
    want = mean_of_draws(groups_then_knockout(6, 2), by_seed(6))
    assert odds.samples == 500
    assert (np.abs(odds.p_place - want) <= 5 * odds.error).all()


def test_equals_are_equal() -> None:
    odds = blind_draw_odds(single_elimination(11), np.full((11, 11), 0.5))
    assert (np.abs(odds.title - 1 / 11) <= 5 * odds.error[:, 0]).all()
