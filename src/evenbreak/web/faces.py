"""How the pages say a sentence: parameters are fields, commands are forms, files have no folder."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import PurePath

from evenbreak.files.catalogues import face_in
from evenbreak.words import Face, in_face, say

FIELDS = {
    "race": say("the race"),
    "losers_race": say("the race on the losers' side"),
    "final_race": say("the race in the final"),
    "groups": say("the number of groups"),
    "qualifiers": say("the number of players advancing"),
    "rounds": say("the number of rounds"),
    "tables": say("the number of tables"),
    "fee": say("the entry fee"),
    "added": say("the added money"),
    "a": say("the first score"),
    "b": say("the second score"),
    "sets": say("the number of sets"),
    "times": say("how often each may play"),
    "table": say("the table"),
    "payout": say("the payout"),
    "cap": say("the cap"),
    "doubling": say("the points that double the odds"),
}
"""What the pages call a parameter."""

FORMS = {
    "tournament correct": say("Correct a result"),
    "tournament draw": say("Make the draw"),
    "tournament result": say("Enter result"),
    "tournament tiebreak": say("Break the ties"),
    "tournament undo": say("Undo"),
}
"""What is on the pages in place of a command."""


def page_face(language: str) -> Face:
    """Return how the pages say a sentence in a language.

    >>> from evenbreak.words import Parameter
    >>> say("{field} is blank", field=Parameter("tables")).said(page_face("en"))
    'the number of tables is blank'
    """
    plain = face_in(language)

    def parameter(name: str) -> str:
        return str(in_face(FIELDS.get(name, name), plain))

    def command(name: str, _: Sequence[str]) -> str:
        return say("“{form}”", form=FORMS.get(name, name)).said(plain)

    return replace(plain, parameter=parameter, command=command, file=_without_folder)


def _without_folder(path: str) -> str:
    return PurePath(path).name
