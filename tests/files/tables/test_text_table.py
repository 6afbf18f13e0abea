import csv
import hashlib
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.tables.table import read_table

REQUIRED = {"name": ["player"], "score": ["games won"]}
OPTIONAL = {"note": []}


@pytest.fixture
def read(tmp_path):
    def read_content(content):
        path = tmp_path / "t.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_table(path, REQUIRED, OPTIONAL)

    return read_content


def problems(table):
    with pytest.raises(DataError) as caught:
        table.problems.raise_any()
    return [problem.rpartition("t.csv")[2] for problem in caught.value.problems]


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_separators_line_ends_and_byte_order_mark(read, separator, end, mark):
    rows = [("Name", "Score"), ("Zoë", "7"), ("Bo", "5")]
    table = read(mark + end.join(separator.join(row) for row in rows) + end)
    assert table.cells("name") == ["Zoë", "Bo"]
    assert table.cells("score") == ["7", "5"]
    assert table.lines.tolist() == [2, 3]
    assert table.warnings == ()
    table.problems.raise_any()


@pytest.mark.parametrize(
    "header", ["name,score", "NAME,SCORE", " Name , Score", "Player,Games Won", "player,games_won"]
)
def test_header_names_in_any_case_and_by_their_aliases(read, header):
    assert read(f"{header}\nBo,5\n").cells("score") == ["5"]


@pytest.mark.parametrize("first", ["sep={}", "SEP={}", '"sep={}"', "\ufeffsep={}", "sep={} "])
@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_first_line_may_say_the_separator(read, first, separator, end):
    rows = [("name", "score", "note"), ("Zoë", "7", "a,b;c"), ("Bo", "x", "")]
    lines = (separator.join(f'"{cell}"' for cell in row) for row in rows)
    content = end.join([first.format(separator), *lines, ""])
    table = read(content)
    assert table.cells("name") == ["Zoë", "Bo"]
    assert table.cells("note") == ["a,b;c", ""]
    assert table.lines.tolist() == [3, 4]
    assert table.sha256 == hashlib.sha256(content.encode()).hexdigest()
    assert table.warnings == ()
    table.problems.raise_any()


def test_a_separator_is_said_in_a_line_of_its_own(read):
    table = read("sep=;name;score\nx;Bo;5\n")
    assert (table.cells("name"), table.lines.tolist()) == (["Bo"], [2])
    with pytest.raises(DataError, match="has no rows"):
        read("sep=;\n")


def test_commas_in_other_columns_do_not_mislead_the_separator(read):
    table = read("name;a,b,c,d,e;score\nBo;x,y;5\n")
    assert table.cells("score") == ["5"]


def test_a_header_of_one_known_column_still_finds_its_separator(read):
    assert "score" in problems(read("name;points\nBo;5\n"))[0]


def test_blank_lines_are_skipped_and_lines_counted_as_an_editor_counts(read):
    table = read('\n\nname,score\n\nBo,5\n,\n"A\nB",7\n  \nCy,1\n')
    assert table.cells("name") == ["Bo", "A\nB", "Cy"]
    assert table.lines.tolist() == [5, 7, 10]
    table.problems.raise_any()


def test_cells_are_stripped_and_quotes_understood(read):
    table = read('name, score\n "Lee, Ann", 7 \n"a ""b"" c",5\nJoe "Fats" Doe,3\n')
    assert table.cells("name") == ["Lee, Ann", 'a "b" c', 'Joe "Fats" Doe']
    assert table.cells("score") == ["7", "5", "3"]


def test_an_optional_column_that_is_missing_reads_as_empty(read):
    table = read("name,score\nBo,5\nCy,6\n")
    assert "note" not in table
    assert table.cells("note") == ["", ""]
    assert table.warnings == ()


def test_unknown_columns_are_told(read):
    table = read("name,score,round,\nBo,5,1,\n")
    assert table.warnings[0].endswith("columns not used: 'round'")


def test_missing_and_doubled_columns_are_told_together(read):
    told = problems(read("name,player,points\nBo,Bo,5\n"))
    assert told[0].startswith(":1: columns 'name' and 'player' both mean name")
    assert told[1].startswith(":1: there's no column 'score' among 'name', 'player', 'points'")
    assert "'games won'" in told[1]


