import numpy as np
import pytest

from evenbreak.answers.league.matchups import (
    about_method,
    about_pairs,
    about_players,
    about_time,
    doubtful,
    evening_words,
    game_model,
    least_even,
    races_of,
    which_races,
)
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.round import EveningEnd
from evenbreak.matches.pace import PACES, Turnover, own_pace
from evenbreak.ratings.roster import Roster
from leagues import round_of


def test_the_least_even_race_is_the_furthest_from_a_half():
    frame = round_of().matchups.frame
    text = least_even(races_of(frame, "chart_"))
    worst = frame.iloc[frame["chart_unfairness"].argmax()]
    # In the order of the table, whoever is the favorite.
    needs = f"{worst.chart_race_a:g}:{worst.chart_race_b:g}"
    assert f"{needs} for {worst.player_a} against {worst.player_b}: " in text
    favorite = worst.player_a if worst.chart_p_win_a > 0.5 else worst.player_b
    assert f": {favorite} wins" in text
    assert f"{50 + 100 * worst.chart_unfairness:.0f}%" in text


def test_races_say_where_they_come_from():
    tonight = round_of(offered=OfferedRaces((7, 13)))
    assert "npl_10" in which_races(tonight, "chart_")
    assert "7 to 13 games" in which_races(tonight, "")


def test_an_evening_is_counted_and_timed():
    text = evening_words(EveningEnd("best", 1, 1, 65.0, 80.0, True, 0, 0.0, 0.0))
    assert "1 match on 1 table takes 1 h 05" in text
    assert "1 h 20" in text


def test_what_the_minutes_assume_is_said():
    assert about_time(round_of()) == ""
    timed = about_time(round_of(pace=PACES["9-ball"]))
    assert "9-ball: 5.6 minutes" in timed
    assert "table" not in timed
    own = about_time(round_of(pace=own_pace(8.0), tables=2, turnover=Turnover(5)))
    assert "8 minutes a game on average" in own
    assert "starts 5 minutes later" in own


def test_pairs_that_cannot_be_compared_or_made_even_are_named():
    apart = Roster(["Ann", "Bo"], [92, 71], None, [9, 9], component=[1, 2])
    (remark,) = about_pairs(round_of(apart).matchups.frame)
    assert list(remark.names) == ["Ann – Bo"]
    assert least_even(races_of(round_of(apart).matchups.frame, "chart_")) == ""
    far = Roster([f"P{k}" for k in range(8)], [300 - 40 * k for k in range(8)])
    tonight = round_of(far, chart=None, offered=OfferedRaces(race_to=3))
    (remark,) = about_pairs(tonight.matchups.frame)
    p = tonight.matchups.frame["p_win_a"]
    assert len(remark.names) == ((p - 0.5).abs() > 0.1).sum() > 10
    assert not list(about_pairs(round_of().matchups.frame))


@pytest.fixture
def with_newcomers():
    """Ann has games and no error; Bo is new; Cy has a rating, but no games yet."""
    return Roster(["Ann", "Bo", "Cy"], [92, np.nan, 85], None, [140, 0, 0])


def test_what_was_filled_in_is_said_of_whom(with_newcomers):
    tonight = round_of(with_newcomers.with_starters(80, 30, "npl"), read=with_newcomers)
    said = {tuple(remark.names): remark.why for remark in about_players(tonight)}
    assert said.keys() == {("Bo",), ("Cy",), ("Ann",)}
    assert "80 ± 30" in said["Bo",]
    assert "± 30" in said["Cy",]
    assert "± 7.32 after 140" in said["Ann",]


def test_only_players_who_meet_are_spoken_of(with_newcomers):
    started = with_newcomers.with_starters(80, 30, "npl")
    tonight = round_of(started, [[1, 2]], read=with_newcomers)
    assert {name for remark in about_players(tonight) for name in remark.names} == {"Bo", "Cy"}


def test_ratings_without_errors_and_games_are_exact():
    club = Roster(["Ann", "Bo", "Cy", "Di"], [92, 71, 80, 60])
    (everybody,) = about_players(round_of(club))
    assert everybody.names == ()
    assert not doubtful(round_of(club))


def test_the_method_is_said_as_far_as_it_was_used():
    plain = [remark.what for remark in about_method(round_of())]
    assert plain[0] == "Chart npl_10"
    assert any("standard error" in what for what in plain)
    timed = [str(remark) for remark in about_method(round_of(pace=own_pace(8.0), tables=2))]
    assert any("50,000 simulated evenings" in text for text in timed)
    assert "d/30" in game_model(round_of())
