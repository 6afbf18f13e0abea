"""Options shared by several commands, each declared once, and commands that take ratings."""

import math
import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import update_wrapper
from typing import Any, TypeVar

import click

from evenbreak.chains.ways import WAYS
from evenbreak.cli.kit import completion
from evenbreak.cli.kit.said import said
from evenbreak.cli.kit.values import NUMBER, SHARE, SPAN, Number, Whole, meant, refuse
from evenbreak.errors import InputError
from evenbreak.matches.formats import LONGEST, match_format
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of

Command = TypeVar("Command", bound=Callable[..., Any])
Decorator = Callable[[Command], Command]


def with_options(command: Command, *options: Decorator[Any]) -> Command:
    """Return a command with more options, the last of them first in its help."""
    for option in options:
        command = option(command)
    return command


HIGHEST_SEED = 2**32 - 1


class PlainCommand(click.Command):
    """A command that reads -20 as a number, where click alone sees an unknown option."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, and refuse words that only begin like a number."""
        ctx.ignore_unknown_options = any(
            word.startswith("-") and NUMBER.fullmatch(word) for word in args
        )
        rest = super().parse_args(ctx, args)
        words: Sequence[str] = ctx.params.get("ratings", ())
        if ctx.resilient_parsing:
            return rest
        named = ctx.params.get("from_file") is not None
        for word in words:
            if (named and not word.startswith("-")) or NUMBER.fullmatch(word):
                continue
            if word.startswith("-"):
                known = [name for option in self.params for name in option.opts]
                raise click.NoSuchOption(word.split("=")[0], possibilities=known, ctx=ctx)
            wanted = "give two numbers, such as 612 521, or say with --from where it stands"
            wanted += self._as_match(word) or meant(word, -math.inf, math.inf)
            refuse(f"{word!r} is not a rating; {wanted}")
        return rest

    def _as_match(self, word: str) -> str:
        """Return how a match is given, if that is what the word names and the command takes one."""
        with suppress(InputError):
            match = match_format(word)
            option = "--ahead" if match.ahead else "--race"
            if any(option in param.opts for param in self.params):
                return f"; a match goes with {option} {match.m}:{match.n}"
        return ""


def _scale(name: str) -> Scale:
    try:
        scale: Scale = scale_of(name)
    except InputError as error:
        raise click.BadParameter(said(error.sentence)) from None
    return scale


OF_LIST = "the one that the file states, else the only one that the ratings can be on"
"""What applies without --scale to a list of ratings."""

SAY_WHICH = "say which with --scale npl, --scale fargo or --scale elo"
"""What to do about ratings that do not show their scale."""


def scale_option(without: str = DEFAULT_SCALE, *, fixed: bool = True) -> Decorator[Any]:
    """Return the option --scale.

    Parameters
    ----------
    without
        what applies if the option is not given, in words.
    fixed
        whether those words name a scale, which the command then gets; otherwise it gets
        None.
    """
    return click.option(
        "--scale",
        type=_scale,
        shell_complete=completion.scales,
        default=without if fixed else None,
        show_default=False,
        metavar="npl|fargo|elo|POINTS",
        help="The scale of the ratings: POINTS double the odds of winning a game.  "
        f"[default: {without}]",
    )


drill_option = click.option(
    "--drill", metavar="NAME", help="The drill to look at, if the file has several."
)


def seed_option(
    what: str = "The seed of all random draws.", *, default: int | None = 1
) -> Decorator[Any]:
    """Return the option --seed; `what` says what is drawn."""
    return click.option(
        "--seed",
        type=Whole(0, HIGHEST_SEED),
        default=default,
        metavar="N",
        help=what,
    )


def chart_option(
    what: str = "The chart that sets the races.  [default: the system's own]",
) -> Decorator[Any]:
    """Return the option --chart; `what` says what the chart is for."""
    return click.option("--chart", metavar="NAME|FILE", help=what)


form_option = click.option(
    "--form",
    metavar="SD",
    type=Number(0.0, 3.0, "; give a number from 0 to 3, such as 0.35"),
    help="Allow for form of the day: how much the log-odds of a game vary from match to match "
    "(standard deviation), as `evenbreak rate` finds it, such as 0.35.  [default: what the list of "
    "ratings states, else 0]",
)
"""The option --form of the commands that answer for matches."""


