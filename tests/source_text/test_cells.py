from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from evenbreak.source_text.cells import (
    beside,
    csv_bytes,
    difference_cell,
    fixed_cell,
    markdown_table,
    number_cell,
    record,
    rounded,
)


# At 1e-14 itself, where noise ends, one side is written and the other is not.
@given(st.floats(-1e6, 1e6, allow_subnormal=False).filter(lambda x: not 0.9 < abs(x) * 1e14 < 1.1))
@example(0.20947265625)
@example(1.1e-14)
def test_cells_hide_the_noise_of_machines(value):
    noisy = [value * (1 + 2e-16), value * (1 - 2e-16)]
    assert {number_cell(v) for v in noisy} == {number_cell(value)}
    assert float(number_cell(value)) == pytest.approx(value, rel=1e-9, abs=1e-13)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1e-17, "0"),
        (-1e-17, "0"),
        (1200.0, "1200"),
        (Fraction(1, 3), "0.3333333333"),
        (0.11279296875, "0.1127929688"),
        (2.694665955e-9, "2.694665955E-9"),
    ],
)
def test_number_cells_as_written(value, text):
    assert str(number_cell(value)) == text


def test_fixed_cells_have_six_decimals():
    assert [str(fixed_cell(v)) for v in (0, 1, 1e-9, 0.0078125, 0.75)] == [
        "0.000000",
        "1.000000",
        "0.000000",
        "0.007812",
        "0.750000",
    ]


def test_difference_of_equal_numbers_is_zero():
    assert str(difference_cell(0.1 + 0.2, Decimal("0.3"))) == "0"
    assert str(difference_cell(0.5, Decimal("0.49"))) == "0.01"
    assert str(difference_cell(-1 / 14, Decimal("-0.08"))) == "0.0085714286"


@pytest.mark.parametrize("noise", [-2e-16, 0.0, 2e-16])
def test_difference_that_ends_in_a_half_hides_the_noise_of_machines(noise):
    assert str(difference_cell(0.80615234375 * (1 + noise), Decimal("0.806"))) == "0.0001523438"


def test_a_record_has_its_inputs_exactly_and_its_values_rounded():
    found = record({"panel": "a", "side": 0.25}, {"y": 1 / 3, "z": None})
    assert {name: str(cell) for name, cell in found.items()} == {
        "panel": "a",
        "side": "0.25",
        "y": "0.333333",
        "z": "None",
    }


def test_a_table_has_every_column_that_any_row_has():
    rows = [{"m": 1, "n": Decimal("0.5")}, {"m": 2, "text": "=1+1", "n": None}]
    assert csv_bytes(rows) == b"m,n,text\n1,0.5,\n2,,'=1+1\n"


def test_bars_in_cells_do_not_end_them():
    assert markdown_table(["a", "b"], [["|z|", 1]]).splitlines()[-1] == "| &#124;z&#124; | 1 |"


def test_columns_flush_left():
    assert markdown_table(["a", "b", "c"], [], left=2).splitlines()[1] == "|:--|:--|--:|"


def test_halves_are_rounded_up():
    assert [rounded(Decimal(v), 2) for v in ("0.145", "0.545", "2", "-0.005")] == [
        "0.15",
        "0.55",
        "2.00",
        "-0.01",
    ]


def test_printed_number_is_shown_where_rounding_does_not_lead_to_it():
    assert beside(Decimal("0.5455"), Decimal("0.54"), 3) == "0.546 (text: 0.54)"
    assert beside(Decimal("0.6429"), Decimal("0.64"), 3) == "0.643"
    assert beside(Decimal("7"), None, 0) == "7"
