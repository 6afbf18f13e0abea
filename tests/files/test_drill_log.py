import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.practice import WORDS, read_drill_log


@pytest.fixture
def drill_file(tmp_path):
    def write(text):
        path = tmp_path / "drill.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def problems(path, **more):
    with pytest.raises(DataError) as caught:
        read_drill_log(path, **more)
    return [line.removeprefix(str(path)).partition(";")[0] for line in caught.value.problems]


@pytest.mark.parametrize("word", WORDS)
def test_words_for_success_and_miss(drill_file, word):
    log = read_drill_log(drill_file(f"level,success\n1,{word.upper()}\n")).log
    assert log.success.tolist() == [WORDS[word]]


def test_rows_come_in_the_order_of_the_file(drill_file):
    file = read_drill_log(drill_file("success;level\nyes;1\nyes;2\n\nno;3\nno;2\n"))
    assert file.log.level.tolist() == [1, 2, 3, 2]
    assert file.log.success.tolist() == [True, True, False, False]
    assert (file.log.sessions, file.warnings) == (1, ())


def test_a_session_begins_where_session_or_date_changes(drill_file):
    file = read_drill_log(
        drill_file(
            "date,session,level,success\n"
            "2024-09-03,a,1,yes\n2024-09-03,a,2,no\n2024-09-03,b,1,no\n2024-09-04,b,1,yes\n"
        )
    )
    assert (file.log.sessions, file.log.starts.tolist()) == (3, [0, 2, 3])
    assert file.warnings == ()


def test_an_empty_cell_stands_for_the_one_above(drill_file):
    log = read_drill_log(drill_file("day,level,made\nMo,1,yes\n,2,no\nTu,1,no\n,1,no\n")).log
    assert log.starts.tolist() == [0, 2]


def test_empty_cells_on_top_are_a_session_of_their_own(drill_file):
    log = read_drill_log(drill_file("day,level,made\n,1,yes\n,2,no\nTu,1,no\n")).log
    assert log.starts.tolist() == [0, 2]


def test_a_step_against_the_rule_is_a_new_start_with_a_warning(drill_file):
    path = drill_file("level,success\n1,yes\n2,yes\n5,no\n4,no\n2,yes\n")
    file = read_drill_log(path)
    assert file.log.starts.tolist() == [0, 2, 4]
    (warning,) = file.warnings
    assert warning.startswith(f"{path}:4: level 5 follows a success at level 2")
    assert "2 such rows" in warning


def test_levels_of_the_drill(drill_file):
    path = drill_file("level,success\n1,yes\n2,yes\n2,no\n")
    assert read_drill_log(path).warnings == ()
    assert "should lead to level 3" in read_drill_log(path, levels=3).warnings[0]
    assert read_drill_log(path, levels=5).log.attempts.tolist() == [1, 2, 0, 0, 0]
    assert problems(path, levels=1) == [
        f":{line}: level '2' isn't a whole number from 1 to 1. Write 1, 2, 3, ..., or give the "
        "drill more levels."
        for line in (3, 4)
    ]


def test_all_problems_are_told_at_once(drill_file):
    path = drill_file("level,success\n0,yes\n1,maybe\n,no\n101,no\n2,\n3,no,no\n")
    assert problems(path) == [
        ":2: level '0' isn't a whole number from 1 to 100. Write 1, 2, 3, ...",
        ":3: success 'maybe' isn't yes or no. Write one of them, in one row per attempt.",
        ":4: level is empty. Write 1, 2, 3, ...",
        ":5: level '101' isn't a whole number from 1 to 100. Write 1, 2, 3, ...",
        ":6: success is empty. Write one of them, in one row per attempt.",
        (
            ":7: has 3 cells, but the header has 2. Add what's missing, or put cells that "
            "contain the separator in quotes."
        ),
    ]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("level,success\n", "has no attempts below its header"),
        ("1,yes\n2,no\n", "doesn't name the columns"),
        ("level\n1\n", "there's no column 'success' among 'level'"),
        ("", "is empty"),
    ],
)
def test_files_that_hold_no_log(drill_file, text, words):
    (problem,) = problems(drill_file(text))
    assert words in problem


cells = st.sampled_from(["1", "2", "9", "x", "", "yes", "no", "-1", "1e9", '"'])


@given(st.lists(st.lists(cells, max_size=3), max_size=8))
def test_any_file_is_read_or_its_problems_are_told(tmp_path_factory, rows):
    path = tmp_path_factory.getbasetemp() / "any_drill.csv"
    path.write_text("level,success,date\n" + "\n".join(map(",".join, rows)), encoding="utf-8")
    with contextlib.suppress(DataError):
        assert 0 < len(read_drill_log(path).log) <= len(rows)


TWO_DRILLS = "session,drill,level,success\n1,Line,1,yes\n1,,2,no\n1,L,1,no\n2,Line,1,yes\n"


def test_a_log_of_several_drills_is_split(drill_file):
    path = drill_file(TWO_DRILLS)
    (problem,) = problems(path)
    assert "2 drills ('Line', 'L')" in problem
    log = read_drill_log(path, drill="line").log
    assert (log.level.tolist(), log.starts.tolist()) == ([1, 2, 1], [0, 2])
    assert read_drill_log(path, drill="L").log.level.tolist() == [1]
    assert "'Q'" in problems(path, drill="Q")[0]
