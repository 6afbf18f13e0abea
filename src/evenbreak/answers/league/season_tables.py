"""A simulated season's tables: standings, ratings by week, fairness.

Each randomly drawn value has its Monte Carlo standard error (the standard deviation between runs
with different seeds) next to it, in a column of the same name with `_se` added.
"""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from evenbreak.league.one_season import PlayedSeason
from evenbreak.league.season import FIFTHS, Season, Tally

Floats = Any
"""Arrays of numbers, of any shape."""

QUANTILES = (0.1, 0.5, 0.9)
"""The quantiles of points and ratings, in `standings.csv`."""

SPREAD = (0.05, 0.25, 0.5, 0.75, 0.95)
"""The quantiles of the rating errors, in `ratings_by_week.csv`."""

RARE = 0.001
"""Wide skill gaps are merged until they hold this share of all matches."""


class SeasonTables(NamedTuple):
    """A simulated season's three tables, as DataFrames."""

    standings: pd.DataFrame
    weeks: pd.DataFrame
    fairness: pd.DataFrame


def season_tables(season: Season, tally: Tally) -> SeasonTables:
    """Return a simulated season's tables."""
    weeks = weeks_frame(tally, cycle=season.system.cycle)
    return SeasonTables(standings_frame(season, tally), weeks, fairness_frame(season, tally))


def standings_frame(season: Season, tally: Tally) -> pd.DataFrame:
    """Return what each player can expect from the season, most wins first.

    Returns
    -------
    pandas.DataFrame
        player; rating_start and skill_start, in points (the mean skill where it is drawn); matches,
        the mean number played in a season; points_mean, points_se, points_sd and the quantiles
        points_p10, points_p50, points_p90 of the matches won in a season; p_win and p_win_se, P(the
        player wins | they play a match); rating_mean, rating_se, rating_sd and quantiles of the
        rating after the season. In a league too large to keep a histogram for each player, the
        quantiles are missing.
    """
    players, replicas = season.players, int(tally.replicas.sum())
    points, points_sd = _mean_and_sd(tally.wins, tally.wins_squared, replicas)
    moved, rating_sd = _mean_and_sd(tally.rating, tally.rating_squared, replicas)
    matches = tally.matches / replicas
    points_se, p_win_se, rating_se = tally.player_errors()
    columns: dict[str, Any] = {
        "player": players.names or [f"player {k}" for k in range(1, len(players) + 1)],
        "rating_start": players.rating,
        "skill_start": players.skill,
        "matches": matches,
        "points_mean": points,
        "points_se": points_se,
        "points_sd": points_sd,
        **_quantiles("points", tally.wins_counts, 0),
        "p_win": np.divide(points, matches, out=np.full_like(points, np.nan), where=matches > 0),
        "p_win_se": p_win_se,
        "rating_mean": players.rating + moved,
        "rating_se": rating_se,
        "rating_sd": rating_sd,
        **_quantiles("rating", tally.rating_counts, players.rating),
    }
    order = np.argsort(-points, kind="stable")
    return pd.DataFrame(columns).iloc[order].reset_index(drop=True)


def _mean_and_sd(total: Any, squares: Any, replicas: int) -> tuple[Floats, Floats]:
    """Return the mean over replicas and their standard deviation, or NaN with one replica."""
    mean = total / replicas
    if replicas < 2:
        return mean, np.full_like(mean, np.nan)
    left = replicas * squares - total**2  # in whole numbers, so that no digits are lost
    return mean, np.sqrt(left / (replicas * (replicas - 1.0)))


def _quantiles(what: str, counts: Any, start: Any) -> dict[str, Any]:
    """Return each player's quantiles: the smallest value that reaches each probability.

    `counts` is None if it wasn't kept; `start` is the value of the first column (points) or the
    middle column (ratings).
    """
    names = [f"{what}_p{100 * q:.0f}" for q in QUANTILES]
    if counts is None:
        return dict.fromkeys(names, np.nan)
    first = 0 if what == "points" else start - counts.shape[1] // 2
    summed = np.cumsum(counts, axis=1)
    return {
        name: pd.array(first + reached(summed, q), dtype="Int64")
        for name, q in zip(names, QUANTILES, strict=True)
    }


def reached(summed: NDArray[np.int64], q: float) -> NDArray[np.intp]:
    """Return where running counts first reach a share of the total, row by row.

    >>> reached(np.array([[1, 5, 10], [0, 0, 4]]), 0.5)
    array([1, 2])
    """
    tenth_of_percent = round(1000 * q)  # whole numbers, so that ties are ties
    there = 1000 * summed >= tenth_of_percent * summed[:, -1:]
    return np.asarray(there.argmax(axis=1))


