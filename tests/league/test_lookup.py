"""The flat tables hold what the match table says."""

import numpy as np
import pytest

from evenbreak.handicaps import chart, system_of
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.league.lookup import lookup_of

TABLE = match_table(system_of("npl"), chart("npl_10"), widest=20)
LOOK = lookup_of(TABLE, 15.2)


def test_chances_to_win_are_those_of_the_table() -> None:
    p = system_of("npl").scale.win_probability(np.arange(-16.0, 17.0))
    race = LOOK.twice_race[np.arange(-20, 21)] // 2
    held = LOOK.wins[::2].reshape(33, LOOK.races)[:, race] / 2.0**32
    assert LOOK.gap == 16
    assert np.abs(held - TABLE.wins(p).T).max() <= 2.0**-32
    assert np.array_equal(LOOK.wins[::2], LOOK.wins[1::2])


def test_chances_of_scores_add_up_to_those_of_the_table() -> None:
    last, place = LOOK.cumulative
    races = int(place.max()) + 1
    by_gap = last.reshape(LOOK.outcomes, 33, races)[:, :, place] / 2.0**32
    chances = TABLE.chances(system_of("npl").scale.win_probability(np.arange(-16.0, 17.0)))
    assert np.abs(by_gap - np.cumsum(chances, axis=1).transpose(1, 2, 0)).max() < 2.0**-31


def test_what_is_expected_of_a_match() -> None:
    hill, shut, games = LOOK.expected.reshape(3, 33, LOOK.races)[:, 16, LOOK.twice_race[0] // 2]
    assert hill == pytest.approx(70 / 256)  # 4-4 of eight even games
    assert shut == pytest.approx(2 / 32)
    assert games == pytest.approx(
        sum(
            k * c
            for k, c in zip(
                range(5, 10), (2 / 32, 10 / 64, 30 / 128, 70 / 256, 70 / 256), strict=True
            )
        )
    )


def test_what_winners_and_losers_move() -> None:
    assert LOOK.steps == (1, -1)
    one, two = LOOK.by_winner
    assert one.reshape(-1, 2)[7].tolist() == [-1, 1]
    assert two.reshape(-1, 2)[7].tolist() == [1, -1]
    assert lookup_of(match_table(system_of("step 2 1")), 10).steps == (2, -1)


def test_moves_that_depend_on_the_score_are_recognized() -> None:
    margin = lookup_of(match_table(system_of("margin")), 10)
    assert margin.steps is None
    assert margin.by_winner is None
    one, two = margin.moves
    assert np.array_equal(one.reshape(margin.width, -1), margin.table.moves[..., 0])
    assert np.array_equal(two.reshape(margin.width, -1), margin.table.moves[..., 1])


def test_notes_of_a_score_are_one_number() -> None:
    assert np.array_equal(LOOK.noted[LOOK.code].reshape(LOOK.classes.shape), LOOK.classes)
    assert LOOK.code.max() < LOOK.codes


def test_far_apart_is_far_enough() -> None:
    assert lookup_of(TABLE, 1e5).gap == 360
