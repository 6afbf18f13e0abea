"""The list after a night, with its reasons and warnings."""

import pytest

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.league.rating_changes import rating_changes_answer, rating_changes_of_files
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.catalog import system_of

NPL = system_of("npl")
LAST = "player,rating,games\nBo,80,120\nAnn,92,140\nCy,71,\n=cmd(),60,0\nNew,,0\n"
HEADER = "player_a,player_b,score_a,score_b"
NIGHT = f"{HEADER}\nAnn,Bo,5,3\nCy,Ann,2,6\nBo,=cmd(),6,1\n"
NPL_10 = chart("npl_10")


@pytest.fixture
def answer_of(tmp_path):
    def answer(night=NIGHT, last=LAST, by=NPL_10, **options):
        (tmp_path / "last.csv").write_text(last, encoding="utf-8")
        (tmp_path / "night.csv").write_text(night, encoding="utf-8")
        files = read_roster(tmp_path / "last.csv"), read_results(tmp_path / "night.csv")
        moves = rating_changes_of_files(NPL, *files, chart=by)
        return rating_changes_answer(moves, *files, chart=by, **options)

    return answer


def test_the_list_after_the_night_with_its_reasons(answer_of):
    assert "".join(to_csv(answer_of())).splitlines() == [
        "player,rating,standard_error,games,component,provisional,matches,rating_before,change,"
        "matches_won,matches_lost,why,scale",
        'Ann,94,,156,,no,,92,2,2,0,"beat Bo 5-3 (race 5:4); beat Cy 6-2 (race 6:4)",',
        'Bo,80,,135,,no,,80,0,1,1,"lost to Ann 3-5 (race 4:5); beat =cmd() 6-1 (race 6:4)",',
        "Cy,70,,,,yes,,71,-1,0,1,lost to Ann 2-6 (race 4:6),",
        "'=cmd(),59,,7,,yes,,60,-1,0,1,lost to Bo 1-6 (race 4:6),",
        "New,,,0,,yes,,,,0,0,,",
    ]


def test_the_list_after_the_night_is_the_list_before_the_next(answer_of, tmp_path):
    answer = answer_of()
    (tmp_path / "next.csv").write_text("".join(to_csv(answer)), encoding="utf-8")
    again = read_roster(tmp_path / "next.csv")
    assert again.warnings == ()
    for row in answer.to_dict()["players"]:
        place = again.roster.position(row["player"])
        assert row["rating"] in (again.roster.rating[place], None)
        assert row["games"] in (again.roster.games[place], None)


def test_who_gained_and_lost_comes_first(answer_of):
    gained, lost, same = answer_of().sentences[0].split(". ")
    assert "Ann by 2" in gained
    assert "=cmd() by 1" in lost
    assert "Cy by 1" in lost
    assert "1 player " in same


def test_each_match_is_a_line_and_each_player_is_named_once(answer_of):
    reasons, standings = answer_of().parts[1:]
    assert [row[0] for row in reasons.rows] == ["Ann", None, "Bo", None, "Cy", "=cmd()"]
    assert [row[:2] for row in standings.rows] == [
        ("1", "Ann"),
        ("2", "Bo"),
        ("P1", "Cy"),
        ("P2", "=cmd()"),
        ("P3", "New"),
    ]
    assert standings.columns[2].text(standings.rows[-1][2]) == "new"


def test_parts_of_points_and_standard_errors_are_kept(answer_of):
    last = "player,rating,standard_error\nAnn,92.5,4\nBo,80,\n"
    night = f"{HEADER},race_a,race_b\nAnn,Bo,4,4,5,4\n"
    ann, bo = answer_of(night, last, None).to_dict()["players"]
    assert (ann["rating"], ann["standard_error"], ann["change"]) == (91.5, 4.0, -1)
    assert (bo["rating"], bo["standard_error"], bo["change"]) == (81.0, None, 1)


def test_a_match_known_by_its_winner_alone_has_no_score(answer_of):
    answer = answer_of(f"{HEADER},race_a,race_b,winner\nAnn,Bo,,,5,4,b\n", by=None)
    why = {row["player"]: row["why"] for row in answer.to_dict()["players"]}
    assert (why["Bo"], why["Ann"]) == ("beat Ann (race 4:5)", "lost to Bo (race 5:4)")
    (match,) = answer.to_dict()["matches"]
    assert (match["winner"], match["games"], match["race"]) == ("Bo", None, [4, 5])


def test_a_chart_that_was_found_is_named(answer_of):
    assert not any("npl_10" in sentence for sentence in answer_of().sentences)
    assert "npl_10" in answer_of(found_chart=True).sentences[1]


def test_other_races_than_the_charts_are_warnings(answer_of):
    header = f"date,{HEADER},race_a,race_b\n"
    one = "2025-11-20,Ann,Bo,5,3,5,4\n2025-11-20,Ann,Cy,5,3,5,5\n"
    (off,) = answer_of(header + one).warnings
    assert "night.csv:3: " in off
    assert "5:5" in off
    assert "6:4" in off


def test_the_list_after_the_night_keeps_the_scale_of_the_list_before(answer_of):
    header, *rows = LAST.splitlines()
    last = "\n".join([f"{header},scale", *(f"{row},npl" for row in rows)])
    assert {row["scale"] for row in answer_of(last=last).to_dict()["players"]} == {"npl"}
