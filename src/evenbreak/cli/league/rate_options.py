"""How to rate: the options that `rate`, `report`, `why` and `validate` share, and their use."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import click

from evenbreak.cli.kit.options import Command, refuse_both, with_options
from evenbreak.cli.kit.values import Number, refuse
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    from evenbreak.answers.league.roster_matchups import OfferedRaces
    from evenbreak.files.results.results_file import ResultsFile
    from evenbreak.files.tables.dates import DateOrder
    from evenbreak.ratings.beginning import Beginning
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.prior import PriorChoice

RACE_TO = 7
"""The races that are offered unless an option says otherwise."""


class NumberOr(Number):
    """A number, or a word in place of it."""

    def __init__(self, word: str, low: float, wanted: str = "a number of points") -> None:
        super().__init__(low, 1e6, f"; give {wanted}, or {word}")
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

    from evenbreak.files.tables.dates import is_two_dates, read_date

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
    from evenbreak.answers.league.roster_matchups import OfferedRaces

    refuse_both(games, race_to)
    return OfferedRaces(games, RACE_TO if games is None and race_to is None else race_to)


def _as_of(ctx: click.Context, param: click.Parameter, text: str | None) -> str | None:  # noqa: ARG001
    return None if text is None else read_day(text, ctx.params.get("dates"))


_DAYS_AHEAD = 366

DAYS = NumberOr("none", 0.01, "a number of days from 0.01 to 1,000,000, such as 180")

prior_option = click.option(
    "--prior",
    metavar="POINTS|best",
    type=NumberOr("best", 0.0),
    help="How far apart players are assumed to be before any result (standard deviation); best: "
    "what predicts best, and where newcomers, teams, divisions and handicap races start, if that "
    "helps.  [default: best, if the dates can show it, else what doubles the odds]",
)

half_life_option = click.option(
    "--half-life",
    metavar="DAYS|none",
    type=DAYS,
    help="After this many days a match counts half; none: it always counts in full.  [default: "
    "what clearly predicts better, unless --prior gives points]",
)


beginning_option = click.option(
    "--begin",
    metavar="RATINGS.csv",
    help="Begin from these ratings: those that --save wrote after last season, or any list of "
    "rated players, such as the ratings that they bring along from elsewhere.",
)


def how_to_rate(command: Command) -> Command:
    """Add the options --prior, --half-life, --begin and --as-of."""
    return with_options(
        command,
        click.option(
            "--as-of",
            metavar="DATE",
            callback=_as_of,
            help="Rate as of this day, without later matches.  [default: the last date]",
        ),
        half_life_option,
        beginning_option,
        prior_option,
    )


def rated(
    file: ResultsFile,
    scale: Scale,
    *,
    prior: float | Literal["best"] | None,
    half_life: float | str | None,
    as_of: str | None,
    begin: str | None = None,
    anchor: float | dict[str, float] | None = None,
    break_advantage: float | str | None = None,
) -> tuple[Ratings, PriorChoice | None]:
    """Return the ratings by the options that were given, and how their prior was chosen.

    Form of the day is estimated with them.

    Raises
    ------
    DataError
        if no match counts.
    """
    from evenbreak.cli.kit.progress import Progress
    from evenbreak.errors import DataError
    from evenbreak.ratings.usual import usual_ratings

    beginning = None if begin is None else begin_from(begin, file, scale)
    with Progress("steps") as progress:
        ratings, choice = usual_ratings(
            file.results,
            scale=scale,
            prior=prior_in_log_odds(prior, scale) if isinstance(prior, float) else prior,
            half_life=half_life_to_choose(half_life),
            as_of=as_of,
            beginning=beginning,
            anchor=anchor,
            break_advantage=break_advantage,
            progress=progress,
        )
    if not ratings.matches:
        why = "was played; add matches with games"
        if ratings.later:
            why = f"was played by {as_of}; give a later day to --as-of"
        raise DataError([f"{file.source}: no match in it {why}"])
    return ratings, choice


def begin_from(path: str, file: ResultsFile, scale: Scale) -> Beginning:
    """Return the ratings that --begin names, in the spelling of the results, or refuse them."""
    from evenbreak.answers.kit.scales import league_doubts
    from evenbreak.errors import InputError
    from evenbreak.files.lists.saved_ratings import read_saved
    from evenbreak.ratings.scale import refuse_contradicted

    saved = read_saved(path, scale, file.results.players)
    if not saved.found:
        refuse(f"--begin {path}: none of its players is in {file.source}; check the names")
    beginning, day = saved.beginning, saved.beginning.as_of
    if not saved.scale_stated:
        remedy = "name the scale with --scale, or state it in a column scale"
        listed = beginning.rating.tolist(), beginning.players
        try:
            refuse_contradicted(scale, *listed, whose="the new ratings", remedy=remedy)
        except InputError as error:
            refuse(f"--begin {path}: {error}")
        for doubt in league_doubts(scale, beginning.rating, remedy):
            refuse(f"--begin {path}: {doubt}")
    if day is not None and file.results.date is not None:
        known = int((file.results.date[file.results.counted] <= day).sum())
        if known:
            refuse(
                f"--begin {path}: its ratings are as of {day}, and {known:,} of the matches in "
                f"{file.source} are of that day or earlier, so they would count twice; give the "
                "later matches alone"
            )
    return beginning


def prior_in_log_odds(points: float, scale: Scale) -> float:
    """Return the standard deviation that --prior gives, in log-odds, or refuse it."""
    from evenbreak.ratings.fit import NARROWEST, WIDEST

    width = scale.log_odds(points)
    if not NARROWEST <= width <= WIDEST:
        least, most = scale.points(NARROWEST), scale.points(WIDEST)
        refuse(f"--prior is {points:g} points; on this scale give {least:.2g} to {most:.4g}")
    return width


def half_life_to_choose(given: float | str | None) -> float | Literal["best"] | None:
    """Return the half-life as `best_prior` takes it: what --half-life gives, or the best."""
    if given is None:
        return "best"
    return None if given == "none" else float(given)
