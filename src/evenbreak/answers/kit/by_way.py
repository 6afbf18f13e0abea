"""The method behind an answer, and how far another seed would move a simulation's results."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Part, Quantities

if TYPE_CHECKING:
    from evenbreak.chains.ways import Way


_WORDS: dict[Way, str] = {
    "kernel": "Calculated by the kernel, the fast formula for this question.",
    "elimination": "Calculated by elimination: the game's graph became a sparse matrix, and its "
    "states were eliminated one by one, without subtraction.",
    "eigen": "Calculated by eigenvectors: the game's graph became a sparse matrix, and the limit "
    "was read off its eigenvectors of eigenvalue 1.",
}

DEFECTIVE = (
    "The matrix of a race is defective: it has fewer independent eigenvectors than states. But "
    "all the eigenvectors of eigenvalue 1 exist, and the limit needs no others."
)


def by_way(
    via: Way | None, pairs: Iterable[tuple[Any, Any]], *, beside: Way = "kernel", note: str = ""
) -> list[Part]:
    """Return what an answer adds if a method was requested; nothing if none was.

    Each of `pairs` is a number from this method and from the method `beside`.
    """
    if via is None:
        return []
    known = [(one, other) for one, other in pairs if one is not None and other is not None]
    apart = None if via == beside else max((abs(one - other) for one, other in known), default=0.0)
    listed = quantities_of(
        {"via": via, "way_difference": apart},
        beside=beside,
        way="the kernel" if beside == "kernel" else beside,
    )
    return [" ".join(filter(None, (_WORDS[via], note))), Quantities(listed)]


def error_of_share(share: float, runs: int) -> float:
    """Return the standard error of a proportion from independent runs.

    >>> error_of_share(0.5, 400)
    0.025
    """
    return math.sqrt(share * (1.0 - share) / runs)


def luck_words(errors: Iterable[float], figures: str = "share") -> str:
    """Return how far another seed would move a simulation's figures, 19 times in 20.

    The standard errors are for proportions.

    >>> luck_words([0.01, 0.02], "title odds")
    'with other random numbers, no title odds would move by more than about 4.0 percentage points'
    """
    points = f"{200.0 * max(errors):.1f}"
    unit = "point" if points == "1.0" else "points"
    return (
        f"with other random numbers, no {figures} would move by more than about {points} "
        f"percentage {unit}"
    )
