"""The fairest race of each pair of rated players."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import pandas as pd

from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.answers.roster_matchups import roster_matchups
from evenbreak.files.csv_writer import DECIMALS
from evenbreak.handicaps.charts.given_ratings import MOST_DOUBLINGS
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.roster import Roster


def matchups_frame(ratings: Ratings, players: Sequence[int], offered: OfferedRaces) -> pd.DataFrame:
    """Return the fairest race of each pair of players, the stronger of the two first.

    The races are those of `roster_matchups` for the list of ratings that a report writes, so a
    pair has the same race here and wherever that list is read.

    Parameters
    ----------
    ratings
        how strong everybody is.
    players
        who is paired: positions in `ratings.players`.
    offered
        the races to choose from.

    Returns
    -------
    pandas.DataFrame
        the frame of `roster_matchups`. Where no chain of opponents links the two, their ratings
        cannot be compared: there are no numbers then, and the note says so.
    """
    order = ratings.strongest_first(players)
    pairs = np.array(list(combinations(order, 2)), dtype=np.int64).reshape(-1, 2)
    return roster_matchups(
        _as_listed(ratings), pairs, scale=ratings.scale, offered=offered, form=ratings.match_form
    ).frame


def _as_listed(ratings: Ratings) -> Roster:
    """Return the ratings as their list has them: rounded, with an error for each player."""
    # An error beyond this says that nothing is known; numbers would not change much.
    most = MOST_DOUBLINGS * ratings.scale.points_per_doubling / 2.0
    return Roster(
        ratings.players,
        np.round(ratings.rating, DECIMALS),
        np.minimum(np.round(ratings.quasi_error, DECIMALS), most),
        ratings.games + ratings.races_won + ratings.races_lost,
        component=ratings.component,
    )
