"""Which players are new, and how strong they are taken to be."""

from __future__ import annotations

import numpy as np

from evenbreak.answers.wording import count_of, some_of
from evenbreak.ratings.roster import Roster


def starters_words(listed: Roster, filled: Roster) -> str:
    """Return who has no rating on the list and what they are taken as; '' if nobody.

    >>> listed = Roster(["Ann", "Bo"], [600, np.nan])
    >>> starters_words(listed, listed.with_starters(500.0, 100.0, "fargo"))
    '1 player has no rating (Bo) and is taken as 500 ± 100.'
    """
    new = np.flatnonzero(np.isnan(listed.rating))
    said = [games_words(listed, filled)]
    if new.size:
        names = some_of([listed.players[place] for place in new])
        rating, error = filled.rating[new[0]], filled.standard_error[new[0]]
        off = "" if np.isnan(error) else f" ± {error:g}"
        have, verb = ("has", "is") if new.size == 1 else ("have", "are")
        said.insert(
            0,
            f"{count_of(int(new.size), 'player')} {have} no rating ({names}) and {verb} taken as "
            f"{rating:g}{off}.",
        )
    return " ".join(filter(None, said))


def games_words(listed: Roster, filled: Roster) -> str:
    """Return whose error comes from the games behind their rating; '' if nobody's does.

    >>> listed = Roster(["Ann", "Bo"], [600, 500], games=[300, 12])
    >>> games_words(listed, listed.with_starters(500.0, 100.0, "fargo"))
    'The errors of 2 ratings come from their games, such as ± 83 for Bo after 12.'
    """
    rated = ~np.isnan(listed.rating) & np.isnan(listed.standard_error) & (listed.games >= 0)
    by_games = np.flatnonzero(rated)
    if not by_games.size:
        return ""
    least = by_games[listed.games[by_games].argmin()]
    name = listed.players[least]
    error = filled.standard_error[filled.position(name)]
    return (
        f"The {'errors' if by_games.size > 1 else 'error'} of {count_of(by_games.size, 'rating')} "
        f"{'come from their games, such as' if by_games.size > 1 else 'comes from its games:'} "
        f"± {error:.{0 if error >= 10 else 1}f} for {name} after {listed.games[least]:,}."
    )
