"""Lumping: one state for many that cannot be told apart, without changing any answer.

A partition of the states is lumpable if all states of a block move to each other block with the
same chance. Then the block that the chain is in makes a Markov chain too, whatever the start. The
coarsest lumpable partition that keeps given states apart is found by refinement: a block whose
states differ in their chances into another block is split by them, until none is. As long as
blocks split, only arcs into new pieces are looked at; the last look is at all arcs.

References: Kemeny and Snell 1960, Finite Markov Chains, section 6.3; Valmari and Franceschinis
2010, "Simple O(m log n) time Markov chain lumping".
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.sparse import csc_array

from evenbreak.chains.arcs import sums
from evenbreak.chains.chain import Chain, by_label, check_chain, check_present
from evenbreak.chains.exact import exact_chance
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places

_ROUNDING = 1e-12
"""Chances count as equal if they differ by no more than this, relatively."""


class _Flows(NamedTuple):
    """The chance from each state into each other block that its arcs lead to, by state.

    States of one block have the same `kind` of flow into another block if the chances are equal.
    """

    states: Places
    blocks: Places
    chances: NDArray[np.float64]
    kinds: Places


def lumped(chain: Chain, by: Callable[[Any], Hashable] | Mapping[Any, Hashable]) -> Chain:
    """Return the chain of the labels of its states: states with the same label become one.

    All answers stay exact: a label has the probability of all its states together.

    Parameters
    ----------
    chain
        the chain; its start becomes the label of the start.
    by
        the label of each state, as a function or a mapping. Chances count as equal if they
        differ by rounding only, no more than 1e-12 of themselves.

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
    names, block = _labelled(chain, by)
    arcs = chain.arcs
    _check(chain, names, block, _flows(block, arcs.sources, arcs.targets, arcs.chances))
    count = len(names)
    first = np.unique(block, return_index=True)[1]
    column = chain.matrix[:, first].tocoo()
    pairs, place = np.unique(column.col * count + block[column.row], return_inverse=True)
    source, target = np.divmod(pairs, count)
    chances = np.minimum(sums(place, column.data, len(pairs)), 1.0)
    matrix = csc_array((chances, (target, source)), shape=(count, count))
    given: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for i, b, p in zip(column.row.tolist(), column.col.tolist(), column.data.tolist(), strict=True):
        if block[i] != b:
            given[b, int(block[i])] += chain.given.get((int(first[b]), i)) or exact_chance(p)
    start = None if chain.start is None else names[block[chain.index(chain.start)]]
    return Chain(names, matrix, start, given)


def coarsest_lumping(
    chain: Chain, by: Callable[[Any], Hashable] | Mapping[Any, Hashable]
) -> dict[Hashable, Hashable]:
    """Return the fewest labels by which the chain can be lumped, keeping some states apart.

    Parameters
    ----------
    chain
        the chain.
    by
        the label of each state, as in `lumped`. States with different labels are kept apart,
        such as those in which different players have won.

    Returns
    -------
    dict
        for each state the first of those that are lumped with it.

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
    block = _labelled(chain, by)[1]
    into = chain.arcs.matrix().tocsr()
    sizes, changed = np.bincount(block).tolist(), np.arange(len(chain))
    while True:
        some = into[changed].tocoo()
        flows = _flows(block, some.col, changed[some.row], some.data)
        new: list[int] = []
        for piece in _split(block, sizes, flows):
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


def _labelled(chain: Chain, by: Any) -> tuple[list[Hashable], Places]:
    """Return the labels, in the order of their first states, and the number of each state's."""
    by = by_label(by, "by")
    if isinstance(by, Mapping):
        missing = [state for state in chain.states if state not in by]
        if missing:
            raise ChainError(f"by has no label for state {missing[0]!r}; give each state one")
        by = by.__getitem__
    if not callable(by):
        raise ChainError(f"by is {by!r:.60}; give a function of a state, or a mapping")
    numbers: dict[Hashable, int] = {}
    block = [numbers.setdefault(by(state), len(numbers)) for state in chain.states]
    check_present(numbers)
    return list(numbers), np.array(block)


def _flows(block: Places, sources: Places, targets: Places, chances: NDArray[np.float64]) -> _Flows:
    """Return the flows of some arcs, which must be all those into the blocks they lead to."""
    outside = block[sources] != block[targets]
    j, b = sources[outside].astype(np.int64), block[targets[outside]]
    pairs, place = np.unique(j * len(block) + b, return_inverse=True)
    states, blocks = np.divmod(pairs, len(block))
    total = sums(place, chances[outside], len(pairs))
    order = np.lexsort((total, blocks, block[states]))
    own, to, sorted_total = block[states][order], blocks[order], total[order]
    differ = (np.diff(own) != 0) | (np.diff(to) != 0)
    differ |= sorted_total[1:] > sorted_total[:-1] * (1.0 + _ROUNDING)
    kinds = np.zeros(len(pairs), dtype=np.int64)
    kinds[order[1:]] = np.cumsum(differ)
    return _Flows(states, blocks, total, kinds)


def _split(block: Places, sizes: list[int], flows: _Flows) -> list[list[int]]:
    """Return the states that must leave their block, piece by piece, by their flows.

    Of each block stay the states without flows, or the largest piece if there are none.
    """
    marks = np.flatnonzero(np.diff(flows.states, prepend=-1))
    states = flows.states[marks]
    alike: dict[tuple[int, ...], list[int]] = defaultdict(list)
    for state, kinds in zip(states.tolist(), np.split(flows.kinds, marks)[1:], strict=True):
        alike[block[state], *kinds.tolist()].append(state)
    pieces: dict[int, list[list[int]]] = defaultdict(list)
    for key, piece in alike.items():
        pieces[key[0]].append(piece)
    leaving: list[list[int]] = []
    for number, parts in pieces.items():
        idle = sizes[number] - sum(map(len, parts))
        leaving += parts if idle else sorted(parts, key=len)[:-1]
    return leaving


def _check(chain: Chain, names: list[Hashable], block: Places, flows: _Flows) -> None:
    """Refuse labels that are not lumpable, naming two states and what tells them apart."""
    leaving = _split(block, np.bincount(block).tolist(), flows)
    if not leaving:
        return
    one, own = leaving[0][0], block == block[leaving[0][0]]
    own[leaving[0]] = False
    other = int(own.argmax())
    chance, kind = np.zeros((2, 2, len(names)))
    for row, state in enumerate((one, other)):
        at = np.flatnonzero(flows.states == state)
        chance[row, flows.blocks[at]] = flows.chances[at]
        kind[row, flows.blocks[at]] = flows.kinds[at] + 1
    b = int((kind[0] != kind[1]).argmax())
    raise ChainError(
        f"states {chain.states[one]!r} and {chain.states[other]!r} have the same label "
        f"{names[block[one]]!r}, but move to {names[b]!r} with the chances {chance[0, b]:.12g} and "
        f"{chance[1, b]:.12g}; give them different labels, or let coarsest_lumping find the labels"
    )
