import math
import re
from decimal import Decimal
from fractions import Fraction
from itertools import product

import pytest

from evenbreak.chains import chain_of, spectrum
from evenbreak.games import Ahead, Rack
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.series import Series
from evenbreak.matches import win_probability
from evenbreak.practice import long_run_share, one_ball_win
from evenbreak.source_text.section5 import break_formats, long_run, one_ball
from evenbreak.source_text.section5.numbers import findings
from evenbreak.source_text.section5.problems import (
    COLUMNS,
    DERIVED,
    PROBLEMS,
    problem_frames,
    published_frame,
)
from evenbreak.stats import GamesWon, InningsScore, RunLength


@pytest.fixture(scope="module")
def frames():
    return problem_frames(findings())


def answers(frame):
    """Return what is computed, by quantity and inputs."""
    return {(row.quantity, row.inputs): row.computed for row in frame.itertuples()}


def as_python(formula):
    return re.sub(r"(?<=[\dp]) q", "*q", formula).replace("^", "**")


def test_every_problem_has_an_answer(frames):
    assert list(frames) == [f"problem_5_{n:02}" for n in range(1, 28)]
    for name, frame in frames.items():
        assert tuple(frame.columns) == COLUMNS, name
        assert len(frame) >= 4, name
        assert not frame.computed.isna().any(), name
    assert set(DERIVED) <= set(PROBLEMS)


def test_quantity_and_inputs_name_a_row(frames):
    for name, frame in frames.items():
        named = frame[["problem", "quantity", "inputs", "verdict", "note"]]
        assert not named.duplicated().any(), name


def test_published_frame_has_all_numbers_as_printed():
    frame = published_frame(findings())
    assert len(frame) == len(findings())
    row = frame[frame.quantity == "p where W(p;2,1)=W(p;4,2)"].iloc[0]
    assert str(row.printed) == "0.641"
    assert str(row.computed) == "0.6403882032"
    assert str(row.difference) == "-0.0006117968"
    assert str(row.tolerance) == "0.0005"
    assert row.verdict == "erratum"
    derived = frame[frame.verdict == "derived"]
    assert derived.printed.isna().all()
    assert derived.difference.isna().all()


def test_who_filters_by_the_tolerance_finds_the_errata_and_nothing_else():
    frame = published_frame(findings())
    printed = frame[frame.verdict != "derived"]
    off = printed[printed.difference.map(abs) > printed.tolerance]
    assert len(off) == 9
    assert list(off.index) == list(frame[frame.verdict == "erratum"].index)


def test_what_agrees_and_is_not_rounded_is_said_to_be_cut_off():
    cut_off = [
        (row.problem, str(row.printed))
        for row, computed, verdict in findings()
        if verdict == "agrees"
        and abs(computed - float(row.printed)) > 0.51 * 10.0 ** row.printed.as_tuple().exponent
    ]
    noted = [
        (row.problem, str(row.printed))
        for row, _, verdict in findings()
        if verdict == "agrees" and row.note.startswith("cut off")
    ]
    assert cut_off == noted
    assert cut_off == [("Table 5.2", "15.9"), ("Table 5.2", "67.9"), ("Table 5.4", "0.54")]


def test_choices_are_all_subsets(frames):
    found = answers(frames["problem_5_03"])
    chosen = [text for (quantity, _), text in found.items() if quantity.startswith("choice")]
    assert len(chosen) == len(set(chosen)) == 16
    assert {"{}", "{1 3}", "{1 2 3 4}"} <= set(chosen)


def test_pascals_triangle_is_that_of_the_binomial_coefficients(frames):
    found = answers(frames["problem_5_03"])
    entries = {key: value for key, value in found.items() if key[0] == "Pascal's triangle"}
    assert len(entries) == 66
    for n in range(11):
        for m in range(n + 1):
            assert entries["Pascal's triangle", f"n={n} m={m}"] == math.comb(n, m)


def test_orders_sum_to_the_score(frames):
    found = answers(frames["problem_5_04"])
    orders = [chance for (quantity, _), chance in found.items() if quantity.startswith("order")]
    assert len(orders) == 4
    assert float(sum(orders)) == pytest.approx(float(Fraction(32, 81)), abs=1e-9)


