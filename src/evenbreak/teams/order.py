"""The order of nomination: which team names its player first, set by set."""

from __future__ import annotations

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.words import Parameter, say

OURS, THEIRS, BOTH, WINNER, LOSER = "A", "B", "=", "W", "L"
_MIRROR = {OURS: THEIRS, THEIRS: OURS}
NAMED = {
    "alternate": "AB",
    "home": "A",
    "blind": "=",
    "winner": "AW",
    "loser": "AL",
}
"""Orders with a name, as patterns; the last letters are repeated (AB) or the last one (AW)."""


def order_of(text: str, sets: int) -> str:
    """Return who names first in each set, a letter each.

    Parameters
    ----------
    text
        a pattern such as 'ABABA', a shorter one that is repeated, or a name: 'alternate' (AB...),
        'home' (A...), 'blind' (=...), 'winner' and 'loser' (A, then who won or lost the last set).
        A: we name first and they answer; B: the other way round; =: both at once, blind; W and L:
        the winner or the loser of the last set names first.
    sets
        how many sets there are.

    Raises
    ------
    InputError
        if the text is not an order, is longer than the night, or asks who won before the first set.

    >>> order_of("alternate", 5), order_of("ABBA", 5), order_of("loser", 3)
    ('ABABA', 'ABBAA', 'ALL')
    """
    whole(sets, "sets", at_least=1)
    pattern = NAMED.get(text.strip().lower(), "")[:sets] or text.strip().upper()
    wanted = say(
        "write who names first in each set: A (you), B (they), = (both at once, unseen), W or L "
        "(who won or lost the last set); or a name: {names}",
        names=", ".join(NAMED),
    )
    if not pattern or set(pattern) - {OURS, THEIRS, BOTH, WINNER, LOSER}:
        raise InputError(
            "{order} is {text!r}; {wanted}", order=Parameter("order"), text=text, wanted=wanted
        )
    if len(pattern) > sets:
        raise InputError(
            "{order} is {text!r}, {letters} letters for {sets} sets; {wanted}",
            order=Parameter("order"),
            text=text,
            letters=len(pattern),
            sets=sets,
            wanted=wanted,
        )
    repeated = pattern[-1:] if pattern[-1] in (WINNER, LOSER) else pattern
    found = (pattern + repeated * sets)[:sets]
    if found[0] in (WINNER, LOSER):
        raise InputError(
            "{order} is {text!r}, but nobody has won before the first set; {wanted}",
            order=Parameter("order"),
            text=text,
            wanted=wanted,
        )
    return found


def mirrored(order: str) -> str:
    """Return the order if the other team wins the toss: A and B change places.

    >>> mirrored("AB=AW")
    'BA=BW'
    """
    return "".join(_MIRROR.get(letter, letter) for letter in order)
