"""Odds of matches by points: against straight pool's engine, a random walk and the score sheet."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import audit_points, loser_share, points_chart, points_odds
from evenbreak.handicaps.charts.chart import catalog_rows


def test_chances_are_those_of_the_audit():
    for pair in audit_points("apa_9ball").pairs:
        odds = points_odds("apa_9ball", pair.level, pair.opponent_level)
        assert odds.p_win_1 == pytest.approx(pair.p_win, abs=1e-9)
        assert odds.p_win_1 + odds.p_win_2 == pytest.approx(1.0, abs=1e-12)
        assert odds.share_1 + odds.share_2 == pytest.approx(20.0)


def test_a_simulated_match_ends_as_calculated():
    rng, needs, has = np.random.default_rng(3), (31, 19), (12, 0)
    chance = [need / (25.0 + need) for need in needs]
    lost, innings, share = np.zeros(2), [], []
    for match in range(4000):
        points, turn, played = list(has), match % 2, [0, 0]
        while True:
            played[turn] += 1
            points[turn] += rng.geometric(1.0 - chance[turn]) - 1
            if points[turn] >= needs[turn]:
                break
            turn = 1 - turn
        lost[1 - turn] += 1
        innings.append(played[turn])
        loser = loser_share((4, 2)[1 - turn], points[1 - turn])
        share.append(loser if turn else 20 - loser)
    odds = points_odds("apa_9ball", 4, 2, score=has)
    assert odds.p_win_1 == pytest.approx(lost[1] / 4000, abs=0.03)
    assert odds.mean_innings == pytest.approx(np.mean(innings), abs=0.4)
    assert odds.share_1 == pytest.approx(np.mean(share), abs=0.3)


@pytest.mark.parametrize(
    ("level", "points", "share"), [(3, 21, 7), (9, 17, 0), (5, 37, 8), (1, 0, 0), (1, 3, 1)]
)
def test_the_losers_share_is_the_score_sheets(level, points, share):
    assert loser_share(level, points) == share


def test_a_loser_gets_eight_at_most_one_point_short():
    for level, *limits in catalog_rows("apa_9ball_shares"):
        needs = points_chart("apa_9ball").race(level, level)[0]
        assert limits == sorted(limits)
        assert limits[-1] == needs - 1
        assert loser_share(level, needs - 1) == 8
        with pytest.raises(InputError, match=f"points must be 0 to {needs - 1}"):
            loser_share(level, needs)


def test_a_match_that_is_over_has_no_odds():
    with pytest.raises(InputError, match="38 of 38"):
        points_odds("apa_9ball", 5, 3, score=(38, 2))
