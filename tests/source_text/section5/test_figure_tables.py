from decimal import Decimal

import numpy as np
import pytest

from evenbreak.games import Ahead, Rack
from evenbreak.matches import win_probability
from evenbreak.source_text.section5.tables import figure_tables


@pytest.fixture(scope="module")
def tables():
    return figure_tables()


def at(rows, **inputs):
    """Return the one row with these inputs, without them."""
    (row,) = [row for row in rows if all(float(row[k]) == v for k, v in inputs.items())]
    return {name: cell for name, cell in row.items() if name not in inputs}


def test_curves_of_races(tables):
    rows = tables["figure_5_1"]
    assert (len(rows), len(rows[0])) == (101, 21)
    even = at(rows, p=0.5)
    assert {even[f"w_{n}_{n}"] for n in range(1, 11)} == {Decimal("0.500000")}
    assert even["w_2_1"] == Decimal("0.250000")
    assert even["w_4_2"] == Decimal("0.187500")


def test_surfaces(tables):
    shots = at(tables["figure_5_3"], p1=0.4, p2=0.8)
    assert list(map(str, shots.values())) == ["0.454545", "0.460000"]
    breaks = at(tables["figure_5_6"], p1=0.9, p2=0.5)
    assert list(map(str, breaks.values())) == ["0.833333", "0.642857", "0.700000", "0.190476"]
    assert len(tables["figure_5_3"]) == len(tables["figure_5_6"]) == 19 * 19


def test_distributions_sum_to_one(tables):
    levels = np.array([list(row.values())[1:] for row in tables["figure_5_8"]], float)
    assert levels.sum(axis=1) == pytest.approx(1.0, abs=1e-5)
    errors = np.array([list(row.values())[1:] for row in tables["figure_5_9"]], float)
    assert errors.sum(axis=0) == pytest.approx(1.0, abs=1e-4)
    assert (errors == errors[::-1]).all()


def test_leads(tables):
    row = at(tables["figure_5_11"], p=0.6)
    for m in range(1, 6):
        exact = win_probability(Ahead(m, 6 - m, Rack(0.6)))
        assert float(row[f"w_{m}_{6 - m}"]) == pytest.approx(exact, abs=5e-7)
