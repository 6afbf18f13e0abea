"""The standings of a Swiss under way."""

from __future__ import annotations

from evenbreak.answers.parts import Column, Part, Table
from evenbreak.tournaments.brackets.swiss import swiss_standings
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import pairings, swiss_of


def swiss_table(state: Evening) -> list[Part]:
    """Return the standings of a Swiss, once a round is over."""
    over = [
        pairs
        for pairs in pairings(state.later, state.counted)
        if all(p.winner or p.second is None for p in pairs)
    ]
    if not over:
        return []
    rows = swiss_standings(swiss_of(state.plan, state.order), over)
    columns = [
        Column("name", "player", left=True),
        Column("won", "matches\nwon"),
        Column("buchholz", "won by their\nopponents"),
    ]
    title = f"Standings after round {len(over)}"
    return [Table("standings", columns, [list(row) for row in rows], title=title)]
