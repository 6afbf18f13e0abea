"""A player's short code: it is typed, or scanned from the score card, and claims their phone.

It is drawn from the file's secret and from the entry with which the player came, so that it stays
the same after a restart, on another laptop, and when the name is corrected.
"""

from __future__ import annotations

import hashlib
import hmac
from collections.abc import Mapping

from evenbreak.tournaments.evening.fold import Evening

LETTERS = "CDFGHJKMNPQRTVWXY3469"
"""No letter that looks like another or like a digit, and no vowel: a code is no word."""

LENGTH = 5


def codes_of(state: Evening, key: str, before: Mapping[str, str] | None = None) -> dict[str, str]:
    """Return the code of each player in the tournament, drawn from the secret key.

    `before` has the codes of other events of the night: a player in one of them has a code already.

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
    """Return a code as it was typed, in the letters of codes.

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
