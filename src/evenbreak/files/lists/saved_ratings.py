"""The ratings at the end of a season as a file, with which the next one begins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from evenbreak.errors import DataError
from evenbreak.files.csv_writer import csv_lines
from evenbreak.files.lists.roster import LARGEST, OPTIONAL, REQUIRED, WRITTEN, roster_of
from evenbreak.files.tables.cells import dates, numbers
from evenbreak.files.tables.names import KnownNames
from evenbreak.files.tables.table import read_table
from evenbreak.ratings.beginning import Beginning
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale

MORE = {"prior": (), "prior_mean": (), "as_of": ("date", "day", "updated")}
"""The columns of a saved file besides those of a roster."""

COLUMNS = (
    *("player", "rating", "quasi_error", "standard_error", "games"),
    *("prior_mean", "prior", "as_of", "scale"),
)


class Saved(NamedTuple):
    """What a file of ratings to begin from says.

    Parameters
    ----------
    beginning
        the ratings, with names as the results spell them.
    found
        how many of the players are in the results.
    warnings
        what to check although the file can be used.
    scale_stated
        whether the file states its scale.
    """

    beginning: Beginning
    found: int
    warnings: tuple[str, ...]
    scale_stated: bool


def saved_csv(ratings: Ratings, day: str, before: Beginning | None = None) -> bytes:
    """Return a file with the ratings of all who have played, and of those who did not this time.

    Parameters
    ----------
    ratings
        the ratings.
    day
        the last day of their results, '' if they have no dates.
    before
        those with which they began: players without results keep theirs.

    >>> from evenbreak.ratings import Results, fit
    >>> ratings = fit(Results.from_names(["Ann"], ["Bo"], [7], [4]))
    >>> print(saved_csv(ratings, "2026-11-01").decode().splitlines()[1])
    Ann,88.645400,15.945300,24.023400,11,80.000000,30.000000,2026-11-01,npl
    """
    points, scale = ratings.scale.points(ratings.prior_sd), ratings.scale.text
    columns = (
        ratings.rating,
        ratings.quasi_error,
        ratings.standard_error,
        ratings.games + ratings.races_won + ratings.races_lost,
        ratings.expected,
    )
    rows: list[tuple[Any, ...]] = [
        (ratings.players[k], *(_rounded(column[k]) for column in columns), _rounded(points), day)
        for k in ratings.strongest_first()
    ]
    rows += _who_did_not_play(ratings, before)
    form = {"match_form": ratings.match_form} if ratings.match_form else {}
    names = (*COLUMNS[:-1], *form, COLUMNS[-1])
    return "".join(csv_lines(names, [(*row, *form.values(), scale) for row in rows])).encode()


def _who_did_not_play(ratings: Ratings, before: Beginning | None) -> Iterator[tuple[Any, ...]]:
    """Yield those who brought a rating along and have no result, on the scale of the ratings."""
    if before is None:
        return
    centre = before.centre(ratings.players)
    unit = ratings.scale.points(before.scale.log_odds(1.0))
    day = "" if before.as_of is None else str(before.as_of)
    for k, name in enumerate(before.players):
        if name in ratings.players:
            continue
        error, prior = (float(one[k]) * unit for one in (before.standard_error, before.prior_sd))
        rating, mean = (
            ratings.anchor + unit * (float(one[k]) - centre)
            for one in (before.rating, before.prior_mean)
        )
        errors = ("", "") if np.isnan(error) else (_rounded(error), _rounded(error))
        assumed = ("", "") if np.isnan(prior) else (_rounded(mean), _rounded(prior))
        yield (name, _rounded(rating), *errors, int(before.games[k]), *assumed, day)


def _rounded(value: Any) -> Any:
    return int(value) if isinstance(value, np.integer) else round(float(value), 4)


def read_saved(path: str | Path, scale: Scale, players: Sequence[str]) -> Saved:
    """Read ratings to begin from: a file that `saved_csv` made, or any list of rated players.

    Parameters
    ----------
    path
        the file.
    scale
        the scale of its ratings, where it states none.
    players
        the players of the results; names are matched with theirs as elsewhere.

    Raises
    ------
    DataError
        with every problem of the file: those of a roster, numbers out of range, dates that are
        none, or a scale other than the one asked for.
    """
    table = read_table(path, REQUIRED, {**OPTIONAL, **WRITTEN, **MORE}, rows="players")
    asked: Any = {
        "at_most": LARGEST,
        "remedy": "write points, or leave it empty",
        "may_be_empty": True,
    }
    prior = numbers(table, "prior", at_least=0, **asked).values
    mean = numbers(table, "prior_mean", at_least=-LARGEST, **asked).values
    day = dates(table, "as_of").values
    file = roster_of(table)
    if file.scale is not None and not file.scale.same_points(scale):
        raise DataError(
            [
                f"{file.source} states that its ratings are {file.scale.text}, but the results are "
                f"rated on {scale.text}; give --scale {file.scale.text}"
            ]
        )
    if file.levels and file.scale is None:
        raise DataError(
            [f"{file.source}: its ratings are skill levels; give ratings in points to begin from"]
        )
    roster = file.roster
    rated = np.flatnonzero(~np.isnan(roster.rating))
    if not len(rated):
        raise DataError([f"{file.source}: no player in it has a rating to begin from"])
    known = KnownNames(players)
    places = [known.place(roster.players[k]) for k in rated]
    error = roster.standard_error[rated]
    beginning = Beginning(
        [
            roster.players[k] if place is None else players[place]
            for k, place in zip(rated, places, strict=True)
        ],
        roster.rating[rated],
        np.where(error > 0.0, error, np.nan),
        scale=scale,
        prior_sd=np.where(prior[rated] > 0.0, prior[rated], np.nan),
        prior_mean=np.where(np.isnan(mean[rated]), scale.centre, mean[rated]),
        games=np.maximum(roster.games[rated], 0).astype(float),
        as_of=None if np.isnat(day).all() else str(day[~np.isnat(day)].max()),
    )
    found = sum(place is not None for place in places)
    return Saved(beginning, found, file.warnings, file.scale is not None)
