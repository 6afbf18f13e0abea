"""The stochastic limit as a formula, for diagrams whose probabilities are sympy expressions.

The limit is found by elimination (see `elimination`) with another kind of number: elements of the
field of rational functions of the symbols.

This needs sympy, which the extra `symbolic` installs.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from evenbreak.chains.elimination import eliminated, limit_in
from evenbreak.chains.explore import chain_of
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    import networkx as nx
    import sympy  # type: ignore[import-untyped]

Arc: TypeAlias = tuple[Hashable, Hashable, Any]
Rows: TypeAlias = dict[Hashable, dict[Hashable, Any]]


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
        `sympy.Rational(1, 3)`); those of a state sum to 1 identically. A state without arcs is
        absorbing. `OneBall` takes expressions too; `evenbreak.matches.win_formula` has the formulas
        of races and n-ahead matches.
    start
        the starting state; by default the game's own start, the graph's
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
    Every listed arc whose probability is not identically zero counts as possible. The formulas hold
    if all of these are positive; at the edges (p = 0, p = 1) they hold only if they have a limit.
    Source: P5.20, P5.24, P5.27.

    >>> import sympy
    >>> p1, p2 = sympy.symbols("p1 p2")
    >>> one_ball = [("S1", "W", p1), ("S1", "S2", 1 - p1), ("S2", "L", p2), ("S2", "S1", 1 - p2)]
    >>> symbolic_limit(one_ball)["W"]
    p1/(-p1*p2 + p1 + p2)
    """
    rows, start = _diagram(source, start)
    sympy = _sympy()
    from sympy.polys.constructor import construct_domain  # type: ignore[import-untyped]

    # The graph alone says what is transient, whatever the chances of its arcs.
    graph = chain_of({j: {i: 1 / len(row) for i in row} for j, row in rows.items()})
    place = graph.position
    listed = [(j, i, p) for j, row in rows.items() for i, p in row.items() if i != j]
    formulas = [sympy.Integer(1), *(p for _, _, p in listed)]
    field, (unit, *chances) = construct_domain(formulas, field=True)
    arcs: list[dict[int, Any]] = [{} for _ in rows]
    for (j, i, _), chance in zip(listed, chances, strict=True):
        arcs[place[j]][place[i]] = chance
    limit = limit_in(graph.structure, arcs, {place[start]: unit}, _visits)
    shares = (field.to_sympy(field.convert(limit.get(k, 0))) for k in range(len(graph)))
    return dict(zip(graph.states, map(_readable, shares), strict=True))


def _visits(rows: Any, states: Any, b: list[Any]) -> list[Any]:
    return eliminated(rows, states).visits(b)


def _readable(formula: Any) -> Any:
    """Return the factored formula, with a denominator that is positive if the symbols are 1/2."""
    sympy = _sympy()
    above, below = sympy.fraction(sympy.factor(formula))
    middle = below.subs(dict.fromkeys(below.free_symbols, sympy.Rational(1, 2)))
    return -above / -below if middle.is_negative else above / below


def _sympy() -> Any:
    try:
        import sympy
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "formulas need sympy. Install it with: pip install sympy"
        ) from error
    return sympy


def _diagram(source: Any, start: Hashable | None) -> tuple[Rows, Hashable]:
    """Return the possible arcs of each state, and the start."""
    sympy = _sympy()
    arcs, own_start = _arcs(source)
    rows: Rows = {}
    for k, arc in enumerate(arcs, 1):
        try:
            origin, target, chance = arc
            row = rows.setdefault(origin, {})
            rows.setdefault(target, {})
            formula = sympy.sympify(chance)
        except (TypeError, ValueError):
            formula = None
        if not isinstance(formula, sympy.Expr):
            raise ChainError(
                f"arc {k} must be (source, target, probability), two hashable states and a number "
                f"or a formula; you gave {arc!r}"
            )
        if target in row:
            raise ChainError(f"the arc {origin!r} -> {target!r} is listed twice. List it once.")
        row[target] = formula
    if not rows:
        raise ChainError("there must be at least one arc (source, target, probability)")
    if start is None:
        start = next(iter(rows)) if own_start is None else own_start
    if start not in rows:
        raise ChainError(f"the start {start!r} isn't in the diagram. Give one of its states.")
    for state, row in rows.items():
        total = sum(row.values())
        if row and sympy.simplify(total - 1) != 0:
            raise ChainError(
                f"the probabilities out of state {state!r} sum to {total}, not 1. Write the last "
                "one as 1 minus the others."
            )
        rows[state] = {target: p for target, p in row.items() if sympy.simplify(p) != 0}
    return rows, start


def _arcs(source: Any) -> tuple[Iterable[Any], Hashable | None]:
    """Return the arcs, and the start if the source has one."""
    if hasattr(source, "adjacency"):
        starts = (state for state, kind in source.nodes(data="kind") if kind == "start")
        return source.edges(data="probability"), next(starts, None)
    if hasattr(source, "moves"):
        return _walked(source), source.start
    if isinstance(source, Iterable):
        return source, None
    raise ChainError(
        "the source must be a game, a networkx.DiGraph, or a list of (source, target, "
        f"probability); you gave {source!r:.60}"
    )


def _walked(game: Any) -> Iterator[Arc]:
    """Yield the arcs from every state of a game that can be reached."""
    queue, seen = [game.start], {game.start}
    for state in queue:
        for target, chance in game.moves(state).items():
            yield state, target, chance
            if target not in seen:
                seen.add(target)
                queue.append(target)
