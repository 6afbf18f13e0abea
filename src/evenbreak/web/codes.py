"""A player's short code, typed or scanned from the score card to claim their phone.

It is derived from the file's secret and the player's first entry, so it stays the same after a
restart, on another laptop, and when the name is corrected.
"""

from __future__ import annotations

import hashlib
import hmac
from collections.abc import Mapping

from evenbreak.tournaments.evening.fold import Evening

LETTERS = "CDFGHJKMNPQRTVWXY3469"
"""No letters that look like another letter or a digit, and no vowels, so that no code is a word."""

LENGTH = 5


def codes_of(state: Evening, key: str, before: Mapping[str, str] | None = None) -> dict[str, str]:
    """Return each player's code in the tournament, derived from the secret key.

    `before` has the codes from the night's other events: a player in one of these already has a
    code.

    >>> from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan, Renamed
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> both = Opened(Plan("single", 5), (Entrant("Ann", 80.0), Entrant("Bo", 70.0)))
    >>> renamed = Renamed("Ann", "Anne")
    >>> one, other = (
    ...     evening([Event("2025-03-01T19:30:00", what) for what in happened])
    ...     for happened in ([both], [both, renamed])
    ... )
    >>> codes_of(one, "key")["Ann"] == codes_of(other, "key")["Anne"]
    True
    """
    begun = state.events[0].at
    found = {code: name for name, code in (before or {}).items()}
    for name, (number, place) in state.entries.items():
        again = 0
        if name in (before or {}):
            continue
        while (code := _code(key, f"{begun} {number}.{place} {again}")) in found:
            again += 1
        found[code] = name
    return {
        name: code for code, name in found.items() if name in {**state.entrants, **(before or {})}
    }


def code_in(text: str) -> str:
    """Return a typed code in the alphabet of codes.

    >>> code_in(" fk7-q2 ")
    'FK7Q2'
    """
    return "".join(letter for letter in text.upper() if letter.isascii() and letter.isalnum())


def _code(key: str, what: str) -> str:
    number = int.from_bytes(hmac.digest(key.encode(), what.encode(), hashlib.sha256)[:8])
    code = ""
    for _ in range(LENGTH):
        number, at = divmod(number, len(LETTERS))
        code += LETTERS[at]
    return code
