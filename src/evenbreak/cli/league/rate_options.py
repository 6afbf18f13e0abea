"""How to rate: the options that `rate`, `report`, `why` and `validate` share, and their use."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import Command, Decorator, refuse_both, with_options
from evenbreak.cli.kit.values import Number, refuse
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    from evenbreak.answers.offered_races import OfferedRaces
    from evenbreak.files.date_cells import DateOrder
    from evenbreak.files.results import ResultsFile
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.prior import PriorChoice

RACE_TO = 7
"""The races that are offered unless an option says otherwise."""


class PointsOr(Number):
    """A number of points, or a word in place of it."""

    def __init__(self, word: str, low: float) -> None:
        super().__init__(low, 1e6, f"; give a number of points, or {word}")
        self.word = word

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number, or the word."""
        if str(value).strip().lower() == self.word:
            return self.word
        return super().convert(value, param, ctx)


def read_day(text: str, order: DateOrder | None = None) -> str:
    """Return a day, written in any way that a cell of a results file may have, as 2026-01-31.

    In 9/3/2024 `order` says which is the month. The day may lie up to a year ahead, for a
    tournament to come; a later one was mistyped.
    """
    import numpy as np

    from evenbreak.files.date_cells import is_two_dates, read_date

    day = read_date(text.strip(), order)
    if day is None:
        remedy = "give a day, such as 2026-01-31, 31.1.2026 or 1/31/2026"
        if is_two_dates(text.strip()):
            remedy = "say with --dates mdy or --dates dmy what comes first, or write 2026-01-31"
        raise click.BadParameter(f"{text!r}; {remedy}")
    if day > np.datetime64("today", "D") + _DAYS_AHEAD:
        raise click.BadParameter(f"{text!r} is more than a year from today; give an earlier day")
    return str(day)


def offered_races(games: tuple[int, int] | None, race_to: int | None) -> OfferedRaces:
    """Return the races of --games or --race-to, or races to 7 where neither is given."""
    from evenbreak.answers.offered_races import OfferedRaces

    refuse_both(games, race_to)
    return OfferedRaces(games, RACE_TO if games is None and race_to is None else race_to)


def _as_of(ctx: click.Context, param: click.Parameter, text: str | None) -> str | None:  # noqa: ARG001
    return None if text is None else read_day(text, ctx.params.get("dates"))


_DAYS_AHEAD = 366

DAYS = Number(0.01, 1e6, "; give a number of days from 0.01 to 1,000,000, such as 180")


def prior_option(default: str) -> Decorator[Any]:
    """Return the option --prior; `default` says what applies if it is not given."""
    return click.option(
        "--prior",
        metavar="POINTS|best",
        type=PointsOr("best", 0.0),
        help="How far apart players are assumed to be before any result (standard deviation); "
        f"best: the value that predicts best.  [default: {default}]",
    )


half_life_option = click.option(
    "--half-life",
    metavar="DAYS",
    type=DAYS,
    help="After this many days a match counts half.  [default: it always counts in full]",
)


def how_to_rate(command: Command) -> Command:
    """Add the options --prior, --half-life and --as-of."""
    return with_options(
        command,
        click.option(
            "--as-of",
            metavar="DATE",
            callback=_as_of,
            help="Rate as of this day, without later matches.  [default: the last date]",
        ),
        half_life_option,
        prior_option("what doubles the odds"),
    )


def rated(
    file: ResultsFile,
    scale: Scale,
    *,
    prior: float | str | None,
    half_life: float | None,
    as_of: str | None,
    anchor: float | dict[str, float] | None = None,
    break_advantage: float | str | None = None,
) -> tuple[Ratings, PriorChoice | None]:
    """Return the ratings by the options that were given, and how their prior was chosen.

    Raises
    ------
    DataError
        if no match counts.
    """
    from evenbreak.errors import DataError
    from evenbreak.ratings.fit import PRIOR_SD, fit

    choice = None
    if prior == "best":
        choice = _best_prior(file, scale, half_life, as_of, break_advantage)
        prior_sd = choice.prior_sd
    else:
        prior_sd = PRIOR_SD if prior is None else prior_in_log_odds(float(prior), scale)
    ratings = fit(
        file.results,
        prior_sd=prior_sd,
        scale=scale,
        anchor=anchor,
        half_life=half_life,
        as_of=as_of,
        break_advantage=break_advantage,
    )
    if not ratings.matches:
        why = "was played; add matches with games"
        if ratings.later:
            why = f"was played by {as_of}; give a later day to --as-of"
        raise DataError([f"{file.source}: no match in it {why}"])
    return ratings, choice


def prior_in_log_odds(points: float, scale: Scale) -> float:
    """Return the standard deviation that --prior gives, in log-odds, or refuse it."""
    from evenbreak.ratings.fit import NARROWEST, WIDEST

    width = scale.log_odds(points)
    if not NARROWEST <= width <= WIDEST:
        least, most = scale.points(NARROWEST), scale.points(WIDEST)
        refuse(f"--prior is {points:g} points; on this scale give {least:.2g} to {most:.4g}")
    return width


def _best_prior(
    file: ResultsFile,
    scale: Scale,
    half_life: float | None,
    as_of: str | None,
    break_advantage: float | str | None,
) -> PriorChoice:
    from evenbreak.cli.kit.progress import Progress
    from evenbreak.ratings.decay import day_of, until
    from evenbreak.ratings.prior import best_prior

    results = file.results
    if as_of is not None:
        results = results.select(until(results, day_of(as_of)))
    with Progress("stretches predicted") as progress:
        return best_prior(
            results,
            half_life=half_life,
            break_advantage=break_advantage,
            scale=scale,
            progress=progress,
        )
