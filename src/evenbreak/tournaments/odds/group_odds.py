"""Who comes first, second, ... in a group, by enumerating all possible results."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import permutations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from evenbreak.league.tables.ladder import places_by_wins

MOST_MATCHES = 21
"""The most matches whose results are enumerated: 7 players who meet once."""

_CHUNK = 1 << 15


class RankOrders(NamedTuple):
    """The final order for each combination of a group's results.

    `order_of` is the order's number for each combination of results, whose bit k is set if slot 1's
    player wins match k; orders[o, i] is how many members are ahead of member i in order o, equal
    for ties.
    """

    order_of: NDArray[np.int32]
    orders: NDArray[np.int16]


@lru_cache(maxsize=16)
def rank_orders(members: int, pairs: tuple[tuple[int, int], ...]) -> RankOrders:
    """Return a group's final order for each combination of results."""
    count = 1 << len(pairs)
    codes = np.empty(count, dtype=np.int64)
    power = members ** np.arange(members)
    for start in range(0, count, _CHUNK):
        results = np.arange(start, min(start + _CHUNK, count))
        beats = np.zeros((len(results), members, members), dtype=np.int16)
        for k, (one, other) in enumerate(pairs):
            won = ((results >> k) & 1).astype(np.int16)
            beats[:, one, other] += won
            beats[:, other, one] += 1 - won
        codes[results] = places_by_wins(beats).astype(np.int64) @ power
    distinct, order_of = np.unique(codes, return_inverse=True)
    orders = (distinct[:, None] // power % members).astype(np.int16)
    return RankOrders(order_of.astype(np.int32), orders)


@lru_cache(maxsize=32)
def rank_states(
    members: int, pairs: tuple[tuple[int, int], ...], ranks: tuple[int, ...]
) -> tuple[NDArray[np.int16], csr_array]:
    """Return who can have the given ranks, and how likely that is in each final order.

    Remaining ties are broken by lot: all orders of tied players are equally likely. Ranks ascend
    from 0; states[s, k] is the member with rank ranks[k] in state s, and shares[s, o] = P(state s |
    order o).
    """
    found: dict[tuple[int, ...], int] = {}
    rows, columns, shares = [], [], []
    for o, ahead in enumerate(rank_orders(members, pairs).orders.tolist()):
        law = _lots(tuple(ahead), ranks)
        for state, share in law.items():
            rows.append(found.setdefault(state, len(found)))
            columns.append(o)
            shares.append(share)
    shape = len(found), len(rank_orders(members, pairs).orders)
    matrix = csr_array((shares, (rows, columns)), shape=shape)
    states = np.array(list(found), dtype=np.int16).reshape(len(found), len(ranks))
    return states, matrix


def _lots(ahead: tuple[int, ...], ranks: tuple[int, ...]) -> dict[tuple[int, ...], float]:
    """Return the distribution of who has the given ranks, given who is tied with whom."""
    laws: dict[tuple[int, ...], float] = {(): 1.0}
    blocks = sorted(set(ahead))
    for start in blocks:
        level = [member for member, place in enumerate(ahead) if place == start]
        wanted = [rank - start for rank in ranks if start <= rank < start + len(level)]
        if not wanted:
            continue
        drawn: dict[tuple[int, ...], float] = {}
        ways = list(permutations(level, len(wanted)))
        for way in ways:
            drawn[way] = drawn.get(way, 0.0) + 1.0 / len(ways)
        laws = {
            (*before, *way): one * other
            for before, one in laws.items()
            for way, other in drawn.items()
        }
    return laws


def result_chances(chances: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the chance of each combination of results in a group's matches.

    Each is P(slot 1's player wins): a number, or an array over samples.

    >>> result_chances([np.array(0.75), np.array(0.5)])
    array([0.125, 0.375, 0.125, 0.375])
    """
    law = np.ones((1, *np.shape(chances[0])))
    for chance in chances:
        law = np.concatenate([law * (1.0 - chance), law * chance])
    return law
