"""What if: races one game shorter, one more table."""

import pytest

from evenbreak.answers.tournament.time import savings, shorter, what_if
from evenbreak.handicaps import chart
from evenbreak.tournaments import Fairest, Races, double_elimination, finish, pair_odds


@pytest.mark.parametrize(
    ("races", "fewer"),
    [
        (Races(7), Races(6)),
        (Races(7, losers=5, final=9), Races(6, losers=4, final=8)),
        (Races(Fairest(7), losers=Fairest(2)), Races(Fairest(6), losers=Fairest(1))),
        (Races(1), None),
        (Races(7, losers=1), None),
        (Races(chart("npl_10")), None),
    ],
)
def test_races_one_game_shorter(races, fewer):
    assert shorter(races) == fewer


def test_more_tables_and_shorter_races_end_it_sooner():
    bracket = double_elimination(8)

    def ask(tables, races):
        return finish(bracket, pair_odds(bracket, [500] * 8, races), tables=tables, runs=200)

    changes = what_if(ask(2, Races(5)), ask, bracket, 2, Races(5))
    moved = {row[0]: row[2] for row in changes.rows}
    assert moved["one_table_fewer"] > 0.0 > moved["losers_races_one_shorter"]
    assert moved["losers_races_one_shorter"] > moved["races_one_shorter"]
    assert savings(changes) == {
        "one_more_table": -moved["one_more_table"],
        "races_one_shorter": -moved["races_one_shorter"],
    }
