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
    >>> author_words("phones: Tom and Jerry and Bo")
    'phones: Tom and Jerry and Bo'
    """
    if not kept:
        return say("a terminal")
    if kept == DIRECTOR:
        return say("director's page")
    if kept.startswith("phone: "):
        return say("phone: {player}", player=kept.removeprefix("phone: "))
    if kept.startswith(_PHONES):
        both = kept.removeprefix(_PHONES)
        names = both.split(_BETWEEN)
        # Where a name itself has an "and" in it, nobody can say where the other one starts.
        return say("phones: {players}", players=listed(names) if len(names) == 2 else both)
    if kept.startswith(_CAPTAIN):
        return say("captain of {team}", team=kept.removeprefix(_CAPTAIN))
    return kept
