"""A move: something that can be entered on a night, from which commands and forms are made."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from evenbreak.errors import InputError

State = TypeVar("State")
What = TypeVar("What")


class AlreadyError(InputError):
    """Raised if what is entered is already so: the same tap came in twice."""


@dataclass(frozen=True)
class Move(Generic[State, What]):
    """Something that can be entered on a night.

    The question's fields are the options of a command and the fields of a form. `decide` returns
    the entries for a state, a question and a time, or raises an `InputError` (against the rules) or
    an `AlreadyError`. `said` and `doubts` return, in words, what it changed and what may be wrong
    with it, given the states before and after; `would` returns what it would do, for a move that is
    confirmed first even if it removes nothing.
    """

    question: type
    decide: Callable[[State, Any, str], Sequence[What]]
    said: Callable[[State, State, Any], Sequence[str]]
    doubts: Callable[[State, State, Any], Sequence[str]] = lambda *_: ()
    would: Callable[[State, State], Sequence[str]] | None = None
    by: Literal["director", "anybody"] = "director"
