"""How the terminal says a sentence: parameters are options, and files have their whole path."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import click

from evenbreak.words import Face, in_face

_running: list[click.Command] = []


def runs(command: click.Command) -> None:
    """Keep which command runs: a sentence calls a parameter by its option there."""
    _running[:] = [command]


def _spelled(name: str) -> str:
    """Return the option of the command that runs for a parameter; its name if there is none."""
    for param in _running[0].params if _running else ():
        if param.name == name and isinstance(param, click.Option):
            return max(param.opts, key=len)
    return name


@cache
def terminal() -> Face:
    """Return how the terminal says what the command that runs answers."""
    from evenbreak.files.catalogues import face_in

    return replace(face_in("en"), parameter=_spelled)


def said(text: str, spelled: Callable[[str], str] | None = None) -> str:
    """Return a text as the terminal says it; `spelled` returns the option of a parameter.

    >>> from evenbreak.words import Parameter, say
    >>> said(say("{scale} must be above 0", scale=Parameter("scale")), lambda name: f"--{name}")
    '--scale must be above 0'
    """
    face = terminal() if spelled is None else replace(terminal(), parameter=spelled)
    shown: str = in_face(text, face)
    return shown
