"""By which way an answer was calculated, and how far that is from the fast way."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Part, Quantities

if TYPE_CHECKING:
    from evenbreak.chains.ways import Way


_WORDS: dict[Way, str] = {
    "kernel": "Calculated by the kernel, the fast formula for this question.",
    "elimination": "Calculated by elimination: the game's graph became a sparse matrix, and its "
    "states were eliminated one by one, without a subtraction.",
    "eigen": "Calculated by eigenvectors: the game's graph became a sparse matrix, and the limit "
    "was read off its eigenvectors of eigenvalue 1.",
}

ROUNDING = 1e-14
"""Differences up to this are rounding; their digits vary from computer to computer."""

DEFECTIVE = (
    "The matrix of a race is defective: it has fewer independent eigenvectors than states. But "
    "all those of eigenvalue 1 exist, and the limit needs no others."
)


def by_way(
    via: Way | None,
    pairs: Iterable[tuple[Any, Any]],
    *,
    beside: Way = "kernel",
    note: str = "",
) -> list[Part]:
    """Return what an answer says about the way that was asked for; nothing if none was.

    Parameters
    ----------
    via
        the way.
    pairs
        numbers by this way, each with the same number by the way `beside`; None for none.
    beside
        the way to compare with.
    note
        what else to know about the way.

    >>> for part in by_way("eigen", [(0.5, 0.5), (0.25, 0.25000000000000006)]):
    ...     print(part if isinstance(part, str) else [(one.name, one.value) for one in part.of])
    Calculated by eigenvectors: the game's graph became a sparse matrix, and the limit was read \
off its eigenvectors of eigenvalue 1.
    [('via', 'eigen'), ('kernel_difference', 5.551115123125783e-17)]
    """
    if via is None:
        return []
    known = [(one, other) for one, other in pairs if one is not None and other is not None]
    apart = None if via == beside else max((abs(one - other) for one, other in known), default=0.0)
    listed = quantities_of(
        {
            "via": via,
            "way_difference": apart,
        },
        beside=beside,
        way="the kernel" if beside == "kernel" else beside,
    )
    return [" ".join(filter(None, (_WORDS[via], note))), Quantities(listed)]
