"""Odds of a blind draw: the mean over all samples."""

from __future__ import annotations

from itertools import combinations, permutations
from math import comb, factorial

import numpy as np
import pytest

from evenbreak.tournaments import (
    blind_draw_odds,
    double_elimination,
    groups_then_knockout,
    single_elimination,
    title_odds,
)
from tournaments.fields import by_seed, by_strength, one_favourite


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


def distinct_draws(players: tuple[int, ...]):
    """Yield every draw once: orders that give the same bracket are one."""
    if len(players) == 1:
        yield players
        return
    first, *others = players
    for half in combinations(others, len(players) // 2 - 1):
        mine = (first, *half)
        rest = tuple(k for k in players if k not in mine)
        for one in distinct_draws(mine):
            for other in distinct_draws(rest):
                yield one + other


def test_distinct_draws() -> None:
    assert len(list(distinct_draws((0, 1, 2, 3)))) == 3
    assert len(list(distinct_draws(tuple(range(8))))) == 315
    assert factorial(16) // 2**15 == 638_512_875
    assert comb(16, 8) == 12_870
    win = by_seed(8)
    titles = [
        title_odds(single_elimination(8, lines=range(8)), win[np.ix_(order, order)]).title[
            np.argsort(order)
        ]
        for order in distinct_draws(tuple(range(8)))
    ]
    odds = blind_draw_odds(single_elimination(8), win)
    assert odds.title == pytest.approx(np.mean(titles, axis=0), rel=1e-12)


def test_sixteen_players() -> None:
    bracket = single_elimination(16)
    odds = blind_draw_odds(bracket, one_favourite(16, 2 / 3))
    assert odds.samples == 0
    assert odds.title[0] == pytest.approx(16 / 81, rel=1e-12)
    assert odds.p_place.sum(axis=0) == pytest.approx([1, 1, 2, 4, 8])


@pytest.mark.parametrize("final", ["true", "single"])
def test_double_elimination_is_exact_to_eight_players(final) -> None:
    bracket = double_elimination(8, final=final)
    odds = blind_draw_odds(bracket, one_favourite(8, 2 / 3, 3))
    assert odds.samples == 0
    if final == "true":
        assert odds.title[3] == pytest.approx(800 / 2187, rel=1e-12)
    draws = np.random.default_rng(1).permuted(np.tile(np.arange(8), (200, 1)), axis=1)
    win = by_seed(8)
    sample = [title_odds(bracket, win[np.ix_(o, o)]).title[np.argsort(o)] for o in draws]
    exact = blind_draw_odds(bracket, win)
    error = np.std(sample, axis=0) / np.sqrt(200)
    assert (np.abs(np.mean(sample, axis=0) - exact.title) < 5 * error).all()


def test_straight_drops_are_exact_and_others_are_compared_with_them() -> None:
    win = by_seed(11)
    straight = blind_draw_odds(double_elimination(11, drops="straight"), win)
    crossed = blind_draw_odds(double_elimination(11), win, samples=100)
    assert (straight.samples, crossed.samples) == (0, 100)
    assert crossed.error[:, 0].max() < 0.001
    assert np.abs(crossed.title - straight.title).max() < 0.01
    assert crossed.p_place.sum(axis=0) == pytest.approx(straight.p_place.sum(axis=0))
    many = [
        title_odds(crossed.bracket, win[np.ix_(o, o)]).title[np.argsort(o)]
        for o in np.random.default_rng(1).permuted(np.tile(np.arange(11), (400, 1)), axis=1)
    ]
    error = np.hypot(np.std(many, axis=0) / 20, crossed.error[:, 0])
    assert (np.abs(np.mean(many, axis=0) - crossed.title) < 5 * error).all()


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
