"""Seeding: lines, orders, clubs apart."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.tournaments import apart_by_club, blind_draw, by_rating
from evenbreak.tournaments.brackets.knockout import bracket_size, seeded_lines, standard_lines


def test_standard_lines() -> None:
    assert standard_lines(4) == [1, 4, 2, 3]
    assert standard_lines(16) == [1, 16, 8, 9, 4, 13, 5, 12, 2, 15, 7, 10, 3, 14, 6, 11]
    for size in (8, 32, 256):
        lines = standard_lines(size)
        while len(lines) > 1:  # the stronger seeds win: pairs sum to the number left plus 1
            assert {a + b for a, b in zip(lines[::2], lines[1::2], strict=True)} == {len(lines) + 1}
            lines = [min(pair) for pair in zip(lines[::2], lines[1::2], strict=True)]


@given(st.integers(2, 256))
def test_byes_go_to_the_top_seeds(players: int) -> None:
    lines = seeded_lines(players)
    assert len(lines) == bracket_size(players)
    pairs = list(zip(lines[::2], lines[1::2], strict=True))
    lucky = sorted(a if b is None else b for a, b in pairs if None in (a, b))
    assert lucky == list(range(len(lines) - players))


def test_by_rating_is_stable() -> None:
    assert by_rating(["A", "B", "C", "D"], [500, 600, 600, 400]) == ["B", "C", "A", "D"]
    with pytest.raises(InputError, match="ratings"):
        by_rating(["A", "B"], [1])


def test_blind_draw_is_uniform() -> None:
    rng = np.random.default_rng(1)
    drawn = [tuple(blind_draw("ABC", rng)) for _ in range(6000)]
    counts = [drawn.count(order) for order in set(drawn)]
    assert len(counts) == 6
    assert max(counts) < 1150
    assert min(counts) > 850


def early(players, clubs, order) -> int:
    """Return how many first matches are between two of one club."""
    lines = seeded_lines(len(players))
    club = dict(zip(players, clubs, strict=True))
    count = 0
    for a, b in zip(lines[::2], lines[1::2], strict=True):
        if a is not None and b is not None:
            count += club[order[a]] is not None and club[order[a]] == club[order[b]]
    return count


@given(st.lists(st.sampled_from(["East", "West", "North", None]), min_size=4, max_size=33))
def test_clubs_are_kept_apart_within_their_tiers(clubs) -> None:
    players = [f"P{k}" for k in range(len(clubs))]
    order = apart_by_club(players, clubs)
    assert order[:2] == players[:2]
    first = 2
    while first < len(players):
        tier = slice(first, 2 * first)
        assert sorted(order[tier]) == sorted(players[tier])
        first *= 2
    assert early(players, clubs, order) <= early(players, clubs, players)


def test_a_club_of_four_is_spread_over_the_quarters() -> None:
    players = [f"P{k}" for k in range(16)]
    clubs = [None] * 8 + ["East"] * 4 + [None] * 4
    order = apart_by_club(players, clubs)
    lines = seeded_lines(16)
    quarters = {lines.index(order.index(f"P{k}")) // 4 for k in (8, 9, 10, 11)}
    assert quarters == {0, 1, 2, 3}
