"""The errors that this package raises, as a small hierarchy.

Every message says what was wrong, where, and how to correct it. All of them are
`EvenbreakError`; those caused by a wrong value are also `ValueError`, so that code which
knows nothing of this package catches them too.
"""

from __future__ import annotations

from collections.abc import Iterable


class EvenbreakError(Exception):
    """The base of every error that this package raises on purpose."""


class InputError(EvenbreakError, ValueError):
    """A parameter has a value that it cannot have."""


class GameError(EvenbreakError, ValueError):
    """A game does not follow the rules of a game (see `evenbreak.game`)."""


class ChainError(EvenbreakError, ValueError):
    """Arcs or a matrix do not make a Markov chain, or the question does not apply to it."""


class AccuracyError(EvenbreakError, ArithmeticError):
    """The method asked for cannot guarantee the accuracy of the answer."""


class WorkerError(EvenbreakError, RuntimeError):
    """The processes or the cluster that should do the work cannot be reached or have stopped."""


class DataError(EvenbreakError, ValueError):
    """A file cannot be used; `problems` lists everything that is wrong with it, one line each.

    >>> error = DataError(["r.csv:2: score_a 'x' is not a whole number; write 0, 1, 2, ..."])
    >>> error.problems
    ("r.csv:2: score_a 'x' is not a whole number; write 0, 1, 2, ...",)
    """

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(problems)
        super().__init__(self.problems)  # what a copy in another process is made from

    def __str__(self) -> str:
        return "\n".join(self.problems)
