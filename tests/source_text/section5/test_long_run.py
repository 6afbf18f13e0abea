import re

import pytest

from derived import derived
from evenbreak.games import Ahead, Rack
from evenbreak.matches import win_probability
from evenbreak.source_text.section5 import long_run
from rows import each_of


def as_python(formula):
    return re.sub(r"(?<=[\dp]) q", "*q", formula).replace("^", "**")


def formula_of(m, n):
    return derived(long_run, "P5.27")["formula: W", f"{m}:{n}"]


@each_of("m, n", long_run.HANDICAPS)
@each_of("p", [0.0, 0.3, 0.5, 0.6, 1.0])
def test_polynomials_give_the_chance_of_a_lead(m, n, p):
    value = eval(as_python(formula_of(m, n)), {"p": p, "q": 1 - p})  # noqa: S307
    assert value == pytest.approx(win_probability(Ahead(m, n, Rack(p))), abs=1e-14)


def test_polynomials_are_the_formulas_of_the_chain():
    sympy = pytest.importorskip("sympy", reason="formulas need the extra `symbolic`")
    from evenbreak.chains import symbolic_limit

    p = sympy.symbols("p")
    for m, n in long_run.HANDICAPS:
        arcs = [
            (k, k + step, p if step > 0 else 1 - p) for k in range(1 - n, m) for step in (1, -1)
        ]
        formula = sympy.sympify(as_python(formula_of(m, n))).subs("q", 1 - p)
        assert sympy.simplify(symbolic_limit(arcs, 0)[m] - formula) == 0


def test_the_level_worth_practising_is_that_of_the_largest_gain():
    found = derived(long_run, "P5.26")
    assert found["level most worth practising", "p=0.8"] == 4
    gains = [found["gain of the mean level", f"p=0.8 level={level}"] for level in range(1, 10)]
    assert max(gains) == gains[3]


@pytest.mark.parametrize(("chart", "sd"), [(8, 4.963), (20, 3.668)])
def test_ratings_wander_less_with_longer_matches(chart, sd):
    assert long_run.ladder(chart).sd == pytest.approx(sd, abs=5e-4)
    assert long_run.ladder(chart, autocorrelated=True).sd > sd