def weeks_frame(tally: Tally, *, cycle: int = 1) -> pd.DataFrame:
    """Return how far off the ratings are, week by week.

    Parameters
    ----------
    tally
        a season's tally.
    cycle
        its system's cycle.

    Returns
    -------
    pandas.DataFrame
        week, 0 before the first; the players in the league; error_mean and error_sd of the rating
        error (rating less true skill) over players and replicas, with their standard errors;
        p_near, P(the rating is within a sixth of a doubling of the odds), with its standard error,
        and error_p05 ... error_p95, quantiles of the error in whole points; these over the cycle of
        weeks that ends with this one, without the start. In weeks with no one in the league only
        week and players are filled in.
    """
    players, error, square, _ = np.moveaxis(tally.weeks, 2, 0)
    mean, mean_se = tally.mean_and_error(error, players)
    spread = square - 2.0 * mean * error + mean**2 * players
    variance, variance_se = tally.mean_and_error(spread, players)
    sd = np.sqrt(np.maximum(variance, 0.0))
    errors = _over_cycle(tally.errors[None], cycle)[0]
    values, summed = tally.error_values, np.cumsum(errors, axis=1)
    anybody = players.sum(axis=0) > 0
    over_cycle = _over_cycle(tally.weeks, cycle)
    p_near, p_near_se = tally.mean_and_error(over_cycle[..., 3], over_cycle[..., 0])
    columns: dict[str, Any] = {
        "week": np.arange(len(mean)),
        "players": players.sum(axis=0) / tally.replicas.sum(),
        "error_mean": mean,
        "error_mean_se": mean_se,
        "error_sd": sd,
        # A spread of nothing is nothing in every replica.
        "error_sd_se": np.divide(
            variance_se, 2.0 * sd, out=np.where(anybody, 0.0, np.nan), where=sd > 0
        ),
        "p_near": np.where(anybody, p_near, np.nan),
        "p_near_se": np.where(anybody, p_near_se, np.nan),
    }
    for q in SPREAD:
        quantile = pd.array(values[reached(summed, q)], dtype="Int64")
        quantile[~anybody] = pd.NA
        columns[f"error_p{100 * q:02.0f}"] = quantile
    return pd.DataFrame(columns)


def _over_cycle(weeks: Floats, cycle: int) -> Floats:
    """Return sums over the cycle ending with each week (the second axis); the start is separate."""
    found = weeks.copy()
    for back in range(1, min(cycle, weeks.shape[1] - 1)):
        found[:, 1 + back :] += weeks[:, 1:-back]
    return found


def weeks_with_players(weeks: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of `weeks_frame` with anyone in the league, as floats: NaN, never NA."""
    return weeks[weeks["players"] > 0].astype(float)


def fairness_frame(season: Season, tally: Tally) -> pd.DataFrame:
    """Return how even the matches were: by gap in true skill, and by fifth of the skill range.

    Returns
    -------
    pandas.DataFrame
        group: 'all' matches, those of one 'gap' between the two skills of the day, or a 'fifth' of
        the players by true skill at the start, 1 the weakest, if there are five players or more;
        from and to, the limits of the gap in points (`to` excluded; the last gap has none), or the
        number of the fifth. A gap is about a third of a doubling of the odds wide; the last gap
        includes all wider gaps that are rare, at most one match in a thousand. matches, the mean
        number in a season; p_win, P(the stronger wins) or, in a fifth, P(a player of it wins);
        p_hill_hill, P(the last game decides); p_shutout, P(the loser wins no game); mean_games of a
        match; each with its standard error.
    """
    width, spans = _spans(season, tally)
    gaps = np.concatenate([spans.sum(axis=1, keepdims=True), spans], axis=1)
    matches = gaps[..., 0]
    replicas = float(tally.replicas.sum())
    rows: list[dict[str, Any]] = []
    for place in np.flatnonzero(matches.sum(axis=0)).tolist():
        last = place == gaps.shape[1] - 1
        row: dict[str, Any] = {
            "group": "gap" if place else "all",
            "from": (place - 1) * width if place else None,
            "to": place * width if place and not last else None,
            "matches": matches[:, place].sum() / replicas,
        }
        for k, name in enumerate(_MEASURES, 1):
            mean, error = tally.mean_and_error(gaps[:, place, k], matches[:, place])
            row |= {name: float(mean), f"{name}_se": float(error)}
        rows.append(row)
    measures = [f"{name}{end}" for name in _MEASURES for end in ("", "_se")]
    columns = ["group", "from", "to", "matches", *measures]
    if len(season.players) >= FIFTHS:
        rows += _fifths(tally)
    frame = pd.DataFrame(rows, columns=columns)
    return frame.astype({"from": "Int64", "to": "Int64"})


_MEASURES = ("p_win", "p_hill_hill", "p_shutout", "mean_games")


def _spans(season: Season, tally: Tally) -> tuple[int, Floats]:
    """Return gaps merged into wider ones: the width, and sums of shape (batches, spans, 5)."""
    third = season.system.scale.points_per_doubling / 3.0
    each = max(1, round(third / tally.gap_width))
    starts = np.arange(0, tally.gaps.shape[1], each)
    spans = np.add.reduceat(tally.gaps, starts, axis=1)
    beyond = np.cumsum(spans[..., 0].sum(axis=0)[::-1])[::-1]  # matches in a span or a later one
    kept = max(1, int((beyond > RARE * beyond[0]).sum()))
    return each * tally.gap_width, np.concatenate(
        [spans[:, : kept - 1], spans[:, kept - 1 :].sum(axis=1, keepdims=True)], axis=1
    )


def _fifths(tally: Tally) -> list[dict[str, Any]]:
    played, won = np.moveaxis(tally.fifths, 2, 0)
    mean, error = tally.mean_and_error(won, played)
    matches = played.sum(axis=0) / tally.replicas.sum()
    return [
        {
            "group": "fifth",
            "from": k + 1,
            "to": k + 1,
            "matches": float(matches[k]),
            "p_win": float(mean[k]),
            "p_win_se": float(error[k]),
        }
        for k in np.flatnonzero(matches).tolist()
    ]


def matches_frame(played: PlayedSeason) -> pd.DataFrame:
    """Return one season's matches as a table that `read_results` can read.

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
    """Return the true skills behind the matches, which are never known in a real league.

    Returns
    -------
    pandas.DataFrame
        player; rating and skill, at the start; rating_end and skill_end, after the last week.
        `read_season_players` reads it as a roster.
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
