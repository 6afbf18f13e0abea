"""The tables that `evenbreak simulate` writes.

What is drawn by chance has its Monte Carlo standard error beside it, in a column or row of the
same name with `_se` behind: by how much, as one standard deviation, another seed would change it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak import __version__
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin
from evenbreak.league.tally import Tally

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray

    from evenbreak.league.season import Season

Floats = Any
"""Arrays of numbers, of whatever shape."""

QUANTILES = (0.1, 0.5, 0.9)
"""Those of points and ratings, in `standings.csv`."""

SPREAD = (0.05, 0.25, 0.5, 0.75, 0.95)
"""Those of the rating errors, in `ratings_by_week.csv`."""

RARE = 0.001
"""The part of all matches below which wide gaps are put together."""

NEAR = 5
"""Points within which a rating is called near."""


def standings_frame(season: Season, tally: Tally) -> pd.DataFrame:
    """Return what each player can expect of the season, who wins most matches first.

    Returns
    -------
    pandas.DataFrame
        player; rating_start and skill_start, in points (the mean skill where it is drawn);
        matches, played in a season on average; points_mean, points_se, points_sd and quantiles
        points_p10, points_p50, points_p90 of the matches won in a season; p_win and p_win_se,
        P(the player wins | he plays a match); rating_mean, rating_se, rating_sd and quantiles
        of the rating after the season. Quantiles are missing where the league is too large for
        all of its players' laws to be kept.
    """
    import pandas as pd

    players, replicas = season.players, int(tally.replicas.sum())
    points, points_sd = _mean_and_sd(tally.wins, tally.wins_squared, replicas)
    moved, rating_sd = _mean_and_sd(tally.rating, tally.rating_squared, replicas)
    matches = tally.matches / replicas
    known = matches > 0
    points_se, p_win_se, rating_se = tally.player_errors()
    columns: dict[str, Any] = {
        "player": names_of(season),
        "rating_start": players.rating,
        "skill_start": players.skill,
        "matches": matches,
        "points_mean": points,
        "points_se": points_se,
        "points_sd": points_sd,
        **_quantiles("points", tally.wins_counts, 0),
        "p_win": np.divide(points, matches, out=np.full_like(points, np.nan), where=known),
        "p_win_se": p_win_se,
        "rating_mean": players.rating + moved,
        "rating_se": rating_se,
        "rating_sd": rating_sd,
        **_quantiles("rating", tally.rating_counts, players.rating),
    }
    order = np.argsort(-points, kind="stable")
    return pd.DataFrame(columns).iloc[order].reset_index(drop=True)


def _mean_and_sd(total: Any, squares: Any, replicas: int) -> tuple[Floats, Floats]:
    """Return the mean over replicas and their standard deviation, NaN for one replica."""
    mean = total / replicas
    if replicas < 2:
        return mean, np.full_like(mean, np.nan)
    left = replicas * squares - total**2  # in whole numbers, so that no digits are lost
    return mean, np.sqrt(left / (replicas * (replicas - 1.0)))


def _quantiles(what: str, counts: Any, start: Any) -> dict[str, Any]:
    """Return the smallest values that are reached with each of the chances, by player.

    Parameters
    ----------
    counts
        how often each player had each value; None where that is not known.
    start
        the value of the first column, or of the middle one: a player's rating did not move.
    """
    import pandas as pd

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
    """Return where running counts first reach a part of the whole, in each row.

    >>> reached(np.array([[1, 5, 10], [0, 0, 4]]), 0.5)
    array([1, 2])
    """
    tenth_of_percent = round(1000 * q)  # whole numbers, so that ties are ties
    there = 1000 * summed >= tenth_of_percent * summed[:, -1:]
    return np.asarray(there.argmax(axis=1))


def weeks_frame(tally: Tally) -> pd.DataFrame:
    """Return how wrong the ratings are, week by week.

    Returns
    -------
    pandas.DataFrame
        week, 0 before the first; players in the league; of the rating error, rating less true
        skill, over players and replicas: error_mean and error_sd with their standard errors,
        p_within_5, P(the rating is at most 5 points off), and error_p05 ... error_p95, the
        quantiles in whole points. All but week and players is missing where nobody is in the
        league.
    """
    import pandas as pd

    players, error, square = np.moveaxis(tally.weeks, 2, 0)
    mean, mean_se = tally.mean_and_error(error, players)
    spread = square - 2.0 * mean * error + mean**2 * players
    variance, variance_se = tally.mean_and_error(spread, players)
    sd = np.sqrt(np.maximum(variance, 0.0))
    values, summed = tally.error_values, np.cumsum(tally.errors, axis=1)
    near = np.abs(values) <= NEAR
    anybody = summed[:, -1] > 0
    empty = np.full(len(mean), np.nan)
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
        f"p_within_{NEAR}": np.divide(
            tally.errors[:, near].sum(axis=1), summed[:, -1], out=empty, where=anybody
        ),
    }
    for q in SPREAD:
        quantile = pd.array(values[reached(summed, q)], dtype="Int64")
        quantile[~anybody] = pd.NA
        columns[f"error_p{100 * q:02.0f}"] = quantile
    return pd.DataFrame(columns)


def weeks_with_players(weeks: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of `weeks_frame` in which there is anybody in the league, as plain floats.

    A row with whole numbers that may be missing would hold `NA` for an error that is not known.
    """
    return weeks[weeks["players"] > 0].astype(float)


