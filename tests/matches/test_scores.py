import numpy as np
import pytest

from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import (
    final_scores,
    hill_hill_probability,
    match_length,
    shutout_probability,
    win_probability,
)


def test_the_final_scores_of_the_text() -> None:
    # P5.5: the race 3:2 at p = 2/3 is won 3:0 and 3:1 with chance 8/27 each.
    scores = final_scores(Race(3, 2, Rack(2 / 3)))
    assert scores.probability[3, 0] == pytest.approx(8 / 27, rel=1e-14)
    assert scores.probability[3, 1] == pytest.approx(8 / 27, rel=1e-14)
    assert list(scores.probability) == [(3, 0), (3, 1), (0, 2), (1, 2), (2, 2)]
    assert (scores.p_never_ends, scores.tail_mass, scores.span) == (0.0, 0.0, 4)


def test_hill_hill_is_the_chance_of_the_score_before_the_last_rack() -> None:
    # P5.4: P(2/3; 3, 1) = .3951, which in a race 4:2 is hill-hill.
    assert hill_hill_probability(Race(4, 2, Rack(2 / 3))) == pytest.approx(
        0.3950617283950617, rel=1e-14
    )
    assert hill_hill_probability(Race(4, 2, Rack(0.3)), (3, 1)) == 1.0
    assert hill_hill_probability(Race(4, 2, Rack(0.3)), (4, 1)) == 0.0
    assert hill_hill_probability(Race(2, 2, Rack(0.5), win_by=2)) is None
    assert hill_hill_probability(Ahead(2, 2, Rack(0.5))) is None
    found = hill_hill_probability(Race(2, 2, Rack([0.5, 0.1])))
    assert found == pytest.approx([0.5, 0.18], rel=1e-15)


def test_a_shutout_is_counted_from_the_start_score() -> None:
    race = Race(3, 4, Rack(0.6, 0.7), breaks=winner_breaks)
    assert shutout_probability(race) == pytest.approx(0.6**3, rel=1e-15)
    assert shutout_probability(race, player=2) == pytest.approx(0.4 * 0.7**3, rel=1e-15)
    assert shutout_probability(race, (1, 2)) == pytest.approx(0.6**2, rel=1e-15)
    assert shutout_probability(race, (3, 2)) == 1.0
    assert shutout_probability(race, (3, 2), player=2) == 0.0
    assert shutout_probability(Ahead(2, 2, Rack(0.5))) is None
    assert shutout_probability(Race(2, 2, Rack(0.5), win_by=3)) == 0.5**3
    # A run so unlikely that it lies beyond the lengths of which any mass is followed.
    rare = Race(20, 2, Rack([1e-6, 0.5]), win_by=2)
    assert shutout_probability(rare) == pytest.approx([1e-120, 0.5**20], rel=1e-13, abs=0)
    sets = Race(2, 2, Race(2, 1, Rack([0.5, 0.2])))
    assert shutout_probability(sets) == pytest.approx([0.25**2, 0.04**2], rel=1e-15)
    # Player 1 wins a set 1:0 or 1:1, so who breaks first in the next set is left to chance.
    carried = Race(2, 9, Race(1, 2, Rack(0.6, 0.7), breaks=alternate_breaks))
    by_next = {2: 0.6, 1: 0.4 * 0.3}, {1: 0.3, 2: 0.7 * 0.6}  # breaker 1, breaker 2
    expected = sum(p * sum(by_next[then - 1].values()) for then, p in by_next[0].items())
    assert shutout_probability(carried) == pytest.approx(expected, rel=1e-14)


def test_final_scores_that_have_no_last_one() -> None:
    scores = final_scores(Ahead(2, 2, Rack(0.5)), tail=0.1)
    assert scores.probability == {
        (2, 0): 0.25,
        (3, 1): 0.125,
        (4, 2): 0.0625,
        (5, 3): 0.03125,
        (0, 2): 0.25,
        (1, 3): 0.125,
        (2, 4): 0.0625,
        (3, 5): 0.03125,
    }
    assert (scores.tail_mass, scores.span) == (0.0625, 8)
    race = Race(3, 2, Rack(0.6), win_by=2, score=(1, 1))
    match = final_scores(race)
    # 1 wins at 3:1 at once, or by a lead of 3 - 2 + 2 later on; 2 wins at 1:2 if ahead by 2.
    assert all(race.decided(*end) for end in match.probability)
    assert sum(match.probability.values()) + match.tail_mass == pytest.approx(1.0)
    one = sum(chance for end, chance in match.probability.items() if race.decided(*end) == 1)
    assert one == pytest.approx(win_probability(race), rel=1e-11)
    assert match.tail_mass < 1e-12


def test_final_scores_of_a_deuce_that_is_under_way() -> None:
    race = Race(5, 5, Rack(0.5), win_by=2)
    scores = final_scores(race, (9, 9), tail=0.3)
    assert scores.probability == {(11, 9): 0.25, (12, 10): 0.125, (9, 11): 0.25, (10, 12): 0.125}
    assert final_scores(race, (6, 4)).probability == {(6, 4): 1.0}


def test_sets_are_counted_in_sets() -> None:
    inner = Ahead(2, 2, Rack(0.6, 0.5), breaks=alternate_breaks)
    for match in (
        Race(2, 2, inner, breaks=winner_breaks),
        Race(2, 2, inner),
        Ahead(2, 1, inner, breaks=alternate_breaks),
        Race(2, 1, Race(2, 2, Rack(0.6)), win_by=2),
    ):
        scores = final_scores(match)
        one = sum(mass for end, mass in scores.probability.items() if match.decided(*end) == 1)
        assert one == pytest.approx(win_probability(match), rel=1e-11)
        assert sum(scores.probability.values()) + scores.tail_mass == pytest.approx(1.0, rel=1e-14)
        assert scores.tail_mass <= 1e-12
        assert match_length(match).span >= scores.span
    assert list(final_scores(Race(2, 1, inner)).probability) == [(2, 0), (0, 1), (1, 1)]
    assert final_scores(Race(2, 1, inner)).span == 2


def test_arrays_and_endless_matches() -> None:
    match = Ahead(2, 2, Rack(1.0, [1.0, 0.5]), breaks=alternate_breaks)
    scores = final_scores(match)
    assert scores.p_never_ends.tolist() == [1.0, 0.0]
    assert scores.probability[2, 0].tolist() == [0.0, 0.5]
    assert np.max(scores.tail_mass) <= 1e-12
    endless = final_scores(Race(1, 1, match))
    assert endless.p_never_ends.tolist() == [1.0, 0.0]
    assert endless.probability[1, 0] == pytest.approx([0.0, 1.0])
    decided = final_scores(Race(2, 2, Rack([0.5, 0.6])), (2, 1)).probability
    assert decided[2, 1].tolist() == [1.0, 1.0]
