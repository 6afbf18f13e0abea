import pytest

from derived import derived
from evenbreak.chains import chain_of, spectrum
from evenbreak.games import Rack
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.series import Series
from evenbreak.practice import long_run_share
from evenbreak.source_text.answers import section_5_findings
from evenbreak.source_text.section5 import break_formats


def test_shares_by_the_chain_are_those_by_the_formula():
    found = derived(break_formats, "P5.24")
    for p1, p2 in break_formats.PAIRS:
        for name in break_formats.FORMATS:
            by_chain = found["W by the chain", f"{name} breaks p1={p1} p2={p2}"]
            by_formula = long_run_share(p1, p2, BREAK_FORMATS[name])
            assert by_chain == pytest.approx(by_formula, abs=1e-9)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", break_formats.FORMATS)
def test_eigenvalues_are_those_of_the_chain(name):
    p1, p2 = 0.9, 0.5
    text = derived(break_formats, "P5.24")["formula: eigenvalues", f"{name} breaks"]
    text = text.removeprefix("1 and ")
    second = eval(text, {"p1": p1, "p2": p2})  # noqa: S307
    series = Series(Rack(p1, p2), breaks=BREAK_FORMATS[name])
    assert sorted(spectrum(chain_of(series)).values) == pytest.approx([second, 1], abs=1e-14)
    found = derived(break_formats, "P5.24")
    assert found["second eigenvalue", f"{name} breaks p1=0.9 p2=0.5"] == pytest.approx(second)


def test_pairs_are_the_rows_of_table_5_4():
    rows = {finding.published.inputs for finding in section_5_findings()}
    for number, (p1, p2) in enumerate(break_formats.PAIRS, 1):
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
    found = derived(break_formats, "P5.24")
    for name, arcs in diagrams.items():
        law = symbolic_limit(arcs, 1)
        share = law[1] * p1 + law[2] * (1 - p2)
        formula = sympy.sympify(found["formula: W", f"{name} breaks"])
        assert sympy.simplify(share - formula) == 0, name
