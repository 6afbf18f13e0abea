"""The tables of one simulated season in full: its matches, and the true skills behind them."""

import pandas as pd

from evenbreak.league.one_season import PlayedSeason
from evenbreak.league.season import Season


def matches_frame(played: PlayedSeason) -> pd.DataFrame:
    """Return the matches of one season as a table that `read_results` reads back.

    Returns
    -------
    pandas.DataFrame
        date, event ('week 1', ...), player_a, player_b, race_a, race_b, score_a, score_b, and
        racks: who won each, in order.
    """
    results = played.results
    return pd.DataFrame(
        {
            "date": pd.Series(results.date, dtype="datetime64[s]"),
            "event": [f"week {week}" for week in played.week.tolist()],
            "player_a": [results.players[k] for k in results.player_a.tolist()],
            "player_b": [results.players[k] for k in results.player_b.tolist()],
            **{
                name: getattr(results, name)
                for name in ("race_a", "race_b", "score_a", "score_b", "racks")
            },
        }
    )


def truth_frame(season: Season, played: PlayedSeason) -> pd.DataFrame:
    """Return what is never known of a real league: the true skills behind the matches.

    Returns
    -------
    pandas.DataFrame
        player; rating and skill, at the start; rating_end and skill_end, after the last week.
        `read_league` reads it as a roster.
    """
    return pd.DataFrame(
        {
            "player": played.results.players,
            "rating": season.players.rating,
            "skill": played.skill,
            "rating_end": played.rating,
            "skill_end": played.skill_after,
        }
    )
