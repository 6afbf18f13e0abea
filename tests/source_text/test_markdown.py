from decimal import Decimal

from evenbreak.source_text.cells import beside, markdown_table, rounded


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
