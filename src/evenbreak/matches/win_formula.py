"""The chance of winning as a formula, with sympy.

It needs sympy, which the extra `symbolic` installs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak.chains.symbolic import symbolic_limit
from evenbreak.checks import one_of
from evenbreak.games.ahead import Ahead
from evenbreak.games.match import Match
from evenbreak.games.one_ball import OneBall
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.formats import MatchFormat, match_format
from evenbreak.matches.parameters import checked_match, unit_of
from evenbreak.matches.rack_graph import breaker_in, rack_moves
from evenbreak.matches.win_forms import win_forms

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
    formats), P5.27 (n-ahead). A formula from another score or with breaks is solved for; that
    takes time for long matches.

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
        return symbolic_limit(_one_ball_arcs(), "S1")["W" if player == 1 else "L"]
    if isinstance(played, str):
        played = match_format(played)
    if isinstance(played, MatchFormat):
        rack = Rack(0.5) if _breaks_of(played) is None else Rack(0.5, 0.5)
        played = played.match(rack)
    match = checked_match(played)
    format_ = _format_of(match)
    return _of_forms(format_, player) if format_ is not None else _solved(match, player)


def _breaks_of(played: MatchFormat) -> str | None:
    return _breaks_of(played.set_) if played.set_ is not None else played.breaks


def _format_of(match: Match) -> MatchFormat | None:
    """Return the format of a match from 0:0 in which the break does not matter, else None."""
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


def _solved(match: Match, player: int) -> Any:
    """Return the formula from the diagram of the match, with 1 minus a symbol for the loser."""
    import sympy

    if match.break_matters:
        p1, p2 = sympy.symbols("p1 p2")
        chances = {1: (p1, 1 - p1), 2: (1 - p2, p2)}
    else:
        p = sympy.Symbol("p")
        chances = {1: (p, 1 - p)}
    moves = rack_moves(match)
    if match.winner(match.start) is not None:
        return sympy.Integer(match.winner(match.start) == player)
    # All scores with one winner are one final state, which keeps the systems small.
    arcs: dict[tuple[Any, Any], Any] = {}
    for state, row in moves.items():
        for (target, _), chance in zip(row, chances[breaker_in(match, state)], strict=True):
            end = target if target in moves else f"won by {match.winner(target)}"
            arcs[state, end] = arcs.get((state, end), 0) + chance
    triples = [(source, target, chance) for (source, target), chance in arcs.items()]
    return sympy.factor(symbolic_limit(triples, match.start)[f"won by {player}"])


def _one_ball_arcs() -> list[tuple[str, str, Any]]:
    import sympy

    p1, p2 = sympy.symbols("p1 p2")
    return [("S1", "W", p1), ("S1", "S2", 1 - p1), ("S2", "L", p2), ("S2", "S1", 1 - p2)]