def test_spans_shrink_with_the_length_of_the_race(frames):
    found = answers(frames["problem_5_07"])
    name = "width of the span where the longer match is lost more seldom"
    widths = [width for (quantity, _), width in found.items() if quantity == name]
    assert len(widths) == 9
    assert widths == sorted(widths, reverse=True)
    assert widths[-1] > 0


def test_wider_samples_scatter_less(frames):
    found = answers(frames["problem_5_18"])
    without = [found["sd of the mean, without replacement", f"1 2 4 5 m={n}"] for n in (1, 2, 3, 4)]
    assert without == sorted(without, reverse=True)
    assert without[-1] == 0
    assert (
        without[1] == found["sd of the mean, without replacement", "1 2 4 5 m=2 from all six pairs"]
    )


def test_steps_go_to_the_limit(frames):
    found = answers(frames["problem_5_23"])
    for start, where in product(("v", "w"), ("W", "S1", "S2", "L")):
        inputs = f"p1=0.4 p2=0.8 node={where}"
        last, limit = found[f"{start}, step 5", inputs], found[f"{start}, limit", inputs]
        assert float(last) == pytest.approx(float(limit), abs=0.02)
    assert found["v, step 2", "p1=0.4 p2=0.8 node=S1"] == Decimal("0.12")


def test_second_eigenvalue_of_break_formats(frames):
    found = answers(frames["problem_5_24"])
    assert found["second eigenvalue", "winner breaks p1=0.9 p2=0.5"] == Decimal("0.4")
    assert found["second eigenvalue", "loser breaks p1=0.9 p2=0.5"] == Decimal("-0.4")
    assert found["second eigenvalue", "alternate breaks p1=0.9 p2=0.5"] == -1
    for p1, p2 in break_formats.PAIRS:
        for name in break_formats.FORMATS:
            by_chain = found["W by the chain", f"{name} breaks p1={p1} p2={p2}"]
            by_formula = long_run_share(p1, p2, BREAK_FORMATS[name])
            assert float(by_chain) == pytest.approx(by_formula, abs=1e-9)


def test_pairs_are_the_rows_of_table_5_4():
    rows = {finding.published.inputs for finding in findings()}
    for number, (p1, p2) in enumerate(break_formats.PAIRS, 1):
        assert f"row={number} p1={p1} p2={p2}" in rows


def test_formulas_are_those_of_the_diagrams():
    sympy = pytest.importorskip("sympy", reason="formulas need the extra `symbolic`")
    from evenbreak.chains import symbolic_limit

    p1, p2 = sympy.symbols("p1 p2")
    one = [("S1", "W", p1), ("S1", "S2", 1 - p1), ("S2", "L", p2), ("S2", "S1", 1 - p2)]
    limits = {"v": symbolic_limit(one, "S1"), "w": symbolic_limit(one, "S2")}
    half = {node: (limits["v"][node] + limits["w"][node]) / 2 for node in ("W", "L")}
    for (start, node), text in one_ball.FORMULAS.items():
        exact = limits.get(start, half)[node]
        assert sympy.simplify(sympy.sympify(text) - exact) == 0, (start, node)
    diagrams = {
        "winner": [(1, 1, p1), (1, 2, 1 - p1), (2, 2, p2), (2, 1, 1 - p2)],
        "loser": [(1, 1, 1 - p1), (1, 2, p1), (2, 2, 1 - p2), (2, 1, p2)],
        "alternate": [(1, 2, sympy.Integer(1)), (2, 1, sympy.Integer(1))],
    }
    for name, arcs in diagrams.items():
        law = symbolic_limit(arcs, 1)
        share = law[1] * p1 + law[2] * (1 - p2)
        formula = sympy.sympify(break_formats.FORMULAS[name])
        assert sympy.simplify(share - formula) == 0, name


