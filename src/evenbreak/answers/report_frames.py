"""The table that `evenbreak report` writes as summary.csv."""

import numpy as np
import pandas as pd

from evenbreak import __version__
from evenbreak.answers.file_words import file_name, fingerprints
from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.answers.scale_words import like_scale_words
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results


def summary_frame(
    file: ResultsFile, ratings: Ratings, paired: pd.DataFrame, offered: OfferedRaces
) -> pd.DataFrame:
    """Return what a report was made from and how, as rows of key and value.

    `components` counts those of players with games; `anchor` is the mean rating of each
    component, so the rating of a player without games; the standard deviation of the prior
    is given in natural log-odds and in points of the scale.
    """
    scale = ratings.scale
    first, last = dates_of(file.results, ratings.as_of)
    rows: dict[str, object] = {
        "results_file": file_name(file),
        "results_sha256": fingerprints(file),
        "matches_read": len(file.results),
        "matches_used": ratings.matches,
        "forfeits_left_out": ratings.forfeits,
        "empty_left_out": ratings.empty,
        "later_left_out": ratings.later,
        "first_date": first,
        "last_date": last,
        "games": int(ratings.won.sum()),
        "players": len(ratings.players),
        "players_without_games": int(ratings.idle.sum()),
        "components": count_groups(ratings),
        "groups_of_similar_names": len(file.similar_names),
        "scale": f"{like_scale_words(scale)}; not an official rating",
        "points_per_doubling": scale.points_per_doubling,
        "anchor": ratings.anchor,
        "prior_sd_log_odds": ratings.prior_sd,
        "prior_sd_points": float(scale.points(ratings.prior_sd)),
        "joined_below_points": float(scale.points(ratings.levels.joined)),
        "newcomers_below_points": ratings.newcomer,
        "race_counts": ratings.levels.race,
        "team_sd_points": float(scale.points(ratings.levels.team_sd)),
        "division_sd_points": float(scale.points(ratings.levels.division_sd)),
        "half_life_days": ratings.half_life,
        "match_form_log_odds": ratings.match_form,
        "as_of": None if ratings.as_of is None else str(ratings.as_of),
        "race_to": offered.race_to,
        "games_lo": offered.games[0] if offered.games else None,
        "games_hi": offered.games[1] if offered.games else None,
        "pairs": len(paired),
        "pairs_without_race": int(paired["race_a"].isna().sum()),
        "evenbreak_version": __version__,
    }
    return pd.DataFrame(
        {"key": list(rows), "value": pd.Series(list(rows.values()), dtype="object")}
    )


def count_groups(ratings: Ratings) -> int:
    """Return how many groups of players never met; a player without results is no group."""
    return len(np.unique(ratings.component[~ratings.idle]))


def dates_of(results: Results, as_of: np.datetime64 | None = None) -> tuple[str, str]:
    """Return the first and last day, up to `as_of`, on which a match was played; '' if unknown."""
    counted = results.played().results, results.won_only()
    stated = [part.date for part in counted if part.date is not None]
    days = np.concatenate(stated) if stated else np.zeros(0, "datetime64[D]")
    days = days[~np.isnat(days) if as_of is None else days <= as_of]
    return (str(days.min()), str(days.max())) if len(days) else ("", "")
