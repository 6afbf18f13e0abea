"""What stands on the score card of a match, and who plays where in the first round."""

from __future__ import annotations

from dataclasses import dataclass

from evenbreak.tournaments.evening.fold import Evening


@dataclass(frozen=True)
class Card:
    """A score card.

    Parameters
    ----------
    match
        the match.
    where
        the part of the bracket, such as 'winners' side, round 2'.
    names, needs
        the players, and the games that each needs.
    table
        the table; None if it has not been called.
    onward
        where winner and loser go, a line each.
    """

    match: str
    where: str
    names: tuple[str, str]
    needs: tuple[int, int]
    table: int | None
    onward: tuple[str, ...]


def score_cards(state: Evening, match: str | None = None) -> list[Card]:
    """Return the cards of all matches whose players are known and that are not over, or of one.

    Raises
    ------
    InputError
        if the draw has not been made, or there is no such match with known players.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> names = ("Ann", "Bo", "Cy")
    >>> begun = Opened(Plan("single", 5), tuple(Entrant(name, 80.0) for name in names))
    >>> happened = begun, Drawn(names, (0, None, 1, 2))
    >>> (card,) = score_cards(evening([Event("2025-03-01T19:30:00", what) for what in happened]))
    >>> card.match, card.names, card.needs, card.onward
    ('W1.2', ('Bo', 'Cy'), (5, 5), ('The winner plays F.',))
    """
    found = state.bracket.match(match).name if match is not None else None
    if found is not None and found not in state.standing.to_play:
        from evenbreak.errors import InputError

        raise InputError(f"match {found} cannot be played now; its card can be printed when it can")
    names = [found] if found is not None else list(state.standing.to_play)
    return [_card(state, name) for name in names]


def _card(state: Evening, name: str) -> Card:
    match, pair = state.bracket.match(name), state.pair(name)
    onward = []
    for target, slots in state.bracket.graph.adj[name].items():
        onward += [f"The {outcome} plays {target}." for outcome in slots if outcome != "ranks"]
    side = {"winners": "winners' side", "losers": "losers' side"}.get(match.side, match.side)
    where = side if match.side in ("final", "second final") else f"{side}, round {match.round}"
    table = state.on_tables.get(name)
    return Card(
        name,
        where,
        pair,
        state.needed(name, pair),
        None if table is None else table.call.table,
        tuple(sorted(onward, reverse=True)),
    )
