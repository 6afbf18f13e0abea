import pytest

from evenbreak.source_text.answers import section_5_findings
from evenbreak.source_text.findings import row_of
from evenbreak.source_text.section5.problems import DERIVED, PROBLEMS, problem_tables


@pytest.fixture(scope="module")
def tables():
    return problem_tables(section_5_findings())


def test_every_problem_has_an_answer(tables):
    assert list(tables) == [f"problem_5_{n:02}" for n in range(1, 28)]
    columns = list(row_of(section_5_findings()[0]))
    for name, rows in tables.items():
        assert len(rows) >= 4, name
        for row in rows:
            assert list(row) == columns, name
            assert row["computed"] is not None, name
    assert set(DERIVED) <= set(PROBLEMS)


def test_quantity_and_inputs_name_a_row(tables):
    for name, rows in tables.items():
        named = [(row["quantity"], row["inputs"], row["verdict"], row["note"]) for row in rows]
        assert len(set(named)) == len(named), name


def test_printed_numbers_come_first(tables):
    printed = [row["printed"] is not None for row in tables["problem_5_07"]]
    assert printed == sorted(printed, reverse=True)


def test_what_agrees_and_is_not_rounded_is_said_to_be_cut_off():
    agreed = [finding for finding in section_5_findings() if finding.verdict == "agrees"]
    cut_off = [
        (row.problem, str(row.printed))
        for row, computed, _ in agreed
        if abs(computed - float(row.printed)) > 0.51 * 10.0 ** row.printed.as_tuple().exponent
    ]
    noted = [
        (row.problem, str(row.printed)) for row, *_ in agreed if row.note.startswith("cut off")
    ]
    assert cut_off == noted
    assert cut_off == [("Table 5.2", "15.9"), ("Table 5.2", "67.9"), ("Table 5.4", "0.54")]
