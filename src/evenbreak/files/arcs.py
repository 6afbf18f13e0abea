"""Reading a Markov chain from a file of arcs: source, target, probability."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.tables.problems import quoted, refusal
from evenbreak.files.tables.schema import Number, Schema, Text
from evenbreak.files.tables.table import Texts, TextTable
from evenbreak.words import Sentence, say

if TYPE_CHECKING:
    import networkx as nx

    from evenbreak.chains.chain import Chain

WEIGHT = "weight"
"""What networkx and others call a probability; used if no column has that name."""

_STATE = say("the name of a state")
_CHANCE = say("a probability such as 0.25")

ARCS = Schema(
    "arcs",
    source=Text("from, state, source state", "a state", needed=True, filled=True, write=_STATE),
    target=Text(
        "to, next, next state, target state",
        "the state that comes next",
        needed=True,
        filled=True,
        write=_STATE,
    ),
    probability=Number(
        "p, prob, chance",
        "the chance of going to the target from the source",
        needed=True,
        instead=[WEIGHT],
        filled=True,
        least=0,
        most=1,
        write=_CHANCE,
    ),
    weight=Number(
        about="used if there's no `probability` column", filled=True, least=0, most=1, write=_CHANCE
    ),
)

SUM_TOLERANCE = 1e-9


class ArcsFile(NamedTuple):
    """The arcs of a file, in file order.

    `sources[k]` and `targets[k]` are positions in `states`, which are listed in order of first
    appearance; `probabilities[k]` is P(target | source). `start` is the chain's first state, and
    `winners` has the number of the player who has won in each state, if the file gives them.
    """

    states: list[str]
    sources: NDArray[np.int64]
    targets: NDArray[np.int64]
    probabilities: NDArray[np.float64]
    source: str
    warnings: tuple[str, ...]
    start: str | None = None
    winners: Mapping[str, int] = {}

    def chain(self, start: str | None = None) -> Chain:
        """Return the chain from a state; by default, from the file's start or first state.

        Raises
        ------
        DataError
            if there is no such state.
        """
        from evenbreak.chains.explore import chain_from_arrays

        if start is None:
            start = self.start or self.states[0]
        elif start not in self.states:
            first_states = ", ".join(map(quoted, self.states[:5]))
            raise refusal(
                self.source,
                "start {start} isn't a state; the first states are {states}",
                start=quoted(start),
                states=first_states,
            )
        return chain_from_arrays(
            self.states, self.sources, self.targets, self.probabilities, start=start
        )

    def graph(self, start: str | None = None) -> nx.DiGraph[Any]:
        """Return the chain as a graph like those from `evenbreak.game.graph_of`."""
        graph = self.chain(start).to_networkx()
        for state, node in graph.nodes.items():
            node["winner"] = self.winners.get(state)
        return graph


def read_arcs(path: str | Path) -> ArcsFile:
    r"""Read a chain from a CSV file of arcs; '-' is standard input.

    The arcs out of a state, including its self-loop, must sum to 1 within 1e-9; a state that is
    only a target is absorbing.

    Raises
    ------
    DataError
        listing every problem in the file: missing columns, empty names, invalid probabilities, arcs
        listed twice, sums that are not 1.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "arcs.csv"
    ...     _ = path.write_text("source,target,probability\nS,W,0.6\nS,L,0.4\n")
    ...     arcs = read_arcs(path)
    >>> arcs.states, arcs.sources, arcs.targets, arcs.probabilities
    (['S', 'W', 'L'], array([0, 0]), array([1, 2]), array([0.6, 0.4]))
    """
    table = ARCS.text(path)
    whole = len(table.problems) == 0
    name = WEIGHT if WEIGHT in table and "probability" not in table else "probability"
    table = ARCS.only("source", "target", name).of(table)
    p = table[name]
    if all(column in table for column in ("source", "target", name)):
        states, sources, targets = _states(table)
        _refuse_twice(table, states, sources, targets)
        # If a number is wrong or missing, its sum would be reported for the same reason.
        if whole and not np.isnan(p).any():
            for row, problem in sum_problems(states, sources, p).items():
                table.note(row, problem)
    table.problems.raise_any()
    return ArcsFile(states, sources, targets, p, table.source, table.warnings, states[sources[0]])


def _states(table: TextTable) -> tuple[list[str], NDArray[np.int64], NDArray[np.int64]]:
    """Return the states in order of first appearance, and each arc's two positions."""
    arcs = zip(table.cells("source"), table.cells("target"), strict=True)
    states, places = Texts.of([name for arc in arcs for name in arc])
    return states, places[::2], places[1::2]


def _refuse_twice(
    table: TextTable, states: list[str], sources: NDArray[np.int64], targets: NDArray[np.int64]
) -> None:
    key = sources * len(states) + targets
    _, first, which = np.unique(key, return_index=True, return_inverse=True)
    again = np.flatnonzero(first[which] != np.arange(len(key)))
    for row in again:
        table.note(
            row,
            "the arc {source} -> {target} is already in line {line}. Keep one of the two.",
            source=quoted(states[sources[row]]),
            target=quoted(states[targets[row]]),
            line=table.lines[first[which[row]]],
        )


def sum_problems(
    states: Sequence[str], sources: NDArray[np.int64], p: NDArray[np.float64]
) -> dict[int, Sentence]:
    """Return the states whose arcs don't sum to 1 as problems, each at its first arc.

    >>> sum_problems(["S", "W"], np.array([0]), np.array([0.9]))[0][:52]
    "the probabilities of the arcs out of 'S' sum to 0.9,"
    """
    leaving, first = np.unique(sources, return_index=True)
    sums = np.bincount(sources, weights=p, minlength=len(states))
    wrong = np.sort(first[np.abs(sums[leaving] - 1.0) > SUM_TOLERANCE])
    return {
        row: say(
            "the probabilities of the arcs out of {state} sum to {sum:.12g}, not 1. Add the "
            "missing arcs (self-loops count), or write more digits.",
            state=quoted(states[sources[row]]),
            sum=sums[sources[row]],
        )
        for row in wrong.tolist()
    }
