import contextlib
import warnings

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.charts import chart_table, find_chart, read_chart, read_chart_file
from evenbreak.files.csv_writer import to_csv
from evenbreak.handicaps import CHARTS, LEVEL_CHARTS, Chart, LevelChart, chart, level_chart
from evenbreak.handicaps.charts.chart import ChartRow

ROWS = "difference_from,difference_to,stronger_needs,weaker_needs\n"
LEVELS = "level,opponent_level,needs,opponent_needs\n"


@pytest.fixture
def write(tmp_path):
    def file(text, name="ours.csv"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return file


def problems_of(path, read=read_chart):
    with pytest.raises(DataError) as refused:
        read(path)
    return [problem.replace(f"{path}", "F").partition(";")[0] for problem in refused.value.problems]


@pytest.mark.parametrize("name", [*CHARTS, *LEVEL_CHARTS])
@pytest.mark.parametrize("excel", [False, True])
def test_what_is_written_reads_back_the_same(write, name, excel):
    columns, rows = chart_table(find_chart(name))
    frame = pd.DataFrame(rows, columns=columns).astype("Int64")
    path = write(to_csv(frame, excel=excel), f"{name}.csv")
    assert read_chart(path) == find_chart(name)


def test_other_names_of_columns_and_a_semicolon(write):
    path = write("From;To;Stronger;Weaker;note\n0;9;5;5;x\n10;;5;4;\n")
    file = read_chart_file(path)
    assert file.chart == Chart("ours", [(0, 9, 5, 5), (10, None, 5, 4)])
    assert file.warnings == (f"{path}: columns not used: 'note'",)


def test_all_faults_of_a_chart_are_told_at_once_with_their_lines(write):
    path = write(ROWS + "0,4,5,4\n6,14,5,4\n\n12,20,4,6\n21,30,6,4\n")
    assert problems_of(path) == [
        (
            "F:2: row 1 is a race 5:4. Give an even race, since at a difference of 0 "
            "neither player is stronger."
        ),
        "F:3: row 2 starts at 6, but row 1 ends at 4. Start it at 5.",
        (
            "F:5: stronger_needs in row 3 must be 6 or more, since the stronger player "
            "never needs fewer games"
        ),
        "F:5: row 3 starts at 12, but row 2 ends at 14. Start it at 15.",
        (
            "F:6: the last row ends at 30, but a chart must cover all "
            "larger differences too. Leave out its end."
        ),
    ]
    file = read_chart_file(path)
    assert file.found.rows[0] == ChartRow(0, 4, 5, 4)
    assert len(file.problems) == 5


def test_cells_that_are_no_whole_numbers(write):
    path = write(ROWS + "0,four,5,5\n-5,,0,4\n5.5,,5,\n")
    assert problems_of(path, read_chart_file) == [
        (
            "F:2: difference_to 'four' isn't a whole number from 0 to 1,000,000. Write "
            "points, such as 7."
        ),
        (
            "F:3: difference_from '-5' isn't a whole number from 0 to 1,000,000. Write "
            "points, such as 7."
        ),
        (
            "F:3: stronger_needs '0' isn't a whole number from 1 to 1,000. Write a "
            "number of games, such as 5."
        ),
        (
            "F:4: difference_from '5.5' isn't a whole number from 0 to 1,000,000. Write "
            "points, such as 7."
        ),
        "F:4: weaker_needs is empty. Write a number of games, such as 5.",
    ]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("a,b\n1,2\n", "has none of a chart's columns"),
        (ROWS, "has no rows below its header"),
        ("from,to,stronger\n0,,5\n", "there's no column 'weaker_needs'"),
        ("level,opponent_level\n3,3\n", "there's no column 'needs'"),
        (ROWS + "9,4,5,5\n", "difference_to in row 1 must be 9 or more"),
        ("", "is empty"),
    ],
)
def test_files_that_say_nothing_of_a_chart(write, text, problem):
    assert any(problem in one for one in problems_of(write(text), read_chart_file))


def test_a_chart_of_levels_needs_each_pair_once_only(write):
    half = write(LEVELS + "3,3,2,2\n4,3,3,2\n4,4,3,3\n")
    assert read_chart(half) == LevelChart("ours", [3, 4], [[2, 2], [3, 3]])
    one_column = write("level,opponent,games\n3,3,2\n4,3,3\n3,4,2\n4,4,3\n")
    assert read_chart(one_column) == read_chart(half)


