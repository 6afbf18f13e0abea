import hashlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.results.results_file import read_results
from places import ROOT

SEASON = ROOT.parent / "shared" / "data" / "snooker_2016_17_results.csv"
HEADER = "date,player_a,player_b,score_a,score_b"


@pytest.fixture
def read(tmp_path):
    def read_content(content):
        path = tmp_path / "r.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_results(path)

    return read_content


def problems(read, content):
    with pytest.raises(DataError) as caught:
        read(content)
    return [problem.rpartition("r.csv")[2] for problem in caught.value.problems]


def test_the_demo_league():
    file = read_results(ROOT / "data" / "demo_league.csv")
    results = file.results
    assert (len(results), len(results.players), file.warnings) == (408, 24, ())
    assert results.date is not None
    assert str(results.date[0]) == "2024-09-03"
    assert results.players[int(results.player_a[1])] == "Pia Rautavuori"
    assert results.race_a is not None
    assert results.race_a[0] == 7
    assert set(np.unique(results.first_break)) == {0, 1, 2}
    assert results.forfeit is not None
    assert int(results.forfeit.sum()) == 11


@pytest.mark.skipif(not SEASON.exists(), reason="the real season lies beside a checkout only")
def test_the_real_season():
    file = read_results(SEASON)
    played, forfeits, empty = file.results.played()
    assert (len(file.results), len(file.results.players)) == (2461, 335)
    assert (len(played), forfeits, empty) == (2412, 49, 0)
    assert file.similar_names == (("Mark Davies", "Mark Davis"),)
    assert any("'Mark Davies' and 'Mark Davis' may be the same player" in w for w in file.warnings)


def test_the_fingerprint_is_that_of_the_bytes(read):
    content = f"{HEADER}\n2024-09-03,Ann,Bo,7,5\n".encode()
    assert read(content).sha256 == hashlib.sha256(content).hexdigest()


@pytest.mark.parametrize(
    "content",
    [
        f"{HEADER}\n2024-09-03,Zoë,Bo,7,5\n".encode("cp1252"),
        f"{HEADER}\n2024-09-03,Zoë,Bo,7,5\n".encode("utf-8-sig"),
        f"{HEADER}\r\n2024-09-03,Zoë,Bo,7,5\r\n".replace(",", ";").encode(),
        f"{HEADER}\n2024-09-03,Zoë,Bo,7,5\n".replace(",", "\t").encode(),
        b"Score B,Home,Away,Score 1\n5,Zoe\xcc\x88,Bo,7\n",
    ],
)
def test_files_as_programs_write_them(read, content):
    file = read(content)
    assert file.results.players == ("Bo", "Zoë")
    assert (file.results.player_a[0], file.results.score_a[0], file.results.score_b[0]) == (1, 7, 5)


def test_a_date_is_not_needed(read):
    assert read("player_a,player_b,score_a,score_b\nAnn,Bo,7,5\n").results.date is None


@pytest.mark.parametrize("column", ["player_a", "player_b", "score_a", "score_b"])
def test_each_needed_column_is_asked_for_and_the_rest_still_looked_at(read, column):
    header = HEADER.replace(column, "other")
    told = problems(read, f"{header}\nsoon,Ann,Bo,7,5\n")
    assert told[0].startswith(f":1: there's no column {column!r}")
    assert told[1].startswith(":2: date 'soon' isn't a date")
    assert len(told) == 2


def test_a_header_without_matches_is_told(read):
    assert problems(read, f"{HEADER}\n") == [
        ": has no matches below its header. Write one line for each."
    ]


