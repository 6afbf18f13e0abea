"""A season from its files, night by night."""

import pytest

from evenbreak.answers.league.rating_changes import nights_of_files
from evenbreak.answers.sandbag.season import events_marked, with_even_races
from evenbreak.errors import DataError, InputError
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps import chart, system_of
from evenbreak.ratings import walk_forward

NPL, TEN = system_of("npl"), chart("npl_10")
ROSTER = "player,rating\nAnn,80\nBo,80\n"
SEASON = (
    "date,event,player_a,player_b,score_a,score_b,forfeit\n"
    "2025-01-07,league,Ann,Bo,5,0,\n2025-01-14,cup,Bo,Ann,5,1,\n2025-01-21,league,Ann,Bo,,,yes\n"
    "2025-01-21,league,Bo,Ann,0,5,\n"
)


def files(folder, season=SEASON, roster=ROSTER):
    for name, text in (("season.csv", season), ("roster.csv", roster)):
        (folder / name).write_text(text, encoding="utf-8")
    return read_roster(folder / "roster.csv"), read_results(folder / "season.csv")


def test_nights_move_the_ratings_and_a_forfeit_does_not(tmp_path):
    first, season = files(tmp_path)
    nights = nights_of_files(NPL, first, season, chart=TEN)
    assert [night.rows.tolist() for night in nights] == [[0], [1], [2, 3]]
    assert nights[-1].changes.after.rating.tolist() == [81, 79]


def test_races_are_those_by_which_validate_predicts(tmp_path):
    season = files(tmp_path)[1]
    raced, _ = with_even_races(season)
    walk = walk_forward(season.results)
    counted = raced.results.counted
    assert raced.results.race_a[counted].tolist() == walk.race_a.tolist() == [5, 5, 5]


def test_a_stranger_is_a_problem_once_with_the_first_line(tmp_path):
    first, season = files(tmp_path, SEASON.replace("Bo", "Boo"))
    with pytest.raises(DataError) as caught:
        nights_of_files(NPL, first, season, chart=TEN)
    (problem,) = caught.value.problems
    assert problem.split("/")[-1].startswith("season.csv:2: 'Boo'")


def test_events_are_found_by_name(tmp_path):
    _, season = files(tmp_path)
    assert events_marked(season.results, ["league"]).tolist() == [True, False, True, True]
    with pytest.raises(InputError, match=r"'leage'.*cup, league"):
        events_marked(season.results, ["leage"])
