from itertools import combinations

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import audit_points, points_chart

NINE = points_chart("apa_9ball")


def played(rng, needs, averages, first, matches=20_000):
    """Return the share of matches that player 1 wins, shot by shot."""
    makes = np.array(averages) / (1.0 + np.array(averages))
    won = np.zeros(matches, dtype=int)
    scores, turn = np.zeros((matches, 2), dtype=int), np.full(matches, first - 1)
    while (open_ := np.flatnonzero(won == 0)).size:
        shooter = turn[open_]
        made = rng.random(open_.size) < makes[shooter]
        scores[open_, shooter] += made
        turn[open_] = np.where(made, shooter, 1 - shooter)
        won[open_] = np.where(scores[open_, shooter] >= np.array(needs)[shooter], shooter + 1, 0)
    return (won == 1).mean()


def test_matches_played_shot_by_shot():
    rng = np.random.default_rng(9)
    report = audit_points(NINE)
    (pair,) = [one for one in report.pairs if (one.level, one.opponent_level) == (9, 1)]
    share = np.mean([played(rng, (75, 14), (3.0, 0.56), first) for first in (1, 2)])
    assert pair.p_win == pytest.approx(share, abs=0.01)
    share = np.mean([played(rng, (38, 38), (46 / 25, 38 / 25), first) for first in (1, 2)])
    assert report.levels[4].p_win_as_next == pytest.approx(share, abs=0.01)


@pytest.mark.parametrize("innings", [10, 25, 60])
def test_the_chart_is_nearly_even_however_many_innings_it_takes(innings):
    report = audit_points(NINE, innings=innings)
    assert [(one.opponent_level, one.level) for one in report.pairs] == list(
        combinations(range(1, 10), 2)
    )
    assert max(abs(one.p_win - 0.5) for one in report.pairs) < 0.025


def test_a_chart_of_points_by_its_name():
    assert audit_points("APA-9ball") == audit_points(NINE)


def test_the_highest_level_has_no_next():
    assert [one.p_win_as_next is None for one in audit_points(NINE).levels] == [False] * 8 + [True]


@pytest.mark.parametrize("wrong", ["apa_8ball", None, 3])
def test_what_is_no_chart_of_points(wrong):
    with pytest.raises(InputError, match="PointsChart"):
        audit_points(wrong)


def test_innings_that_cannot_be():
    with pytest.raises(InputError, match="innings"):
        audit_points(NINE, innings=0.5)
