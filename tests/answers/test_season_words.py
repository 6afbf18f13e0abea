"""What a simulated season says in words, and its table on a terminal."""

import numpy as np
import pytest

from evenbreak.answers.season_words import season_words, standings_rows
from evenbreak.league import FixedSchedule, LeaguePlayers, Season, run_chunk


def told(season, many=10, replicas=50):
    seeds = np.random.SeedSequence(1).spawn(many)
    tally = run_chunk(season, replicas, seeds[0])
    for seed in seeds[1:]:
        tally += run_chunk(season, replicas, seed)
    return season_words(season, tally), standings_rows(season, tally)


def test_an_operator_is_told_how_wrong_how_fair_and_who_profits():
    players = LeaguePlayers.of(
        [60, 80, 80, 80], skill=[90, 80, 80, 80], names=["Otto", "Ann", "Bo", "Cy"]
    )
    words, rows = told(Season(players, "npl", weeks=12))
    assert words[0] == (
        "4 players, 12 weeks, 24 matches a season; system npl, chart npl_10; 500 seasons simulated."
    )
    assert words[1].startswith("How wrong are the ratings? At the start by 13.0 points")
    assert "and 75.0 % are within 5. After week 12 by" in words[1]
    assert "50 would be even" in words[2]
    assert "The weakest fifth" in words[2]
    assert words[3].startswith("Who profits? Most of all Otto, rated 60 with a skill of 90, wins ")
    assert words[4].startswith("How much of the table is luck? A player's matches won vary by")
    assert rows[1][:3] == ["1", "Otto", "60"]
    assert len(rows) == 5


def test_nobody_profits_where_all_are_alike():
    words, _ = told(Season(LeaguePlayers.of([80] * 4), "npl", weeks=8), many=10, replicas=5)
    assert words[3].startswith("Who profits? Nobody that these seasons can tell")


def test_of_many_who_are_all_alike_nobody_is_named():
    """Of 200 some ten are two standard errors off a half; that is luck, and no profit."""
    season = Season(LeaguePlayers.of([80] * 200), "npl", weeks=10)
    words, _ = told(season, many=20, replicas=5)
    assert words[3].startswith("Who profits? Nobody that these seasons can tell")


def test_only_those_are_named_of_whom_it_is_clear():
    """Forty lose a little to the one who is better than his rating: none of them clearly."""
    players = LeaguePlayers.of([80] * 41, skill=[110, *[80] * 40])
    words, _ = told(Season(players, "npl", weeks=10), many=20, replicas=2)
    assert words[3].startswith("Who profits? Most of all player 1, rated 80 with a skill of 110")
    assert words[3].endswith("nobody clearly wins less than half.")
    players = LeaguePlayers.of([80] * 41, skill=[50, *[80] * 40])
    words, _ = told(Season(players, "npl", weeks=10), many=20, replicas=2)
    assert words[3].startswith("Who profits? Nobody clearly wins more than half of his matches;")
    assert "; least player 1, rated 80 with a skill of 50, wins " in words[3]


def test_a_long_table_shows_its_ends():
    _, rows = told(Season(LeaguePlayers.of([80] * 40), "npl", weeks=2), many=1, replicas=10)
    assert len(rows) == 14
    assert [row[0] for row in rows][:8] == ["", "1", "2", "3", "4", "5", "6", "..."]
    assert rows[-1][0] == "40"


@pytest.mark.filterwarnings("error")
def test_one_season_and_none_at_all_are_told_as_such():
    words, rows = told(Season(LeaguePlayers.of([80, 70]), "npl", weeks=1), many=1, replicas=1)
    assert "1 season simulated" in words[0]
    assert "±" not in "".join(words)
    assert "nan" not in "".join(words) + str(rows)
    assert [row[5] for row in rows] == ["8 of 10 seasons", "", ""]
    season = Season(
        LeaguePlayers.of([80, 70], joins=[1, 9]), "npl", None, FixedSchedule([1], [0], [1]), weeks=2
    )
    words, rows = told(season, many=1, replicas=5)
    assert words == ["No match was played: nobody was there whom the schedule had meet."]
    assert "nan" not in str(rows)
