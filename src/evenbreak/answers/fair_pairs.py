"""The fairest race of each pair of rated players."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import TYPE_CHECKING

from evenbreak.answers.chosen_players import by_strength
from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.ratings.fitted import Ratings

if TYPE_CHECKING:
    import pandas as pd

NOT_LINKED = "no race: no chain of opponents links the two"


def matchups_frame(ratings: Ratings, players: Sequence[int], offered: OfferedRaces) -> pd.DataFrame:
    """Return the fairest race of each pair of players, the stronger of the two first.

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
        player_a, player_b; p_game_a = P(a wins a game | the ratings are right); race_a,
        race_b, the games that each needs; p_win_a = P(a wins that race); mean_games and
        games_p90, its mean length and the games within which 90 % of such races end;
        note. Where no chain of opponents links the two, their ratings cannot be
        compared: there are no numbers then, and the note says so.
    """
    import pandas as pd

    rows = [_row(ratings, a, b, offered) for a, b in combinations(by_strength(ratings, players), 2)]
    columns = {
        "player_a": "object",
        "player_b": "object",
        "p_game_a": "float64",
        "race_a": "Int64",
        "race_b": "Int64",
        "p_win_a": "float64",
        "mean_games": "float64",
        "games_p90": "Int64",
        "note": "object",
    }
    return pd.DataFrame(rows, columns=list(columns)).astype(columns)


def _row(ratings: Ratings, a: int, b: int, offered: OfferedRaces) -> tuple[object, ...]:
    names = ratings.players[a], ratings.players[b]
    if ratings.component[a] != ratings.component[b]:
        return (*names, *[None] * 6, NOT_LINKED)
    p = ratings.scale.win_probability(float(ratings.rating[a] - ratings.rating[b]))
    race = offered.fairest(p)
    numbers = (race.race_1, race.race_2, race.p_win_1, race.mean_games, race.games_p90)
    return (*names, p, *numbers, "")
