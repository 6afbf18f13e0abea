"""What can go wrong, as a small hierarchy.

Every error says what was wrong, where, and how to mend it. All of them are
`EvenbreakError`; those that a wrong value causes are also `ValueError`, so that
code which knows nothing of this package catches them too.
"""

from __future__ import annotations

from collections.abc import Iterable


class EvenbreakError(Exception):
    """Base of every error that this package raises on purpose."""


class InputError(EvenbreakError, ValueError):
    """A parameter has a value that it cannot have."""


class GameError(EvenbreakError, ValueError):
    """A game does not follow the rules of a game (see `evenbreak.game`)."""


class ChainError(EvenbreakError, ValueError):
    """Arcs or a matrix are not a Markov chain, or a question does not apply to this one."""


class AccuracyError(EvenbreakError, ArithmeticError):
    """The answer cannot be vouched for by the method asked for."""


class WorkerError(EvenbreakError, RuntimeError):
    """Those who were to do the work, processes or a cluster, cannot be reached or are gone."""


class DataError(EvenbreakError, ValueError):
    """A file cannot be used; `problems` lists all that is wrong with it, a line each.

    >>> error = DataError(["r.csv:2: score_a 'x' is not a whole number; write 0, 1, 2, ..."])
    >>> error.problems
    ("r.csv:2: score_a 'x' is not a whole number; write 0, 1, 2, ...",)
    """

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))
