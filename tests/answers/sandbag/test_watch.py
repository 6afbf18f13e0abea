"""Who is flagged and after which match, and what each match of a player weighs."""

import math
import re

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.answers.league.rating_changes import nights_of_files
from evenbreak.answers.sandbag.watch import (
    day_sd_doubts,
    match_rows,
    sandbag_player_answer,
    sandbag_watch_answer,
    watch_rows,
)
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps import Ladder, chart, system_of
from evenbreak.league.sandbag_watch import watch
from evenbreak.ratings import Results

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


def test_lines_of_players_and_of_one_players_matches(tmp_path):
    first, season = files(tmp_path)
    nights = nights_of_files(NPL, first, season, chart=TEN)
    found = watch(nights, NPL, Ladder("npl").law(), alpha=0.4)
    rows = watch_rows(found, season.results)
    assert sorted(row.player for row in rows) == ["Ann", "Bo"]
    assert [row.largest_e for row in rows] == sorted((row.largest_e for row in rows), reverse=True)
    bo = next(one for one in found if one.player == "Bo")
    matches = match_rows(bo, nights)
    assert [match[:9] for match in matches] == [
        (0, "Ann", 80.0, 80.0, 0, 5, 5, 5, False),
        (1, "Ann", 79.0, 81.0, 5, 1, 5, 5, True),
        (3, "Ann", 80.0, 80.0, 0, 5, 5, 5, False),
    ]
    assert np.prod([match[10] for match in matches]) == pytest.approx(matches[-1][9])


def test_an_alarm_has_its_match_and_date(tmp_path):
    lines = [
        f"2025-{1 + week // 4:02d}-{1 + 7 * (week % 4):02d},league,Bo,Ann,{score},"
        for week, score in enumerate(["0,5", "5,0"] * 12)
    ]
    season = SEASON.splitlines()[0] + ",race_a,race_b\n"
    first, file = files(tmp_path, season + "".join(f"{line},5,5\n" for line in lines))
    found = watch(nights_of_files(NPL, first, file), NPL, Ladder("npl").law())
    row = watch_rows(found, file.results)[0]
    assert row.flagged
    assert row.league_wide
    assert row.alarm_date == str(file.results.date[row.alarm_match - 1])


def test_the_answer_names_the_flagged_and_shows_the_others(tmp_path):
    first, season = files(tmp_path)
    nights = nights_of_files(NPL, first, season, chart=TEN)
    flagged = watch(nights, NPL, Ladder("npl").law(), alpha=0.5)
    answer = sandbag_watch_answer(flagged, season.results, "season.csv")
    names = [row.player for row in watch_rows(flagged, season.results) if row.flagged]
    assert all(name in answer.sentences[0] for name in names)
    assert f"{len(names)} of 2" in answer.sentences[0] or "None" in answer.sentences[0]
    assert [row["player"] for row in answer.to_dict()["players"]] == list(
        answer.to_frame()["player"]
    )
    one = sandbag_player_answer(flagged[0], nights, season.results)
    assert len(one.to_dict()["matches"]) == 3


def test_a_season_without_matches_has_no_players(tmp_path):
    _, season = files(tmp_path)
    empty = season.results.select(np.array([], dtype=int))
    answer = sandbag_watch_answer([], empty, "season.csv")
    assert answer.to_dict()["players"] == []
    assert len(answer.parts) == 1


def test_form_of_the_day_in_the_results_suggests_a_day_sd():
    rng = np.random.default_rng(3)
    strength = rng.normal(0.0, 0.5, 20)
    a, b = np.array([rng.choice(20, 2, replace=False) for _ in range(1500)]).T
    form = rng.normal(0.0, 0.6, 1500)
    won = rng.binomial(15, expit(strength[a] - strength[b] + form))
    names = [f"Player {k:02d}" for k in range(20)]
    season = Results(names, a, b, won, 15 - won)
    (doubt,) = day_sd_doubts(season, "npl")
    points = int(re.search(r"Give day_sd (\d+)", doubt).group(1))
    assert points == pytest.approx(0.6 * 30.0 / math.log(2.0) / math.sqrt(2.0), abs=3.0)
    steady = rng.binomial(15, expit(strength[a] - strength[b]))
    assert day_sd_doubts(Results(names, a, b, steady, 15 - steady), "npl") == []
