"""The text's closed forms come out of the diagrams, and agree with numbers."""

import builtins
from fractions import Fraction

import networkx as nx
import pytest

from evenbreak.chains import chain_of
from evenbreak.chains.symbolic import symbolic_limit
from evenbreak.errors import ChainError, GameError
from evenbreak.games import OneBall
from evenbreak.matches import win_probability

sympy = pytest.importorskip("sympy", reason="the extra 'symbolic' is not installed")
p, p1, p2 = sympy.symbols("p p1 p2", positive=True)
q, q1, q2 = 1 - p, 1 - p1, 1 - p2


def same(formula, other):
    return sympy.simplify(formula - other) == 0


ONE_BALL = [("S1", "W", p1), ("S1", "S2", q1), ("S2", "L", p2), ("S2", "S1", q2)]


def test_one_ball():
    """P5.20: W = p1 / (1 - q1 q2)."""
    limit = symbolic_limit(ONE_BALL)
    assert same(limit["W"], p1 / (1 - q1 * q2))
    assert same(limit["L"], q1 * p2 / (1 - q1 * q2))
    assert limit["S1"] == limit["S2"] == 0
    assert list(limit) == ["S1", "W", "S2", "L"]


def test_one_ball_second_shooter():
    """P5.23: the limit from S2."""
    limit = symbolic_limit(ONE_BALL, "S2")
    assert same(limit["W"], q2 * p1 / (1 - q1 * q2))


def test_p_crit_makes_the_one_ball_game_even():
    limit = symbolic_limit(ONE_BALL)
    assert sympy.solve(sympy.Eq(limit["W"], sympy.Rational(1, 2)), p2) == [-p1 / (p1 - 1)]


def test_fraction_of_games_won():
    """P5.24: player 1 wins p1 of the racks that player 1 breaks, and q2 of the others."""
    winner = symbolic_limit([(1, 1, p1), (1, 2, q1), (2, 1, q2), (2, 2, p2)])
    loser = symbolic_limit([(1, 1, q1), (1, 2, p1), (2, 1, p2), (2, 2, q2)])
    alternate = symbolic_limit([(1, 2, 1), (2, 1, 1)])

    def fraction(limit):
        return sympy.factor(limit[1] * p1 + limit[2] * q2)

    assert same(winner[1], q2 / (q1 + q2))
    assert same(fraction(winner), q2 / (q1 + q2))
    assert same(fraction(loser), p1 / (p1 + p2))
    assert same(fraction(alternate), (p1 + q2) / 2)
    assert str(fraction(loser)) == "p1/(p1 + p2)"


def six_ahead():
    """The diagram of Fig. 5.10 with seven nodes, -L..W."""
    graph = nx.DiGraph()
    for lead in range(1, 6):
        graph.add_edge(lead, lead + 1, probability=p)
        graph.add_edge(lead, lead - 1, probability=q)
    return graph


# P5.27: player 1 needs `needed` games more than player 2 to win, of six in all.
AHEAD = {
    1: p * (p**4 + p**3 * q + p**2 * q**2 + p * q**3 + q**4),
    2: p**2 * (p**3 + p**2 * q + p * q**2 + q**3),
    3: p**3 * (p**2 + p * q + q**2),
    4: p**4 * (p + q),
    5: p**5,
}


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("needed", AHEAD)
def test_n_ahead(needed):
    """P5.27: the five ratios of polynomials."""
    limit = symbolic_limit(six_ahead(), 6 - needed)
    whole = p**5 + p**4 * q + p**3 * q**2 + p**2 * q**3 + p * q**4 + q**5
    assert same(limit[6], AHEAD[needed] / whole)
    assert same(limit[0] + limit[6], 1)


def test_n_ahead_3_3_is_a_short_formula():
    assert same(symbolic_limit(six_ahead(), 3)[6], p**3 / (p**3 + q**3))


