import pandas as pd
import pytest

from evenbreak.answers.rating_changes_frame import (
    moves_frame,
    moves_of_files,
    night_warnings,
    reasons,
)
from evenbreak.errors import DataError
from evenbreak.files.csv_writer import to_csv
from evenbreak.files.results import read_results
from evenbreak.files.roster import read_roster
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.catalogue import system_of

NPL = system_of("npl")
LAST = "player,rating,games\nBo,80,120\nAnn,92,140\nCy,71,\n=cmd(),60,0\nNew,,0\n"
HEADER = "player_a,player_b,score_a,score_b"
NIGHT = f"{HEADER}\nAnn,Bo,5,3\nCy,Ann,2,6\nBo,=cmd(),6,1\n"


@pytest.fixture
def files(tmp_path):
    def written(last, night):
        (tmp_path / "last.csv").write_text(last, encoding="utf-8")
        (tmp_path / "night.csv").write_text(night, encoding="utf-8")
        return read_roster(tmp_path / "last.csv"), read_results(tmp_path / "night.csv")

    return written


def problems(files, night, last=LAST, **options):
    with pytest.raises(DataError) as caught:
        moves_of_files(NPL, *files(last, night), **options)
    return [problem.rpartition("night.csv")[2] for problem in caught.value.problems]


def test_the_list_after_the_night_with_its_reasons(files):
    frame = moves_frame(moves_of_files(NPL, *files(LAST, NIGHT), chart=chart("npl_10")))
    assert to_csv(frame).decode().splitlines() == [
        "player,rating,standard_error,games,component,matches,rating_before,change,matches_won,"
        "matches_lost,why",
        "Ann,94,,156,,,92,2,2,0,beat Bo 5-3 (race 5:4); beat Cy 6-2 (race 6:4)",
        "Bo,80,,135,,,80,0,1,1,lost to Ann 3-5 (race 4:5); beat =cmd() 6-1 (race 6:4)",
        "Cy,70,,,,,71,-1,0,1,lost to Ann 2-6 (race 4:6)",
        "'=cmd(),59,,7,,,60,-1,0,1,lost to Bo 1-6 (race 4:6)",
        "New,,,0,,,,,0,0,",
    ]


def test_the_list_after_the_night_is_the_list_before_the_next(files, tmp_path):
    last, night = files(LAST, NIGHT)
    moves = moves_of_files(NPL, last, night, chart=chart("npl_10"))
    (tmp_path / "next.csv").write_bytes(to_csv(moves_frame(moves)))
    again = read_roster(tmp_path / "next.csv")
    assert again.warnings == ()
    assert sorted(again.roster.players) == sorted(last.roster.players)
    for name in last.roster.players:
        here, there = again.roster.position(name), moves.after.position(name)
        assert again.roster.games[here] == moves.after.games[there]
        rating = again.roster.rating[here], moves.after.rating[there]
        assert rating[0] == rating[1] or name == "New"


def test_parts_of_points_and_standard_errors_are_kept(files):
    last = "player,rating,standard_error\nAnn,92.5,4\nBo,80,\n"
    night = f"{HEADER},race_a,race_b\nAnn,Bo,4,4,5,4\n"
    frame = moves_frame(moves_of_files(NPL, *files(last, night)))
    assert list(frame["rating"]) == [91.5, 81.0]
    assert frame["standard_error"][0] == 4.0
    assert pd.isna(frame["standard_error"][1])
    assert list(frame["change"]) == [-1, 1]


def test_a_match_known_by_its_winner_alone_has_no_score(files):
    night = f"{HEADER},race_a,race_b,winner\nAnn,Bo,,,5,4,b\n"
    moves = moves_of_files(NPL, *files(LAST, night))
    assert reasons(moves) == {0: ["beat Ann (race 4:5)"], 1: ["lost to Bo (race 5:4)"]}


def test_all_that_is_wrong_is_told_with_lines_and_remedies(files):
    told = problems(files, f"{HEADER}\n\nAnn,Bo,5,3\nAnn,Boo,5,2\nAnn, cy ,5,2\nBo,Cy,5,3\n")
    assert [text.partition(" ")[0] for text in told] == [":3:", ":4:", ":5:"]
    assert "neither the race nor the winner" in told[0]
    assert "(2 such matches; --chart NAME serves for all)" in told[0]
    assert "'Boo' is not on the list" in told[1]
    assert told[2].endswith("if 'Cy' is meant, write that or say so in --aliases")


def test_a_score_at_odds_with_the_chart(files):
    told = problems(files, f"{HEADER}\nAnn,Cy,5,3\n", chart=chart("npl_10"))
    assert len(told) == 1
    assert told[0].startswith(":2: 5-3 does not finish the race 6:4")


def test_races_that_are_not_the_charts_and_further_nights_are_told(files):
    by_ten = chart("npl_10")
    header = f"date,{HEADER},race_a,race_b\n"
    one = "2026-11-20,Ann,Bo,5,3,5,4\n2026-11-20,Ann,Cy,5,3,5,5\n"
    off = ":3: 'Ann' - 'Cy' was a race 5:5; the chart npl_10 has 6:4 for 92 and 71"
    more = (
        ": holds 2 dates, for which the chart is looked up with the same ratings; run one night "
        "at a time if the ratings moved in between"
    )
    for rows, wanted in ((one, [off]), (f"{one}2026-11-27,Bo,Ann,4,2,4,5\n", [more, off])):
        last, night = files(LAST, header + rows)
        moves = moves_of_files(NPL, last, night, chart=by_ten)
        told = [line.rpartition("night.csv")[2] for line in night_warnings(moves, night, by_ten)]
        assert told == wanted
