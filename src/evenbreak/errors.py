"""The exceptions that this package raises, as a small hierarchy.

Every message says what was wrong, where, and how to correct it. All of them are `EvenbreakError`;
those caused by an invalid value are also `ValueError`, so code that doesn't know this package
catches them too.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from evenbreak.words import Sentence, joined, say


class EvenbreakError(Exception):
    """Base class of every exception that this package raises on purpose.

    Parameters
    ----------
    template
        what went wrong: a template for `evenbreak.words.say`, or a sentence.
    values
        the values that fill in the template.

    Attributes
    ----------
    sentence
        what went wrong, in a form that can be translated; `str` of the error is its English text.

    >>> error = InputError("{name!r} has not entered", name="Tom and Jerry")
    >>> str(error), error.sentence.template
    ("'Tom and Jerry' has not entered", '{name!r} has not entered')
    """

    sentence: Sentence

    def __init__(self, template: str, /, **values: Any) -> None:
        self.sentence = template if isinstance(template, Sentence) else say(template, **values)
        super().__init__(self.sentence)  # what a copy in another process is made from


class InputError(EvenbreakError, ValueError):
    """A parameter has an invalid value."""


class GameError(EvenbreakError, ValueError):
    """A game breaks the rules of a game (see `evenbreak.game`)."""


class ChainError(EvenbreakError, ValueError):
    """Arcs or a matrix do not make a Markov chain, or the question does not apply to it."""


class AccuracyError(EvenbreakError, ArithmeticError):
    """The requested method cannot guarantee the accuracy of the answer."""


class WorkerError(EvenbreakError, RuntimeError):
    """The worker processes or the cluster cannot be reached or have stopped."""


class DataError(EvenbreakError, ValueError):
    """A file cannot be used; `problems` lists everything wrong with it, one line each.

    >>> error = DataError(["r.csv:2: score_a 'x' isn't a whole number. Write 0, 1, 2, ..."])
    >>> error.problems
    ("r.csv:2: score_a 'x' isn't a whole number. Write 0, 1, 2, ...",)
    """

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(problems)
        super().__init__(joined(self.problems, "\n"))
        self.args = (self.problems,)  # what a copy in another process is made from

    def __str__(self) -> str:
        return str(self.sentence)