def test_numbers_stay_exact():
    third = Fraction(1, 3)
    limit = symbolic_limit([("a", "b", third), ("a", "a", 1 - third), ("b", "a", 1)])
    assert limit == {"a": sympy.Rational(3, 4), "b": sympy.Rational(1, 4)}


def test_several_closed_classes_and_an_unreachable_one():
    limit = symbolic_limit(
        [("s", "x", p), ("s", "u", q), ("x", "y", 1), ("y", "x", 1), ("lost", "u", 1)], "s"
    )
    assert limit == {"s": 0, "x": p / 2, "u": 1 - p, "y": p / 2, "lost": 0}


def test_an_arc_that_is_identically_zero_is_no_arc():
    limit = symbolic_limit([("s", "a", 1), ("s", "b", p + q - 1), ("a", "a", 1), ("b", "b", 1)])
    assert limit["b"] == 0
    assert limit["a"] == 1


def test_rating_difference():
    """The NPL game probability as a formula of the rating difference."""
    d = sympy.symbols("d", real=True)
    game = 1 / (1 + sympy.Integer(2) ** (-d / 30))
    limit = symbolic_limit([(1, 2, game), (1, 0, 1 - game)])
    assert limit[2].subs(d, 30) == sympy.Rational(2, 3)


def test_a_game_with_symbols():
    class Duel:
        start = "S1"

        def moves(self, state):
            return {"S1": {"W": p1, "S2": q1}, "S2": {"L": p2, "S1": q2}}.get(state, {})

    assert same(symbolic_limit(Duel())["W"], p1 / (1 - q1 * q2))


def test_a_one_ball_game_with_symbols():
    limit = symbolic_limit(OneBall(p1, p2))
    assert same(limit["W"], p1 / (1 - q1 * q2))
    third = symbolic_limit(OneBall(Fraction(1, 3), p2))
    assert same(third["W"], limit["W"].subs(p1, sympy.Rational(1, 3)))


def test_numbers_are_asked_for_where_a_game_has_symbols():
    with pytest.raises(GameError, match=r"probability p1\. Give a number from 0 to 1"):
        chain_of(OneBall(p1, p2))
    with pytest.raises(GameError, match=r"probability p1\. Give a number from 0 to 1"):
        win_probability(OneBall(p1, p2))


def test_the_start_node_of_a_diagram():
    graph = nx.DiGraph([("L", "L"), ("S", "L")])
    nx.set_edge_attributes(graph, 1, "probability")
    graph.nodes["S"]["kind"] = "start"
    assert symbolic_limit(graph) == {"L": 1, "S": 0}


def test_refusals():
    with pytest.raises(ChainError, match="'S' sum to 2\\*p, not 1"):
        symbolic_limit([("S", "W", p), ("S", "L", p)])
    with pytest.raises(ChainError, match="listed twice"):
        symbolic_limit([("S", "W", p), ("S", "W", q)])
    with pytest.raises(ChainError, match="arc"):
        symbolic_limit([])
    with pytest.raises(ChainError, match="the source must"):
        symbolic_limit(3)
    with pytest.raises(ChainError, match="'X' isn't in the diagram"):
        symbolic_limit(ONE_BALL, "X")


def test_without_sympy(monkeypatch):
    real = builtins.__import__

    def refuse(name, *args, **kwargs):
        if name == "sympy":
            raise ModuleNotFoundError("No module named 'sympy'")
        return real(name, *args, **kwargs)

    monkeypatch.setattr(builtins, "__import__", refuse)
    with pytest.raises(ModuleNotFoundError, match="pip install sympy"):
        symbolic_limit([("S", "S", 1)])


@pytest.mark.parametrize(
    "arc",
    [("A", "B"), "A", 5, (["A"], "B", 1), ("A", "B", None), ("A", "B", "1 +"), ("A", "B", [1])],
)
def test_what_is_no_arc_is_refused(arc):
    for k, arcs in ((1, [arc]), (2, [("S", "A", 1), arc])):
        with pytest.raises(ChainError, match=rf"arc {k} must be \(source, target, prob"):
            symbolic_limit(arcs)
