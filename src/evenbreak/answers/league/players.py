"""Choosing the players of a sheet: by name, or those who play most."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from evenbreak.answers.kit.wording import count_of, some_of
from evenbreak.errors import InputError
from evenbreak.files.tables.names import KnownNames, clean_name
from evenbreak.files.tables.problems import quoted
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import NOT_STATED, Roster


def most_active(ratings: Ratings, top: int) -> list[int]:
    """Return the players with the most games (positions in `ratings.players`), the most first.

    Players with equally many games are ordered by their matches known by the winner alone,
    then by name.
    """
    races = ratings.races_won + ratings.races_lost
    order = sorted(range(len(ratings.players)), key=lambda k: (-ratings.games[k], -races[k], k))
    return order[:top]


def find_players(
    ratings: Ratings | Results | Roster,
    names: Sequence[str],
    *,
    said: str = "players",
    where: str = "the results",
) -> list[int]:
    """Return the positions of the named players, each once; upper and lower case may differ.

    Parameters
    ----------
    ratings
        the players to search.
    names
        as a person typed them.
    said
        the parameter or option that named them, for the error.
    where
        where they should stand, for the error.

    Raises
    ------
    InputError
        if names are not among the players; it lists all of them, each with similar names.
    """
    known = KnownNames(ratings.players)
    found: dict[int, None] = {}
    unknown: dict[str, None] = {}
    for name in map(clean_name, names):
        place = known.place(name)
        if place is None:
            unknown[quoted(name) + known.hint(name)] = None
        else:
            found[place] = None
    if unknown:
        raise InputError(
            f"{said}: not in {where}: {', '.join(unknown)}; write names as they stand there"
        )
    return list(found)


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
    >>> listed = Roster(["Ann", "Bo"], [600, 500], games=[300, NOT_STATED])
    >>> games_words(listed, listed.with_starters(500.0, 100.0, "fargo"))
    'The error of 1 rating comes from its games: ± 17 for Ann after 300. The games of 1 rating (Bo)
    are not stated: it is taken to be as uncertain as that of a new player, ± 100.'
    """
    rated = ~np.isnan(listed.rating) & np.isnan(listed.standard_error)
    by_games = np.flatnonzero(rated & (listed.games != NOT_STATED))
    said = []
    if by_games.size:
        least = by_games[listed.games[by_games].argmin()]
        name = listed.players[least]
        error = filled.standard_error[filled.position(name)]
        said.append(
            f"The {'errors' if by_games.size > 1 else 'error'} of "
            f"{count_of(by_games.size, 'rating')} "
            f"{'come from their games, such as' if by_games.size > 1 else 'comes from its games:'} "
            f"± {error:.{0 if error >= 10 else 1}f} for {name} after {listed.games[least]:,}."
        )
    silent = [listed.players[k] for k in np.flatnonzero(rated & (listed.games == NOT_STATED))]
    error = filled.standard_error[filled.position(silent[0])] if silent else np.nan
    if not np.isnan(error):
        said.append(
            f"The games of {count_of(len(silent), 'rating')} ({some_of(silent)}) are not stated: "
            f"{'they are' if silent[1:] else 'it is'} taken to be as uncertain as that of a new "
            f"player, ± {error:.4g}."
        )
    return " ".join(said)
