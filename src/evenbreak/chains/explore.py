"""Convert games, graphs and lists of arcs to chains: which ones are valid, and what is filled in.

The rules of a chain:

- the listed arcs of a state, its self-loop included, sum to 1 within 1e-9;
- each probability is a number in [0, 1], and no arc is listed twice;
- an arc of probability zero counts as listed and makes no arc;
- a listed self-loop (unless zero) becomes the remainder of the other arcs. If none is listed, none
  is added: three float arcs often miss 1 by one rounding error, and a self-loop of 1e-16 would turn
  a period of 2 into 1;
- a state without listed arcs absorbs.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import chain as chained
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csc_array, sparray, spmatrix

from evenbreak.arrays import Floats, Ints
from evenbreak.chains.chain import Chain, check_present
from evenbreak.chains.matrices import Rows, is_matrix, read_matrix
from evenbreak.errors import ChainError
from evenbreak.game import ArcArrays, Game, arcs_of

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    Source: TypeAlias = (
        Game
        | nx.DiGraph[Any]
        | NDArray[Any]
        | sparray
        | spmatrix
        | pd.DataFrame
        | Mapping[Any, Mapping[Any, float]]
        | Sequence[Sequence[float]]
        | Iterable[tuple[Any, Any, float]]
    )


def chain_of(
    source: Source,
    *,
    start: Hashable | None = None,
    rows: Rows | None = None,
    weight: str | None = None,
) -> Chain:
    """Return the chain of a game, a directed graph, a matrix, or arcs.

    Parameters
    ----------
    source
        one of

        - a game (see `evenbreak.game`);
        - a `networkx.DiGraph` with the probabilities on its arcs;
        - a square numpy array, scipy sparse matrix or list of lists, whose states are 0, 1,
          2, ..., or a pandas DataFrame with the states as its index and its columns;
        - a dict that has, for each state, a dict from the next states to their probabilities;
        - (source, target, probability) triples.

        A probability is always that of the target, given the source. In dicts, triples and graphs,
        it may be a `Fraction` or a string such as "0.6" or "3/5"; `exact=True` then calculates with
        exactly that value.
    start
        the starting state. If None: the start of the game, or the graph's node of `kind` 'start' if
        it has one; other sources have no start of their own.
    rows
        how to read a matrix. 'from': a row holds the chances out of its state. 'to': a row
        holds the chances into its state, as in `Chain`. It may be omitted if the matrix is
        stochastic in only one direction, or symmetric.
    weight
        the attribute of a graph's arcs that holds their probability. None: 'probability', or
        networkx's own 'weight' if no arc has a probability. Other weights, such as lengths or
        counts, do not sum to 1 and raise an error.

    Raises
    ------
    ChainError
        if the arcs break the rules of this module, a matrix can be read two ways, or the
        start is unknown.
    GameError
        if the game has too many states or its moves are not probabilities.

    >>> chain = chain_of([("rain", "rain", 0.7), ("rain", "sun", 0.3), ("sun", "rain", 1)])
    >>> chain.states
    ['rain', 'sun']
    >>> chain.matrix.toarray()
    array([[0.7, 1. ],
           [0.3, 0. ]])
    >>> chain_of({"rain": {"rain": 0.7, "sun": 0.3}, "sun": {"rain": 1}}).states
    ['rain', 'sun']
    >>> chain_of(np.array([[0.7, 0.3], [1.0, 0.0]]), rows="from").matrix.toarray()
    array([[0.7, 1. ],
           [0.3, 0. ]])
    """
    if is_matrix(source):
        _only_for(weight, "weight", "a graph")
        return Chain(*read_matrix(source, rows), start)
    _only_for(rows, "rows", "a matrix")
    if hasattr(source, "adjacency"):
        return _chain_of_graph(source, weight, start)
    _only_for(weight, "weight", "a graph")
    if isinstance(source, Game):
        arcs = arcs_of(source, start=start)
        return chain_from_arrays(*arcs, start=source.start if start is None else start)
    if isinstance(source, Mapping):
        return chain_from_arrays(*_arcs_of_mapping(source), start=start)
    if not isinstance(source, Iterable):
        raise ChainError(
            "the source must be a game, a networkx.DiGraph, a matrix, a dict of dicts, "
            f"or a list of (source, target, probability); you gave {source!r}"
        )
    return chain_from_arrays(*_arcs_of_triples(source), start=start)


def _only_for(value: object, name: str, kind: str) -> None:
    if value is not None:
        raise ChainError(f"{name} is {value!r}, but the source isn't {kind}. Leave out {name}.")


def chain_from_arrays(
    states: Sequence[Hashable],
    sources: ArrayLike,
    targets: ArrayLike,
    probabilities: ArrayLike,
    start: Hashable | None = None,
) -> Chain:
    """Return a chain from arcs given as arrays.

    Parameters
    ----------
    states
        n distinct states.
    sources, targets
        positions in `states`, one for each arc, in any order.
    probabilities
        the probability of each arc's target, given its source; numbers, fractions, or strings such
        as "0.6" or "3/5".
    start
        the starting state, or None.

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
    chances, fractions = _fractions(probabilities)
    j, i, p = _checked_arrays(states, sources, targets, chances)
    exact = {(int(j[k]), int(i[k])): fraction for k, fraction in fractions.items()}
    n = len(states)
    absorbing = np.flatnonzero(np.bincount(j, minlength=n) == 0)
    ends = np.concatenate((i, absorbing)), np.concatenate((j, absorbing))
    # The conversion sorts the arcs in linear time and adds duplicates up.
    matrix = csc_array((np.concatenate((p, np.ones(len(absorbing)))), ends), shape=(n, n))
    if matrix.nnz < len(ends[0]):
        raise _listed_twice(states, j * n + i)
    matrix.eliminate_zeros()
    return Chain(states, matrix, start, exact)


