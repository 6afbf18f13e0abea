"""The stochastic limit as a formula, for diagrams whose probabilities are sympy expressions.

With T the transient states and C a closed class, the limit from a start s is
sum over C of pi_C a_C(s), where a_C = (I - M_TT)^-T (M_CT^T 1) is the probability of
ending in C and pi_C solves M_CC pi_C = pi_C, sum pi_C = 1. Both are linear systems over
the field of rational functions of the symbols.

It needs sympy, which the extra `symbolic` installs.

Reference: Kemeny and Snell 1960, Finite Markov Chains, chapter III.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import TYPE_CHECKING, Any, TypeAlias

import networkx as nx

from evenbreak.errors import ChainError

if TYPE_CHECKING:
    import sympy  # type: ignore[import-untyped]

Arc: TypeAlias = tuple[Hashable, Hashable, Any]


def symbolic_limit(
    source: nx.DiGraph[Any] | Iterable[Arc] | Any, start: Hashable | None = None
) -> dict[Hashable, sympy.Expr]:
    """Return the long-run probability of every state as a formula, given the start.

    It is the limit of M^n v if the chain settles down and the long-run average if it is
    periodic; one formula holds for both.

    Parameters
    ----------
    source
        a `networkx.DiGraph` with `probability` on its arcs; an iterable of arcs
        (source, target, probability); or an object with `start` and `moves(state)`.
        A probability is a sympy expression or a number (write 1/3 as
        `sympy.Rational(1, 3)`); those of a state sum to 1 identically. A state without
        arcs absorbs.
    start
        the state in which the game begins; by default the game's own start, the graph's
        node of kind 'start', or the source of the first arc.

    Returns
    -------
    dict
        state -> formula, factored, in the order in which the states are listed.

    Raises
    ------
    ChainError
        if there are no arcs, an arc is not (source, target, probability) or is listed
        twice, the probabilities of a state do not sum to 1, or the start is unknown.
    ModuleNotFoundError
        if sympy is not installed.

    Notes
    -----
    Every listed arc whose probability is not identically zero counts as possible. The
    formulas hold where all of these are positive; at the edges (p = 0, p = 1) they hold
    only if they have a limit. Source: P5.20, P5.24, P5.27.

    >>> import sympy
    >>> p1, p2 = sympy.symbols("p1 p2")
    >>> one_ball = [("S1", "W", p1), ("S1", "S2", 1 - p1), ("S2", "L", p2), ("S2", "S1", 1 - p2)]
    >>> symbolic_limit(one_ball)["W"]
    p1/(-p1*p2 + p1 + p2)
    """
    graph, start = _diagram(source, start)
    limit: dict[Hashable, Any] = dict.fromkeys(graph, _sympy().Integer(0))
    reached = graph.subgraph({start} | nx.descendants(graph, start))
    closed = [c for c in nx.strongly_connected_components(reached) if _is_closed(reached, c)]
    inside = set().union(*closed)
    transient = [state for state in graph if state in reached and state not in inside]
    ends = [[state for state in graph if state in members] for members in closed]
    for members, chance in zip(ends, _absorbed(graph, transient, ends, start), strict=True):
        for state, share in zip(members, _stationary(graph, members), strict=True):
            limit[state] = _readable(share * chance)
    return limit


def _readable(formula: Any) -> Any:
    """Return the formula factored, its denominator positive where the symbols are 1/2."""
    sympy = _sympy()
    above, below = sympy.fraction(sympy.factor(formula))
    middle = below.subs(dict.fromkeys(below.free_symbols, sympy.Rational(1, 2)))
    return -above / -below if middle.is_negative else above / below


def _sympy() -> Any:
    try:
        import sympy
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "formulas need sympy; install it with: pip install sympy"
        ) from error
    return sympy


def _diagram(source: Any, start: Hashable | None) -> tuple[nx.DiGraph[Any], Hashable]:
    sympy = _sympy()
    arcs, own_start = _arcs(source)
    graph: nx.DiGraph[Any] = nx.DiGraph()
    for k, arc in enumerate(arcs, 1):
        origin, target, chance = _checked(k, arc)
        if graph.has_edge(origin, target):
            raise ChainError(f"the arc {origin!r} -> {target!r} is listed twice; list it once")
        graph.add_edge(origin, target, probability=chance)
    if start is None:
        start = next(iter(graph)) if own_start is None else own_start
    if start not in graph:
        raise ChainError(f"the start {start!r} is not in the diagram; give one of its states")
    for state in graph:
        total = sum(arc["probability"] for arc in graph[state].values())
        if graph[state] and sympy.simplify(total - 1) != 0:
            raise ChainError(
                f"the probabilities of state {state!r} sum to {total}, not 1; "
                "write the last one as 1 minus the others"
            )
    impossible = [
        (origin, target)
        for origin, target, arc in graph.edges(data=True)
        if sympy.simplify(arc["probability"]) == 0
    ]
    graph.remove_edges_from(impossible)
    return graph, start


def _checked(k: int, arc: Any) -> Arc:
    """Return the k-th arc with its probability as a sympy expression."""
    sympy = _sympy()
    try:
        origin, target, chance = arc
        hash(origin), hash(target)
        formula = sympy.sympify(chance)
    except (TypeError, ValueError):
        formula = None
    if not isinstance(formula, sympy.Expr):
        raise ChainError(
            f"arc {k} is {arc!r}; give (source, target, probability), states that can be "
            "hashed and a number or a formula"
        )
    return origin, target, formula


def _arcs(source: Any) -> tuple[list[Arc], Hashable | None]:
    arcs: list[Arc]
    if isinstance(source, nx.DiGraph):
        arcs = list(source.edges(data="probability"))
        starts = [state for state, kind in source.nodes(data="kind") if kind == "start"]
    elif hasattr(source, "moves"):
        arcs, starts = [], [source.start]
        queue, seen = [source.start], {source.start}
        for state in queue:
            for target, chance in source.moves(state).items():
                arcs.append((state, target, chance))
                if target not in seen:
                    seen.add(target)
                    queue.append(target)
    elif isinstance(source, Iterable):
        arcs, starts = list(source), []
    else:
        raise ChainError(
            f"the source is {source!r:.60}; give a game, a networkx.DiGraph, or a list of "
            "(source, target, probability)"
        )
    if not arcs:
        raise ChainError("there are no arcs; give at least one (source, target, probability)")
    return arcs, starts[0] if starts else None


def _is_closed(graph: nx.DiGraph[Any], members: set[Any]) -> bool:
    return all(target in members for state in members for target in graph[state])


def _block(graph: nx.DiGraph[Any], states: list[Any]) -> Any:
    """I - M on `states`; the diagonal is what the other arcs take away, wherever they lead."""
    place = {state: i for i, state in enumerate(states)}
    block = _sympy().zeros(len(states), len(states))
    for origin in states:
        for target, arc in graph[origin].items():
            if target != origin:
                block[place[origin], place[origin]] += arc["probability"]
                if target in place:
                    block[place[target], place[origin]] -= arc["probability"]
    return block


def _solve(matrix: Any, right: Any) -> Any:
    from sympy.polys.matrices import DomainMatrix  # type: ignore[import-untyped]

    left, b = DomainMatrix.from_Matrix(matrix), DomainMatrix.from_Matrix(right)
    left, b = left.unify(b)
    return left.to_field().lu_solve(b.to_field()).to_Matrix()


def _absorbed(
    graph: nx.DiGraph[Any], transient: list[Any], ends: list[list[Any]], start: Any
) -> list[Any]:
    """Return the probability of ending in each closed class, given the start."""
    sympy = _sympy()
    if start not in transient:
        return [sympy.Integer(start in members) for members in ends]
    origin = sympy.zeros(len(transient), 1)
    origin[transient.index(start)] = 1
    visits = _solve(_block(graph, transient), origin)
    return [
        sum(
            visits[i] * arc["probability"]
            for i, state in enumerate(transient)
            for target, arc in graph[state].items()
            if target in members
        )
        for members in ends
    ]


def _stationary(graph: nx.DiGraph[Any], members: list[Any]) -> list[Any]:
    """Return the stationary law of a closed class; the sum replaces one balance equation."""
    sympy = _sympy()
    balance = _block(graph, members)
    balance[0, :] = sympy.ones(1, len(members))
    total = sympy.zeros(len(members), 1)
    total[0] = 1
    return list(_solve(balance, total))
