"""How the terminal says a sentence: parameters are options, and files have their whole path."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

from evenbreak.files.catalogues import face_in
from evenbreak.words import Face, in_face


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


@cache
def _terminal() -> Face:
    return replace(face_in("en"), parameter=_option)


def said(text: str, spelled: Callable[[str], str] | None = None) -> str:
    """Return a text as the terminal says it; `spelled` returns the option of a parameter.

    >>> from evenbreak.words import Parameter, say
    >>> said(say("{scale} must be above 0", scale=Parameter("prior_scale")))
    '--prior-scale must be above 0'
    """
    shown: str = in_face(
        text, _terminal() if spelled is None else replace(_terminal(), parameter=spelled)
    )
    return shown