def fairness_frame(season: Season, tally: Tally) -> pd.DataFrame:
    """Return how even the matches were: by the gap of true skills, and by fifth of skill.

    Returns
    -------
    pandas.DataFrame
        group: 'all' matches, those of a 'gap' of the two skills of the day, or a 'fifth' of
        the players by true skill at the start, 1 the weakest; from and to, the span of the
        gap in points (its upper end is not in it; the last has none), or the number of the
        fifth. A gap is about a third of a doubling of the odds wide, and the last takes in
        all that are wider and rare, one match in a thousand or less; matches, in a
        season on average; p_win, P(the stronger wins) or, in a fifth, P(a player of it
        wins); p_hill_hill, P(the last game decides); p_shutout, P(the loser wins no game);
        mean_games of a match; each with its standard error.
    """
    import pandas as pd

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
        for k, name in enumerate(("p_win", "p_hill_hill", "p_shutout", "mean_games"), 1):
            mean, error = tally.mean_and_error(gaps[:, place, k], matches[:, place])
            row |= {name: float(mean), f"{name}_se": float(error)}
        rows.append(row)
    frame = pd.DataFrame([*rows, *_fifths(tally)], columns=_FAIRNESS)
    return frame.astype({"from": "Int64", "to": "Int64"})


def _spans(season: Season, tally: Tally) -> tuple[int, Floats]:
    """Return the gaps put together to wider ones: their width, and (chunks, spans, 5) sums."""
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


_FAIRNESS = (
    *("group", "from", "to", "matches"),
    *("p_win", "p_win_se", "p_hill_hill", "p_hill_hill_se"),
    *("p_shutout", "p_shutout_se", "mean_games", "mean_games_se"),
)


def season_frame(season: Season, tally: Tally, settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the season in one table: what was simulated, and what came of it.

    Parameters
    ----------
    settings
        what a reader must know besides, such as the seed and the name of the roster's file.

    Returns
    -------
    pandas.DataFrame
        quantity, value, and standard_error where the value was drawn by chance.
    """
    import pandas as pd

    replicas = int(tally.replicas.sum())
    rows: list[tuple[str, Any, float | None]] = [
        *((name, value, None) for name, value in settings.items()),
        ("system", season.system.name, None),
        ("points_per_doubling", season.system.scale.points_per_doubling, None),
        ("chart", season.chart.name, None),
        ("schedule", _schedule(season), None),
        ("play", season.play, None),
        ("players", len(season.players), None),
        ("weeks", season.weeks, None),
        ("replicas", replicas, None),
        ("matches_a_season", float(tally.matches.sum() / 2 / replicas), None),
        *_rating_rows(weeks_frame(tally)),
        *_fairness_rows(fairness_frame(season, tally)),
        *_standing_rows(standings_frame(season, tally)),
        ("mean_rating_change", float(tally.rating.sum() / tally.rating.size / replicas), None),
        ("evenbreak_version", __version__, None),
    ]
    frame = pd.DataFrame(rows, columns=["quantity", "value", "standard_error"])
    return frame.astype({"value": "object", "standard_error": float})


def _rating_rows(weeks: pd.DataFrame) -> list[tuple[str, Any, float | None]]:
    there = weeks_with_players(weeks)
    rows: list[tuple[str, Any, float | None]] = []
    if not len(there):
        return rows
    for when, row in (("start", there.iloc[0]), ("end", there.iloc[-1])):
        rows += [
            (f"error_{what}_{when}", float(row[f"error_{what}"]), float(row[f"error_{what}_se"]))
            for what in ("mean", "sd")
        ]
        rows.append((f"p_within_{NEAR}_{when}", float(row[f"p_within_{NEAR}"]), None))
    return rows


def _fairness_rows(fairness: pd.DataFrame) -> list[tuple[str, Any, float | None]]:
    rows: list[tuple[str, Any, float | None]] = []
    every = fairness[fairness["group"] == "all"]
    fifths = fairness[fairness["group"] == "fifth"]
    for row in every.to_dict("records"):
        for name, column in (
            ("p_stronger_wins", "p_win"),
            *((same, same) for same in ("p_hill_hill", "p_shutout", "mean_games")),
        ):
            rows.append((name, row[column], row[f"{column}_se"]))
    for name, row in zip(
        ("p_win_weakest_fifth", "p_win_strongest_fifth"),
        fifths.iloc[[0, -1]].to_dict("records") if len(fifths) else (),
        strict=False,
    ):
        rows.append((name, row["p_win"], row["p_win_se"]))
    return rows


def _standing_rows(standings: pd.DataFrame) -> list[tuple[str, Any, float | None]]:
    """Return how far the table tells players apart, and how far luck does."""
    luck = float(np.sqrt((standings["points_sd"] ** 2).mean()))
    between = float(standings["points_mean"].std(ddof=0))
    return [
        ("points_sd_between_players", between, None),
        ("points_sd_by_luck", luck, None),
    ]


def _schedule(season: Season) -> str:
    match season.schedule:
        case RoundRobin(matches_a_week=matches):
            return f"round robin, {matches} a week"
        case RandomPairing(matches_a_week=matches):
            return f"random, {matches} a week"
        case FixedSchedule():
            return f"list of {len(season.schedule):,} matches"
        case _:
            return type(season.schedule).__name__


def names_of(season: Season) -> Sequence[str]:
    """Return the names of the players, or numbers for names."""
    names = season.players.names
    if names is not None:
        return names
    return [f"player {k}" for k in range(1, len(season.players) + 1)]
