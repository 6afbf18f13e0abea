"""Where a chain ends, or its long-run behavior."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import by_way
from evenbreak.answers.kit.columns import column_of, columns_of, table_by_column
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import chance, count_of, games
from evenbreak.chains.chain import Chain
from evenbreak.chains.explore import chain_of
from evenbreak.chains.limits import Limit, stochastic_limit
from evenbreak.chains.mixing import apparent_period, spectral_gap
from evenbreak.chains.passage_times import steps_to_absorption
from evenbreak.chains.powers import propagate
from evenbreak.chains.spectrum import Spectrum, spectrum
from evenbreak.chains.ways import WAYS, Way
from evenbreak.errors import AccuracyError, ChainError, GameError
from evenbreak.game import Game, graph_of
from evenbreak.words import listed

if TYPE_CHECKING:
    import networkx as nx


NAMED = 5
"""How many states a sentence names, likeliest first."""


def chain_answer(
    chain: Chain, *, steps: int | None = None, warnings: Sequence[str] = (), via: Way | None = None
) -> Answer:
    """Return a chain's stochastic limit, or its probability vector after some steps."""
    limit = stochastic_limit(chain, via=via)
    mean_steps, doubts = mean_steps_of(chain)
    states, structure = list(chain.states), chain.structure
    values: dict[Any, Any] = {"state": states, "kind": structure.kinds}
    sentences = [in_the_end(limit, structure.kinds, mean_steps)]
    density = None
    if steps is not None:
        after = f"after {count_of(steps, 'step')}"
        density = dict(zip(states, propagate(chain, steps=steps).tolist(), strict=True))
        values[column_of("density", after=after)] = density.values()
        sentences.insert(0, f"A{after[1:]} the chain is in {_places(density)}.")
    values["limit"] = limit.probability
    classes = zip(states, structure.label.tolist(), structure.kinds, strict=True)
    return Answer(
        f"A chain of {count_of(len(states), 'state')} that starts in {chain.start!r}",
        ["\n".join(sentences), table_by_column("", values), *_way(via, limit)],
        [
            "A transient state is left for good, an absorbing state is never left, and a recurrent "
            "state is returned to again and again."
        ],
        warnings=[*warnings, *doubts],
        data={
            "start": chain.start,
            "limit": limit.to_dict(),
            "states": {state: {"class": label, "kind": kind} for state, label, kind in classes},
            "period": limit.period,
            "mean_steps": mean_steps,
            "bound": limit.bound,
            "steps": steps,
            "density": density,
        },
        csv=Table(
            "probabilities",
            columns_of("-state probability"),
            list((density or limit.to_dict()).items()),
        ),
    )


def _way(via: Way | None, limit: Limit) -> list[Part]:
    """Return how the limit was found, and the closed form for a line or else elimination."""
    if via is None:
        return []
    beside: Way = "kernel" if limit.chain.line is not None else "elimination"
    known = stochastic_limit(limit.chain, via=beside)
    pairs = zip(limit.probability.tolist(), known.probability.tolist(), strict=True)
    return by_way(via, pairs, beside=beside)


def mean_steps_of(chain: Chain) -> tuple[float | None, list[str]]:
    """Return the mean number of steps to absorption, or why there is none."""
    try:
        return steps_to_absorption(chain).mean, []
    except AccuracyError as error:
        doubt = f"the mean number of steps could not be calculated ({error}); absorption may be "
        return None, [doubt + "certain nevertheless"]


def in_the_end(limit: Limit, kinds: Sequence[str], mean_steps: float | None) -> str:
    """Return where the chain ends, or where it is in the long run."""
    where = _places(limit.to_dict())
    if any(p and kind != "absorbing" for p, kind in zip(limit.probability, kinds, strict=True)):
        text = f"In the long run the chain is in {where}."
        if limit.is_cesaro:
            text += f" It never settles (period {limit.period}): these are long-run averages."
        return text
    steps = f", after {games(mean_steps)} steps on average" if mean_steps else ""
    return f"The chain ends in {where}{steps}."


def _places(density: Mapping[Any, float]) -> str:
    """Return the likeliest states, each with its chance."""
    likeliest = sorted((item for item in density.items() if item[1]), key=lambda item: -item[1])
    named = [f"{state!r} ({chance(p)})" for state, p in likeliest[:NAMED]]
    more = len(likeliest) - len(named)
    return listed([*named, f"{more:,} other states"] if more > 0 else named, "or")


@dataclass(frozen=True, eq=False)
class Road:
    """A game's path from its graph to its limit.

    In `graph`, the chances out of each state add up to 1 to the last digit. `limits` has the limit
    from each method that can find it; elimination always can. `spectrum` has all eigenpairs, or for
    a large chain the leading ones, or only those with eigenvalue 1 if the matrix has too few
    eigenvectors; None if not even these are certain. `gap` and `period` come from `spectral_gap`
    and `apparent_period`. `refused` gives the reason for each missing answer.
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
        """The largest difference between each other method's limit and the limit by elimination."""
        exact = self.limit.probability
        return {
            way: float(np.abs(limit.probability - exact).max())
            for way, limit in self.limits.items()
            if way != "elimination"
        }


def road_of(game: Game | nx.DiGraph[Any], *, start: str | None = None) -> Road:
    """Return a game's path to its limit; raise GameError if two states have the same string."""
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
    """Return the graph with its states as strings, as in files."""
    import networkx as nx

    names = {state: str(state) for state in graph}
    if len(set(names.values())) < len(names):
        raise GameError(
            "two of the game's states look the same when printed. Make each state "
            "print differently."
        )
    named: nx.DiGraph[str] = nx.relabel_nodes(graph, names)
    return named


def _adding_up(graph: nx.DiGraph[str]) -> nx.DiGraph[str]:
    """Return the graph with the chances out of each state adding up to 1, correctly rounded.

    If they don't, they are all scaled, and the largest becomes the remainder.
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