def test_all_problems_are_told_at_once_with_line_column_and_remedy(read):
    told = problems(
        read,
        f"{HEADER},race_a,race_b,winner\n"
        "2024-13-03,Ann,Ann,x,-1,,,\n"
        "\n"
        "2024-09-03,,Bo,7,NaN,0,5,\n"
        '2024-09-03,Ann,"Bo\nDiaz",7,5,7,,Cy\n'
        "2024-09-03,Ann,Bo,6,5,7,5,a\n"
        "2024-09-03,Ann\n",
    )
    assert [text.partition("; ")[0] for text in told] == [
        ":2: score_a 'x' isn't a whole number from 0 to 1,000,000. Write 0, 1, 2, ...",
        ":2: score_b '-1' isn't a whole number from 0 to 1,000,000. Write 0, 1, 2, ...",
        (
            ":2: date '2024-13-03' isn't a date. Write 2024-09-03, 3.9.2024 or 9/3/2024, "
            "or leave it empty."
        ),
        ":2: 'Ann' is on both sides of the match. Correct one of the names.",
        ":4: player_a is empty. Write the player's name.",
        ":4: score_b 'NaN' isn't a whole number from 0 to 1,000,000. Write 0, 1, 2, ...",
        (
            ":4: race_a '0' isn't a whole number from 1 to 1,000,000. Write 1, 2, 3, "
            "..., or leave both races empty."
        ),
        (
            ":5: winner 'Cy' is neither of the two players. Write a, b or one of the two "
            "names, or leave it empty."
        ),
        (
            ":7: winner is a, but b reached the race (6-5 in a race 7:5). Write b, or "
            "correct the scores or the race."
        ),
        (
            ":8: has 2 cells, but the header has 8. Add what's missing, or put cells that "
            "contain the separator in quotes."
        ),
    ]
    assert all(". " in text for text in told)


def test_names_that_differ_in_case_or_spaces_are_one_player_and_both_spellings_are_named(read):
    file = read(
        f"{HEADER}\n2024-09-03,Ann  Lee,Bo,7,5\n2024-09-04, Ann Lee ,Bo,7,5\n"
        "2024-09-05,bo,ANN LEE,7,5\n2024-09-06,Bo,AnnLee,7,5\n"
    )
    assert file.results.players == ("Ann Lee", "Bo")
    assert file.results.player_a.tolist() == [0, 0, 1, 1]
    told = [w.partition(": ")[2].partition(", because")[0] for w in file.warnings]
    assert told == [
        "'ANN LEE' is read as 'Ann Lee'",
        "'Ann  Lee' is read as 'Ann Lee'",
        "'AnnLee' is read as 'Ann Lee'",
        "'bo' is read as 'Bo'",
    ]
    assert file.similar_names == ()


def test_names_that_differ_in_accents_are_asked_about(read):
    rows = "2024-09-03,Zoë Lee,Zoe Lee,7,5\n2024-09-03,Jörg Petersen,Jorg Petersen,7,5\n"
    file = read(f"{HEADER}\n{rows}")
    assert file.similar_names == (("Jorg Petersen", "Jörg Petersen"), ("Zoe Lee", "Zoë Lee"))
    assert len(file.warnings) == 2
    assert "'Jorg Petersen' and 'Jörg Petersen' may be the same player" in file.warnings[0]


def test_a_player_does_not_play_another_spelling_of_their_name(read):
    with pytest.raises(DataError) as caught:
        read(f"{HEADER}\n2024-09-03,Ann Lee,ann lee,7,5\n")
    (told,) = caught.value.problems
    assert "('Ann Lee' and 'ann lee' are read as one player)" in told


def test_names_a_letter_apart_are_listed_unless_they_met(read):
    rows = "2024-09-03,Bob,Cy,7,5\n2024-09-03,Bobb,Cy,7,5\n2024-09-03,Anna,Anne,7,5\n"
    file = read(f"{HEADER}\n{rows}")
    assert file.similar_names == (("Bob", "Bobb"),)


def test_of_many_similar_names_twenty_groups_are_listed(read):
    letters = "abcdefghijklmnopqrstuvwxyz"
    rows = "".join(f"2024-09-03,Zoë L{a * 9},Zoe L{a * 9},7,5\n" for a in letters)
    warnings = read(f"{HEADER}\n{rows}").warnings
    assert len(warnings) == 21
    assert warnings[-1].endswith("and 6 more groups of similar names")


