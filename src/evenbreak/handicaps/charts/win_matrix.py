"""The chance of every player against every other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.given_ratings import win_given_ratings
from evenbreak.ratings.fitted import Ratings

if TYPE_CHECKING:
    import pandas as pd


def win_matrix(
    ratings: Ratings, players: Sequence[str] | None = None, *, race: tuple[int, int] = (1, 1)
) -> pd.DataFrame:
    """Return the chance of every player against every other.

    Each chance is averaged over the error of the difference of the two ratings, in which what
    is uncertain for both cancels.

    Parameters
    ----------
    ratings
        what `fit` returns.
    players
        names; None: all of them.
    race
        the games that the player of the row and the player of the column need; (1, 1) is a
        single game.

    Returns
    -------
    pandas.DataFrame
        P(the player of the row wins); NaN on the diagonal, and where no chain of opponents
        connects the two.

    Raises
    ------
    InputError
        if a player is not rated or named twice, or the race is not two whole numbers above 0.

    >>> from evenbreak.ratings import Results, fit
    >>> ratings = fit(Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [14, 10], [10, 10]))
    >>> win_matrix(ratings).round(3)
    player    Ann     Bo     Cy
    player
    Ann       NaN  0.566  0.557
    Bo      0.434    NaN  0.493
    Cy      0.443  0.507    NaN
    """
    import pandas as pd

    if not isinstance(ratings, Ratings):
        raise InputError(f"ratings is {ratings!r:.60}; give what fit(results) returns")
    named = list(ratings.players if players is None else players)
    if len(set(named)) < len(named):
        raise InputError("players holds a name twice; give each name once")
    try:
        m, n = (whole(games, "race", at_least=1) for games in race)
    except (TypeError, ValueError):
        raise InputError(f"race is {race!r}; give two whole numbers such as (7, 5)") from None
    covariance = ratings.covariance(named)
    position = {name: place for place, name in enumerate(ratings.players)}
    places = [position[name] for name in named]
    rating, component = ratings.rating[places], ratings.component[places]
    variance = np.diag(covariance)
    spread = variance[:, None] + variance - 2.0 * covariance
    known = component[:, None] == component
    np.fill_diagonal(known, val=False)
    chance = np.full(known.shape, np.nan)
    chance[known] = win_given_ratings(
        (rating[:, None] - rating)[known],
        np.sqrt(np.maximum(spread, 0.0))[known],
        m,
        n,
        scale=ratings.scale,
    )
    names = pd.Index(named, name="player")
    return pd.DataFrame(chance, index=names, columns=names)
