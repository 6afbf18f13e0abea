"""Where the losers of the winners' side drop to.

A player who drops straight down soon meets somebody they have already played. A good order
sends each round's losers to another part of the losers' side. All orders here are flips: the
loser of match i, counted from 0, drops to match i XOR mask. Mask 0 is straight, 1 swaps
neighbours, half the number of matches shifts by half, all ones reverses the round. The
measure of an order is the expected number of rematches among equal players
(`expected_rematches`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias, get_args

from evenbreak.errors import InputError

Drops: TypeAlias = Literal["fewest rematches", "usual", "straight"]
DROPS: tuple[Drops, ...] = get_args(Drops)
"""The patterns of drops, by name."""

# The masks of each round of drops, by number of lines; later rounds are straight.
_MASKS: dict[Drops, dict[int, tuple[int, ...]]] = {
    # The best of all flips up to 64 lines, the best that a search found beyond.
    "fewest rematches": {
        8: (1,),
        16: (3, 0),
        32: (3, 3, 0),
        64: (15, 4, 1, 1),
        128: (31, 3, 2, 2, 0),
        256: (63, 24, 3, 2, 2, 0),
    },
    # What most bracket programs do by default.
    "usual": {
        8: (1,),
        16: (1, 1),
        32: (7, 2, 0),
        64: (15, 4, 3, 0),
        128: (31, 8, 1, 1, 1),
        256: (63, 16, 1, 1, 1, 1),
    },
    "straight": {},
}


def drop_orders(
    size: int, drops: Drops | Sequence[Sequence[int]], *, pod: int | None = None
) -> list[list[int]]:
    """Return, for each round of drops, whose loser drops into each match, from 1 on.

    Parameters
    ----------
    size
        the lines of the bracket, a power of 2.
    drops
        'straight': the loser of match i drops into match i. 'usual': what most programs do.
        'fewest rematches': the flips with the fewest expected rematches among equal players.
        Or the orders themselves, from the first round of drops on.
    pod
        keep drops within pods of so many lines; None: there are no pods.

    Raises
    ------
    InputError
        if an order does not name each match once.

    >>> drop_orders(16, "fewest rematches")
    [[4, 3, 2, 1], [1, 2], [1]]
    >>> drop_orders(16, "usual")
    [[2, 1, 4, 3], [2, 1], [1]]
    """
    counts = [size // 2**r for r in range(2, size.bit_length())]
    if isinstance(drops, str):
        if drops not in DROPS:
            listed = ", ".join(repr(name) for name in DROPS)
            raise InputError(
                "drops is {drops!r}; give {listed}, or the orders themselves",
                drops=drops,
                listed=listed,
            )
        masks = [*_MASKS[drops].get(pod or size, ()), *[0] * len(counts)]
        return [
            [(i ^ mask) + 1 for i in range(count)]
            for mask, count in zip(masks, counts, strict=False)
        ]
    given = [list(order) for order in drops]
    if len(given) > len(counts):
        raise InputError(
            "drops has {n_given} orders; give {n_counts} at most",
            n_given=len(given),
            n_counts=len(counts),
        )
    for number, (order, count) in enumerate(zip(given, counts, strict=False), 1):
        if sorted(order) != list(range(1, count + 1)):
            raise InputError(
                "drops has {order} for its round {number}; give 1 to {count}, each once",
                order=order,
                number=number,
                count=count,
            )
    return given + [list(range(1, count + 1)) for count in counts[len(given) :]]
