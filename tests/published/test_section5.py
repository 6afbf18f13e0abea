"""Every number that section 5 of the text prints, beside what the library computes."""

import csv
import math
import re
from collections import Counter
from decimal import Decimal
from fractions import Fraction
from math import comb
from statistics import NormalDist, mean, pstdev

import pytest

from evenbreak.handicaps import chart
from evenbreak.handicaps.charts.off_rule import off_rule
from evenbreak.source_text.answers import SECTION_5, compute, section_5_findings
from evenbreak.source_text.pages import slips_of
from evenbreak.source_text.published import (
    PublishedNumber,
    errata,
    published_numbers,
    verdict_of,
)
from places import SHARED

SEED = SHARED / "seed" / "section5_numbers.csv"
TABLES = ("P(p;m,n)", "W(p;m,n)")
NUMBERS = [row for row in published_numbers() if row.quantity not in TABLES]


def complaint(row: PublishedNumber) -> str:
    """Return what is wrong with the computed number of a row, or nothing."""
    computed = float(compute(row.problem, row.quantity, row.inputs))
    far = row.verdict == "agrees" and abs(computed - float(row.printed)) > float(row.tolerance)
    verdict = verdict_of(row, computed)
    if verdict == row.verdict and not far:
        return ""
    return f"{row.quantity} {row.inputs}: {computed} is {verdict}; {row.printed} {row.verdict}"


@pytest.mark.parametrize("problem", sorted({row.problem for row in NUMBERS}))
def test_the_numbers_of_a_problem_have_the_verdicts_that_are_expected(problem: str) -> None:
    off = [complaint(row) for row in NUMBERS if row.problem == problem]
    assert not any(off), "\n".join(filter(None, off))


@pytest.mark.parametrize("p", ["1/2", "2/3"])
@pytest.mark.parametrize("quantity", TABLES)
def test_cells_of_the_four_tables(quantity: str, p: str) -> None:
    cells = [row for row in published_numbers() if row.quantity == quantity]
    cells = [row for row in cells if f"p={p} " in row.inputs]
    assert len(cells) == 100
    for row in cells:
        assert verdict_of(row, float(compute(*row[:3]))) == row.verdict, row


def test_every_number_of_the_list_is_computed() -> None:
    if not SEED.exists():
        pytest.skip("the list of printed numbers lies beside the repository only in development")
    found = {finding.published[:3]: finding for finding in section_5_findings()}
    with SEED.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        finding = found[row["problem"], row["quantity"], row["inputs"]]
        recomputed = pytest.approx(float(row["recomputed"]), rel=1e-9, abs=1e-13)
        if row["problem"] == "NPL" and row["quantity"].startswith("sd"):
            recomputed = pytest.approx(float(row["recomputed"]), abs=6e-5)  # listed to four places
        if not looser(row):
            assert finding.computed == recomputed, row
        assert finding.verdict == {"yes": "agrees"}.get(row["agrees"], row["agrees"])


def looser(row: dict[str, str]) -> bool:
    """Return whether the list computes with a table's rounded critical value, or rounded sd."""
    return row["quantity"].startswith(("80% interval", "standard units of a 53 over"))


def test_all_that_is_computed_is_printed_somewhere() -> None:
    asked = {row[:2] for row in published_numbers()}
    assert {key for part in SECTION_5 for key in part.ANSWERS} == asked


def test_errata_are_explained_where_they_occur() -> None:
    wrong = {row.problem for row in NUMBERS if row.verdict == "erratum"}
    assert {problem for problem in wrong if not slips_of(problem)} == set()
    assert len(errata()) == len(set(errata()))


def test_what_is_right_in_place_of_a_wrong_number() -> None:
    # By hand and by the standard library: no verdict tells an erratum from a wrong computation.
    crossing = (1 + math.sqrt(17)) / 8
    scores = [50, 44, 46, 52, 47, 51, 49, 45, 48, 50]
    normal, sd = NormalDist(), pstdev(scores)
    units = (53 - mean(scores)) / sd - normal.inv_cdf(0.9) / math.sqrt(10)
    right = {
        ("P5.7", "p where W(p;2,1)=W(p;4,2)"): [crossing],
        ("P5.10", "range low, normal"): [62.4 - normal.inv_cdf(0.975) * math.sqrt(62.4 * 0.48)],
        ("P5.17", "relative deviation"): [1 / math.sqrt(5 * 0.96)],
        ("P5.19", "chance of a score so far out"): [2 * normal.cdf(-units)],
        ("P5.19", "confidence, 1 less that chance"): [1 - 2 * normal.cdf(-units)],
        ("P5.22", "W infinite look-ahead"): [10 / 11],
        ("Table 5.4", "W winner breaks less 1/2"): [1 / 22],
        ("P5.25", "expected points per game"): [1 / 2, -1 / 14],
    }
    found: dict[tuple[str, str], list[float]] = {}
    for row in NUMBERS:
        if row.verdict == "erratum":
            found.setdefault(row[:2], []).append(float(compute(*row[:3])))
    assert found == {key: pytest.approx(values, rel=1e-12) for key, values in right.items()}


def test_the_slip_of_table_5_6_names_the_races_that_are_off_the_rule() -> None:
    (slip,) = slips_of("Table 5.6")
    charts = re.findall(r"([^()]+) \(chart (\d+)\)", slip.printed)
    for races, number in charts:
        for place in off_rule(chart(f"npl_{number}"), "npl"):
            m, n = place.race
            assert f"{m}:{n} " in races
            assert f" {place.difference}" in races
            assert "{}:{}".format(*place.nearest) in slip.correct
    assert [number for _, number in charts] == ["8", "10", "12", "20"]


def test_w_of_p5_7_is_right_at_the_printed_p_alone() -> None:
    at = {row.quantity: row for row in findings_of("P5.7") if row.inputs == "p=.641"}
    assert at["W(p;2,1)"].printed == at["W(p;4,2)"].printed == Decimal("0.411")
    for m, n in ((2, 1), (4, 2)):
        p = Fraction("0.641")
        win = float(sum(comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n)))
        assert compute("P5.7", f"W(p;{m},{n})", "p=.641") == pytest.approx(win, rel=1e-12)
        assert round(win, 3) == 0.411


def findings_of(problem: str) -> list[PublishedNumber]:
    return [row for row in NUMBERS if row.problem == problem]


def test_order_is_that_of_the_text() -> None:
    places = list(dict.fromkeys(finding.published.problem for finding in section_5_findings()))
    assert places[:4] == ["P5.1", "P5.2", "P5.3", "P5.4"]
    assert places[-4:] == ["P5.25", "Table 5.5", "NPL", "P5.27"]
    assert Counter(places).most_common(1)[0][1] == 1
