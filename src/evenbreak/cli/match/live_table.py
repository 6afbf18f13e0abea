"""The comeback table on a terminal: A's chances at every score to come, in percent."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from evenbreak.cli.kit.output import aligned
from evenbreak.games.ahead import Ahead
from evenbreak.games.rack import Rack

if TYPE_CHECKING:
    from evenbreak.games.match import Match
    from evenbreak.matches.live import LiveOdds

Score = tuple[int, int]
Cells = Mapping[Score, float]

_ACROSS = 10
"""Columns side by side, so that 80 characters hold them."""


def comeback_text(match: Match, odds: LiveOdds) -> str:
    """Return the comeback table as text: a matrix of scores, or a list of leads.

    In a match of sets, the scores of the set under way, then those at which a set begins. A
    star stands before the chance at the score now.

    >>> from evenbreak.games import Race
    >>> from evenbreak.matches import live_odds
    >>> race = Race(2, 2, Rack(0.5))
    >>> print(comeback_text(race, live_odds(race)), end="")
    A wins the match at each score, in %
    * is the score now
    <BLANKLINE>
             B 0   B 1
      A 0  *50.0  25.0
      A 1   75.0  50.0
    """
    moments = odds.comebacks()
    if not moments:
        return "The match is over: no score is to come.\n"
    parts = []
    for breaker in sorted({moment.breaker or 0 for moment in moments}):
        score, *inner = odds.now.scores if (odds.now.breaker or 0) == breaker else ((-1, -1),)
        here = [moment for moment in moments if (moment.breaker or 0) == breaker]
        breaks = f" with {' AB'[breaker]} to break" if breaker else ""
        if isinstance(match.rack, Rack):
            cells = {moment.scores[0]: moment.p_win_1 for moment in here}
            title = f"at each score{breaks}"
            parts.append(_part(title, cells, isinstance(match, Ahead), score))
            continue
        now, begin = match.fold(*odds.now.scores[0]), match.rack.fold(*match.rack.score)
        inside = {m.scores[1]: m.p_win_1 for m in here if m.scores[0] == now}
        if inside:
            title = f"at each score of the set under way{breaks}"
            at = inner[0] if inner else None
            parts.append(_part(title, inside, isinstance(match.rack, Ahead), at))
        between = {m.scores[0]: m.p_win_1 for m in here if m.scores[1] == begin}
        if between:
            title = f"at each score in sets, as a set begins{breaks}"
            at = score if inner == [begin] else None
            parts.append(_part(title, between, isinstance(match, Ahead), at))
    return "\n".join(parts)


def _part(title: str, cells: Cells, leads: bool, now: Score | None) -> str:
    star = "* is the score now\n" if now in cells else ""
    text = f"A wins the match {title}, in %\n{star}\n"
    shown = {at: f"{'*' if at == now else ''}{100 * cells[at]:.1f}" for at in cells}
    if leads:
        by_lead = {a - b: chance for (a, b), chance in shown.items()}
        return text + aligned([[_lead(k), by_lead[k]] for k in sorted(by_lead)])
    rows = sorted({a for a, _ in cells})
    columns = sorted({b for _, b in cells})
    blocks = []
    for at in range(0, len(columns), _ACROSS):
        across = columns[at : at + _ACROSS]
        lines = [["", *(f"B {b}" for b in across)]]
        lines += [[f"A {a}", *(shown.get((a, b), "") for b in across)] for a in rows]
        blocks.append(aligned(lines))
    return text + "\n".join(blocks)


def _lead(lead: int) -> str:
    if lead == 0:
        return "level"
    return f"{'A' if lead > 0 else 'B'} leads by {abs(lead)}"
