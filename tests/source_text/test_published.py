import csv
import math
from collections import Counter
from decimal import ROUND_HALF_UP, Decimal
from fractions import Fraction
from importlib.resources import files
from math import comb

import pytest

from evenbreak.source_text.answers import physics_findings, section_5_findings
from evenbreak.source_text.published import (
    Finding,
    PublishedNumber,
    deciding_tolerance,
    differing,
    errata,
    find,
    parse_inputs,
    physics_errata,
    physics_numbers,
    published_numbers,
    row_of,
    verdict_of,
)
from places import SHARED
from rows import each_of

SEED = SHARED / "seed"
VERDICTS = {"agrees", "erratum", "derived"}
REA25S = [published_numbers, physics_numbers]


def seed_rows(name):
    if not SEED.is_dir():
        pytest.skip("the list of printed numbers lies beside the repository only in development")
    with (SEED / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def rounded(value, printed):
    exact = Decimal(value.numerator) / Decimal(value.denominator)
    return exact.quantize(Decimal((0, (1,), printed.as_tuple().exponent)), ROUND_HALF_UP)


def score_chance(p, m, n):
    return comb(m + n, m) * p**m * (1 - p) ** n


def win_chance(p, m, n):
    return sum(comb(m + k - 1, k) * p**m * (1 - p) ** k for k in range(n))


def test_every_number_of_the_list_is_here_with_its_tolerance_and_verdict():
    verdicts = {"yes": "agrees", "erratum": "erratum", "derived": "derived"}
    listed = [
        (
            row["problem"],
            row["quantity"],
            row["inputs"],
            Decimal(row["printed"]) if row["printed"] else None,
            Decimal(row["tolerance"]),
            verdicts[row["agrees"]],
        )
        for row in seed_rows("section5_numbers.csv")
    ]
    assert set(listed) <= {tuple(row[:6]) for row in published_numbers()}


def test_every_slip_of_the_list_is_here():
    # The list names two of the places as here, the others by what they are about.
    places = {
        "P5.14 / P5.17": "P5.14 and P5.17",
        "S5 transition matrices": "Markov analysis, before P5.23",
        "P5.27 / n-ahead": "P5.27",
    }
    listed = {places.get(row["where"], row["where"]) for row in seed_rows("errata_section5.csv")}
    assert listed <= {slip.where for slip in errata()}


def test_how_many_there_are():
    assert Counter(row.verdict for row in published_numbers()) == {
        "agrees": 796,
        "derived": 25,
        "erratum": 9,
    }


@pytest.mark.parametrize("reader", REA25S)
def test_problem_quantity_and_inputs_name_a_number(reader):
    names = Counter(row[:3] for row in reader())
    assert [name for name, count in names.items() if count > 1] == []


@pytest.mark.parametrize("reader", REA25S)
def test_rows_are_whole(reader):
    for row in reader():
        assert row.problem, row
        assert row.quantity, row
        more = {"formula", "given"} if reader is physics_numbers else set()
        assert row.verdict in VERDICTS | more, row
        assert row.tolerance >= 0, row
        assert (row.printed is None) == (row.verdict == "derived"), row
        assert row.verdict != "erratum" or row.note, row


def test_what_the_value_of_a_number_is():
    assert {row.value_is for row in published_numbers()} == {"printed"}
    for row in physics_numbers():
        assert row.value_is in {"printed", "formula", "words", ""}, row
        assert (row.value_is == "") == (row.printed is None), row
        assert row.verdict != "formula" or row.value_is == "formula", row


def test_damage_to_the_copy_is_not_called_a_slip():
    copies = {slip.printed for slip in physics_errata() if slip.class_ == "copy"}
    assert any(text.startswith("T = T_0 + M_f/(3 M_s)") for text in copies)
    assert any("omega_bv" in text for text in copies)


def test_digits_are_kept_as_printed():
    printed = {row[:3]: str(row.printed) for row in published_numbers()}
    assert printed["P5.22", "W infinite look-ahead", "p1=0.9 p2=0.9"] == "0.90"
    assert printed["Table 5.5", "d9", "p=0.5 p_i=p^(i-1)"] == "0.000"
    assert printed["Table 5.2", "mean run", "p=0.8"] == "4.0"
    assert printed["Table 5.4", "W alternate breaks", "row=10 p1=0.95 p2=0.94"] == "0.505"


def p5_6_tables():
    return [row for row in published_numbers() if row.quantity in ("P(p;m,n)", "W(p;m,n)")]


def test_cells_of_the_four_tables_are_the_exact_values_rounded():
    chances = {"P(p;m,n)": score_chance, "W(p;m,n)": win_chance}
    for cell in p5_6_tables():
        p, m, n = (Fraction(part.split("=")[1]) for part in cell.inputs.split())
        exact = chances[cell.quantity](p, int(m), int(n))
        if cell.printed is None:
            assert (cell.quantity, p, m) == ("W(p;m,n)", Fraction(2, 3), 10)
            assert "not legible" in cell.note
        else:
            assert rounded(exact, cell.printed) == cell.printed, cell
            assert abs(float(exact) - float(cell.printed)) <= cell.tolerance, cell


def test_four_tables_have_each_cell_once():
    found = [(cell.quantity, cell.inputs) for cell in p5_6_tables()]
    assert found == [
        (f"{table}(p;m,n)", f"p={p} m={m} n={n}")
        for p in ("1/2", "2/3")
        for table, first in (("P", 0), ("W", 1))
        for m in range(first, first + 10)
        for n in range(first, first + 10)
    ]


@pytest.mark.parametrize("slips", [errata, physics_errata])
def test_slips_are_complete_in_one_line_each(slips):
    for slip in slips():
        assert slip.where, slip
        assert slip.printed, slip
        assert slip.kind, slip
        assert slip.why.endswith("."), slip
        assert slip.class_ in {"slip", "remark", "copy"}, slip
        assert slip.correct or slip.class_ == "copy", slip
        assert (slip.kind == "scan") == (slip.class_ == "copy"), slip


def test_what_is_no_slip_is_called_a_remark():
    remarks = [(slip.where, slip.kind) for slip in errata() if slip.class_ == "remark"]
    assert ("P5.14 and P5.17", "numerical trap") in remarks
    assert ("Drills, before P5.26", "condition too narrow") in remarks
    assert ("P5.19", "rounded twice") in remarks
    assert not any(kind in {"cut off", "last digit", "rounded inputs"} for _, kind in remarks)


def test_every_number_called_a_slip_is_among_the_slips():
    places = " ".join(slip.where for slip in errata() if slip.class_ == "slip")
    for row in published_numbers():
        assert row.verdict != "erratum" or row.problem in places, row


@pytest.mark.parametrize(
    "name",
    [
        "physics_errata.csv",
        "physics_numbers.csv",
        "section5_errata.csv",
        "section5_numbers.csv",
    ],
)
def test_files_are_plain(name):
    content = files("evenbreak.source_text").joinpath("published", name).read_bytes()
    assert b"\r" not in content
    assert content.endswith(b"\n")
    lengths = {len(row) for row in csv.reader(content.decode("utf-8").splitlines())}
    assert len(lengths) == 1


@each_of(
    "text, numbers, words",
    [
        ("", {}, []),
        ("p=2/3", {"p": (Fraction(2, 3),)}, []),
        ("N=120 p=.52", {"N": (120,), "p": (Fraction(13, 25),)}, []),
        ("x=0 1 1 4 5", {"x": (0, 1, 1, 4, 5)}, []),
        ("scores 50 44", {"scores": (50, 44)}, ["scores"]),
        ("mean run 24", {"run": (24,)}, ["mean", "run"]),
        ("1 2 4 5", {"": (1, 2, 4, 5)}, []),
        ("3:1 sets of 3:3", {"": (3, 1), "of": (3, 3)}, ["sets", "of"]),
        ("p=0.5 p_i=p^(i-1)", {"p": (Fraction(1, 2),)}, []),
        (
            "winner breaks p1=.9 win 1.0 lose 2.0",
            {"p1": (Fraction(9, 10),), "win": (1,), "lose": (2,)},
            ["winner", "breaks", "win", "lose"],
        ),
    ],
)
def test_numbers_are_exact_and_belong_to_the_name_before_them(text, numbers, words):
    found = parse_inputs(text)
    assert (found.numbers, found.words) == (numbers, words)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("alpha=30deg", math.pi / 6),
        ("alpha=0.55", 0.55),
        ("Jz=-.2", -0.2),
        ("mu=4/72", 1 / 18),
        ("V_0=50in/s", 50 * 0.0254),
        ("D=36in", 36 * 0.0254),
        ("M=3oz", 3 * 0.028349523125),
        ("t=7.00s", 7.0),
    ],
)
def test_a_number_is_taken_in_si_units(text, value):
    name = text.partition("=")[0]
    assert parse_inputs(text)[name] == pytest.approx(value, rel=1e-15)