via_option = click.option(
    "--via",
    type=click.Choice(list(WAYS)),
    help="The way to the answer: the fast formula (kernel), or the game's graph and matrix, by "
    "elimination of states or by eigenvectors. They are compared.",
)
"""The option --via of the commands that answer for a chain."""


def _folder(ctx: click.Context, param: click.Parameter, value: str) -> str:  # noqa: ARG001
    if not value.strip():
        refuse("--out is empty; name a folder, or . for this one")
    return value


def out_option(what: str) -> Decorator[Any]:
    """Return the option --out; `what` says what is written to the folder."""
    kind = click.Path(file_okay=False)
    return click.option(
        "--out", required=True, metavar="DIR", type=kind, callback=_folder, help=what
    )


def _columns(
    ctx: click.Context,  # noqa: ARG001
    param: click.Parameter,  # noqa: ARG001
    given: tuple[str, ...],
) -> dict[str, str]:
    """Return the title of each column that --columns names."""
    columns: dict[str, str] = {}
    for text in given:
        # A title may have a comma in it, but hardly words and an equals sign after it.
        for part in re.split(r",(?=[\w ]+=)", text):
            name, sign, title = (piece.strip() for piece in part.partition("="))
            name = name.lower().replace(" ", "_")
            if not (name and sign and title):
                refuse(
                    f"--columns has {part.strip()!r}; give the column and the title that it has in "
                    "the file, such as player_a=Home,player_b=Away"
                )
            if name in columns or title.casefold() in map(str.casefold, columns.values()):
                refuse(f"--columns has {part.strip()!r}, but one of them was given before")
            columns[name] = title
    return columns


dates_option = click.option(
    "--dates",
    type=click.Choice(["mdy", "dmy"]),
    is_eager=True,
    help="The order in dates such as 9/3/2024: month first or day first.  [default: as other dates "
    "of the file show]",
)
"""The option --dates; it is read first, so that options with a date can go by it."""


def results_options(command: Command) -> Command:
    """Add the options of every command that reads results, which gets them as `reading`.

    They are --aliases, --columns, --dates and --skip-bad, by the names that `files.read_results`
    has.
    """

    def run(
        *,
        aliases: str | None,
        columns: dict[str, str],
        dates: str | None,
        skip_bad: bool,
        **rest: Any,
    ) -> Any:
        reading = {"aliases": aliases, "columns": columns, "dates": dates, "skip_bad": skip_bad}
        return command(reading=reading, **rest)

    wrapped: Any = update_wrapper(run, command)
    return with_options(  # type: ignore[no-any-return]
        wrapped,
        dates_option,
        click.option(
            "--skip-bad",
            is_flag=True,
            help="Leave out rows that cannot be read and scores that can hardly be games, and list "
            "them.  [default: refuse the file]",
        ),
        click.option(
            "--columns",
            multiple=True,
            metavar="NAME=TITLE,...",
            callback=_columns,
            help="What the file calls its columns, such as player_a=Home,player_b=Away; can be "
            "repeated.",
        ),
        click.option(
            "--aliases",
            metavar="ALIASES.csv",
            help="Names that mean the same player: a file with the columns name and means.",
        ),
    )


players_file_option = click.option(
    "--players-file",
    metavar="FILE",
    help="Who has entered: a name on each line, or a CSV file with player and rating.",
)
"""The option --players-file of the commands about the players of an evening or a season."""


safety_option = click.option(
    "--safety",
    metavar="ALPHA",
    type=SHARE,
    default="1",
    help="The first shot of an inning goes in ALPHA times as often as the others.",
)
"""The option --safety of the commands about straight pool."""


def race_limit_options(command: Command) -> Command:
    """Add the options that limit the races: --games or --race-to."""
    return with_options(
        command,
        click.option(
            "--race-to",
            type=Whole(1, LONGEST),
            metavar="N",
            help="Races in which the stronger player needs N games.",
        ),
        click.option(
            "--games",
            metavar="LO..HI",
            type=SPAN,
            help="Races whose longest possible match has LO to HI games.",
        ),
    )


def refuse_both(games: tuple[int, int] | None, race_to: int | None) -> None:
    """Refuse --games together with --race-to."""
    if games is not None and race_to is not None:
        refuse("--games and --race-to cannot be combined; leave one out")
