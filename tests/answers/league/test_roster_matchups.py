import math

import numpy as np
import pytest

from evenbreak.answers.league.roster_matchups import (
    NOT_LINKED,
    OfferedRaces,
    all_pairs,
    check_roster,
    roster_matchups,
)
from evenbreak.errors import DataError, InputError
from evenbreak.files.lists.roster import read_roster
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.charts.fair import fair_races
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.handicaps.charts.level_chart import level_chart
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.matches.pace import own_pace
from evenbreak.matches.races import race_odds
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES, scale_of

NPL = SCALES["npl"]
SURE = Roster(["Ann", "Bo", "Cy"], [92.0, 71.4, 80.0])


def test_all_pairs_stronger_first():
    roster = Roster(["Ann", "Bo", "Cy", "Di"], [70, 92, 81, 81])
    assert all_pairs(roster).tolist() == [[1, 2], [1, 3], [1, 0], [2, 3], [2, 0], [3, 0]]


def test_without_errors_chances_are_those_of_the_race():
    pairs = np.array([[0, 1], [1, 2]])
    frame = roster_matchups(
        SURE, pairs, scale=NPL, chart=chart("npl_10"), offered=OfferedRaces((7, 13))
    ).frame
    for row, (a, b) in zip(frame.itertuples(), pairs.tolist(), strict=True):
        p = NPL.win_probability(float(SURE.rating[a] - SURE.rating[b]))
        best = fair_races(p, games=(7, 13), top=1)[0]
        assert (row.player_a, row.player_b) == (SURE.players[a], SURE.players[b])
        assert (row.race_a, row.race_b) == (best.race_1, best.race_2)
        assert row.p_win_a == row.p_win_a_plug_in == pytest.approx(best.p_win_1, rel=1e-12)
        assert row.mean_games == pytest.approx(best.mean_games, rel=1e-12)
        assert row.games_p90 == best.games_p90
        assert math.isnan(row.difference_error)
        # The chart is asked with whole points: 71.4 counts as 71.
        assert (row.chart_race_a, row.chart_race_b) == ((6, 4) if a == 0 else (4, 5))
        law = race_odds(row.chart_race_a, row.chart_race_b, p)
        assert row.chart_p_win_a == pytest.approx(law.p_win_1, rel=1e-12)
        assert row.chart_unfairness == pytest.approx(abs(law.p_win_1 - 0.5), abs=1e-12)
        assert row.chart_mean_games == pytest.approx(law.mean, rel=1e-12)
        assert row.chart_games_p90 == law.quantile(0.9)
        assert row.note == ""


def test_errors_add_up_and_are_averaged_over():
    roster = Roster(["Ann", "Bo", "Cy"], [92.0, 71.0, 80.0], [9.0, 12.0, np.nan])
    frame = roster_matchups(
        roster, np.array([[0, 1], [0, 2]]), scale=NPL, offered=OfferedRaces((5, 9))
    ).frame
    assert frame["difference_error"].tolist() == pytest.approx([15.0, 9.0])
    for row in frame.itertuples():
        averaged = Gap(row.difference, row.difference_error).win(row.race_a, row.race_b)
        assert row.p_win_a == pytest.approx(averaged, abs=1e-12)
        plug_in = race_odds(row.race_a, row.race_b, NPL.win_probability(row.difference)).p_win_1
        assert row.p_win_a_plug_in == pytest.approx(plug_in, rel=1e-12)
        assert 0.5 < row.p_game_a < row.p_game_a_plug_in


def test_minutes_are_games_at_so_many_a_game():
    frame = roster_matchups(
        SURE, all_pairs(SURE), scale=NPL, offered=OfferedRaces(race_to=7), pace=own_pace(7.5)
    ).frame
    assert frame["mean_minutes"].tolist() == pytest.approx((7.5 * frame["mean_games"]).tolist())
    # Games do not all take the same time: 9 of 10 matches need more than 9 of 10 matches' games.
    assert (frame["minutes_p90"] > 7.5 * frame["games_p90"].astype(float)).all()


def test_players_without_a_link_have_no_race():
    roster = Roster(
        ["Ann", "Bo", "Cy", "Di"], [92, 71, 80, 75], component=[1, 1, 2, 0], games=[9, 9, 9, 9]
    )
    answer = roster_matchups(roster, all_pairs(roster), scale=NPL, offered=OfferedRaces((5, 9)))
    notes = dict(
        zip(
            zip(answer.frame.player_a, answer.frame.player_b, strict=True),
            answer.frame.note,
            strict=True,
        )
    )
    apart = {pair for pair, note in notes.items() if note == NOT_LINKED}
    assert apart == {("Ann", "Cy"), ("Cy", "Bo")}
    assert answer.frame.loc[~answer.linked, "race_a"].isna().all()
    assert answer.frame.loc[~answer.linked, "p_game_a"].isna().all()
    assert len(answer.best_lengths) == 4 == answer.linked.sum()


def test_a_new_player_is_compared_by_the_starter_rating():
    roster = Roster(["Ann", "Bo"], [92, 80], [9, 30], [120, 0], component=[1, 2])
    frame = roster_matchups(
        roster, all_pairs(roster), scale=NPL, offered=OfferedRaces((5, 9))
    ).frame
    assert frame["note"].tolist() == ["B is new"]
    assert frame["race_a"].notna().all()


def test_it_says_where_no_race_is_fair():
    roster = Roster(["Ann", "Bo"], [110, 70])
    frame = roster_matchups(
        roster, all_pairs(roster), scale=NPL, offered=OfferedRaces((3, 3))
    ).frame
    # 3:1 gives Ann .365, 2:2 .808: nothing is fair.
    assert frame["note"].tolist() == ["no allowed race is fair: the closest gives A 0.37"]


def test_levels():
    roster, skills = Roster(["Ann", "Bo"], [600, 400], level=[5, 3]), level_skills("apa_8ball")
    pairs, asked = np.array([[0, 1]]), {"scale": scale_of("fargo"), "chart": skills.chart}
    by_rating = roster_matchups(roster, pairs, **asked).frame
    by_level = roster_matchups(roster, pairs, levels=skills, **asked).frame
    for frame, p in ((by_rating, 0.8), (by_level, 0.721)):
        assert frame[["chart_race_a", "chart_race_b"]].to_numpy().tolist() == [[4, 2]]
        assert frame["p_game_a_plug_in"].tolist() == pytest.approx([p])


def test_a_roster_that_does_not_suit_is_refused_with_its_lines(tmp_path):
    path = tmp_path / "roster.csv"
    path.write_text("player,level,se,qse\nAnn,5,,\nBo,9,,\nCy,3,700,\nDi,3,9,600\n")
    file = read_roster(path)
    with pytest.raises(DataError) as caught:
        check_roster(file, file.roster, level_chart("apa_8ball"), scale_of(100))
    problems = [problem.partition("roster.csv:")[2] for problem in caught.value.problems]
    begins = ["3: 'Bo' has skill level 9", "4: standard_error 700", "5: quasi_error 600"]
    assert [text[: len(begin)] for text, begin in zip(problems, begins, strict=True)] == begins
    assert "2, 3, 4, 5, 6, 7" in problems[0]
    assert "500" in problems[1]


def test_refused():
    with pytest.raises(InputError, match="Give at least one of them"):
        roster_matchups(SURE, all_pairs(SURE), scale=NPL)
    unrated = Roster(["Ann", "Bo"], [92, np.nan])
    with pytest.raises(InputError, match="with_starters"):
        roster_matchups(unrated, np.array([[0, 1]]), scale=NPL, offered=OfferedRaces((5, 9)))
