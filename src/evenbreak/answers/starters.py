"""Which players are new, and how strong they are taken to be."""

from __future__ import annotations

import numpy as np

from evenbreak.answers.wording import count_of, some_of
from evenbreak.ratings.roster import Roster


def starters_words(listed: Roster, filled: Roster) -> str:
    """Return who has no rating on the list and what they are taken as; '' if nobody.

    >>> listed = Roster(["Ann", "Bo"], [600, np.nan])
    >>> starters_words(listed, listed.with_starters(500.0, 100.0))
    '1 player has no rating (Bo) and is taken as 500 ± 100.'
    """
    new = np.flatnonzero(np.isnan(listed.rating))
    if not new.size:
        return ""
    names = some_of([listed.players[place] for place in new])
    rating, error = filled.rating[new[0]], filled.standard_error[new[0]]
    off = "" if np.isnan(error) else f" ± {error:g}"
    have = "has" if new.size == 1 else "have"
    verb = "is" if new.size == 1 else "are"
    return (
        f"{count_of(int(new.size), 'player')} {have} no rating ({names}) and {verb} taken as "
        f"{rating:g}{off}."
    )
