"""`limits_over` beside `stochastic_limit`, member by member."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from evenbreak.chains import chain_of, families, limits_over, stochastic_limit
from evenbreak.errors import ChainError, EvenbreakError, InputError
from evenbreak.games import (
    CATALOG,
    Ahead,
    Drill,
    Match,
    OneBall,
    OneBallLookAhead,
    Race,
    Rack,
    Series,
    alternate_breaks,
    loser_breaks,
    winner_breaks,
)

SIDE = np.array([0.0, 1e-3, 0.3, 0.5, 0.7, 1 / 3, 0.9, 1.0])


def kind(p1: Any, p2: Any, like: Any) -> Any:
    """Return a cataloged game with other chances."""
    if isinstance(like, OneBall):
        return OneBall(p1, p2)
    if isinstance(like, OneBallLookAhead):
        return OneBallLookAhead([p1, p2])
    if isinstance(like, Drill):
        return Drill([1.0, p1, p2, p1 * p2])
    if isinstance(like, Rack):
        return Rack(p1, p2) if like.break_matters else Rack(p1)
    rack = kind(p1, p2, like.rack)
    if isinstance(like, Series):
        return Series(rack, breaks=like.breaks)
    options: dict[str, Any] = {"score": like.score, "first_breaker": like.first_breaker}
    if isinstance(like, Race):
        options["win_by"] = like.win_by
    assert isinstance(like, Match)
    return type(like)(like.m, like.n, rack, breaks=like.breaks, **options)


def compare(game_of: Callable[..., Any], *, within: float = 1e-14, **chances: Any) -> None:
    found = limits_over(game_of, **chances)
    arrays = dict(zip(chances, np.broadcast_arrays(*chances.values()), strict=True))
    for place in np.ndindex(found.period.shape):
        game = game_of(**{name: float(array[place]) for name, array in arrays.items()})
        limit = stochastic_limit(chain_of(game))
        exact = [limit.get(state, 0.0) for state in found.states]
        np.testing.assert_allclose(found.probability[place], exact, rtol=within, atol=0.0)
        assert found.period[place] == limit.period
        assert set(limit.states) <= set(found.states)


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("name", CATALOG)
def test_every_game_of_the_catalog_has_its_own_limits_edges_included(name: str) -> None:
    compare(lambda p1, p2: kind(p1, p2, CATALOG[name]), p1=SIDE[:, None], p2=SIDE)


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let families repeat what was done from the 41st member on."""
    monkeypatch.setattr(families, "_FIRST", 40)
    monkeypatch.setattr(families, "_BATCH", 50)


@pytest.mark.slow_after(3)
@pytest.mark.usefixtures("short")
@pytest.mark.parametrize("name", CATALOG)
def test_what_is_repeated_is_what_would_have_been_done(name: str) -> None:
    p1, p2 = np.random.default_rng(3).uniform(0.05, 0.95, (2, 80))
    p1[60:66] = [0.0, 1.0, 0.5, 1e-9, 1e-200, 0.25]
    for size in (55, 80):
        compare(
            lambda p1, p2: kind(p1, p2, CATALOG[name]), within=1e-13, p1=p1[:size], p2=p2[:size]
        )