@pytest.fixture
def aliases(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("name,means\nBobby,Bob Smith\nJo,Joan\nNobody,Joan\n", encoding="utf-8")
    return path


def test_aliases_mend_names_wherever_they_stand(tmp_path, aliases):
    path = tmp_path / "r.csv"
    path.write_text(
        f"{HEADER},winner,first_break\n2024-09-03,Bobby,Joan,7,5,bobby,Jo\n"
        "2024-09-04, Jo ,Bob  Smith,7,5,Joan,Bobby\n"
    )
    file = read_results(path, aliases=aliases)
    assert file.results.players == ("Bob Smith", "Joan")
    assert list(file.results.player_a) == [0, 1]
    assert (list(file.results.winner), list(file.results.first_break)) == ([1, 1], [2, 2])
    assert list(file.lines) == [2, 3]
    assert file.similar_names == ()
    assert "'Bobby' as 'Bob Smith', 'Jo' as 'Joan'" in file.warnings[-1]


def test_two_names_of_one_player_do_not_play_each_other(tmp_path, aliases):
    path = tmp_path / "r.csv"
    path.write_text(f"{HEADER}\n2024-09-03,Bobby,Bob Smith,7,5\n")
    with pytest.raises(DataError) as caught:
        read_results(path, aliases=aliases)
    (told,) = caught.value.problems
    assert told.startswith(f"{path}:2: 'Bob Smith'")
    assert "('Bobby' and 'Bob Smith'" in told


def test_what_is_wrong_with_the_aliases_is_told(tmp_path):
    with pytest.raises(DataError, match="there's no such file"):
        read_results(tmp_path / "r.csv", aliases=tmp_path / "none.csv")


def test_names_that_were_kept_from_being_formulas_are_read_as_they_were(read):
    file = read(f"{HEADER}\n2024-09-03,'=cmd(),\"'t Hooft\",7,5\n2024-09-04,=cmd(),Bo,7,5\n")
    assert file.results.players == ("'t Hooft", "=cmd()", "Bo")


@given(st.binary(max_size=300))
def test_any_bytes_are_read_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "any_results.csv"
    path.write_bytes(content)
    try:
        rows, told = len(read_results(path).results), ()
    except DataError as error:
        rows, told = 0, error.problems
    assert (rows > 0) != (len(told) > 0)
    assert all(line.startswith(str(path)) for line in told)


WORDS = st.sampled_from(
    ["Ann", "Bo", "ann", "", "7", "5", "0", "-1", "x", "a", "b", "yes", "abba", "2024-09-03", "é"]
)


@given(
    st.lists(st.lists(WORDS, min_size=12, max_size=12), min_size=1, max_size=6),
)
def test_any_cells_are_read_or_refused_in_their_lines(tmp_path_factory, rows):
    path = tmp_path_factory.getbasetemp() / "cells.csv"
    header = f"{HEADER},race_a,race_b,winner,first_break,break_format,racks,forfeit"
    path.write_text("\n".join([header, *map(",".join, rows)]), encoding="utf-8")
    try:
        file = read_results(path)
    except DataError as error:
        lines = {int(p.removeprefix(f"{path}:").partition(":")[0]) for p in error.problems}
        blank = {k + 2 for k, row in enumerate(rows) if not any(row)}
        in_rows = lines <= set(range(2, len(rows) + 2)) - blank
    else:
        in_rows = len(file.results) == sum(any(row) for row in rows)
    assert in_rows


def test_rows_that_stand_twice_are_told_with_the_line_of_the_first(tmp_path):
    path = tmp_path / "r.csv"
    row = "2024-01-01,Ann,Bo,5,3\n"
    other = "2024-01-02,Ann,Bo,5,3\n"
    path.write_text("date,player_a,player_b,score_a,score_b\n" + row + other + row + row)
    (warning,) = [text for text in read_results(path).warnings if "earlier" in text]
    assert ":4: 2 rows are identical to earlier ones" in warning


def test_rows_without_dates_may_be_alike(tmp_path):
    path = tmp_path / "r.csv"
    path.write_text("player_a,player_b,score_a,score_b\nAnn,Bo,5,3\nAnn,Bo,5,3\n")
    assert read_results(path).warnings == ()


def test_a_cell_with_half_a_file_in_it_is_no_name(read):
    content = "player_a,player_b,score_a,score_b\nAnn," + 130_000 * "a" + ",7,3\n"
    (problem,) = problems(read, content)
    assert ":2: player_b" in problem
    assert "a name of up to 200" in problem
