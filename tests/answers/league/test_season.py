"""What a simulated season says in words, and its standings as people read them."""

import numpy as np
import pytest

from evenbreak.answers.kit.parts import Table
from evenbreak.answers.league.season import season_answer
from evenbreak.answers.league.season_tables import season_tables
from evenbreak.league import FixedSchedule, LeaguePlayers, Season, run_chunk


def asked(season, many=10, replicas=50, **notes):
    seeds = np.random.SeedSequence(1).spawn(many)
    tally = run_chunk(season, replicas, seeds[0])
    for seed in seeds[1:]:
        tally += run_chunk(season, replicas, seed)
    return season_answer(season, tally, season_tables(season, tally), {"seed": 1}, **notes)


def standings_of(answer):
    (table,) = [part for part in answer.parts if isinstance(part, Table)]
    return list(table.rows)


def who_gains(answer):
    return answer.sentences[2]


def test_an_operator_reads_how_accurate_how_fair_and_who_gains():
    players = LeaguePlayers.of(
        [60, 80, 80, 80], skill=[90, 80, 80, 80], names=["Otto", "Ann", "Bo", "Cy"]
    )
    answer = asked(Season(players, "npl", weeks=12))
    accurate, fair, gains, luck = answer.sentences
    assert "75.0%" in accurate  # the three who are rated rightly at the start
    assert f"{100 * answer.to_dict()['p_stronger_wins']:.1f}" in fair
    assert "fifth" not in fair  # of four players
    assert "Otto, rated 60 with a true skill of 90" in gains
    assert luck
    assert standings_of(answer)[0][:3] == ("1", "Otto", 60)
    assert len(standings_of(answer)) == 4


def test_the_weakest_and_the_strongest_fifth_are_compared_from_five_players_on():
    season = Season(LeaguePlayers.of([60, 70, 80, 90, 100]), "npl", weeks=4)
    answer = asked(season)
    assert "fifth" in answer.sentences[1]
    assert f"{100 * answer.to_dict()['p_win_weakest_fifth']:.1f}" in answer.sentences[1]


def test_what_is_assumed_of_skills_is_said():
    season = Season(LeaguePlayers.of([80] * 4), "npl", weeks=1)
    assert len(asked(season, 2, 2).sentences) == 4
    assert "3 of 4 players" in asked(season, 2, 2, drawn=3).sentences[-1]
    assert "1 of 4 players" in asked(season, 2, 2, exact=1).sentences[-1]


@pytest.mark.slow
@pytest.mark.parametrize(("players", "many"), [(4, 10), (200, 20)])
def test_nobody_is_named_where_all_are_alike(players, many):
    """Of 200 some ten are two standard errors off one half; that is luck."""
    answer = asked(Season(LeaguePlayers.of([80] * players), "npl", weeks=8), many, 5)
    assert "player 1" not in who_gains(answer)
    assert "No one" in who_gains(answer)


@pytest.mark.parametrize(("skill", "words"), [(110, "no one clearly"), (50, "No one clearly")])
def test_only_clear_cases_are_named(skill, words):
    """Forty gain or lose a little by the one whose rating is wrong: none of them clearly."""
    players = LeaguePlayers.of([80] * 41, skill=[skill, *[80] * 40])
    text = who_gains(asked(Season(players, "npl", weeks=10), 20, 2))
    assert f"player 1, rated 80 with a true skill of {skill}" in text
    assert words in text
    assert text.count("player ") == 1


def test_long_standings_show_their_ends():
    rows = standings_of(asked(Season(LeaguePlayers.of([80] * 40), "npl", weeks=2), 1, 10))
    assert [row[0] for row in rows][:7] == ["1", "2", "3", "4", "5", "6", "..."]
    assert (len(rows), rows[-1][0]) == (13, "40")
    assert len(standings_of(asked(Season(LeaguePlayers.of([80] * 12), "npl", weeks=1), 1, 9))) == 12


@pytest.mark.filterwarnings("error")
def test_one_season_and_none_at_all():
    answer = asked(Season(LeaguePlayers.of([80, 70]), "npl", weeks=1), many=1, replicas=1)
    assert "±" not in str(answer)
    assert "nan" not in str(answer)
    assert [row[5] for row in standings_of(answer)] == [None, None]
    season = Season(
        LeaguePlayers.of([80, 70], joins=[1, 9]), "npl", None, FixedSchedule([1], [0], [1]), weeks=2
    )
    answer = asked(season, many=1, replicas=5)
    assert len(answer.parts) == 1
    assert "nan" not in str(answer)
