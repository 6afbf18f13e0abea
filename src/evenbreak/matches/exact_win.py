"""The chance of winning a match as a fraction.

As in `outcomes`, the score after each rack or set is a small Markov chain, and absorption in it
gives the outcomes of a match, which may be a set of a longer one. In a race, the scores only rise,
and a single pass over them in integers is enough.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable
from fractions import Fraction
from math import lcm

from evenbreak.chains.exact import exact_chance, exact_limit
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.outcomes import NEVER, ScoreChain, score_arcs
from evenbreak.matches.parameters import Ends, ends_of_game, first_breaker, rack_of_game

_Outcomes = dict[tuple[int, int], Fraction]
"""The chance of each (winner, next breaker)."""


def exact_win(match: Match, player: int) -> Fraction:
    """Return P(`player` wins the match) from its start score on, as a fraction.

    Raises InputError if the chances in a rack are arrays.

    >>> from evenbreak.games import Ahead
    >>> exact_win(Ahead(2, 2, Rack(0.6)), 1)
    Fraction(9, 13)
    """
    outcomes = _outcomes(match, match.score, first_breaker(match))
    return sum((p for (winner, _), p in outcomes.items() if winner == player), Fraction(0))


def exact_win_of_game(ends: Ends, player: int) -> Fraction:
    """Return P(`player` wins the game) with these endings, as a fraction.

    >>> from evenbreak.games import OneBall
    >>> exact_win_of_game(ends_of_game(OneBall(0.6, 0.6)), 1)
    Fraction(5, 7)
    """
    limit = exact_limit(ends.chain, None)
    return sum((limit[state] for state in ends.by_winner.get(player, [])), Fraction(0))


def _outcomes(match: Match, score: Score, breaker: int) -> _Outcomes:
    winner = match.decided(*score)
    if winner is not None:
        return {(winner, breaker): Fraction(1)}
    units = {first: _unit(match, first) for first in ((1, 2) if match.break_matters else (1,))}
    start = (*match.fold(*score), breaker)
    if isinstance(match, Race) and match.win_by == 1:
        return _rising(match, start, units)
    arcs = score_arcs(match, start, units)
    never = {first: 1 - sum(unit.values(), Fraction(0)) for first, unit in units.items()}
    rows: dict[Hashable, dict[Hashable, Fraction]] = {
        state: dict[Hashable, Fraction](row.items()) | {NEVER: never[state[2]]}
        for state, row in arcs.items()
    }
    chain = ScoreChain(rows)
    results = sorted({target for row in arcs.values() for target in row if len(target) == 2})
    return {result: chain.solve({result: Fraction(1)})[start] for result in results}


def _rising(match: Match, start: tuple[int, int, int], units: dict[int, _Outcomes]) -> _Outcomes:
    """Return the outcomes of a match whose scores only rise, in integers until the end.

    If a unit's chances have a common denominator, the chances after k units have its k-th power.
    """
    below = lcm(*(p.denominator for unit in units.values() for p in unit.values()))
    above = {
        first: {result: int(p * below) for result, p in unit.items()}
        for first, unit in units.items()
    }
    outcomes: _Outcomes = {}
    flow = defaultdict(int, {start: 1})
    # The scores are listed by the units played, so all the flow into one is known in its turn.
    for state, row in score_arcs(match, start, above).items():
        played = state[0] + state[1] - start[0] - start[1] + 1
        for target, ways in row.items():
            if len(target) == 3:
                flow[target] += flow[state] * ways
            else:
                chance = Fraction(flow[state] * ways, below**played)
                outcomes[target] = outcomes.get(target, Fraction(0)) + chance
    return outcomes


def _unit(match: Match, breaker: int) -> _Outcomes:
    """Return the outcomes of one rack or set of the match."""
    rack = match.rack
    if isinstance(rack, Rack):
        chance = _chance(rack, breaker)
        inside = {(breaker, breaker): chance, (3 - breaker, breaker): 1 - chance}
    elif isinstance(rack, Match):
        inside = _outcomes(rack, rack.score, breaker)
    else:
        rack_of_game(rack)  # refuses what player 1 or 2 need not win
        ends = ends_of_game(rack)
        inside = {(winner, breaker): exact_win_of_game(ends, winner) for winner in (1, 2)}
    grouped: _Outcomes = {}
    for (winner, carried), chance in inside.items():
        after = match.breaks(breaker, winner) if match.breaks is not None else carried
        result = winner, after if match.break_matters else 1
        grouped[result] = grouped.get(result, Fraction(0)) + chance
    return grouped


def _chance(rack: Rack, breaker: int) -> Fraction:
    """Return the breaker's chance in a rack, as a fraction."""
    numbers = rack.of_numbers()
    exact = rack.given[breaker - 1]
    if isinstance(exact, Fraction):
        return exact
    p, q = (numbers.p1, numbers.q1) if breaker == 1 else (numbers.p2, numbers.q2)
    # A chance this close to 1 has its digits in what is left over.
    return 1 - exact_chance(q) if p == 1.0 else exact_chance(p)
