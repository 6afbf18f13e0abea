"""Where a team night stands: --used, --score, --playing, --named, --last."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from evenbreak import ratings, teams
from evenbreak.arrays import Floats
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.team.scores import check_score
from evenbreak.files.tables.names import KnownNames
from evenbreak.teams.meeting import SEALED
from evenbreak.teams.night import LOSER, WINNER, order_of

if TYPE_CHECKING:
    from evenbreak.teams.meeting import Meeting

_PLAYING = re.compile(r"\s*(.+?)\s+(?:v|vs|-)\.?\s+(.+?)\s+(\d+)\s*[:/-]\s*(\d+)\s*", re.ASCII)
_SIDES = ("ours", "theirs")


def point_of(
    meeting: Meeting,
    used: str | None,
    score: tuple[int, int] | None,
    playing: tuple[str, ...],
    named: str | None,
    last: str | None,
) -> teams.Point:
    """Return the point in the night that the options describe, or refuse what cannot be."""
    if meeting.order == SEALED:
        refuse("--order sealed is asked before the night; leave out what has happened since")
    rosters = meeting.ours, meeting.theirs
    both: tuple[list[str], list[str]] = ([], [])
    for text in (used or "").split(","):
        if text.strip():
            side, name = _player(rosters, text.strip(), "--used")
            both[side].append(name)
    laws = []
    for text in playing:
        names, law = _in_play(meeting, text)
        laws.append(law)
        for side in (0, 1):
            both[side].extend(names[side])
    if score is None and len(both[0]) > len(laws):
        refuse("--used names players whose sets are over; give the score so far with --score")
    if last is not None and not set(order_of(meeting.order, len(meeting.sizes))) & {WINNER, LOSER}:
        refuse("--last is for an order in which the winner or loser of the last set names first")
    if score is not None:
        check_score(meeting, score, _sets_over(meeting, len(both[0]), len(laws)), last)
    lead = 0 if score is None else score[0] - score[1]
    return teams.Point(
        tuple(both[0]),
        tuple(both[1]),
        lead,
        None if last is None else last == "won",
        () if named is None else _named(rosters, named),
        tuple(laws),
    )


def _sets_over(meeting: Meeting, used: int, playing: int) -> int:
    """Return how many sets are over, if so many of our players are used up or playing."""
    begun = next((k for k in range(len(meeting.sizes) + 1) if sum(meeting.sizes[:k]) >= used), 0)
    return max(0, begun - playing)


def _named(rosters: tuple[ratings.Roster, ratings.Roster], text: str) -> tuple[str, ...]:
    """Return the player that was named, or the pair."""
    return tuple(
        _player(rosters, part.strip(), "--named", any_side=True)[1]
        for part in re.split(r",|&|\band\b", text)
        if part.strip()
    )


def _player(
    rosters: tuple[ratings.Roster, ratings.Roster],
    text: str,
    option: str,
    *,
    any_side: bool = False,
) -> tuple[int, str]:
    """Return the side of a player, and the name as the file spells it."""
    head, colon, name = text.partition(":")
    side = head.strip().lower() if colon else ""
    sides = [_SIDES.index(side)] if side in _SIDES else [0, 1]
    wanted = name.strip() if len(sides) == 1 else text
    found = [
        (side, rosters[side].players[place])
        for side in sides
        if (place := KnownNames(rosters[side].players).place(wanted)) is not None
    ] or _by_beginning([(side, name) for side in sides for name in rosters[side].players], wanted)
    if not found and len(sides) == 1 and option == "--playing":
        other = KnownNames(rosters[1 - sides[0]].players).place(wanted)
        if other is not None:
            refuse(f"{option}: {wanted!r} is in the other team; write your player, then theirs")
    if not found:
        hint = KnownNames([*rosters[0].players, *rosters[1].players]).hint(wanted)
        refuse(f"{option}: {wanted!r} is in neither team{hint}")
    if len(found) > 1 and not any_side:
        refuse(f"{option}: both teams have a {wanted!r}; write ours:{wanted} or theirs:{wanted}")
    return found[0]


def _by_beginning(players: list[tuple[int, str]], wanted: str) -> list[tuple[int, str]]:
    """Return the one player whose first or last name begins like this; none if there are more."""
    begin = f" {wanted.casefold()}"
    found = [(side, name) for side, name in players if wanted and begin in f" {name.casefold()}"]
    return found if len(found) == 1 else []


def _in_play(meeting: Meeting, text: str) -> tuple[list[list[str]], Floats]:
    match = _PLAYING.fullmatch(text)
    if match is None:
        wanted = 'write your player, theirs and the score, such as "Ann v Xi 3:2"'
        refuse(f"--playing {text!r}; {wanted}")
    names = [
        [
            _player((meeting.ours, meeting.theirs), f"{_SIDES[side]}:{part.strip()}", "--playing")[
                1
            ]
            for part in re.split(r",|&|\band\b", match[side + 1])
        ]
        for side in (0, 1)
    ]
    law = meeting.law_in_play(names[0], names[1], (int(match[3]), int(match[4])))
    return names, law
