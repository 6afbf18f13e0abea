"""Choosing the players of a sheet: by name, or those who play most."""

from collections.abc import Sequence

from evenbreak.errors import InputError
from evenbreak.files.tables.names import KnownNames, clean_name
from evenbreak.files.tables.problems import quoted
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster


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