def _fractions(probabilities: ArrayLike) -> tuple[NDArray[Any], dict[int, Fraction]]:
    """Return the probabilities as numbers, and those given as fractions or strings."""
    entered = np.asarray(probabilities)
    if entered.dtype.kind not in "OU":
        return entered, {}
    values = [_number(value) for value in entered.ravel().tolist()]
    fractions = {k: value for k, value in enumerate(values) if isinstance(value, Fraction)}
    numbers = np.array([float(value) for value in values]).reshape(entered.shape)
    for k, fraction in fractions.items():
        if fraction and not numbers.flat[k]:
            raise ChainError(
                f"the probability {fraction} is too small for a float. Leave out its arc."
            )
    return numbers, fractions


def _listed_twice(states: Sequence[Hashable], key: Ints) -> ChainError:
    ordered = np.sort(key)
    j, i = divmod(int(ordered[:-1][ordered[1:] == ordered[:-1]][0]), len(states))
    return ChainError(
        f"the arc {states[j]!r} -> {states[i]!r} is listed more than once. Give one arc with the "
        "total probability."
    )


def _checked_arrays(
    states: Sequence[Hashable], sources: ArrayLike, targets: ArrayLike, probabilities: ArrayLike
) -> tuple[Ints, Ints, Floats]:
    j, i = (_positions(ends) for ends in (sources, targets))
    p = np.asarray(probabilities, dtype=np.float64)
    n = len(states)
    if n == 0:
        raise ChainError("there must be at least one state")
    if not j.ndim == 1 or not j.shape == i.shape == p.shape:
        raise ChainError(
            f"sources, targets and probabilities have shapes {j.shape}, {i.shape} and {p.shape}. "
            "Give one of each for every arc."
        )
    if j.size and (min(j.min(), i.min()) < 0 or max(j.max(), i.max()) >= n):
        raise ChainError(
            f"every arc must lead from and to positions from 0 to {n - 1}; one doesn't"
        )
    wrong = np.flatnonzero(~((p >= 0.0) & (p <= 1.0)))
    if wrong.size:
        k = wrong[0]
        raise ChainError(
            f"the arc {states[j[k]]!r} -> {states[i[k]]!r} has probability "
            f"{float(p[k])!r}. Give a number from 0 to 1."
        )
    return j, i, p


def _positions(entered: ArrayLike) -> Ints:
    positions = np.asarray(entered)
    if positions.size and positions.dtype.kind not in "iu":
        raise ChainError(
            f"sources and targets must be positions in `states`; their type is {positions.dtype}"
        )
    return positions.astype(np.int64, copy=False)


