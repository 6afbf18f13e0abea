"""How the terminal says a sentence: parameters are options, and files have their whole path."""

from dataclasses import replace
from functools import cache

from evenbreak.files.catalogues import face_in
from evenbreak.words import Face, in_face


@cache
def _terminal() -> Face:
    return replace(face_in("en"), parameter=_option)


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def said(text: str) -> str:
    """Return a text as the terminal says it.

    >>> from evenbreak.words import Parameter, say
    >>> said(say("{scale} must be above 0", scale=Parameter("prior_scale")))
    '--prior-scale must be above 0'
    """
    shown: str = in_face(text, _terminal())
    return shown
