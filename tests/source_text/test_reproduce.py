import csv
import io

import pytest

from evenbreak.plots.picture import image_bytes
from evenbreak.source_text.cells import csv_bytes
from evenbreak.source_text.graph_to_limit import game_tables
from evenbreak.source_text.reproduce import all_findings, figures, physics_tables, section_5_tables
from places import ROOT

REPORTS = ROOT / "reports"


@pytest.fixture(scope="module")
def files(reports):
    return reports


def test_everything_is_written(files):
    tables = {f"{name}.csv" for name in {**section_5_tables(), **physics_tables(), **game_tables()}}
    pictures = {f"{name}.{kind}" for name in figures() for kind in ("png", "svg")}
    assert {"index.md", "physics.md", "graph_to_limit.md"} | tables | pictures <= set(files)
    assert all(files.values())


@pytest.mark.slow
def test_this_process_writes_the_same_bytes(files):
    tables = {**section_5_tables(), **physics_tables(), **game_tables()}
    assert [name for name in tables if csv_bytes(tables[name]) != files[f"{name}.csv"]] == []
    for name in ("figure_1_1", "figure_4_8", "figure_5_2", "figure_5_11"):
        figure = figures()[name]()
        for kind in ("png", "svg"):
            assert image_bytes(figure, kind) == files[f"{name}.{kind}"]


@pytest.mark.thorough
def test_another_country_writes_the_same_bytes(files, reproduced):
    assert reproduced.files == {name: files[name] for name in reproduced.files}


@pytest.mark.thorough
def test_it_says_what_it_does(reproduced):
    assert str(len(figures())) in reproduced.said[1]


def test_tables_are_even_and_no_text_is_a_formula(reports):
    for name, content in reports.items():
        if name.endswith(".csv"):
            rows = list(csv.reader(io.StringIO(content.decode())))
            assert len({len(row) for row in rows}) == 1, name
            assert not any(cell.startswith("'") for row in rows for cell in row), name


def test_all_findings_are_of_both_parts():
    problems = {finding.published.problem for finding in all_findings()}
    assert {"P1.1", "P4.27", "P5.1", "P5.27", "NPL"} <= problems


@pytest.mark.slow
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
