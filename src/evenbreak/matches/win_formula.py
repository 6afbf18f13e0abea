"""Chance of winning as a formula (with sympy), and as polynomials in p and q = 1 - p.

The formula needs sympy, which the extra `symbolic` installs.

If the break does not matter, a form of degree N is the list of integer coefficients c[k] of p^k
q^(N-k). Every match has two forms without negative coefficients, F1 and F2, and W(p) = F1 / (F1 +
F2). For a race, they are sums over its scores; for an n-ahead match, they are those of the
gambler's ruin; and a match of sets has the forms of the set in place of p and q. Questions about W
become questions about the signs of integers.
"""

from __future__ import annotations

from collections.abc import Sequence
from graphlib import TopologicalSorter
from itertools import zip_longest
from math import comb
from typing import TYPE_CHECKING, Any

from evenbreak.chains.symbolic import symbolic_limit
from evenbreak.checks import one_of
from evenbreak.games.ahead import Ahead
from evenbreak.games.match import Match
from evenbreak.games.one_ball import OneBall
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.endings import is_bounded
from evenbreak.matches.formats import MatchFormat, match_format
from evenbreak.matches.parameters import checked_match, unit_of
from evenbreak.matches.rack_by_rack import breaker_in, rack_moves

if TYPE_CHECKING:
    import sympy  # type: ignore[import-untyped]


def win_formula(played: Match | OneBall | MatchFormat | str, *, player: int = 1) -> sympy.Expr:
    """Return P(`player` wins) as a polynomial or a quotient of polynomials.

    Parameters
    ----------
    played
        a race, an n-ahead match or a one-ball game, whose own probabilities do not matter; or a
        match format such as '3:2', 'ahead 5:3', '2:1 of 3:3' or '3:2 winner breaks'.
    player
        1 or 2.

    Returns
    -------
    sympy.Expr
        in the symbols p and q = 1 - p, player 1's and player 2's chance in a rack, if the
        break does not matter and the score is 0:0; in p alone from any other score. If the
        break matters, and for the one-ball game, in p1 and p2, each player's chance on their
        own break or shot. Substitute numbers or fractions with its method `subs`.

    Raises
    ------
    InputError
        if it is none of these, or `player` is not 1 or 2.
    ModuleNotFoundError
        if sympy is not installed.

    Notes
    -----
    Source: problems P5.5 and P5.6 (races), P5.8 (sets), P5.20 (one-ball), P5.24 (break
    formats), P5.27 (n-ahead). A formula from another score or with breaks has to be solved for,
    which takes time for long matches.

    >>> win_formula("3:2")
    p**4 + 4*p**3*q
    >>> win_formula("ahead 2:2")
    (p**3 + p**2*q)/(p**3 + p**2*q + p*q**2 + q**3)
    >>> win_formula(OneBall(0.5, 0.5))
    p1/(-p1*p2 + p1 + p2)
    >>> win_formula("1:2 winner breaks")
    p1*p2 - p2 + 1
    """
    one_of(player, "player", (1, 2))
    if isinstance(played, OneBall):
        import sympy

        game = OneBall(*sympy.symbols("p1 p2"))
        return symbolic_limit(game)["W" if player == 1 else "L"]
    if isinstance(played, str):
        played = match_format(played)
    if isinstance(played, MatchFormat):
        rack = Rack(0.5) if _breaks_of(played) is None else Rack(0.5, 0.5)
        played = played.match(rack)
    match = checked_match(played)
    format_ = _format_of(match)
    if format_ is not None:
        return _of_forms(format_, player)
    return _polynomial(match, player) if is_bounded(match) else _quotient(match, player)


def _breaks_of(played: MatchFormat) -> str | None:
    return _breaks_of(played.set_) if played.set_ is not None else played.breaks


def _format_of(match: Match) -> MatchFormat | None:
    """Return the format of a match from 0:0 in which the break does not matter, or None."""
    if match.break_matters or match.score != (0, 0):
        return None
    unit = unit_of(match)
    set_ = _format_of(unit) if isinstance(unit, Match) else None
    if set_ is None and isinstance(unit, Match):
        return None
    by = match.win_by if isinstance(match, Race) else 1
    return MatchFormat(match.m, match.n, isinstance(match, Ahead), by, set_)


def _of_forms(played: MatchFormat, player: int) -> Any:
    import sympy

    p, q = sympy.symbols("p q")
    forms = [
        sum(c * p**k * q ** (len(form) - 1 - k) for k, c in enumerate(form) if c)
        for form in win_forms(played)
    ]
    plain_race = not played.ahead and played.win_by == 1 and played.set_ is None
    return forms[player - 1] if plain_race else forms[player - 1] / sum(forms)


def _polynomial(match: Match, player: int) -> Any:
    """Return the formula of a match with a longest length, from its last racks back.

    If x is the breaker's chance and f_won and f_lost are the formulas after the rack, then f =
    f_lost + x (f_won - f_lost), all in integers.
    """
    import sympy

    ring, *chances = sympy.ring(_symbols_of(match), sympy.ZZ)
    moves = rack_moves(match)
    after = {state: [target for target, _ in row] for state, row in moves.items()}
    formula: dict[Any, Any] = {}
    order = TopologicalSorter(after)
    order.add(match.start)  # also if the match is over
    for state in order.static_order():
        if state not in moves:
            formula[state] = ring(int(match.winner(state) == player))
            continue
        breaker = breaker_in(match, state)
        won, lost = (formula[target] for target in after[state][:: 1 if breaker == 1 else -1])
        formula[state] = lost + chances[breaker - 1] * (won - lost)
    return formula[match.start].as_expr()