def test_a_text_is_kept_where_it_has_a_name():
    found = parse_inputs("nine-foot table class=very_slow")
    assert found["class"] == "very slow"
    assert found.get("balls", "pool") == "pool"
    with pytest.raises(KeyError):
        found["balls"]


def test_one_number_must_be_one():
    with pytest.raises(ValueError, match="unpack"):
        parse_inputs("1 2").one()


NUMBER = PublishedNumber("P4.19", "half", "p=1/2", Decimal("0.90"), Decimal("0.0101"), "agrees", "")


@pytest.mark.parametrize(
    ("expected", "computed", "verdict"),
    [
        ("agrees", 0.909, "agrees"),
        ("agrees", 0.92, "differs"),
        ("agrees", None, "differs"),
        ("formula", 0.9, "formula"),
        ("given", None, "given"),
        ("given", 0.9, "given"),
        ("given", 1.0, "differs"),
        # An erratum is right only within half its last place.
        ("erratum", 0.909, "erratum"),
        ("erratum", 0.904, "agrees"),
    ],
)
def test_the_verdict_on_a_number(expected, computed, verdict):
    assert verdict_of(NUMBER._replace(verdict=expected), computed) == verdict


def test_what_is_not_printed_is_derived():
    assert verdict_of(NUMBER._replace(printed=None), 0.5) == "derived"


