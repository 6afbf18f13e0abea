from itertools import product

import pytest

from derived import derived
from evenbreak.practice import one_ball_win
from evenbreak.source_text.section5 import one_ball
from evenbreak.source_text.section5.rows import formulas


def test_steps_go_to_the_limit():
    found = derived(one_ball, "P5.23")
    for start, where in product(("v", "w"), ("W", "S1", "S2", "L")):
        inputs = f"p1=0.4 p2=0.8 node={where}"
        last, limit = found[f"{start}, step 5", inputs], found[f"{start}, limit", inputs]
        assert last == pytest.approx(limit, abs=0.02)
    assert found["v, step 2", "p1=0.4 p2=0.8 node=S1"] == pytest.approx(0.12)


def test_the_formula_of_two_shots():
    p1, p2 = 0.4, 0.8
    win = eval(formulas("P5.21")[0].computed, {"p1": p1, "p2": p2})  # noqa: S307
    assert win == pytest.approx(one_ball_win(p1, p2, look_ahead="two shots"), rel=1e-14)


def test_formulas_are_the_limits_of_the_diagram():
    sympy = pytest.importorskip("sympy", reason="formulas need the extra `symbolic`")
    from evenbreak.chains import symbolic_limit

    p1, p2 = sympy.symbols("p1 p2")
    arcs = [("S1", "W", p1), ("S1", "S2", 1 - p1), ("S2", "L", p2), ("S2", "S1", 1 - p2)]
    limits = {"v": symbolic_limit(arcs, "S1"), "w": symbolic_limit(arcs, "S2")}
    half = {node: (limits["v"][node] + limits["w"][node]) / 2 for node in ("W", "L")}
    found = [row for row in formulas("P5.23") if row.quantity.endswith(", limit")]
    assert len(found) == 12
    for row in found:
        start = row.quantity.removeprefix("formula: ").removesuffix(", limit")
        exact = limits.get(start, half).get(row.inputs.removeprefix("node="), 0)
        assert sympy.simplify(sympy.sympify(row.computed) - exact) == 0, row
