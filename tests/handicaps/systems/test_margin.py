"""Steps by the margin of the score, by hand."""

import pytest
from scipy.special import betaincinv

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.by_match import PlayedMatch
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.handicaps.systems.step import margin_system


@pytest.mark.parametrize(
    ("most", "race", "lost", "points"),
    [
        (1, 5, 0, 1),
        (1, 5, 4, 1),
        (2, 4, 2, 1),  # just half of the race is left
        (2, 4, 1, 2),
        (3, 4, 3, 1),
        (3, 4, 0, 3),
        (5, 2, 1, 3),
    ],
)
def test_the_margin_is_a_share_of_the_losers_race(most, race, lost, points):
    moved = margin_system(most).rule(PlayedMatch((80, 80), (7, lost), (7, race)))
    assert moved == (points, -points)


def test_the_margin_is_nearly_fair_where_the_race_is():
    """The mean move at the game chance that makes each race even, beside a bare difference."""
    table = match_table(margin_system(2), chart("npl_10"))
    for place, (m, n) in enumerate(table.needs.tolist()):
        real = slice(0, m + n)
        chances = table.chances(float(betaincinv(m, n, 0.5)))[place, real]
        moves, games = table.moves[place, real, 0], table.games[place, real]
        left = (n - games[:, 1]) * table.won[place, real] - (m - games[:, 0]) * (
            ~table.won[place, real]
        )
        assert abs(chances @ moves) < 0.1
        if m != n:
            assert (chances @ left > 0.0) == (m < n)
        if abs(place - table.widest) >= 57:
            assert abs(chances @ left) > 1.0


def test_the_most_points_are_a_whole_number():
    with pytest.raises(
        InputError, match=r"most must be a whole number from 1 to 1000; you gave 1\.5"
    ):
        margin_system(1.5)


def test_score_and_race_are_needed():
    with pytest.raises(InputError, match="score or the race"):
        margin_system().rule(PlayedMatch((80, 80), (5, 3), None))
