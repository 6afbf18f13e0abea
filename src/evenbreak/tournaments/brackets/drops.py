"""Where the losers of the winners' side drop to.

Whoever drops into the match of somebody they have just beaten meets them again at once.
An order sends each round's losers elsewhere. All orders here are flips: match i, counted
from 0, goes to i XOR mask. The mask 1 swaps neighbours, half the matches is a shift by
half, all bits reverse the round, 0 is straight. How good an order is shows in the rematches
to be expected among equal players (`expected_rematches`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias, get_args

from evenbreak.errors import InputError

Drops: TypeAlias = Literal["fewest rematches", "usual", "straight"]
DROPS: tuple[Drops, ...] = get_args(Drops)
"""The patterns of drops, by name."""

# The masks of the rounds of drops, for each number of lines; later rounds are straight.
_MASKS: dict[Drops, dict[int, tuple[int, ...]]] = {
    # All flips of 16 to 64 lines were compared; of more lines, those that a search led to.
    "fewest rematches": {
        8: (1,),
        16: (3, 0),
        32: (3, 3, 0),
        64: (15, 4, 1, 1),
        128: (31, 3, 2, 2, 0),
        256: (63, 24, 3, 2, 2, 0),
    },
    # The default of most programs.
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
    """Return for each round of drops which match's loser goes to each match, from 1 on.

    Parameters
    ----------
    size
        the lines of the bracket, a power of 2.
    drops
        'straight': the loser of the i-th match drops to the i-th match. 'usual': what most
        programs do. 'fewest rematches': the flips with the fewest expected rematches among
        equal players. Or the orders themselves, the first rounds at least.
    pod
        the lines of a pod that nobody leaves; None: all lines.

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
            raise InputError(f"drops is {drops!r}; give {listed}, or the orders themselves")
        masks = [*_MASKS[drops].get(pod or size, ()), *[0] * len(counts)]
        return [
            [(i ^ mask) + 1 for i in range(count)]
            for mask, count in zip(masks, counts, strict=False)
        ]
    given = [list(order) for order in drops]
    if len(given) > len(counts):
        raise InputError(f"drops has {len(given)} orders; give {len(counts)} at most")
    for number, (order, count) in enumerate(zip(given, counts, strict=False), 1):
        if sorted(order) != list(range(1, count + 1)):
            raise InputError(
                f"drops has {order} for its round {number}; give 1 to {count}, each once"
            )
    return given + [list(range(1, count + 1)) for count in counts[len(given) :]]
