"""Chips: published heads-up chances, exact endings, simulations, charts."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    CHIP_CHARTS,
    ChipChart,
    chip_fairness,
    fairest_chips,
    heads_up,
    last_players,
    play_chips,
    rack_chances,
)
from rows import each_of


@pytest.mark.parametrize(
    ("name", "stronger", "weaker", "want"),
    [
        ("hoboken", 650, 350, 0.9736),
        ("hoboken", 650, 500, 0.8127),
        ("hoboken", 550, 450, 0.7110),
        ("hoboken", 450, 350, 0.8505),
        ("pharaohs", 650, 350, 0.9311),
        ("pharaohs", 650, 500, 0.7328),
        ("pharaohs", 550, 450, 0.6503),
        ("pharaohs", 450, 350, 0.8223),
    ],
)
def test_heads_up(name: str, stronger: int, weaker: int, want: float) -> None:
    chips = CHIP_CHARTS[name].chips([stronger, weaker])
    p = rack_chances([stronger, weaker])[0, 1]
    assert heads_up(p, *chips) == pytest.approx(want, abs=5e-5)


def test_charts_as_published() -> None:
    hoboken, pharaohs = CHIP_CHARTS["hoboken"], CHIP_CHARTS["pharaohs"]
    assert hoboken.chips([349, 351, 450, 451, 500, 501, 600, 601]).tolist() == [
        *(8, 7, 7, 6, 6, 5, 5, 4)
    ]
    assert pharaohs.chips([249, 250, 350, 450, 500, 550, 650, 700]).tolist() == [
        *(9, 8, 7, 6, 5, 4, 3, 2)
    ]


def slow_title(chips, racks, line) -> dict[int, Fraction]:
    """Return the title odds by going through every course."""
    if len(line) == 1:
        return {line[0]: Fraction(1)}
    stays, challenger, *waiting = line
    p = racks[stays][challenger]
    odds: dict[int, Fraction] = {}
    for won, lost, share in ((stays, challenger, p), (challenger, stays, 1 - p)):
        left = {**chips, lost: chips[lost] - 1}
        after = [won, *waiting] + ([lost] if left[lost] else [])
        for player, chance in slow_title(left, racks, after).items():
            odds[player] = odds.get(player, Fraction(0)) + share * chance
    return odds


def test_the_last_players_in_fractions() -> None:
    racks = [[Fraction(4 + i, 8 + i + j) for j in range(4)] for i in range(4)]
    chips = [2, 1, 2, 1]
    want = slow_title(dict(enumerate(chips)), racks, [2, 0, 1, 3])
    odds = last_players(chips, np.array(racks, dtype=float), [2, 0, 1, 3])
    assert odds.title == pytest.approx([float(want[k]) for k in range(4)], rel=1e-13)
    assert odds.p_place.sum(axis=0) == pytest.approx(np.ones(4))
    assert odds.p_place.sum(axis=1) == pytest.approx(np.ones(4))


def test_two_at_a_table_are_a_race() -> None:
    p = 0.63
    odds = last_players([4, 7], np.array([[0.5, p], [1 - p, 0.5]]))
    assert odds.title[0] == pytest.approx(heads_up(p, 4, 7), rel=1e-13)


@pytest.mark.parametrize("advantage", [0.0, 40.0])
def test_played_out_is_near_the_exact_ending(advantage: float) -> None:
    ratings, chips, line = [650, 500, 420, 380], [4, 6, 7, 7], [2, 1, 0, 3]
    racks = rack_chances(ratings, break_advantage=advantage)
    exact = last_players(chips, racks, line)
    played = play_chips(chips, racks, line=line, runs=40_000)
    assert (np.abs(played.p_place - exact.p_place) < 5 * played.error + 1e-12).all()
    assert played.racks_mean <= exact.racks_mean + 0.2


def test_a_simulated_tournament() -> None:
    ratings = np.linspace(700, 350, 16)
    odds = play_chips(CHIP_CHARTS["hoboken"].chips(ratings), rack_chances(ratings), tables=4)
    assert odds.p_place.sum(axis=0) == pytest.approx(np.ones(16))
    assert odds.p_place.sum(axis=1) == pytest.approx(np.ones(16))
    assert odds.title.argmax() == 0
    total = CHIP_CHARTS["hoboken"].chips(ratings).sum()
    assert odds.racks_mean < total


@pytest.mark.parametrize("tables", [1, 2, 5])
def test_equals_have_equal_odds(tables: int) -> None:
    odds = play_chips([3] * 10, np.full((10, 10), 0.5), tables=tables, runs=20_000)
    assert (np.abs(odds.title - 0.1) < 5 * odds.error[:, 0]).all()


@pytest.mark.slow
def test_fairness_and_a_fairer_chart() -> None:
    ratings = [650, 600, 550, 500, 450, 400, 350, 300]
    hoboken = chip_fairness(ratings, "hoboken", tables=2)
    rows = fairest_chips(ratings, bands=[351, 451, 501, 601], tables=2, most=9, runs=4000)
    assert hoboken.edge[0] > 0.5
    assert rows.spread < 0.6 * hoboken.spread
    assert (np.diff(rows.chips) >= 0).all()
    assert len(set(rows.chips)) <= 5
    assert hoboken.edge_error.max() < 0.05


@each_of(
    "asked, named",
    [
        (lambda: heads_up(0.5, 0, 1), "chips"),
        (lambda: heads_up(1.5, 1, 1), "p must be"),
        (lambda: last_players([9] * 6, np.full((6, 6), 0.5)), "too many"),
        (lambda: last_players([1, 1], np.full((2, 2), 0.5), [0, 0]), "line"),
        (lambda: play_chips([3], [[0.5]]), "two players"),
        (lambda: play_chips([3, 3], np.full((3, 3), 0.5)), "racks"),
        (lambda: play_chips([3, 0], np.full((2, 2), 0.5)), "chips"),
        (lambda: ChipChart("x", [(0, 5), (100, 6)]), "stronger players can"),
        (lambda: ChipChart("x", [(100, 5), (0, 4)]), "start higher"),
        (lambda: ChipChart("x", [(100, 5)]).chips([50]), "below"),
        (lambda: chip_fairness([500, 400], "moon"), "moon"),
        (lambda: fairest_chips([500, 400], fewest=5, most=4), "fewest"),
    ],
)
def test_what_cannot_be_played_is_refused(asked, named: str) -> None:
    with pytest.raises(InputError, match=named):
        asked()
