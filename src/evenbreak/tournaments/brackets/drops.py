"""Where the losers of the winners' side drop to: the orders in use.

Whoever drops into the match of somebody they have just beaten meets them again at once.
An order sends each round's losers elsewhere; how well it does is measured by the rematches
to be expected among equal players (`expected_rematches`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias, get_args

from evenbreak.errors import InputError

Drops: TypeAlias = Literal["fewest rematches", "usual", "straight"]
DROPS: tuple[Drops, ...] = get_args(Drops)
"""The patterns of drops, by name."""


def _straight(matches: list[int]) -> list[int]:
    return matches


def _reverse(matches: list[int]) -> list[int]:
    return matches[::-1]


def _half_shift(matches: list[int]) -> list[int]:
    half = len(matches) // 2
    return matches[half:] + matches[:half]


def _reverse_halves(matches: list[int]) -> list[int]:
    half = len(matches) // 2
    return matches[:half][::-1] + matches[half:][::-1]


def _flip_pairs(matches: list[int]) -> list[int]:
    return [match for pair in zip(matches[1::2], matches[::2], strict=True) for match in pair]


Order: TypeAlias = Callable[[list[int]], list[int]]

# One order for each round of drops but the last, which has one match.
_USUAL: dict[int, tuple[Order, ...]] = {
    16: (_reverse_halves, _reverse),
    32: (_reverse, _half_shift, _straight),
    64: (_reverse, _half_shift, _reverse, _straight),
    128: (_reverse, _half_shift, _flip_pairs, _flip_pairs, _flip_pairs),
    256: (_reverse, _half_shift, _flip_pairs, _flip_pairs, _flip_pairs, _flip_pairs),
}
_FEWEST: dict[int, tuple[Order, ...]] = {
    16: (_reverse, _straight),
}


def drop_orders(size: int, drops: Drops | Sequence[Sequence[int]]) -> list[list[int]]:
    """Return for each round of drops which match's loser goes to each match, from 1 on.

    Parameters
    ----------
    size
        the lines of the bracket, a power of 2.
    drops
        'straight': the loser of the i-th match drops to the i-th match. 'usual': what most
        programs do. 'fewest rematches': the order of reversals and shifts that has the
        fewest expected rematches among equal players. Or the orders themselves.

    Raises
    ------
    InputError
        if an order does not name each match once.

    >>> drop_orders(16, "fewest rematches")
    [[4, 3, 2, 1], [1, 2], [1]]
    >>> drop_orders(16, "usual")
    [[2, 1, 4, 3], [2, 1], [1]]
    """
    rounds = [list(range(1, size // 2**r + 1)) for r in range(2, size.bit_length())]
    if isinstance(drops, str):
        if drops not in DROPS:
            listed = ", ".join(repr(name) for name in DROPS)
            raise InputError(f"drops is {drops!r}; give {listed}, or the orders themselves")
        table = {"fewest rematches": _FEWEST, "usual": _USUAL, "straight": {}}[drops]
        reversed_once = (_reverse,) if drops != "straight" else ()
        orders = table.get(size, reversed_once)
        padded = [*orders, *[_straight] * (len(rounds) - len(orders))][: len(rounds)]
        return [order(matches) for order, matches in zip(padded, rounds, strict=True)]
    given = [list(order) for order in drops]
    for number, (order, matches) in enumerate(zip(given, rounds, strict=False), 1):
        if sorted(order) != matches:
            raise InputError(
                f"drops has {order} for its round {number}; give 1 to {len(matches)}, each once"
            )
    return given + rounds[len(given) :]
