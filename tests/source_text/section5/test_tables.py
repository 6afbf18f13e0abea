from decimal import Decimal
from fractions import Fraction

import pytest

from evenbreak.handicaps import chart
from evenbreak.matches import race_win_probability
from evenbreak.source_text.answers import DERIVED, section_5_findings
from evenbreak.source_text.published import row_of
from evenbreak.source_text.section5.tables import (
    PROBLEMS,
    chart_rows,
    eight_ball_rows,
    ladder_rows,
    off_rule_rows,
    problem_tables,
    score_tables,
    table_rows,
)


@pytest.mark.parametrize(
    ("table", "count", "quantities"),
    [("5.1", 10, 1), ("5.2", 14, 4), ("5.3", 25, 3), ("5.4", 10, 3), ("5.5", 7, 13)],
)
def test_tables_have_all_rows_and_nothing_is_missing(table, count, quantities):
    rows = table_rows(section_5_findings(), f"Table {table}")
    assert len(rows) == count
    printed = [name for name in rows[0] if name.endswith("_printed")]
    assert len(printed) == quantities
    for row in rows:
        assert list(row) == list(rows[0])
        for name in printed:
            assert abs(row[name.removesuffix("_printed")] - row[name]) <= Decimal("0.1")


def test_table_5_2_at_96_percent():
    rows = {row["p"]: row for row in table_rows(section_5_findings(), "Table 5.2")}
    row = rows[Decimal("0.96")]
    assert (row["mean_run"], row["median_run"]) == (24, 16)
    assert (str(row["median_bound"]), str(row["median_bound_printed"])) == ("15.97974802", "15.9")


def test_unknown_table():
    with pytest.raises(KeyError, match=r"5\.7"):
        table_rows(section_5_findings(), "Table 5.7")


def test_score_tables_are_exact_and_follow_each_other():
    tables = {name: {row["m"]: row for row in rows} for name, rows in score_tables().items()}
    scores, matches = (tables[f"problem_5_06_{name}_p_2_3"] for name in ("scores", "matches"))
    assert float(scores[3]["n_1"]) == pytest.approx(float(Fraction(32, 81)), abs=1e-10)
    assert float(matches[3]["n_2"]) == pytest.approx(float(Fraction(16, 27)), abs=1e-10)
    for m, n in ((1, 1), (3, 2), (9, 5), (10, 10)):
        exact = race_win_probability(2 / 3, m, n)
        assert float(matches[m][f"n_{n}"]) == pytest.approx(exact, abs=1e-9)
    even = tables["problem_5_06_scores_p_1_2"]
    assert all(even[m][f"n_{n}"] == even[n][f"n_{m}"] for m in range(10) for n in range(10))


def test_charts():
    rows = chart_rows()
    counts = [sum(row["chart"] == number for row in rows) for number in (8, 10, 12, 20)]
    assert counts == [6, 8, 11, 19]
    assert list(rows[1].values()) == [8, 4, 3, 7, 19, 7, 18]
    for row in rows:
        printed = chart(f"npl_{row['chart']}").race(row["difference_from_printed"])
        assert printed == (row["stronger_needs"], row["weaker_needs"])


def test_places_off_the_rule():
    rows = off_rule_rows()
    places = [(row["chart"], row["difference"]) for row in rows]
    assert places == [(8, 19), (8, 29), (10, 46), (12, 58), (20, 45), (20, 68), (20, 98)]
    assert (round(rows[2]["w_printed"], 3), round(rows[2]["w"], 3)) == (
        Decimal("0.582"),
        Decimal("0.428"),
    )


def test_the_8_ball_drill_balances():
    for row in eight_ball_rows():
        shares = [float(row[f"d{level}"]) for level in range(1, 8)]
        assert sum(shares) == pytest.approx(1, abs=1e-8)
        for level in range(1, 7):
            up = shares[level - 1] * float(row["p"]) ** level
            down = shares[level] * (1 - float(row["p"]) ** (level + 1))
            assert up == pytest.approx(down, abs=1e-9)


def test_ladder():
    rows = ladder_rows(section_5_findings())
    assert [row["chart"] for row in rows] == [8, 10, 12, 20]
    assert [row["even_up_to"] for row in rows] == [6, 5, 4, 2]
    for row in rows:
        for kind in ("sd_natural", "sd_autocorrelated"):
            assert abs(row[kind] - row[f"{kind}_printed"]) < Decimal("0.0005")


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
