"""A move: something that can be entered on a night, from which commands and forms are made."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from evenbreak.errors import InputError

State = TypeVar("State")
What = TypeVar("What")


class AlreadyError(InputError):
    """What is entered is so already: the same tap came in twice."""


@dataclass(frozen=True)
class Move(Generic[State, What]):
    """Something that can be entered on a night.

    Parameters
    ----------
    question
        what is asked for it: its fields are the options of a command and the fields of a form.
    decide
        returns what happens, given the state, what is asked, and when it is entered. It raises an
        `InputError` if the rules do not allow it, an `AlreadyError` if it is so already.
    said
        returns in words what that changed, given the state before and after, and what was asked.
    doubts
        returns in the same way what may be wrong with it, though it was entered.
    would
        returns in words what it would do, of a move that is asked about before it is entered even
        if it takes nothing away; None: the others.
    by
        who may: the director, or whoever is in the room.
    """

    question: type
    decide: Callable[[State, Any, str], Sequence[What]]
    said: Callable[[State, State, Any], Sequence[str]]
    doubts: Callable[[State, State, Any], Sequence[str]] = lambda *_: ()
    would: Callable[[State, State], Sequence[str]] | None = None
    by: Literal["director", "anybody"] = "director"
