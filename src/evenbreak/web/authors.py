"""Who entered something: how it is kept with the entry, and what a page says of it."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.words import listed, say

DIRECTOR = "director's page"
_PHONES, _CAPTAIN = "phones: ", "captain of "
_BETWEEN = " and "


def phones_of(players: Sequence[str]) -> str:
    """Return whose phones entered something, as it is kept."""
    return ("phone: " if len(players) == 1 else _PHONES) + _BETWEEN.join(players)


def captain_of_team(team: str) -> str:
    """Return the captain of a team, as it is kept."""
    return _CAPTAIN + team


def author_words(kept: str) -> str:
    """Return who entered something.

    >>> author_words("phone: Tom and Jerry"), author_words("captain of the Shark")
    ('phone: Tom and Jerry', 'captain of the Shark')
    """
    if not kept:
        return say("a terminal")
    if kept == DIRECTOR:
        return say("director's page")
    if kept.startswith("phone: "):
        return say("phone: {player}", player=kept.removeprefix("phone: "))
    if kept.startswith(_PHONES):
        return say("phones: {players}", players=listed(kept.removeprefix(_PHONES).split(_BETWEEN)))
    if kept.startswith(_CAPTAIN):
        return say("captain of {team}", team=kept.removeprefix(_CAPTAIN))
    return kept
