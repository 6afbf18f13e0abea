"""The tables that `evenbreak rate` prints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.answers.report_frames import ratings_frame
from evenbreak.ratings.fitted import Ratings

if TYPE_CHECKING:
    import pandas as pd

NOT_LINKED = "no chain of opponents links the two"


def rate_frame(ratings: Ratings) -> pd.DataFrame:
    """Return every player's rating, group by group, the strongest of each first.

    Returns
    -------
    pandas.DataFrame
        the columns of `ratings_frame`, with races_won and races_lost, the matches of
        which only the race and the winner are known, before the component.
    """
    frame = ratings_frame(ratings)
    place = {name: k for k, name in enumerate(ratings.players)}
    at = np.array([place[name] for name in frame["player"]], dtype=np.int64)
    for name in ("races_won", "races_lost"):
        frame.insert(len(frame.columns) - 1, name, getattr(ratings, name)[at])
    return frame.sort_values("component", kind="stable", ignore_index=True)


def pairs_frame(ratings: Ratings, pairs: Sequence[tuple[int, int]]) -> pd.DataFrame:
    """Return how far apart the players of pairs are, and how surely.

    Parameters
    ----------
    ratings
        how strong everybody is.
    pairs
        positions in `ratings.players`.

    Returns
    -------
    pandas.DataFrame
        player_a, player_b; difference, rating a less rating b in points, and its
        standard_error, with the covariance of the two; p_game_a, P(A wins a game | the
        ratings are right); note: why there are no numbers, where nothing links the two.
    """
    import pandas as pd

    rows = [_pair(ratings, first, second) for first, second in pairs]
    columns = ("player_a", "player_b", "difference", "standard_error", "p_game_a", "note")
    return pd.DataFrame(rows, columns=columns)


def _pair(ratings: Ratings, first: int, second: int) -> tuple[Any, ...]:
    names = ratings.players[first], ratings.players[second]
    if ratings.component[first] != ratings.component[second]:
        return (*names, None, None, None, NOT_LINKED)
    difference = float(ratings.rating[first] - ratings.rating[second])
    return (
        *names,
        difference,
        ratings.difference_error(*names),
        float(ratings.scale.win_probability(difference)),
        None,
    )