def _quotient(match: Match, player: int) -> Any:
    """Return the formula of a match that may never end, from its diagram."""
    import sympy

    symbols = sympy.symbols(_symbols_of(match), seq=True)
    # All scores with one winner are one final state, which keeps the systems small.
    arcs: dict[tuple[Any, Any], Any] = {}
    moves = rack_moves(match)
    for state, row in moves.items():
        breaker = breaker_in(match, state)
        own = symbols[breaker - 1]
        for winner, (target, _) in enumerate(row, 1):
            end = target if target in moves else f"won by {match.winner(target)}"
            arcs[state, end] = arcs.get((state, end), 0) + (own if winner == breaker else 1 - own)
    triples = [(source, target, chance) for (source, target), chance in arcs.items()]
    return sympy.factor(symbolic_limit(triples, match.start)[f"won by {player}"])


def _symbols_of(match: Match) -> str:
    return "p1 p2" if match.break_matters else "p"


Form = list[int]
WinForms = tuple[Form, Form]


def win_forms(played: MatchFormat) -> WinForms:
    """Return the forms F1 and F2 of a match: P(player 1 wins) = F1 / (F1 + F2).

    Source: problems P5.5, P5.8 and P5.27.

    >>> from evenbreak.matches.formats import match_format
    >>> win_forms(match_format("2:1"))
    ([0, 0, 1], [1, 2, 0])
    """
    if played.ahead:
        own = _ahead(played.m, played.n)
    elif played.win_by > 1:
        own = _win_by(played.m, played.n, played.win_by)
    else:
        last = played.m + played.n - 1
        ways = [comb(last, k) for k in range(last + 1)]
        own = [0] * played.m + ways[played.m :], ways[: played.m] + [0] * played.n
    if played.set_ is None:
        return own
    inside = win_forms(played.set_)
    return _composed(own[0], inside), _composed(own[1], inside)


def degree_of(played: MatchFormat) -> int:
    """Return the degree of the forms of a match.

    >>> from evenbreak.matches.formats import match_format
    >>> degree_of(match_format("3:1 of 3:3"))
    15
    """
    own = played.m + played.n - 1
    if played.win_by > 1 and not played.ahead:
        own += 4 * played.win_by
    return own * (degree_of(played.set_) if played.set_ else 1)


def product(first: Form, second: Form) -> Form:
    """Return the product of two forms.

    >>> product([1, 1], [1, 1])
    [1, 2, 1]
    """
    result = [0] * (len(first) + len(second) - 1)
    for i, x in enumerate(first):
        if x:
            for j, y in enumerate(second):
                result[i + j] += x * y
    return result


def value_at(form: Sequence[int], p: int, q: int) -> int:
    """Evaluate a form exactly.

    >>> value_at([1, 2, 0], 1, 3)
    15
    """
    value, power = 0, 1
    for coefficient in form:  # Horner's rule in q, with the powers of p collected on the way
        value, power = value * q + coefficient * power, power * p
    return value


def _ahead(m: int, n: int) -> WinForms:
    return [0] * m + [1] * n, [1] * m + [0] * n


def _win_by(m: int, n: int, by: int) -> WinForms:
    """Return the forms of a win-by-K race: the ways to reach a score, times what follows."""
    race = Race(m, n, Rack(0.5), win_by=by)
    over = [1] * (2 * by)
    ways = {(0, 0): 1}
    ends: list[tuple[int, int, int, WinForms]] = []
    while ways:
        after: dict[tuple[int, int], int] = {}
        for (a, b), count in ways.items():
            winner = race.decided(a, b)
            if winner is not None:
                ends.append((a, b, count, (over, [0]) if winner == 1 else ([0], over)))
            elif a >= m - by and b >= n - by:  # from here on only the lead matters
                lead = (a - m) - (b - n)
                ends.append((a, b, count, _ahead(by - lead, by + lead)))
            else:
                for score in ((a + 1, b), (a, b + 1)):
                    after[score] = after.get(score, 0) + count
        ways = after
    longest = max(a + b for a, b, _, _ in ends)
    result = [0] * (longest + 2 * by), [0] * (longest + 2 * by)
    for a, b, count, forms in ends:
        spare = longest - a - b
        padding = [count * comb(spare, k) for k in range(spare + 1)]
        for total, form in zip(result, forms, strict=True):
            for k, c in enumerate(product(padding, form)):
                total[a + k] += c
    return result


def _composed(outer: Form, inside: WinForms) -> Form:
    """Return a form with a set's forms in place of p and q."""
    won, lost = inside
    result, power = [0], [1]
    for place, coefficient in enumerate(reversed(outer)):
        if place:
            result, power = product(result, won), product(power, lost)
        term = [coefficient * c for c in power]
        result = [x + y for x, y in zip_longest(result, term, fillvalue=0)]
    return result
