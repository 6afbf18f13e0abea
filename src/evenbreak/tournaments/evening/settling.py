"""The director's decisions: letting the wrong players' matches stand, and breaking ties."""

from __future__ import annotations

from collections.abc import Mapping
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
    """Let a match count that was played before a correction changed its players.

    A player who moved on into it from the corrected match stays where they are, as that match's
    winner, and the corrected score is kept. Returns the corrected matches. Raises InputError if the
    match wasn't played by other players, or an earlier match must be settled first.
    """
    if state.plan.form == "chips":
        raise InputError(
            "a rack played by someone with no chips left can't stand. Play it again, or undo it."
        )
    name = known_match(state, match)
    played = {one.result.match: one.result for one in state.aside}
    if name not in played:
        if not played:
            raise InputError(
                "{match} wasn't played by the wrong players, so there's nothing to let stand",
                match=state.match_words(name),
            )
        raise InputError(
            "{match} wasn't played by the wrong players, so there's nothing to let "
            "stand; {others} can stand",
            match=state.match_words(name),
            others=listed([state.match_words(one) for one in played]),
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
                "{first} leads to {match} and is still open. Settle {first} first.",
                first=state.match_words(first),
                match=state.match_words(name),
            )
        if not missing & set(before.players):
            raise InputError(
                "{players} didn't come from {before}, so {match} can't stand. Play it "
                "again, or undo it.",
                players=listed(sorted(missing)),
                before=state.match_words(before.match),
                match=state.match_words(name),
            )
        found.append(replace(before, winner=before.loser, corrects=True, stands=not before.stands))
    return found


def tied_groups(state: Evening) -> list[str]:
    """Return the completed groups with ties that leave open who advances.

    The runners-up count as a group, named after their rank, once all groups are settled.
    """
    found = [
        group.name
        for group in state.bracket.groups
        if None in group.places
        and all(name in state.counted for name in group.matches)
        and Source(group.name, 1) not in state.standing.sent
    ]
    return [*found, *_tied_runners(state)]


def _tied_runners(state: Evening) -> list[str]:
    """Return the runners-up's name if it is open which of them advance."""
    runners_up, now = state.bracket.runners_up, state.standing
    if runners_up is None or len(now.runners_up) < len(state.bracket.groups):
        return []
    return [] if Source(runners_up.name, 1) in now.sent else [runners_up.name]


class TieBreak(NamedTuple):
    """A group's order after its ties are broken, by games won minus lost, then by lot."""

    ranked: Ranked
    difference: dict[str, int]
    by_lot: tuple[str, ...]


def break_ties(state: Evening, rng: np.random.Generator, *, only_lots: bool = False) -> TieBreak:
    """Break a finished round robin's ties; with `only_lots`, only by lot.

    Players who are tied in matches won, overall and among themselves, are ranked by games won minus
    games lost in all their matches, and then by lot. Runners-up from several groups who are tied in
    the share of matches won are ranked by the same difference per match, and then by lot. Raises
    InputError if there is no tie.
    """
    runners_up = state.bracket.runners_up
    broken = [runners_up.name] if runners_up and runners_up.name in state.results else []
    for group in state.bracket.groups:
        if group.name in state.ties and group.name in state.results:
            broken.append(group.name)
        elif group.matches and all(name in state.counted for name in group.matches):
            ahead = tied_ranks(state.standing, group)
            if len(set(ahead)) < len(ahead):
                return _broken(state, group, ahead, rng, only_lots=only_lots)
    for name in _tied_runners(state):
        return _runners_broken(state, name, rng, only_lots=only_lots)
    if broken:
        raise InputError(
            "the ties are already broken; to take that back: {undo}",
            undo=Command("tournament undo"),
        )
    raise InputError("there's no tie to break; ties are broken once all matches are played")


def _broken(
    state: Evening, group: Group, ahead: list[int], rng: np.random.Generator, *, only_lots: bool
) -> TieBreak:
    names = [state.order[k] for k in group.members]
    difference = _differences(state, group)
    key: dict[str, tuple[float, float]] = {
        name: (rank, 0 if only_lots else -difference[name])
        for name, rank in zip(names, ahead, strict=True)
    }
    return _by_key(group.name, key, difference, rng)


def _runners_broken(
    state: Evening, name: str, rng: np.random.Generator, *, only_lots: bool
) -> TieBreak:
    groups = {group.name: group for group in state.bracket.groups}
    difference: dict[str, int] = {}
    key: dict[str, tuple[float, float]] = {}
    for letters, seat, share in state.standing.runners_up:
        group, player = groups[letters], state.order[seat]
        difference[player] = _differences(state, group)[player]
        played = 2 * len(group.matches) / len(group.members)
        key[player] = -share, 0 if only_lots else -difference[player] / played
    return _by_key(name, key, difference, rng)


def _differences(state: Evening, group: Group) -> dict[str, int]:
    """Return the games won minus games lost for each player in a group."""
    difference = dict.fromkeys((state.order[k] for k in group.members), 0)
    for match in group.matches:
        result = state.counted[match]
        one, other = result.players
        difference[one] += result.score[0] - result.score[1]
        difference[other] += result.score[1] - result.score[0]
    return difference


def _by_key(
    group: str,
    key: Mapping[str, tuple[float, float]],
    difference: dict[str, int],
    rng: np.random.Generator,
) -> TieBreak:
    """Return the players in the order of a key, breaking ties by lot."""
    names = list(key)
    lots = dict(zip(names, rng.permutation(len(names)).tolist(), strict=True))
    order = tuple(sorted(names, key=lambda name: (key[name], lots[name])))
    drawn = tuple(name for name in order if list(key.values()).count(key[name]) > 1)
    return TieBreak(Ranked(group, order), difference, drawn)
