"""The road from a game to its limit: DiGraph, sparse matrix, eigenpairs, limit by every way."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.chain import Chain
from evenbreak.chains.explore import chain_of
from evenbreak.chains.limits import Limit, stochastic_limit
from evenbreak.chains.mixing import apparent_period, spectral_gap
from evenbreak.chains.spectrum import Spectrum, spectrum
from evenbreak.chains.ways import WAYS
from evenbreak.errors import AccuracyError, ChainError, GameError
from evenbreak.game import Game, graph_of

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True, eq=False)
class Road:
    """What a game's road from its graph to its limit passes.

    Parameters
    ----------
    graph
        the game as a directed graph; its states are texts, and the chances out of each add up to
        1 to the last digit.
    chain
        the sparse transition matrix of the graph.
    limits
        the stochastic limit by each way that can find it; by elimination always.
    spectrum
        all eigenpairs, or for a large chain the leading ones. If the matrix has too few
        eigenvectors, only those of eigenvalue 1; None where these are not certain either.
    gap
        see `spectral_gap`; None if it is not certain.
    period
        see `apparent_period`; that of the limit if it is not certain.
    refused
        why there is no answer, by what there is none of: a way, 'spectrum', 'gap'.
    """

    graph: nx.DiGraph[str]
    chain: Chain
    limits: Mapping[str, Limit]
    spectrum: Spectrum | None
    gap: float | None
    period: int
    refused: Mapping[str, str]

    @property
    def limit(self) -> Limit:
        """The limit by elimination, which loses no digits."""
        return self.limits["elimination"]

    @property
    def differences(self) -> dict[str, float]:
        """The largest difference of each other way's limit from the one by elimination."""
        exact = self.limit.probability
        return {
            way: float(np.abs(limit.probability - exact).max())
            for way, limit in self.limits.items()
            if way != "elimination"
        }


def road_of(game: Game | nx.DiGraph[Any], *, start: str | None = None) -> Road:
    """Return the road of a game.

    Parameters
    ----------
    game
        the game, or the graph of one as `graph_of` returns it.
    start
        the state in which to begin, if it is not that of the game or graph.

    Raises
    ------
    GameError
        if two states are written alike.

    >>> from evenbreak.games import OneBall
    >>> road = road_of(OneBall(0.4, 0.8))
    >>> road.graph, road.chain
    (<networkx.classes.digraph.DiGraph object at ...>, <Chain of 4 states, 6 arcs, start 'S1'>)
    >>> road.spectrum.values.round(4), round(road.limits["eigen"]["W"], 12)
    (array([ 1.    ,  1.    ,  0.3464, -0.3464]), 0.454545454545)
    >>> list(road.refused)
    []
    """
    graph = _adding_up(_named(graph_of(game) if isinstance(game, Game) else game))
    chain = chain_of(graph, start=start)
    limits: dict[str, Limit] = {}
    refused: dict[str, str] = {}

    def attempt(what: str, function: Any, *args: Any, **options: Any) -> Any:
        try:
            return function(*args, **options)
        except (AccuracyError, ChainError) as error:
            refused[what] = str(error)
            return None

    for way in WAYS:
        found = attempt(way, stochastic_limit, chain, via=way)
        if found is not None:
            limits[way] = found
    pairs = attempt("spectrum", spectrum, chain)
    if pairs is None:
        units = int(chain.structure.closed.sum())
        pairs = attempt("eigenvectors of 1", spectrum, chain, k=units)
    gap = attempt("gap", spectral_gap, chain)
    period = limits["elimination"].period if gap is None else apparent_period(chain)
    return Road(graph, chain, limits, pairs, gap, period, refused)


def _named(graph: nx.DiGraph[Any]) -> nx.DiGraph[str]:
    """Return the graph with its states as texts, as files have them."""
    import networkx as nx

    names = {state: str(state) for state in graph}
    if len(set(names.values())) < len(names):
        raise GameError("two states of the game are written alike; give each its own text")
    named: nx.DiGraph[str] = nx.relabel_nodes(graph, names)
    return named


def _adding_up(graph: nx.DiGraph[str]) -> nx.DiGraph[str]:
    """Return the graph with the chances out of each state adding up to 1, correctly rounded.

    Where they miss it all are scaled, and the largest becomes what the others leave over.
    """
    for state in graph:
        arcs = [arc for _, _, arc in graph.out_edges(state, data=True)]
        total = math.fsum(arc["probability"] for arc in arcs)
        if total in (0.0, 1.0):
            continue
        for arc in arcs:
            arc["probability"] /= total
        largest = max(arcs, key=lambda arc: arc["probability"])
        others = [arc["probability"] for arc in arcs if arc is not largest]
        largest["probability"] = -math.fsum([-1.0, *others])
    return graph