def test_rows_of_the_wrong_width_are_told_and_the_rest_kept(read):
    table = read("name,score\nBo\nCy,5,,\nDi,6,7\nEd,8\n")
    assert table.cells("name") == ["Cy", "Ed"]
    assert [text.split(";")[0] for text in problems(table)] == [
        (
            ":2: has 1 cell, but the header has 2. Add what's missing, or put cells that "
            "contain the separator in quotes."
        ),
        (
            ":4: has 3 cells, but the header has 2. Add what's missing, or put cells that "
            "contain the separator in quotes."
        ),
    ]


@pytest.mark.parametrize("rest", ['"Bo,5\nCy,6\n', f'"{"x" * 200_000}\nCy,6\n'])
def test_a_quote_that_is_never_closed_is_told_where_it_opens(read, rest):
    told = problems(read(f"name,score\nAl,1\n{rest}"))
    assert told[0].startswith(":3: can't be split into cells")


def test_text_after_a_closing_quote_is_told_and_the_rest_kept(read):
    table = read('name,score\n"Bo"x,5\nCy,6\n')
    assert table.cells("name") == ["Cy"]
    assert problems(table)[0].startswith(":2: can't be split")


def test_a_header_alone_is_a_table_without_rows(read):
    table = read("name,score")
    assert len(table) == 0
    assert table.cells("name") == []


def test_a_lone_quote_is_refused(read):
    with pytest.raises(DataError, match="has no rows"):
        read('"')


def test_many_rows_keep_their_order_and_lines(read):
    rows = "".join(f"p{k % 100},{k}\n" + "\n" * (k % 5 == 0) for k in range(5_000))
    table = read("name,score\n" + rows)
    assert table.cells("score") == [str(k) for k in range(5_000)]
    assert table.columns["name"].distinct == [f"p{k}" for k in range(100)]
    assert table.lines.tolist() == [2 + k + (k + 4) // 5 for k in range(5_000)]


def test_rows_that_were_there_before_in_every_column_are_found(tmp_path):
    names = [f"column {k}" for k in range(8)]
    rows = [",".join([str(k)] * 8) for k in range(300)]  # 300⁸ is more than 64 bits hold
    path = tmp_path / "t.csv"
    path.write_text("\n".join([",".join(names), *rows, rows[7], rows[7].replace("7", "8", 1)]))
    table = read_table(path, {name: [] for name in names})
    assert table.repeated().nonzero()[0].tolist() == [300]


@given(st.binary(max_size=200))
def test_any_bytes_give_a_table_or_a_data_error(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "any.csv"
    path.write_bytes(content)
    try:
        table = read_table(path, REQUIRED, OPTIONAL)
        table.problems.raise_any()
        whole, told = set(REQUIRED) <= table.found, ()
    except DataError as error:
        whole, told = False, error.problems
    assert whole != (len(told) > 0)
    assert all(line.startswith(str(path)) for line in told)


CELLS = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=8).filter(
    lambda text: text == text.strip()
)


@given(
    st.lists(st.tuples(CELLS.filter(bool), CELLS), max_size=20),
    st.sampled_from([",", ";", "\t"]),
    st.sampled_from(["\n", "\r\n"]),
    st.booleans(),
)
def test_what_is_written_is_read(tmp_path_factory, rows, separator, end, mark):
    out = io.StringIO(newline="")
    writer = csv.writer(out, delimiter=separator, lineterminator=end, quoting=csv.QUOTE_ALL)
    lines = []
    for row in [("name", "score"), *rows]:
        text = out.getvalue()
        lines.append(len(text.replace("\r\n", "\n").replace("\r", "\n").split("\n")))
        writer.writerow(row)
    path = tmp_path_factory.getbasetemp() / "written.csv"
    path.write_bytes(out.getvalue().encode("utf-8-sig" if mark else "utf-8"))
    table = read_table(path, REQUIRED, OPTIONAL)
    table.problems.raise_any()
    assert list(zip(table.cells("name"), table.cells("score"), strict=True)) == rows
    assert table.lines.tolist() == lines[1:]