@pytest.mark.parametrize("name", CATALOG)
def test_no_game_of_the_catalog_is_worked_out_member_by_member(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(families, "stochastic_limit", lambda _: pytest.fail("one by one"))
    p1, p2 = np.random.default_rng(4).uniform(0.2, 0.8, (2, 8))
    limits_over(lambda p1, p2: kind(p1, p2, CATALOG[name]), p1=p1, p2=p2)


@pytest.mark.usefixtures("short")
def test_a_game_that_takes_a_later_member_another_way_is_asked_again() -> None:
    p = np.concatenate([np.linspace(0.1, 0.3, 45), np.linspace(0.4, 0.9, 60)])
    for way in (
        lambda p: p if p < 0.5 else p * p,
        lambda p: p if p < 0.35 else p / 2 if isinstance(p, float) else p / 3,
        lambda p: np.where(p < 0.5, p, 0.25),
        lambda p: p / (0.9 + p) if p < 0.35 else 0.5,
    ):
        found = limits_over(lambda p, way=way: Moody(p, way), p=p)
        np.testing.assert_allclose(found["won"], [way(x) for x in p.tolist()], rtol=1e-13)


def test_stiff_chances_keep_their_digits() -> None:
    tiny = 10.0 ** -np.arange(1.0, 16.0, 2.0)
    compare(OneBall, within=1e-12, p1=tiny[:, None], p2=tiny)
    compare(
        lambda p1, p2: Ahead(4, 4, Rack(p1, p2), breaks=winner_breaks),
        within=1e-12,
        p1=tiny[:, None],
        p2=1.0 - tiny,
    )
    compare(lambda p: Drill([p] * 30), within=1e-12, p=tiny)


def test_limits_beyond_the_range_of_floats_are_calculated_alone() -> None:
    compare(lambda p: Drill([p] * 40), within=1e-12, p=np.array([1e-12, 1e-9, 0.4, 0.5, 0.6]))


def test_periods_are_those_of_each_member() -> None:
    series = limits_over(
        lambda p1, p2: Series(Rack(p1, p2), breaks=loser_breaks), p1=[0.5, 1.0], p2=[[0.5], [1.0]]
    )
    assert series.period.tolist() == [[1, 1], [1, 2]]
    always = limits_over(
        lambda p1, p2: Series(Rack(p1, p2), breaks=alternate_breaks), p1=[0.2] * 5, p2=0.4
    )
    assert always.period.tolist() == [2] * 5
    assert always[1].tolist() == [0.5] * 5


class Shuffle:
    """A dense game without an end, on `size` states; its arcs bend with p."""

    start = 0

    def __init__(self, p: Any, size: int = 30) -> None:
        self.p, self.size = p, size

    def moves(self, state: int) -> dict[int, Any]:
        weight = {i: 1.0 + (state * 7 + i * 3) % 11 * self.p for i in range(self.size)}
        total = sum(weight.values())
        return {i: w / total for i, w in weight.items()}

    def winner(self, state: int) -> None:  # noqa: ARG002
        return None


def test_dense_games_are_right_entry_by_entry() -> None:
    compare(Shuffle, p=np.linspace(0.0, 1.0, 150))


@dataclass
class Moody:
    """A game of somebody's own, that does unusual things with its chance."""

    p: Any
    way: Callable[[Any], Any]
    start: str = "begin"

    def moves(self, state: str) -> dict[str, Any]:
        if state != "begin":
            return {}
        q = self.way(self.p)
        return {"won": q, "lost": 1.0 - q}

    def winner(self, state: str) -> int | None:
        return {"won": 1, "lost": 2}.get(state)


@pytest.mark.slow_after(9)
@pytest.mark.parametrize(
    "way",
    [
        lambda p: p if p > 0.5 else p * p,
        lambda p: max(p, 0.25),
        lambda p: min(abs(p - 0.5), 0.2),
        lambda p: math.exp(-p),
        lambda p: round(p, 1),
        lambda p: float(p) ** 2,
        lambda p: np.sqrt(p),
        lambda p: p if isinstance(p, float) else p / 2,
        lambda p: 0.5 if str(p) == "0.5" else 0.25,
        lambda p: {0.5: 0.75}.get(p, 0.125),
        lambda p: np.clip(p, 0.2, 0.4),
        lambda p: float(np.array([p, 0.5]).max()),
        lambda p: np.interp(p, [0, 1], [0.25, 0.75]),
    ],
)
def test_games_of_your_own_are_never_silently_wrong(way: Callable[[Any], Any]) -> None:
    compare(lambda p: Moody(p, way), p=np.linspace(0.0, 1.0, 41))


def test_a_division_by_zero_is_an_error_as_for_floats() -> None:
    with pytest.raises(ZeroDivisionError):
        limits_over(lambda p: Moody(p, lambda p: min(0.1 / p, 0.5)), p=np.linspace(0.0, 1.0, 9))


def test_a_batch_boundary_changes_nothing() -> None:
    p = np.linspace(0.0, 1.0, 20_001)
    limit = limits_over(OneBall, p1=p, p2=0.5)
    np.testing.assert_allclose(limit["W"], p / (1 - (1 - p) / 2), rtol=1e-15)


def test_numbers_alone_make_a_family_of_one() -> None:
    limit = limits_over(OneBall, p1=0.5, p2=0.25)
    assert limit.period.shape == ()
    assert limit["W"] == pytest.approx(0.8)


def test_an_unknown_state_is_named() -> None:
    with pytest.raises(ChainError, match="'S9'"):
        limits_over(OneBall, p1=[0.5], p2=0.25)["S9"]


@pytest.mark.parametrize(
    ("chances", "named"),
    [
        ({"p1": [0.5, math.nan], "p2": 0.5}, "p1"),
        ({"p1": 0.5, "p2": [0.2, 1.5]}, "p2"),
        ({"p1": -0.1, "p2": 0.5}, "p1"),
        ({"p1": [0.1, 0.2], "p2": [0.1, 0.2, 0.3]}, r"p1 has shape \(2,\)"),
        ({"p1": [], "p2": 0.5}, "p1 must not be empty"),
        ({"p1": np.zeros((2, 0)), "p2": 0.5}, "p1 must not be empty"),
        ({"p1": ["a", "b"], "p2": 0.5}, "p1"),
        ({}, "probabilities"),
    ],
)
def test_bad_chances_are_refused_at_the_door(chances: dict[str, Any], named: str) -> None:
    with pytest.raises(InputError, match=named):
        limits_over(OneBall, **chances)


def test_what_makes_no_game_is_refused() -> None:
    with pytest.raises(InputError, match="game_of"):
        limits_over(OneBall(0.5, 0.5), p1=[0.5])  # type: ignore[arg-type]
    with pytest.raises(EvenbreakError):
        limits_over(lambda p: p, p=np.full(9, 0.5))
    with pytest.raises(TypeError):
        limits_over(OneBall, p1=np.full(9, 0.5), p3=0.5)


def test_moves_that_miss_1_are_refused_as_for_one_chain() -> None:
    class Leaky(Shuffle):
        def moves(self, state: int) -> dict[int, Any]:
            return {1 - state: self.p}

    with pytest.raises(ChainError, match="sum"):
        limits_over(Leaky, p=np.array([1.0, 1.0, 1.0, 1.0, 0.9]))


def test_chances_too_small_to_leave_over_a_loop_agree_with_one_chain() -> None:
    compare(
        lambda p: Series(Rack(1.0 - p, p), breaks=loser_breaks),
        p=np.array([1e-17, 1e-12, 0.5, 0.2, 1e-3, 0.0]),
    )
