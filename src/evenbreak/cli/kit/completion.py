"""What a shell offers when a word is half typed: charts, scales, systems, players, files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import click
from click.shell_completion import CompletionItem

from evenbreak.errors import EvenbreakError
from evenbreak.fields.kinds import File, Kind
from evenbreak.ratings.scale import SCALES

FILES = ("csv", "FILE")
"""What the metavar of an argument or option says that is the name of a file."""

LISTS = ("from_file", "results")
"""The parameters that name a file with players, by what commands call them."""


Complete = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]


class Completed(click.types.StringParamType):
    """A text for which a shell is offered words."""

    def __init__(self, complete: Complete) -> None:
        self._complete = complete

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Return the words."""
        return self._complete(ctx, param, incomplete)


def complete_files(command: click.Command) -> None:
    """Make the shell offer files where a parameter is the name of one."""
    for param in command.params:
        named = str(param.metavar or "")
        if param.type is click.STRING and any(word in named for word in FILES):
            param.type = Completed(file_names)


def offers(kind: Kind) -> Complete | None:
    """Return what offers words for a kind of values, or None."""
    if isinstance(kind, File):
        return file_names if kind.names is None else partial(_names_or_files, kind.names)
    functions: dict[str, Complete] = {
        "files": file_names,
        "players": players,
        "scales": scales,
        "systems": systems,
    }
    return functions.get(getattr(kind, "offers", ""))


def file_names(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:  # noqa: ARG001
    """Let the shell offer its files."""
    return [CompletionItem(incomplete, type="file")]


def scales(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:  # noqa: ARG001
    """Return the names of scales."""
    return offered(SCALES, incomplete)


def systems(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:  # noqa: ARG001
    """Return the names of handicap systems."""
    from evenbreak.handicaps import SYSTEMS
    from evenbreak.plugins import added

    return offered([*SYSTEMS, *added("system")], incomplete)


def _names_or_files(
    names: Callable[[], Iterable[str]], ctx: click.Context, param: click.Parameter, incomplete: str
) -> list[CompletionItem]:
    """Return names of what comes with the program, or files where none starts like that."""
    return offered(names(), incomplete) or file_names(ctx, param, incomplete)


def players(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:  # noqa: ARG001
    """Return the players on the list that was named before, by any of their names."""
    names: Iterable[str] = ()
    for name in LISTS:
        given = ctx.params.get(name) or ()
        paths = [path for path in ((given,) if isinstance(given, str) else given) if path != "-"]
        if paths:
            names = [player for path in paths for player in _players_of(path)]
            break
    typed = incomplete.casefold()
    return [
        CompletionItem(_in_shell(name))
        for name in names
        if any(part.startswith(typed) for part in (name.casefold(), *name.casefold().split()))
    ]


def _players_of(path: str) -> Iterable[str]:
    """Return the players of a list of ratings or of results; none if it cannot be read."""
    from evenbreak import files

    readers: tuple[Any, ...] = (
        lambda: files.read_roster(path).roster.players,
        lambda: files.read_seasons([path]).results.players,
    )
    for read in readers:
        try:
            names: Iterable[str] = read()
        except (EvenbreakError, OSError):
            continue
        return names
    return ()


def _in_shell(name: str) -> str:
    """Return a name as bash needs it, which does not quote blanks by itself."""
    if os.environ.get("_EVENBREAK_COMPLETE") != "bash_complete" or not set(name) & set(" '"):
        return name
    words = os.environ.get("COMP_WORDS", "").split("\n")
    typed = words[min(int(os.environ.get("COMP_CWORD", "0")), len(words) - 1)]
    return name if typed.startswith(('"', "'")) else f'"{name}"'


def offered(words: Iterable[str], incomplete: str) -> list[CompletionItem]:
    """Return the words that start like this."""
    return [CompletionItem(word) for word in words if word.startswith(incomplete)]
