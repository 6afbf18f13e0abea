"""The ratings at the end of a season as a file, from which the next season starts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from evenbreak.errors import DataError
from evenbreak.files.csv_writer import csv_lines
from evenbreak.files.lists.roster import LARGEST, ROSTER, WRITTEN, roster_of
from evenbreak.files.tables.dates import Day
from evenbreak.files.tables.names import KnownNames
from evenbreak.files.tables.problems import refusal
from evenbreak.files.tables.schema import Number, Schema
from evenbreak.ratings.beginning import Beginning
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale
from evenbreak.words import FilePath, Parameter, say

_POINTS = Number(least=-LARGEST, most=LARGEST, write=say("points"))

OF_PRIOR = Schema(
    prior_mean=_POINTS.called(
        "",
        "the mean of the prior used for the rating. This prior is removed, so that only the new "
        "one counts; if the cell is empty, the rating is used as it is",
    ),
    prior=_POINTS.called("", "the prior's standard deviation", least=0),
    as_of=Day(
        "date, day, updated", "the date of the ratings; with a half-life, they have aged since then"
    ),
)
SAVED = ROSTER | WRITTEN | OF_PRIOR
"""Starting ratings: a roster with priors, and the date they are from."""

COLUMNS = (
    *("player", "rating", "quasi_error", "standard_error", "games"),
    *("prior_mean", "prior", "as_of", "scale"),
)


class Saved(NamedTuple):
    """A file of starting ratings; names are spelled as in the results.

    `found` is the number of players who are in the results.
    """

    beginning: Beginning
    found: int
    warnings: tuple[str, ...]
    scale_stated: bool


def saved_csv(ratings: Ratings, day: str, before: Beginning | None = None) -> bytes:
    """Return a file with the ratings of everyone who has played, now or before.

    `day` is the date of the last result; players without results keep their rating from `before`.

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
        np.round(ratings.games_behind).astype(np.int64),
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
    """Yield players who came with a rating but have no result, on the ratings' scale."""
    if before is None:
        return
    center = before.center(ratings.players)
    unit = ratings.scale.points(before.scale.log_odds(1.0))
    day = "" if before.as_of is None else str(before.as_of)
    for k, name in enumerate(before.players):
        if name in ratings.players:
            continue
        error, prior = (
            float(column[k]) * unit for column in (before.standard_error, before.prior_sd)
        )
        rating, mean = (
            ratings.anchor + unit * (float(column[k]) - center)
            for column in (before.rating, before.prior_mean)
        )
        errors = ("", "") if np.isnan(error) else (_rounded(error), _rounded(error))
        assumed = ("", "") if np.isnan(prior) else (_rounded(mean), _rounded(prior))
        yield (name, _rounded(rating), *errors, int(before.games[k]), *assumed, day)


def _rounded(value: Any) -> Any:
    return int(value) if isinstance(value, np.integer) else round(float(value), 4)


def read_saved(path: str | Path, scale: Scale, players: Sequence[str]) -> Saved:
    """Read starting ratings: a file from `saved_csv`, or any list of rated players.

    The scale is for a file that states none. Raises DataError listing every problem in the file:
    the problems a roster can have, numbers out of range, invalid dates, a different scale.
    """
    table = SAVED.read(path)
    prior, mean, day = (table[name] for name in ("prior", "prior_mean", "as_of"))
    file = roster_of(table)
    if file.scale is not None and not file.scale.same_points(scale):
        raise DataError(
            [
                say(
                    "{source} says its ratings are on scale {stated}, but the results are being "
                    "rated on scale {asked}. Give {scale} {stated}.",
                    source=FilePath(file.source),
                    stated=file.scale.text,
                    asked=scale.text,
                    scale=Parameter("scale"),
                )
            ]
        )
    if file.levels and file.scale is None:
        raise refusal(
            file.source, "its ratings are skill levels. Give ratings in points to start from."
        )
    roster = file.roster
    rated = np.flatnonzero(~np.isnan(roster.rating))
    if not len(rated):
        raise refusal(file.source, "none of its players has a rating to start from")
    rated_players = KnownNames(players)
    places = [rated_players.place(roster.players[k]) for k in rated]
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
        prior_mean=np.where(np.isnan(mean[rated]), scale.center, mean[rated]),
        games=np.maximum(roster.games[rated], 0).astype(float),
        as_of=None if np.isnat(day).all() else str(day[~np.isnat(day)].max()),
    )
    matched = sum(place is not None for place in places)
    return Saved(beginning, matched, file.warnings, file.scale is not None)
