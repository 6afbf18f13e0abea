"""Expected rematches, by enumeration and as published."""

from __future__ import annotations

import numpy as np
import pytest

from evenbreak.tournaments import (
    double_elimination,
    expected_rematches,
    groups_then_knockout,
    pods,
)
from tournaments import enumerated
from tournaments.fields import by_seed


def late(n: int) -> set[str]:
    """Return the finals and the last two rounds of the losers' side."""
    k = n.bit_length() - 1
    return {"F", f"L{2 * k - 2}.1", f"L{2 * k - 3}.1"}


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(
    "bracket",
    [
        double_elimination(6),
        double_elimination(7, final="single"),
        double_elimination(8, qualifiers=4),
        pods(8, size=4, qualifiers=2),
        groups_then_knockout(7, 2),
    ],
    ids=lambda bracket: f"{bracket.format} {len(bracket.players)}",
)
def test_all_courses(bracket) -> None:
    chance = enumerated.by_strength(list(range(len(bracket.players), 0, -1)))
    grouped = {name for group in bracket.groups for name in group.matches} | {"F2"}

    def again(met) -> int:
        seen: set[frozenset[int]] = set()
        count = 0
        for name, one, other, _ in met:
            count += frozenset((one, other)) in seen and name not in grouped
            seen.add(frozenset((one, other)))
        return count

    want = enumerated.expected(bracket, chance, again)
    found = expected_rematches(bracket, by_seed(len(bracket.players)))
    assert found.mean == pytest.approx(float(want), rel=1e-12)
    assert found.error == 0.0


@pytest.mark.parametrize(("n", "want"), [(8, 2.06), (16, 3.77), (32, 7.19), (64, 14.09)])
def test_straight_drops(n: int, want: float) -> None:
    found = expected_rematches(double_elimination(n, drops="straight"))
    assert found.error == 0.0
    assert found.mean == pytest.approx(want, abs=0.05)


@pytest.mark.parametrize(
    ("drops", "want", "early"), [("fewest rematches", 1.40, 0.24), ("usual", 1.69, 0.495)]
)
def test_sixteen_players(drops, want: float, early: float) -> None:
    found = expected_rematches(double_elimination(16, drops=drops))
    assert found.mean == pytest.approx(want, abs=0.03)
    first = sum(p for name, p in found.by_match.items() if name not in late(16))
    assert first == pytest.approx(early, abs=0.015)


@pytest.mark.slow
@pytest.mark.parametrize("n", [16, 32, 64])
def test_fewest_rematches_are_fewer_than_usual(n: int) -> None:
    fewest, usual = (
        expected_rematches(double_elimination(n, drops=drops)).mean
        for drops in ("fewest rematches", "usual")
    )
    assert fewest < usual - 0.05


def test_played_out_is_near_the_exact_number(monkeypatch) -> None:
    bracket = double_elimination(12)
    exact = expected_rematches(bracket, by_seed(12))
    monkeypatch.setattr("evenbreak.tournaments.odds.rematches.MOST_STATES", 0)
    drawn = expected_rematches(bracket, by_seed(12), rng=np.random.default_rng(1))
    assert drawn.mean == pytest.approx(exact.mean, abs=5 * drawn.error)
    assert 0.0 < drawn.error < 0.01


def test_who_has_met_is_remembered() -> None:
    bracket = double_elimination(4)
    results = {"W1.1": "1", "W1.2": "2", "W2.1": "1", "L1.1": "4"}
    # 2 meets 4 for the first time; whoever comes through has met 1 before.
    found = expected_rematches(bracket, results=results)
    assert found.by_match == {"L2.1": 0.0, "F": 1.0}
