import csv
import io

import pytest

from evenbreak.source_text.physics.numbers import physics_findings
from evenbreak.source_text.reproduce import differing, reproduction
from evenbreak.source_text.section5.numbers import findings
from places import ROOT

REPORTS = ROOT / "reports"


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def files(told):
    return reproduction(told.append)


def test_everything_is_written(files):
    assert {f"table_5_{n}.csv" for n in range(1, 7)} <= set(files)
    assert {f"problem_5_{n:02}.csv" for n in range(1, 28)} <= set(files)
    assert {f"figure_5_{n}.{kind}" for n in range(1, 12) for kind in ("png", "svg")} <= set(files)
    assert {"figure_p5_24.png", "npl_ladder.csv", "published.csv", "errata.csv"} <= set(files)
    assert {"published_physics.csv", "errata_physics.csv"} <= set(files)
    assert {f"figure_{n}.svg" for n in ("3_1", "3_2", "3_3", "3_4")} <= set(files)
    assert {f"figure_{n}.svg" for n in ("4_4", "4_5", "4_7", "4_8")} <= set(files)
    assert list(files)[:2] == ["index.md", "physics.md"]
    assert all(files.values())


def test_it_says_what_it_does(files, told):
    figures = sum(name.endswith(".png") for name in files)
    assert told == ["Computing the tables and problems", f"Drawing {figures} figures"]


def test_tables_are_even_and_no_text_is_a_formula(files):
    for name, content in files.items():
        if name.endswith(".csv"):
            rows = list(csv.reader(io.StringIO(content.decode())))
            assert len({len(row) for row in rows}) == 1, name
            assert not any(cell.startswith("'") for row in rows for cell in row), name


def test_nothing_differs():
    assert list(differing(findings())) == []
    assert list(differing(physics_findings())) == []


def test_what_differs_is_told():
    finding = findings()[0]
    wrong = finding._replace(verdict="differs", computed=2.5)
    assert list(differing([wrong])) == [
        "P5.1: mean (x=0 1 1 4 5): printed 2.2, computed 2.5: differs, not agrees"
    ]


def test_a_number_of_the_table_side_that_differs_is_told():
    wrong = physics_findings()[0]._replace(verdict="differs", computed=None)
    assert list(differing([wrong])) == [
        "Section 1: diameter, in (balls=pool n=1): printed 2.25, computed nothing: "
        "differs, not given"
    ]


def test_committed_reports_are_these(files):
    if not (REPORTS / "index.md").exists():
        pytest.skip("no reports lie beside this copy of the program")
    # Pictures depend on the version of matplotlib; `make drift` compares them where it is fixed.
    stale = [
        name
        for name, content in files.items()
        if name.endswith((".csv", ".md")) and (REPORTS / name).read_bytes() != content
    ]
    assert stale == [], "run `make reports`"