LAWS = {
    "p": Fraction(7, 10),
    "q": Fraction(3, 10),
    "alpha": Fraction(4, 5),
    "N": 12,
    "m": 4,
    "n": 3,
}
RUN, SAFE, SCORE = RunLength(0.7), RunLength(0.7, 0.8), InningsScore(0.7, 4)
GAMES = GamesWon(12, 0.7)


@pytest.mark.parametrize(
    ("problem", "quantity", "inputs", "value"),
    [
        (9, "mode", "", GAMES.mode),
        (9, "mean", "", GAMES.mean),
        (9, "standard deviation", "", GAMES.sd),
        (11, "P(run = n)", "", RUN.probability(3)),
        (11, "P(run >= n)", "", RUN.at_least(3)),
        (11, "mode", "", RUN.mode),
        (11, "mean", "", RUN.mean),
        (15, "P(run = 0)", "", SAFE.probability(0)),
        (15, "P(run = n)", "n > 0", SAFE.probability(3)),
        (15, "mean", "", SAFE.mean),
        (16, "P(score = n)", "m innings", SCORE.probability(3)),
        (16, "mean", "m innings", SCORE.mean),
        (16, "standard deviation", "m innings", SCORE.sd),
        (16, "mode", "m innings", SCORE.mode),
    ],
)
def test_formulas_of_scores_and_runs(frames, problem, quantity, inputs, value):
    text = answers(frames[f"problem_5_{problem:02}"])[f"formula: {quantity}", inputs]
    formula = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text).replace("^", "**")
    functions = {"C": math.comb, "sqrt": math.sqrt, "ceiling": math.ceil}
    assert eval(formula, {**LAWS, **functions}) == pytest.approx(value, rel=1e-12)  # noqa: S307


def test_formulas_of_the_two_shot_look_ahead_and_of_eigenvalues():
    p1, p2 = 0.4, 0.8
    win = eval(one_ball.TWO_SHOTS, {"p1": p1, "p2": p2})  # noqa: S307
    assert win == pytest.approx(one_ball_win(p1, p2, look_ahead="two shots"), rel=1e-14)
    for name, text in break_formats.EIGENVALUES.items():
        series = Series(Rack(p1, p2), breaks=BREAK_FORMATS[name])
        second = eval(text.removeprefix("1 and "), {"p1": p1, "p2": p2})  # noqa: S307
        values = sorted(spectrum(chain_of(series)).values)
        assert values == pytest.approx([second, 1], abs=1e-14), name


@pytest.mark.parametrize(("m", "n"), long_run.HANDICAPS)
@pytest.mark.parametrize("p", [0.0, 0.3, 0.5, 0.6, 1.0])
def test_polynomials_of_leads(m, n, p):
    value = eval(as_python(long_run.ahead_formula(m, n)), {"p": p, "q": 1 - p})  # noqa: S307
    assert value == pytest.approx(win_probability(Ahead(m, n, Rack(p))), abs=1e-14)


def test_polynomials_are_the_formulas_of_the_chain():
    sympy = pytest.importorskip("sympy", reason="formulas need the extra `symbolic`")
    from evenbreak.chains import symbolic_limit

    p = sympy.symbols("p")
    for m, n in long_run.HANDICAPS:
        arcs = [
            (k, k + step, p if step > 0 else 1 - p) for k in range(1 - n, m) for step in (1, -1)
        ]
        formula = sympy.sympify(as_python(long_run.ahead_formula(m, n))).subs("q", 1 - p)
        assert sympy.simplify(symbolic_limit(arcs, 0)[m] - formula) == 0


def test_eigenvalues_of_a_lead_match():
    values = spectrum(chain_of(Ahead(3, 3, Rack(0.6)))).values
    assert sorted(values)[-2:] == pytest.approx([1, 1])
    assert max(abs(value) for value in sorted(values)[:-2]) < 1


def test_drill_rows_tell_what_to_practise(frames):
    found = answers(frames["problem_5_26"])
    assert found["level most worth practising", "p=0.8"] == 4
    gains = [found["gain of the mean level", f"p=0.8 level={level}"] for level in range(1, 10)]
    assert max(gains) == found["gain of the mean level", "p=0.8 level=4"]
