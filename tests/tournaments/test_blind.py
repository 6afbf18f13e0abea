"""Odds of a blind draw: the mean over all samples."""

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
from tournaments.fields import by_seed, by_strength


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
    assert odds.samples == 0
    assert odds.p_place == pytest.approx(mean_of_draws(bracket, win), rel=1e-11)


def test_sixteen_players_by_a_sample_of_draws() -> None:
    bracket, win = single_elimination(16), by_seed(16)
    odds = blind_draw_odds(bracket, win)
    assert odds.samples == 0
    assert odds.p_place.sum(axis=0) == pytest.approx([1, 1, 2, 4, 8])
    rng = np.random.default_rng(1)
    orders = [rng.permutation(16) for _ in range(400)]
    sample = [title_odds(bracket, win[np.ix_(o, o)]).title[np.argsort(o)] for o in orders]
    error = np.std(sample, axis=0) / 20
    assert (np.abs(np.mean(sample, axis=0) - odds.title) < 5 * error).all()


def test_races_by_round() -> None:
    bracket = single_elimination(6)
    weak, strong = by_seed(6), by_strength([2.0**k for k in range(6, 0, -1)])
    chances = {match.name: strong if match.round > 1 else weak for match in bracket.matches}
    odds = blind_draw_odds(bracket, chances)
    laws = []
    for order in permutations(range(6)):
        seated = {name: win[np.ix_(order, order)] for name, win in chances.items()}
        laws.append(title_odds(bracket, seated).p_place[np.argsort(order)])
    assert odds.p_place == pytest.approx(np.mean(laws, axis=0), rel=1e-11)


def test_many_draws_are_sampled() -> None:
    odds = blind_draw_odds(groups_then_knockout(6, 2), by_seed(6), samples=500)
    want = mean_of_draws(groups_then_knockout(6, 2), by_seed(6))
    assert odds.samples == 500
    assert (np.abs(odds.p_place - want) <= 5 * odds.error).all()


def test_equals_are_equal() -> None:
    odds = blind_draw_odds(single_elimination(11), np.full((11, 11), 0.5))
    assert odds.title == pytest.approx([1 / 11] * 11)
