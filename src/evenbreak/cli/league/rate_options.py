"""What `rate` and `report` share: the options that say how to rate, and the rating by them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, Command, refuse
from evenbreak.errors import DataError

if TYPE_CHECKING:
    from evenbreak.files.results import ResultsFile
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.prior import PriorChoice
    from evenbreak.ratings.scale import Scale


def points(ctx: click.Context, param: click.Parameter, value: str | None) -> Any:
    """Return a number of points above 0, or the option's word; None where it is absent."""
    word = "best" if param.name == "prior" else "fit"
    if value is None or value.strip().lower() == word:
        return None if value is None else word
    number = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if math.isfinite(number) and (word == "fit" or number > 0):
        return number
    least = " above 0" if word == "best" else ""
    raise click.BadParameter(
        f"{value!r}; give a number of points{least}, or {word}", ctx=ctx, param=param
    )


def _days(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None
    number = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if math.isfinite(number) and number > 0:
        return number
    raise click.BadParameter(
        f"{value!r}; give a number of days above 0, such as 180", ctx=ctx, param=param
    )


def _day(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Return a day as 2026-01-31, from all that a cell of a results file may say."""
    if value is None:
        return None
    from evenbreak.files.cells import read_date

    day = read_date(value.strip())
    if day is None:
        raise click.BadParameter(
            f"{value!r}; give a day, such as 2026-01-31 or 31.1.2026", ctx=ctx, param=param
        )
    return str(day)


def how_to_rate(command: Command) -> Command:
    """Add the options --prior, --half-life and --as-of."""
    command = click.option(
        "--as-of",
        metavar="DATE",
        callback=_day,
        help="Rate as of this day: leave later matches out.  [default: the last date]",
    )(command)
    command = click.option(
        "--half-life",
        metavar="DAYS",
        callback=_days,
        help="A match counts half after so many days.  [default: always whole]",
    )(command)
    return click.option(
        "--prior",
        metavar="POINTS|best",
        callback=points,
        help="How far players are apart, before any result: the standard deviation; best: the "
        "one that predicts later days best.  [default: what doubles the odds]",
    )(command)


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
    from evenbreak.ratings.fit import fit

    prior_sd, choice = _prior(file, prior, scale, half_life, as_of, break_advantage)
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


def _prior(
    file: ResultsFile,
    prior: float | str | None,
    scale: Scale,
    half_life: float | None,
    as_of: str | None,
    break_advantage: float | str | None,
) -> tuple[float, PriorChoice | None]:
    """Return the standard deviation of the prior in log-odds, and how it was chosen."""
    from evenbreak.ratings.fit import NARROWEST, PRIOR_SD, WIDEST

    if prior is None:
        return PRIOR_SD, None
    if prior != "best":
        width = float(scale.log_odds(float(prior)))
        if not NARROWEST <= width <= WIDEST:
            least, most = scale.points(NARROWEST), scale.points(WIDEST)
            refuse(f"--prior is {prior:g} points; on this scale give {least:.2g} to {most:.4g}")
        return width, None
    from evenbreak.ratings.decay import day_of, until
    from evenbreak.ratings.prior import best_prior

    results = file.results
    if as_of is not None:
        results = results.select(until(results, day_of(as_of)))
    choice = best_prior(results, half_life=half_life, break_advantage=break_advantage, scale=scale)
    return choice.prior_sd, choice