def test_an_erratum_is_not_excused_by_its_tolerance():
    assert deciding_tolerance(NUMBER) == Decimal("0.0101")
    assert deciding_tolerance(NUMBER._replace(verdict="erratum")) == Decimal("0.005")


def test_a_number_is_computed_from_its_inputs():
    answers = {("P4.19", "half"): lambda inputs: inputs["p"] + 0.4}
    assert list(find([NUMBER], answers)) == [Finding(NUMBER, 0.9, "agrees")]
    given = NUMBER._replace(quantity="not held", verdict="given")
    assert list(find([given], answers)) == [Finding(given, None, "given")]
    with pytest.raises(KeyError):
        list(find([given._replace(verdict="agrees")], answers))


def test_nothing_differs():
    assert list(differing((*physics_findings(), *section_5_findings()))) == []


@pytest.mark.parametrize("computed", [2.5, None])
def test_what_differs_is_named(computed):
    wrong = section_5_findings()[0]._replace(verdict="differs", computed=computed)
    (line,) = differing([wrong])
    for words in ("P5.1: mean (x=0 1 1 4 5)", "2.2", "2.5" if computed else "nothing", "agrees"):
        assert words in line


def test_a_row_is_what_is_said_of_a_number():
    rows = {finding.published.quantity: row_of(finding) for finding in physics_findings()}
    row = rows["alpha_max, deg"]
    assert (row["printed"], row["computed"]) == (Decimal("28.125"), Decimal("28.1255057"))
    assert (row["difference"], row["tolerance"]) == (Decimal("0.0005057021"), Decimal("0.0005"))
    assert row["verdict"] == "erratum"
    assert rows["lag time, s"]["computed"] is rows["lag time, s"]["difference"] is None
    assert rows["full throw, deg"]["printed"] is rows["full throw, deg"]["difference"] is None


def test_a_filter_by_the_tolerance_finds_the_errata_and_nothing_else():
    for found in (section_5_findings(), physics_findings()):
        rows = [row_of(finding) for finding in found]
        known = [row for row in rows if row["difference"] is not None]
        off = [row for row in known if abs(row["difference"]) > row["tolerance"]]
        assert off == [row for row in rows if row["verdict"] == "erratum"]