def _chain_of_graph(graph: Any, weight: str | None, start: Hashable | None) -> Chain:
    if not graph.is_directed() or graph.is_multigraph():
        raise ChainError(
            f"the graph is a {type(graph).__name__}. Give a networkx.DiGraph, with at most one "
            "arc from each source to each target."
        )
    position = {state: k for k, state in enumerate(graph)}
    rows = [row for _, row in graph.adjacency()]
    arcs = [arc for row in rows for arc in row.values()]
    name = weight or "probability"
    if weight is None and any("weight" in arc for arc in arcs):
        name = "probability" if any("probability" in arc for arc in arcs) else "weight"
    try:
        chances = np.array([_number(arc[name]) for arc in arcs])
    except (KeyError, TypeError, ValueError, ZeroDivisionError):
        raise _without_probability(graph, name) from None
    starts = [state for state, kind in graph.nodes(data="kind") if kind == "start"]
    if len(starts) > 1:
        raise ChainError(f"the graph has {len(starts)} nodes with kind='start'. Leave only one.")
    counts = np.fromiter(map(len, rows), dtype=np.int64, count=len(rows))
    ends = map(position.__getitem__, chained.from_iterable(rows))
    targets = np.fromiter(ends, dtype=np.int64, count=len(arcs))
    sources = np.repeat(np.arange(len(rows)), counts)
    begin = start if start is not None or not starts else starts[0]
    try:
        return chain_from_arrays(list(position), sources, targets, chances, start=begin)
    except ChainError as error:
        if weight is None and name == "weight":
            raise ChainError(
                f"the arcs have no probability, only a weight, and {error} Name the attribute "
                "that holds the probability, as in weight='p', or scale the weights with "
                "networkx.stochastic_graph."
            ) from None
        raise


def _without_probability(graph: Any, name: str) -> ChainError:
    """Return what is wrong with the first arc that has no number with this name."""
    for source, target, arc in graph.edges(data=True):
        where, remedy = f"the arc {source!r} -> {target!r}", "Give each arc a number from 0 to 1."
        if name not in arc:
            other = ""
            if arc:
                other = f"{', '.join(map(repr, arc))} but "
                remedy = f"Name the attribute that holds it, as in weight={next(iter(arc))!r}."
            return ChainError(f"{where} has {other}no {name}. {remedy}")
        try:
            _number(arc[name])
        except (TypeError, ValueError, ZeroDivisionError):
            break
    return ChainError(f"{where} has {name} {arc[name]!r}. {remedy}")


def _arcs_of_mapping(moves: Mapping[Any, Any]) -> ArcArrays:
    """Return the arcs of a dict of dicts; states are in the order of its keys, then targets."""
    for state, row in moves.items():
        if not isinstance(row, Mapping):
            raise ChainError(
                f"the moves from {state!r} must be a dict from states to probabilities; "
                f"you gave {row!r}"
            )
    triples = ((j, i, chance) for j, row in moves.items() for i, chance in row.items())
    return _arcs_of_triples(triples, moves)


def _arcs_of_triples(triples: Iterable[Any], states: Iterable[Any] = ()) -> ArcArrays:
    """Return the arcs of triples; states are in the order given, then in order of appearance."""
    position: dict[Any, int] = {state: k for k, state in enumerate(states)}
    sources: list[int] = []
    targets: list[int] = []
    chances: list[Any] = []
    for k, triple in enumerate(triples, 1):
        try:
            source, target, chance = triple
            chances.append(_number(chance))
            sources.append(position.setdefault(source, len(position)))
            targets.append(position.setdefault(target, len(position)))
        except (TypeError, ValueError, ZeroDivisionError):
            raise ChainError(
                f"arc {k} must be (source, target, probability), two hashable states and a "
                f"number; you gave {triple!r}"
            ) from None
    check_present(position)
    return ArcArrays(
        list(position),
        np.array(sources, dtype=np.int64),
        np.array(targets, dtype=np.int64),
        np.array(chances),
    )


def _number(chance: Any) -> float | Fraction:
    """Return a chance as a float, or as a fraction if it is a fraction or a string.

    >>> _number(1), _number("0.6")
    (1.0, Fraction(3, 5))
    """
    return Fraction(chance) if isinstance(chance, (Fraction, str)) else float(chance)
