import re
from itertools import product

import pytest

from derived import derived
from evenbreak.chains import chain_of, spectrum
from evenbreak.games import Ahead, Rack
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.series import Series
from evenbreak.matches import win_probability
from evenbreak.practice import long_run_share, one_ball_win
from evenbreak.source_text.answers import section_5_findings
from evenbreak.source_text.published import formulas
from evenbreak.source_text.section5 import chains
from rows import each_of


def test_steps_go_to_the_limit():
    found = derived(chains, "P5.23")
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


def test_shares_by_the_chain_are_those_by_the_formula():
    found = derived(chains, "P5.24")
    for p1, p2 in chains.PAIRS:
        for name in chains.FORMATS:
            by_chain = found["W by the chain", f"{name} breaks p1={p1} p2={p2}"]
            by_formula = long_run_share(p1, p2, BREAK_FORMATS[name])
            assert by_chain == pytest.approx(by_formula, abs=1e-9)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", chains.FORMATS)
def test_eigenvalues_are_those_of_the_chain(name):
    p1, p2 = 0.9, 0.5
    text = derived(chains, "P5.24")["formula: eigenvalues", f"{name} breaks"]
    text = text.removeprefix("1 and ")
    second = eval(text, {"p1": p1, "p2": p2})  # noqa: S307
    series = Series(Rack(p1, p2), breaks=BREAK_FORMATS[name])
    assert sorted(spectrum(chain_of(series)).values) == pytest.approx([second, 1], abs=1e-14)
    found = derived(chains, "P5.24")
    assert found["second eigenvalue", f"{name} breaks p1=0.9 p2=0.5"] == pytest.approx(second)


def test_pairs_are_the_rows_of_table_5_4():
    rows = {finding.published.inputs for finding in section_5_findings()}
    for number, (p1, p2) in enumerate(chains.PAIRS, 1):
        assert f"row={number} p1={p1} p2={p2}" in rows


def test_formulas_are_the_long_run_shares_of_the_diagrams():
    sympy = pytest.importorskip("sympy", reason="formulas need the extra `symbolic`")
    from evenbreak.chains import symbolic_limit

    p1, p2 = sympy.symbols("p1 p2")
    diagrams = {
        "winner": [(1, 1, p1), (1, 2, 1 - p1), (2, 2, p2), (2, 1, 1 - p2)],
        "loser": [(1, 1, 1 - p1), (1, 2, p1), (2, 2, 1 - p2), (2, 1, p2)],
        "alternate": [(1, 2, sympy.Integer(1)), (2, 1, sympy.Integer(1))],
    }
    found = derived(chains, "P5.24")
    for name, arcs in diagrams.items():
        law = symbolic_limit(arcs, 1)
        share = law[1] * p1 + law[2] * (1 - p2)
        formula = sympy.sympify(found["formula: W", f"{name} breaks"])
        assert sympy.simplify(share - formula) == 0, name


def as_python(formula):
    return re.sub(r"(?<=[\dp]) q", "*q", formula).replace("^", "**")


def formula_of(m, n):
    return derived(chains, "P5.27")["formula: W", f"{m}:{n}"]


@each_of("m, n", chains.HANDICAPS)
@each_of("p", [0.0, 0.3, 0.5, 0.6, 1.0])
def test_polynomials_give_the_chance_of_a_lead(m, n, p):
    value = eval(as_python(formula_of(m, n)), {"p": p, "q": 1 - p})  # noqa: S307
    assert value == pytest.approx(win_probability(Ahead(m, n, Rack(p))), abs=1e-14)


def test_polynomials_are_the_formulas_of_the_chain():
    sympy = pytest.importorskip("sympy", reason="formulas need the extra `symbolic`")
    from evenbreak.chains import symbolic_limit

    p = sympy.symbols("p")
    for m, n in chains.HANDICAPS:
        arcs = [
            (k, k + step, p if step > 0 else 1 - p) for k in range(1 - n, m) for step in (1, -1)
        ]
        formula = sympy.sympify(as_python(formula_of(m, n))).subs("q", 1 - p)
        assert sympy.simplify(symbolic_limit(arcs, 0)[m] - formula) == 0


def test_the_level_worth_practicing_is_that_of_the_largest_gain():
    found = derived(chains, "P5.26")
    assert found["level most worth practicing", "p=0.8"] == 4
    gains = [found["gain of the mean level", f"p=0.8 level={level}"] for level in range(1, 10)]
    assert max(gains) == gains[3]


@pytest.mark.parametrize(("chart", "sd"), [(8, 4.963), (20, 3.668)])
def test_ratings_wander_less_with_longer_matches(chart, sd):
    assert chains.ladder(chart).sd == pytest.approx(sd, abs=5e-4)
    assert chains.ladder(chart, autocorrelated=True).sd > sd
