"""A kind of file is declared once: its columns are found, read and described by the schema."""

import column_tables
import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.tables.dates import Day
from evenbreak.files.tables.names import Name
from evenbreak.files.tables.schema import Number, Parsed, Schema, Text, Whole, Word, YesNo
from evenbreak.words import say

CUES = Schema(
    "cues",
    owner=Name("player, who", "whose it is", needed=True),
    weight=Number(
        "ounces, oz",
        "its weight",
        needed=True,
        least=10,
        most=30,
        write=say("ounces such as 19"),
        empty=say("for a house cue"),
    ),
    pieces=Whole(least=1, most=4, filled=True),
    break_cue=YesNo("breaks", "whether it is for the break", values={"yes": True, "no": False}),
    wrap=Word(values={"linen": 1, "none": 2}, choices=say("linen or none")),
    bought=Day("since"),
    tip=Parsed(parse={"soft": "S"}.get, kind=say("a tip"), write=say("soft")),
    note=Text(form=str.upper),
)


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "cues.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_columns_are_found_by_any_of_their_names_and_read_in_one_pass(written):
    table = CUES.read(
        written(
            "Who,OZ,pieces,Breaks,wrap,since,tip,note\n Ann  Lee ,19.5,2,yes,none,3.9.2024,soft,x\n"
        )
    )
    table.problems.raise_any()
    assert {name: table[name].tolist()[0] for name in ("owner", "weight", "pieces", "wrap")} == {
        "owner": "Ann Lee",
        "weight": 19.5,
        "pieces": 2,
        "wrap": 2,
    }
    assert (table["break_cue"][0], table["tip"][0], table["note"][0]) == (True, "S", "X")
    assert str(table["bought"][0]) == "2024-09-03"


def test_a_column_that_may_be_missing_has_what_an_empty_cell_means(written):
    table = CUES.read(written("owner,weight\nBo,\n"))
    table.problems.raise_any()
    assert np.isnan(table["weight"][0])
    assert (table["pieces"][0], table["break_cue"][0], table["tip"][0]) == (0, False, "")
    assert np.isnat(table["bought"][0])
    assert not table.read["weight"].stated[0]


def test_all_problems_come_at_once_each_with_its_line_and_remedy(written):
    path = written("owner,weight,pieces,wrap,tip\n,x,9,silk,hard\nBo,31,,,\n")
    with pytest.raises(DataError) as caught:
        CUES.read(path).problems.raise_any()
    assert [problem.removeprefix(f"{path}:") for problem in caught.value.problems] == [
        "2: owner is empty. Write a name.",
        (
            "2: weight 'x' isn't a number from 10 to 30. Write ounces such as 19, or "
            "leave it empty for a house cue."
        ),
        "2: pieces '9' isn't a whole number from 1 to 4. Write 1, 2, 3, ...",
        "2: wrap 'silk' isn't linen or none. Write linen or none, or leave it empty.",
        "2: tip 'hard' isn't a tip. Write soft, or leave it empty.",
        (
            "3: weight '31' isn't a number from 10 to 30. Write ounces such as 19, or "
            "leave it empty for a house cue."
        ),
        "3: pieces is empty. Write 1, 2, 3, ...",
    ]


def test_a_missing_column_is_named_with_its_other_names(written):
    path = written("owner,pieces\nBo,2\n")
    with pytest.raises(DataError, match=r"no column 'weight'.*'ounces' or 'oz'"):
        CUES.read(path).problems.raise_any()


def test_a_schema_can_be_changed_joined_and_cut(written):
    strict = CUES.but(weight={"filled": True, "most": 20}).only("weight")
    assert list(strict.columns) == ["weight"]
    assert strict["weight"].remedy == "Write ounces such as 19."
    assert CUES["weight"].most == 30
    more = strict | Schema(weight=Text(), color=Text())
    assert list(more.columns) == ["weight", "color"]
    assert isinstance(more["weight"], Text)
    path = written("weight\n25\n")
    assert len(strict.read(path).problems) == 1


def test_the_reference_describes_a_column_by_its_declaration():
    rows = column_tables.table_of(CUES, full=True).splitlines()[2:]
    assert rows[:2] == [
        "| `owner` | player, who | whose it is | a name; required |",
        "| `weight` | ounces, oz | its weight | a number from 10 to 30; required; empty for a "
        "house cue |",
    ]
    assert "| `bought` | since |  | a [date](#dates); may be empty |" in rows