def test_faults_of_a_chart_of_levels(write):
    path = write(LEVELS + "3,3,2,2\n4,3,3,2\n3,4,3,3\n5,5,4,4\n5,3,2,3\n")
    assert problems_of(path) == [
        "F: doesn't say how many games level 4 needs against level 4. Add a row.",
        "F: doesn't say how many games level 4 needs against level 5. Add a row.",
        "F: doesn't say how many games level 5 needs against level 4. Add a row.",
        "F:4: level 3 needs 3 games against level 4 here but 2 in line 3. Keep one of the two.",
        "F:6: level 5 needs 2 games against level 3, but level 3 needs 3",
    ]


def test_so_many_missing_pairs_are_counted(write):
    path = write("level,opponent_level,needs\n" + "".join(f"{i},{i},3\n" for i in range(9)))
    problems = problems_of(path)
    assert len(problems) == 21
    assert problems[-1] == "F: is missing 52 more pairs of levels"


@pytest.mark.parametrize("name", ["npl_10", "NPL-10", " npl 10 "])
def test_a_chart_is_found_by_its_name(name):
    assert find_chart(name) == chart("npl_10")
    assert find_chart("APA 8ball") == level_chart("apa_8ball")


def test_a_chart_is_found_by_its_file(write):
    path = write(ROWS + "0,,5,5\n")
    assert find_chart(path) == find_chart(str(path)) == Chart("ours", [(0, None, 5, 5)])
    assert problems_of(write("x"), find_chart) == problems_of(write("x"))


def test_a_chart_is_called_as_its_file_in_letters_that_print(tmp_path):
    path = tmp_path / "a\udcff\x1b.csv"
    path.write_text(ROWS + "0,,5,5\n")
    assert read_chart(path).name == r"a\udcff\x1b"


@pytest.mark.parametrize("name", ["x" * 5000, "x\0y", "no/such", "x\ny"])
def test_names_that_no_file_has(name):
    with pytest.raises(
        DataError, match=r"no chart or file with this name.*fargo_r6_hot"
    ) as refused:
        find_chart(name)
    assert "\n" not in str(refused.value)


def test_neither_a_name_nor_a_file():
    with pytest.raises(
        DataError, match=r"npl_9: there's no chart or file with this name.*npl_20, apa_8ball"
    ):
        find_chart("npl_9")


def test_the_beginning_of_a_name_brings_those_that_begin_so():
    with pytest.raises(DataError, match="Did you mean apa_8ball or apa_9ball"):
        find_chart("APA")


cells = st.sampled_from(["0", "4", "5", "9", "10", "", "x", "3.0", "99999999999", "é", '"', "-1"])
headers = st.sampled_from([ROWS, LEVELS, "from;to;stronger;weaker\n", "level\topponent\tgames\n"])


@given(st.data(), headers)
def test_no_file_makes_another_error(tmp_path_factory, data, header):
    separator = next(sign for sign in ";\t," if sign in header)
    row = st.lists(cells, min_size=3, max_size=5).map(separator.join)
    text = header + "\n".join(data.draw(st.lists(row, max_size=5)))
    path = tmp_path_factory.mktemp("charts") / "ours.csv"
    path.write_text(text, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with contextlib.suppress(DataError):
            assert isinstance(read_chart(path), Chart | LevelChart)


@given(st.sampled_from([b"", ROWS.encode(), LEVELS.encode()]), st.binary(max_size=60))
def test_no_bytes_make_another_error(tmp_path_factory, header, body):
    path = tmp_path_factory.mktemp("charts") / "ours.csv"
    path.write_bytes(header + body)
    with contextlib.suppress(DataError):
        assert read_chart(path).name == "ours"


def test_a_race_to_a_million_is_refused(tmp_path):
    path = tmp_path / "long.csv"
    path.write_text("from,to,stronger,weaker\n0,9,1000,1000\n10,,1000000,5\n")
    with pytest.raises(DataError, match=r"long.csv:3: stronger.*1,000"):
        read_chart(path)
