"""What each rule moves, by hand."""

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.catalogue import system_of
from evenbreak.handicaps.systems.elo import elo_system
from evenbreak.handicaps.systems.fixed import fixed_length_system
from evenbreak.handicaps.systems.margin import margin_system
from evenbreak.handicaps.systems.newcomers import step_after
from evenbreak.handicaps.systems.step import step_system
from evenbreak.handicaps.systems.system import PlayedMatch


def test_the_pool_league_moves_a_point_a_match_whatever_the_match_was():
    rule = system_of("npl").rule
    assert rule(PlayedMatch((40.0, 130.0), (2, 6), (2, 7))) == (1, -1)
    assert rule(PlayedMatch((130.0, 40.0), None, None)) == (1, -1)


def test_newcomers_of_the_pool_league_move_by_three_then_by_two():
    rule = system_of("npl").rule
    moves = [rule(PlayedMatch((80, 80), None, None, (n, None))) for n in (0, 9, 10, 29, 30)]
    assert moves == [(3, -1), (3, -1), (2, -1), (2, -1), (1, -1)]
    assert rule(PlayedMatch((80, 80), None, None, (40, 5))) == (1, -3)


def test_steps_may_differ_between_winner_and_loser():
    match = PlayedMatch((80, 80), None, None)
    assert step_system(3).rule(match) == (3, -3)
    assert step_system(3, 0).rule(match) == (3, 0)
    assert step_system(2, 2) == step_system(2)
    assert step_system(1).in_words == system_of("npl").in_words


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
    from scipy.special import betaincinv

    from evenbreak.handicaps.charts.chart import chart
    from evenbreak.handicaps.systems.match_table import match_table

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


def test_a_winner_may_lose_points_by_elos_update():
    rule = elo_system(16).rule
    # A doubling of the odds: 2 of 3 games are expected, 6 of 9.
    doubling = 400 * 0.30102999566398120
    assert rule(PlayedMatch((doubling, 0.0), (6, 3), None)) == (0, 0)
    assert rule(PlayedMatch((doubling, 0.0), (5, 4), None)) == (-16, 16)
    assert rule(PlayedMatch((0.0, doubling), (5, 4), None)) == (32, -32)


def test_fixed_length_matches_are_the_pool_leagues_but_for_the_chart():
    nine, npl = fixed_length_system(), system_of("npl")
    assert nine.name == "fixed 9"
    assert (nine.rule, nine.scale, nine.newcomer_steps) == (npl.rule, npl.scale, npl.newcomer_steps)
    assert {sum(row[2:]) for row in nine.usual_chart().rows} == {10}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: step_system(0), "up is 0; give a whole number, 1 or more"),
        (lambda: step_system(1, -1), "down is -1"),
        (lambda: step_system(1001), "up is 1001; give a whole number, 1000 or less"),
        (lambda: margin_system(1.5), "most is 1.5"),
        (lambda: elo_system("x"), "k is 'x'"),
        (lambda: fixed_length_system(8), "give 7 or 9"),
        (lambda: fixed_length_system(1001), "games is 1001; give 999 or less"),
        (lambda: step_after(-1), "played is -1"),
    ],
)
def test_numbers_out_of_reach_are_refused(make, message):
    with pytest.raises(InputError, match=message):
        make()
