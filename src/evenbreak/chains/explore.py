"""From games, graphs and lists of arcs to chains: what is refused, and what is completed.

The rules of a chain:

- the listed arcs of a state, its self-loop included, sum to 1 within 1e-9;
- each probability is a number in [0, 1], and no arc is listed twice;
- an arc of probability zero counts as listed and makes no arc;
- a listed self-loop (unless zero) becomes whatever the other arcs leave over. If none is
  listed, none is added: three float arcs often miss 1 by one rounding error, and a self-loop
  of 1e-16 would turn a period of 2 into 1;
- a state without listed arcs absorbs.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from itertools import chain as chained
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import coo_array, csc_array

from evenbreak.chains.chain import Chain, check_sums
from evenbreak.errors import ChainError
from evenbreak.game import ArcArrays, Game, arcs_of

if TYPE_CHECKING:
    import networkx as nx
    from numpy.typing import ArrayLike, NDArray


def chain_of(
    source: Game | nx.DiGraph[Any] | Iterable[tuple[Any, Any, float]],
    *,
    start: Hashable | None = None,
) -> Chain:
    """Return the chain of a game, of a directed graph, or of a list of arcs.

    Parameters
    ----------
    source
        a game (see `evenbreak.game`); a `networkx.DiGraph` with `probability` on its
        arcs; or (source, target, probability) triples. A probability is that of the
        target, given the source.
    start
        the state in which to begin. If None: the start of the game, or the graph's node of
        `kind` 'start' if it has one; a list of arcs has no start of its own.

    Raises
    ------
    ChainError
        if the arcs break the rules of this module, or the start is unknown.
    GameError
        if the game has too many states or its moves are not probabilities.

    >>> chain = chain_of([("rain", "rain", 0.7), ("rain", "sun", 0.3), ("sun", "rain", 1)])
    >>> chain.states
    ['rain', 'sun']
    >>> chain.matrix.toarray()
    array([[0.7, 1. ],
           [0.3, 0. ]])
    """
    if isinstance(source, Game):
        arcs = arcs_of(source, start=start)
        return chain_from_arrays(*arcs, start=source.start if start is None else start)
    if hasattr(source, "adjacency"):
        arcs, own_start = _arcs_of_graph(source)
        return chain_from_arrays(*arcs, start=own_start if start is None else start)
    if not isinstance(source, Iterable):
        raise ChainError(
            f"the source is {source!r}; give a game, a networkx.DiGraph, or a list of "
            "(source, target, probability)"
        )
    return chain_from_arrays(*_arcs_of_triples(source), start=start)


def chain_from_arrays(
    states: Sequence[Hashable],
    sources: ArrayLike,
    targets: ArrayLike,
    probabilities: ArrayLike,
    start: Hashable | None = None,
) -> Chain:
    """Return the chain of arcs given as arrays.

    Parameters
    ----------
    states
        the n states, distinct.
    sources, targets
        positions in `states`, one for each arc, in any order.
    probabilities
        the probability of each arc's target, given its source.
    start
        the state in which to begin, or None.

    Raises
    ------
    ChainError
        if the arcs break the rules of this module; the message names the state and says how
        to correct it.

    >>> chain_from_arrays("AB", [0, 0], [0, 1], [0.25, 0.75], start="A").matrix.toarray()
    array([[0.25, 0.  ],
           [0.75, 1.  ]])
    """
    states = tuple(states) if isinstance(states, str) else states
    j, i, p = _checked_arrays(states, sources, targets, probabilities)
    if start is not None and start not in states:
        raise ChainError(f"start is {start!r}, which is not a state of the chain")
    n = len(states)
    key = j * n + i
    if not (key[1:] > key[:-1]).all():
        # A sparse table of the arcs' numbers sorts them in linear time and adds duplicates up.
        table = coo_array((np.arange(len(j)), (i, j)), shape=(n, n)).tocsc()
        if table.nnz < len(j):
            raise _listed_twice(states, key)
        j, i, p = j[table.data], i[table.data], p[table.data]
    listed = np.bincount(j, minlength=n)
    check_sums(states, np.where(listed > 0, np.bincount(j, weights=p, minlength=n), 1.0))
    loops = (i == j) & (p > 0.0)
    if loops.any():
        others = np.bincount(j, weights=np.where(loops, 0.0, p), minlength=n)
        p = np.where(loops, np.maximum(1.0 - others[j], 0.0), p)
    made = p > 0.0
    if not made.all():
        j, i, p = j[made], i[made], p[made]
    return Chain(states, _column_stochastic(n, j, i, p, absorbing=listed == 0), start)


def _listed_twice(states: Sequence[Hashable], key: NDArray[np.int64]) -> ChainError:
    ordered = np.sort(key)
    j, i = divmod(int(ordered[:-1][ordered[1:] == ordered[:-1]][0]), len(states))
    return ChainError(
        f"the arc {states[j]!r} -> {states[i]!r} is listed more than once; "
        "give one arc with the whole probability"
    )


def _checked_arrays(
    states: Sequence[Hashable], sources: ArrayLike, targets: ArrayLike, probabilities: ArrayLike
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    j, i = (_positions(given) for given in (sources, targets))
    p = np.asarray(probabilities, dtype=np.float64)
    n = len(states)
    if n == 0:
        raise ChainError("there are no states; give at least one")
    # Lazy sequences of states are distinct by construction.
    if isinstance(states, (list, tuple)) and len(set(states)) < n:
        raise ChainError("a state is listed twice among the states; give each of them once")
    if not j.ndim == 1 or not j.shape == i.shape == p.shape:
        raise ChainError(
            f"sources, targets and probabilities have shapes {j.shape}, {i.shape}, {p.shape}; "
            "give one entry of each for every arc"
        )
    if j.size and (min(j.min(), i.min()) < 0 or max(j.max(), i.max()) >= n):
        raise ChainError(f"an arc leads from or to a position outside 0 to {n - 1}")
    wrong = np.flatnonzero(~((p >= 0.0) & (p <= 1.0)))
    if wrong.size:
        k = wrong[0]
        raise ChainError(
            f"the arc {states[j[k]]!r} -> {states[i[k]]!r} has probability {float(p[k])!r}; "
            "give a number from 0 to 1"
        )
    return j, i, p


def _positions(given: ArrayLike) -> NDArray[np.int64]:
    positions = np.asarray(given)
    if positions.size and positions.dtype.kind not in "iu":
        raise ChainError(
            f"sources and targets have type {positions.dtype}; give positions in `states`"
        )
    return positions.astype(np.int64, copy=False)


def _column_stochastic(
    n: int,
    j: NDArray[np.int64],
    i: NDArray[np.int64],
    p: NDArray[np.float64],
    absorbing: NDArray[np.bool_],
) -> csc_array:
    """Build M from arcs sorted by source, then target, with a self-loop on absorbing states.

    The columns are written where they belong; a conversion from triples would sort and
    add up what is sorted and distinct already.
    """
    indptr = np.zeros(n + 1, dtype=np.int64)
    np.cumsum(np.bincount(j, minlength=n) + absorbing, out=indptr[1:])
    index_type: Any = np.int32 if max(n, int(indptr[-1])) < 2**31 else np.int64
    indices = np.empty(int(indptr[-1]), dtype=index_type)
    data = np.empty(int(indptr[-1]), dtype=np.float64)
    own = np.repeat(absorbing, np.diff(indptr))
    indices[own] = np.flatnonzero(absorbing)
    data[own] = 1.0
    indices[~own] = i
    data[~own] = p
    matrix = csc_array((data, indices, indptr.astype(index_type)), shape=(n, n))
    matrix.has_canonical_format = True
    return matrix


def _arcs_of_graph(graph: Any) -> tuple[ArcArrays, Hashable | None]:
    if not graph.is_directed() or graph.is_multigraph():
        raise ChainError(
            f"the graph is a {type(graph).__name__}; give a networkx.DiGraph, "
            "one arc from each source to each target"
        )
    position = {state: k for k, state in enumerate(graph)}
    rows = [row for _, row in graph.adjacency()]
    counts = np.fromiter(map(len, rows), dtype=np.int64, count=len(rows))
    total = int(counts.sum())
    targets = np.fromiter(
        map(position.__getitem__, chained.from_iterable(rows)), dtype=np.int64, count=total
    )
    try:
        chances = np.fromiter(
            (arc["probability"] for row in rows for arc in row.values()), np.float64, count=total
        )
    except (KeyError, TypeError, ValueError):
        raise _without_probability(graph) from None
    starts = [state for state, kind in graph.nodes(data="kind") if kind == "start"]
    if len(starts) > 1:
        raise ChainError(f"the graph has {len(starts)} nodes of kind 'start'; leave one")
    arcs = ArcArrays(list(position), np.repeat(np.arange(len(rows)), counts), targets, chances)
    return arcs, starts[0] if starts else None


def _without_probability(graph: Any) -> ChainError:
    for source, target, chance in graph.edges(data="probability"):
        try:
            float(chance)
        except (TypeError, ValueError):
            return ChainError(
                f"the arc {source!r} -> {target!r} has probability {chance!r}; "
                "give each arc a number from 0 to 1"
            )
    return ChainError("the arcs carry no probability; give each arc a number from 0 to 1")


def _arcs_of_triples(triples: Iterable[Any]) -> ArcArrays:
    position: dict[Any, int] = {}
    sources: list[int] = []
    targets: list[int] = []
    chances: list[float] = []
    for k, triple in enumerate(triples, 1):
        try:
            source, target, chance = triple
            chances.append(float(chance))
            sources.append(position.setdefault(source, len(position)))
            targets.append(position.setdefault(target, len(position)))
        except (TypeError, ValueError):
            raise ChainError(
                f"arc {k} is {triple!r}; give (source, target, probability), "
                "states that can be hashed and a number"
            ) from None
    return ArcArrays(
        list(position),
        np.array(sources, dtype=np.int64),
        np.array(targets, dtype=np.int64),
        np.array(chances),
    )
