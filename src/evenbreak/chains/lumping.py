"""Lumping: merge states that cannot be told apart, without changing any answer.

A partition of the states is lumpable if all states in a block move to each other block with the
same chance. Then the blocks form a Markov chain too, regardless of the start. The coarsest lumpable
partition that keeps given states apart is found by refinement: a block whose states have different
chances of moving to another block is split accordingly, until no block is left to split. As long as
blocks split, only arcs into new pieces are looked at; the last look is at all arcs.

References: Kemeny and Snell 1960, Finite Markov Chains, section 6.3; Valmari and Franceschinis
2010, "Simple O(m log n) time Markov chain lumping".
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from scipy.sparse import csc_array, csr_array

from evenbreak.chains.arcs import Places, summed
from evenbreak.chains.chain import Chain, by_label, check_chain, check_present
from evenbreak.chains.exact import exact_chance
from evenbreak.errors import ChainError

Labels: TypeAlias = Callable[[Any], Hashable] | Mapping[Any, Hashable]
"""The label of each state: a function of the state, or a mapping or Series from the states."""

_ROUNDING = 1e-12
"""Relative tolerance within which chances count as equal."""


def lumped(chain: Chain, by: Labels) -> Chain:
    """Return the chain of labels: states with the same label become one.

    All answers stay exact: a label has the total probability of its states.

    Parameters
    ----------
    chain
        a chain; the new start is the label of its start.
    by
        the label of each state, as a function or a mapping. Chances count as equal if they differ
        only by rounding, no more than 1e-12 of themselves.

    Raises
    ------
    ChainError
        if two states with the same label move to another label with different chances; the
        message names them.

    >>> from evenbreak.chains import chain_of
    >>> tables = chain_of([("AB", "A", 0.25), ("AB", "B", 0.25), ("AB", "AB", 0.5),
    ...                    ("A", "none", 0.5), ("B", "none", 0.5), ("A", "A", 0.5),
    ...                    ("B", "B", 0.5)], start="AB")
    >>> lumped(tables, lambda busy: 0 if busy == "none" else len(busy)).to_frame()
    from    2    1    0
    to
    2     0.5  0.0  0.0
    1     0.5  0.5  0.0
    0     0.0  0.5  1.0
    """
    check_chain(chain)
    names, block = _labeled(chain, by)
    into, count = chain.arcs.matrix().tocsr(), len(names)
    leaving = _leaving(block, np.bincount(block).tolist(), into, np.arange(len(chain)))
    if leaving:
        raise _not_lumpable(chain, names, block, leaving[0])
    first = np.unique(block, return_index=True)[1]
    column = chain.matrix[:, first].tocoo()
    matrix = csc_array(summed(block[column.row], column.col, column.data, (count, count)))
    matrix.data = np.minimum(matrix.data, 1.0)
    exact: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for i, b, p in zip(column.row.tolist(), column.col.tolist(), column.data.tolist(), strict=True):
        if block[i] != b:
            exact[b, int(block[i])] += chain.given.get((int(first[b]), i)) or exact_chance(p)
    start = None if chain.start is None else names[block[chain.index(chain.start)]]
    return Chain(names, matrix, start, exact)


def coarsest_lumping(chain: Chain, by: Labels) -> dict[Hashable, Hashable]:
    """Return the smallest set of labels that can lump the chain, keeping some states apart.

    Parameters
    ----------
    by
        the label of each state, as in `lumped`. States with different labels are kept apart,
        such as those in which different players have won.

    Returns
    -------
    dict
        for each state, the first of the states lumped with it.

    >>> from evenbreak.chains import chain_of
    >>> from evenbreak.games import Race, Rack
    >>> race = Race(2, 2, Rack(0.6))
    >>> chain = chain_of(race)
    >>> by = coarsest_lumping(chain, race.winner)
    >>> by[2, 0], by[2, 1]
    ((2, 0), (2, 0))
    >>> len(chain), len(lumped(chain, by))
    (8, 6)
    """
    check_chain(chain)
    block = _labeled(chain, by)[1]
    into = chain.arcs.matrix().tocsr()
    sizes, changed = np.bincount(block).tolist(), np.arange(len(chain))
    while True:
        new: list[int] = []
        for piece in _leaving(block, sizes, into, changed):
            sizes[block[piece[0]]] -= len(piece)
            block[piece] = len(sizes)
            sizes.append(len(piece))
            new += piece
        if not new and len(changed) == len(chain):
            break
        changed = np.array(new) if new else np.arange(len(chain))
    first = np.unique(block, return_index=True)[1]
    return {
        state: chain.states[i] for state, i in zip(chain.states, first[block].tolist(), strict=True)
    }


def _labeled(chain: Chain, by: Any) -> tuple[list[Hashable], Places]:
    """Return the labels, in the order of their first states, and the label number of each state."""
    by = by_label(by, "by")
    if isinstance(by, Mapping):
        missing = [state for state in chain.states if state not in by]
        if missing:
            raise ChainError(f"by has no label for state {missing[0]!r}. Give every state a label.")
        by = by.__getitem__
    if not callable(by):
        raise ChainError(
            f"by must be a function that takes a state, or a mapping; you gave {by!r:.60}"
        )
    numbers: dict[Hashable, int] = {}
    block = []
    for state in chain.states:
        label = by(state)
        try:
            block.append(numbers.setdefault(label, len(numbers)))
        except TypeError:  # it cannot be hashed
            raise ChainError(
                f"the label of state {state!r} must be a name, a number or a tuple; you "
                f"gave {label!r}"
            ) from None
    check_present(numbers)
    return list(numbers), np.array(block)


def _leaving(block: Places, sizes: list[int], into: csr_array, targets: Places) -> list[list[int]]:
    """Return the states that must leave their block, piece by piece.

    The arcs are those into some targets, which make up whole blocks: the states of a piece have
    the same chance into each of these. The states without such arcs stay in their block; if there
    are none, the largest piece stays.
    """
    arcs = into[targets].tocoo()
    sources, entered = arcs.col, block[targets[arcs.row]]
    outside = block[sources] != entered
    flows = summed(sources[outside], entered[outside], arcs.data[outside], into.shape).tocoo()
    states, others, chances = flows.row, flows.col, flows.data
    # Equal chances from one block into another are of one kind.
    order = np.lexsort((chances, others, block[states]))
    own, to, rising = block[states][order], others[order], chances[order]
    differ = (np.diff(own) != 0) | (np.diff(to) != 0)
    differ |= rising[1:] > rising[:-1] * (1.0 + _ROUNDING)
    kinds = np.zeros(len(chances), dtype=np.int64)
    kinds[order[1:]] = np.cumsum(differ)
    marks = np.flatnonzero(np.diff(states, prepend=-1))
    alike: dict[int, dict[bytes, list[int]]] = defaultdict(lambda: defaultdict(list))
    for state, each in zip(states[marks].tolist(), np.split(kinds, marks)[1:], strict=True):
        alike[block[state]][each.tobytes()].append(state)
    leaving: list[list[int]] = []
    for number, pieces in alike.items():
        parts = sorted(pieces.values(), key=len)
        leaving += parts if sum(map(len, parts)) < sizes[number] else parts[:-1]
    return leaving


def _not_lumpable(
    chain: Chain, names: list[Hashable], block: Places, piece: list[int]
) -> ChainError:
    """Return the error that names a state in the piece, another in its block, and what differs."""
    mine = block[piece[0]]
    others = block == mine
    others[piece] = False
    pair = [piece[0], int(others.argmax())]
    to = np.array([np.bincount(block, column) for column in chain.matrix[:, pair].toarray().T])
    differ = np.abs(to[0] - to[1]) / np.maximum(to.max(axis=0), np.finfo(float).tiny)
    differ[mine] = 0.0
    b = int(differ.argmax())
    first, second = (chain.states[i] for i in pair)
    return ChainError(
        f"states {first!r} and {second!r} have the same label {names[mine]!r}, but move to "
        f"{names[b]!r} with different chances, {to[0, b]:.12g} and {to[1, b]:.12g}. Give them "
        "different labels, or let coarsest_lumping find the labels."
    )
