"""What the director decides: matches of the wrong players that stand, ties that are broken."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Group, Source
from evenbreak.tournaments.evening.events import Ranked, Result
from evenbreak.tournaments.evening.fold import Evening, tied_ranks
from evenbreak.tournaments.evening.moves import known_match
from evenbreak.words import Command, listed


def stand(state: Evening, match: str) -> list[Result]:
    """Let a match stand that was played before a correction sent somebody else into it.

    The players who had moved on into it from the corrected match stay where they are. The
    corrected score is kept.

    Returns
    -------
    list of Result
        the corrected matches, with the player who has played on as winner.

    Raises
    ------
    InputError
        if the match was not played by other players, or an earlier one must stand first.
    """
    if state.plan.form == "chips":
        raise InputError("a rack of a player without chips can't stand; play it again, or undo")
    name = known_match(state, match)
    played = {one.result.match: one.result for one in state.aside}
    if name not in played:
        if not played:
            raise InputError(
                "{match} was not played by the wrong players, so there is nothing to let stand",
                match=name,
            )
        raise InputError(
            "{match} was not played by the wrong players, so there is nothing to let stand; "
            "{others} can stand",
            match=name,
            others=listed(list(played)),
        )
    wanted = set(played[name].players)
    found = []
    seats = [
        None if seat is None or seat < 0 else state.order[seat]
        for seat in state.standing.seats[name]
    ]
    missing = wanted - set(seats)
    for slot, there in zip(state.bracket.match(name).slots, seats, strict=True):
        if there in wanted:
            continue
        before = state.counted.get(slot.match) if isinstance(slot, Source) else None
        if before is None:
            first = slot.match if isinstance(slot, Source) else name
            raise InputError(
                "{first}, which leads to {match}, is open; settle {first} first",
                first=first,
                match=name,
            )
        if not missing & set(before.players):
            raise InputError(
                "{players} did not come from {before}, so {match} can't stand; play it "
                "again, or undo",
                players=listed(sorted(missing)),
                before=before.match,
                match=name,
            )
        found.append(replace(before, winner=before.loser, corrects=True, stands=not before.stands))
    return found


def tied_groups(state: Evening) -> list[str]:
    """Return the groups that are played out and tied, so that it is open who goes on."""
    return [
        group.name
        for group in state.bracket.groups
        if None in group.places
        and all(name in state.counted for name in group.matches)
        and Source(group.name, 1) not in state.standing.sent
    ]


class TieBreak(NamedTuple):
    """How the ties of a group were broken.

    Parameters
    ----------
    ranked
        the final order.
    difference
        the games that each player won minus those they lost.
    by_lot
        the players whose order was drawn by lot.
    """

    ranked: Ranked
    difference: dict[str, int]
    by_lot: tuple[str, ...]


def break_ties(state: Evening, rng: np.random.Generator, *, only_lots: bool = False) -> TieBreak:
    """Break the ties of a round robin that is played out.

    Players who are level in matches won, also among themselves, are ranked by games won minus
    games lost in all their matches, and then by lot.

    Parameters
    ----------
    state
        the evening.
    rng
        draws the lots.
    only_lots
        whether games do not count, so that lots alone break the ties.

    Raises
    ------
    InputError
        if there is no tie.
    """
    broken = []
    for group in state.bracket.groups:
        if group.name in state.ties and group.name in state.results:
            broken.append(group.name)
        elif group.matches and all(name in state.counted for name in group.matches):
            ahead = tied_ranks(state.standing, group)
            if len(set(ahead)) < len(ahead):
                return _broken(state, group, ahead, rng, only_lots=only_lots)
    if broken:
        raise InputError(
            "the ties are already broken; to take that back: {undo}",
            undo=Command("tournament undo"),
        )
    raise InputError("there is no tie to break; ties are broken once all matches are played")


def _broken(
    state: Evening, group: Group, ahead: list[int], rng: np.random.Generator, *, only_lots: bool
) -> TieBreak:
    names = [state.order[k] for k in group.members]
    difference = dict.fromkeys(names, 0)
    for match in group.matches:
        result = state.counted[match]
        one, other = result.players
        difference[one] += result.score[0] - result.score[1]
        difference[other] += result.score[1] - result.score[0]
    key = {
        name: (rank, 0 if only_lots else -difference[name])
        for name, rank in zip(names, ahead, strict=True)
    }
    lots = dict(zip(names, rng.permutation(len(names)).tolist(), strict=True))
    order = tuple(sorted(names, key=lambda name: (key[name], lots[name])))
    drawn = tuple(name for name in order if list(key.values()).count(key[name]) > 1)
    return TieBreak(Ranked(group.name, order), difference, drawn)
