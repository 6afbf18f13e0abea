"""From a full grid with byes to a bracket without them: byes resolved, places counted.

A player drawn against a bye advances without playing. The bye itself drops to the losers'
side like any loser, and where two byes meet, a bye advances.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple, TypeAlias

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Place, Slot, Source

FEWEST, MOST = 2, 256
"""The smallest and largest number of players in a bracket."""

DraftSlot: TypeAlias = Slot | None
"""A slot that may hold a bye: None."""


class Draft(NamedTuple):
    """A match in the full grid, before byes are resolved."""

    name: str
    side: str
    round: int
    slots: tuple[DraftSlot, DraftSlot]


class Rank(NamedTuple):
    """The players who leave the tournament at one point, and how many places they share.

    `seats` is None if there is one place for each listed player.
    """

    leaving: tuple[Source, ...]
    seats: int | None = None


def checked_players(players: Sequence[str] | int, *, fewest: int = FEWEST) -> tuple[str, ...]:
    """Return the players' names; a number n stands for '1' to 'n'.

    >>> checked_players(3)
    ('1', '2', '3')
    >>> checked_players(["Ann", "Ann"])
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: players has 'Ann' twice. Give each player a different name.
    """
    if isinstance(players, str):
        raise InputError(
            "{players} must be a list of names, or how many there are; you gave {value!r}",
            value=players,
        )
    if isinstance(players, Sequence):
        names = tuple(str(player) for player in players)
    else:
        names = tuple(str(k) for k in range(1, whole(players, "players") + 1))
    if not fewest <= len(names) <= MOST:
        raise InputError(
            "{players} must have {fewest} to {most} names; it has {n_names}",
            n_names=len(names),
            fewest=fewest,
            most=MOST,
        )
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise InputError(
                "{players} has {name!r} twice. Give each player a different name.", name=name
            )
        seen.add(name)
    return names


def winner(name: str) -> Source:
    """Return the source of a match's winner."""
    return Source(name, "winner")


def loser(name: str) -> Source:
    """Return the source of a match's loser."""
    return Source(name, "loser")


def bracket_of(
    form: str,
    players: tuple[str, ...],
    drafts: Sequence[Draft],
    ranks: Iterable[Rank],
    *,
    groups: Sequence[Group] = (),
    consolation: Iterable[Rank] = (),
) -> Bracket:
    """Return the bracket made from a full grid by resolving its byes.

    Each draft comes after those that feed it; ranks, best first, list who leaves the tournament, or
    the consolation event, at which point.
    """
    sent: dict[Source, DraftSlot] = {}
    kept: list[Draft] = []
    byes: list[tuple[str, int]] = []
    for draft in drafts:
        one, other = (_resolved(slot, sent) for slot in draft.slots)
        if one is None or other is None:
            there = other if one is None else one
            sent[winner(draft.name)], sent[loser(draft.name)] = there, None
            if isinstance(there, int):
                byes.append((draft.name, there))
        else:
            kept.append(draft._replace(slots=(one, other)))
    places = _places(ranks, sent) | _places(consolation, sent, "consolation")
    matches = tuple(
        Match(
            draft.name,
            draft.side,
            draft.round,
            draft.slots,  # type: ignore[arg-type]  # byes are gone
            places.get(winner(draft.name)),
            places.get(loser(draft.name)),
        )
        for draft in kept
    )
    return Bracket(form, players, matches, tuple(groups), tuple(byes))


def _resolved(slot: DraftSlot, sent: dict[Source, DraftSlot]) -> DraftSlot:
    if not isinstance(slot, Source):
        return slot
    key = slot._replace(via=None)
    return sent.get(key, slot)


def _places(
    ranks: Iterable[Rank], sent: dict[Source, DraftSlot], event: str = ""
) -> dict[Source, Place]:
    places: dict[Source, Place] = {}
    first = 1
    for leaving, seats in ranks:
        there = [source for source in leaving if source not in sent]
        last = first - 1 + (len(there) if seats is None else seats)
        places |= dict.fromkeys(there, Place(first, last, event))
        first = last + 1 if there else first
    return places
