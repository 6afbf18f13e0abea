"""What a command takes from the league's file: in the folder it runs in, or that --league names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.said import said
from evenbreak.cli.kit.terminal import FILES_OF_LEAGUE, say
from evenbreak.files.league import LEAGUE_TOML, find_league
from evenbreak.files.tables.problems import source_of_form
from evenbreak.questions import of_league
from evenbreak.words import FilePath
from evenbreak.words import say as sentence

if TYPE_CHECKING:
    from evenbreak.files.league.league_file import LeagueFile

LEAGUE = "--league"
_READ, _TAKEN = "evenbreak league", "evenbreak league taken"
_FILES = "evenbreak league files"


def league_option() -> click.Option:
    """Return the option that names the folder of a league."""
    return click.Option(
        [LEAGUE],
        metavar="FOLDER",
        is_eager=True,
        expose_value=False,
        callback=_point_at,
        help="Take defaults from the league.toml in this folder.  [default: the current folder]",
    )


def _point_at(ctx: click.Context, param: click.Parameter, value: str | None) -> None:  # noqa: ARG001
    if value is not None and not ctx.resilient_parsing:
        point_at(ctx, value)


def point_at(ctx: click.Context, folder: str) -> LeagueFile:
    """Make a folder's league the one of the command that runs; refuse one without it."""
    from evenbreak.files.league.league_file import read_league

    place = Path(folder)
    if find_league(place) is None and not (place.suffix == ".toml" and place.is_file()):
        raise click.BadParameter(
            f"{folder!r} has no {LEAGUE_TOML}. Write one with `evenbreak league init {folder}`.",
            ctx=ctx,
            param_hint=LEAGUE,
        )
    league: LeagueFile = read_league(place, quickly=True)
    _keep(ctx, league)
    return league


def league_in(ctx: click.Context) -> LeagueFile | None:
    """Return the league of the command that runs; None if there is none."""
    if _READ not in ctx.meta:
        ctx.meta[_READ] = None
        if (path := find_league()) is not None:
            from evenbreak.files.league.league_file import read_league

            _keep(ctx, read_league(path, quickly=True))
    league: LeagueFile | None = ctx.meta[_READ]
    return league


def _keep(ctx: click.Context, league: LeagueFile) -> None:
    """Keep a league as that of the command; nothing is written over its files."""
    named = [vars(league.files).values(), [one.file for one in league.results]]
    named.append([league.chart, league.publish.logo])
    files = [league.place(one) for part in named for one in part if one]
    ctx.meta.update({_READ: league, FILES_OF_LEAGUE: (str(league.path), *files)})


def defaults(question: type, typed: Mapping[str, Any], ctx: click.Context) -> dict[str, Any]:
    """Return what a question takes from the league's file; --verbose shows it."""
    if not of_league.takes_any(question) or (league := league_in(ctx)) is None:
        return {}
    every = of_league.taken(question, typed, league)
    if not every:
        return {}
    ctx.meta[_FILES] = _files_of(every, league) if not getattr(question, "of_form", False) else ()
    ctx.meta[_TAKEN] = said(of_league.says_taken(every, league))
    if ctx.params.get("verbose"):
        show_taken(ctx)
    return {one.name: one.value for one in every}


def _files_of(every: Iterable[of_league.Taken], league: LeagueFile) -> set[str]:
    files = {one.text for one in every}
    sources = league.results if str(league.path) in files else ()
    return files.union(league.place(one.file) for one in sources)


def without_form(warnings: Iterable[str]) -> list[str]:
    """Return warnings without those about how the files that league.toml names are written.

    They stay the same from command to command; `league init` and `league tidy` say them.
    """
    ctx = click.get_current_context(silent=True)
    files = ctx.meta.get(_FILES, ()) if ctx is not None else ()
    return [text for text in warnings if source_of_form(text) not in files]


def show_taken(ctx: click.Context) -> None:
    """Show once what was taken from the league's file, if anything was."""
    if (taken := ctx.meta.pop(_TAKEN, None)) is not None:
        say(taken)


class MayBeOfLeague(click.Parameter):
    """A parameter that need not be typed where the league's file has it."""

    def __init__(self, *words: Any, question: type, **options: Any) -> None:
        super().__init__(*words, **options)
        self.question = question

    def process_value(self, ctx: click.Context, value: Any) -> Any:
        """Return the value; nothing where the league's file will give it."""
        try:
            return super().process_value(ctx, value)
        except click.MissingParameter:
            key = of_league.key_of(self.question, self.name or "")
            league = league_in(ctx) if key and not ctx.resilient_parsing else None
            if league is None:
                raise
            if of_league.text_of(league, key) is None:
                why = said(sentence("{file} has no {key}", file=FilePath(league.path), key=key))
                raise click.MissingParameter(why, ctx=ctx, param=self) from None
            return () if self.nargs == -1 or self.multiple else None


class LeagueArgument(MayBeOfLeague, click.Argument):
    """An argument that the league's file may give."""


class LeagueOption(MayBeOfLeague, click.Option):
    """An option that the league's file may give."""
