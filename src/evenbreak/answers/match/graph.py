"""A game's graph, matrix, eigenvalues and limit, and the tables written to files."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import (
    columns_of,
    in_files,
    quantities_of,
    quantity_of,
    table_by_column,
)
from evenbreak.answers.kit.parts import Quantities, Table
from evenbreak.answers.kit.wording import chance, count_of, percent
from evenbreak.answers.match.chain import Road, in_the_end, mean_steps_of
from evenbreak.words import listed

LEADING = 6
"""How many eigenvalues are shown."""

SAME = 1e-12
"""Limits that differ by less than this count as equal."""

WAY_WORDS = {"kernel": "the closed form", "elimination": "elimination", "eigen": "the eigenvectors"}


def graph_answer(title: str, road: Road, *, warnings: Sequence[str] = ()) -> Answer:
    """Return the size and shape of a game's graph, and where it leads."""
    chain, structure = road.chain, road.chain.structure
    mean_steps, doubts = mean_steps_of(chain)
    states, arcs = len(chain), road.graph.number_of_edges()
    values = [] if road.spectrum is None else road.spectrum.values.tolist()
    first = [
        f"{title} is a graph of {count_of(states, 'state')} and {count_of(arcs, 'arc')}.",
        in_the_end(road.limit, structure.kinds, mean_steps),
    ]
    wins = wins_of(road)
    if wins:
        who = [f"player {player} with chance {chance(p)}" for player, p in wins.items()]
        first.insert(1, f"{listed(who).replace(' with', ' wins with', 1).capitalize()}.")
    return Answer(
        f"From graph to limit: {title[0].lower()}{title[1:]}",
        [
            "\n".join(first),
            _classes_words(road),
            _ways_words(road),
            _spectrum_words(road),
            _leading(values[:LEADING]),
        ],
        [
            "Two states are in the same class if each can be reached from the other. The gap is 1 "
            "less the largest modulus of an eigenvalue more than 1e-8 inside the unit circle: in "
            "the end the distance to the limit falls by this share with each step.",
            Quantities(
                [
                    *quantities_of({"gap": road.gap, "period": road.limit.period}),
                    *(
                        quantity_of("way", difference, way=way, words=WAY_WORDS[way])
                        for way, difference in road.differences.items()
                    ),
                ]
            ),
            *(f"{what}: {why}" for what, why in road.refused.items()),
        ],
        warnings=[*warnings, *doubts],
        data={
            "states": states,
            "arcs": arcs,
            "wins": {str(player): p for player, p in wins.items()},
            "start": chain.start,
            "mean_steps": mean_steps,
            "classes": classes_table(road).to_dicts(),
            "eigenvalues": Table("", _EIGENVALUE, _eigenvalue_rows(values)).to_dicts(),
            "all_eigenvalues": len(values) == states,
            "refused": dict(road.refused),
        },
        csv=limit_table(road),
    )


def wins_of(road: Road) -> dict[int, float]:
    """Return the chances of the players who can win.

    >>> from evenbreak.answers.match.chain import road_of
    >>> from evenbreak.games import OneBall
    >>> {player: round(p, 6) for player, p in wins_of(road_of(OneBall(0.4, 0.8))).items()}
    {1: 0.454545, 2: 0.545455}
    """
    wins: dict[int, float] = {}
    for state, attributes in road.graph.nodes(data=True):
        if (winner := attributes["winner"]) is not None:
            wins[winner] = wins.get(winner, 0.0) + road.limit[state]
    return dict(sorted(wins.items()))


def _classes_words(road: Road) -> str:
    structure = road.chain.structure
    closed = int(structure.closed.sum())
    passing = structure.count - closed
    if structure.count == 1:
        period = int(structure.periods[0])
        again = f", so a state can return only after a multiple of {period} steps" * (period > 1)
        return (
            "Every state can be reached from every other. They form one class, with period "
            f"{period}{again}."
        )
    periods = sorted(set(structure.periods[structure.closed].tolist()))
    return (
        f"Its states form {structure.count:,} classes. {closed:,} of them "
        f"{'is' if closed == 1 else 'are'} never left (period {listed(periods, 'or')}), and "
        f"{passing:,} {'is' if passing == 1 else 'are'} left for good."
    )


def _ways_words(road: Road) -> str:
    apart = max(road.differences.values(), default=0.0)
    ways = listed([WAY_WORDS[way] for way in road.limits])
    agree = f"to within {SAME:.0e}" if apart < SAME else f"to within {apart:.1e}"
    text = f"{ways[0].upper()}{ways[1:]} give the same limit, {agree}."
    if len(road.limits) == 1:
        text = "The limit is found by elimination."
    if "kernel" in road.refused:
        text += " The closed form is for states in a line, and these states aren't in a line."
    if "eigen" in road.refused:
        text += f" Eigenvectors weren't used: {road.refused['eigen']}."
    return text


def _spectrum_words(road: Road) -> str:
    if road.spectrum is None:
        return f"The eigenvalues are not certain: {road.refused['eigenvectors of 1']}."
    values, n = road.spectrum.values, len(road.chain)
    gap = _gap_words(road)
    if "spectrum" in road.refused:
        return (
            "Only the eigenvectors of eigenvalue 1 are given. Some of the others don't exist "
            f"(the matrix of a race is defective) or are not certain.{gap}"
        )
    if n == 1:
        return f"The only eigenvalue is 1.{gap}"
    if n == 2:
        return f"Both eigenvalues were found, and both are real.{gap}"
    real = "and all are real" if np.isrealobj(values) else "and some of them are complex"
    which = "All" if len(values) == n else "The leading"
    first = f" The first {LEADING} are below." if len(values) > LEADING else ""
    return f"{which} {len(values):,} eigenvalues were found, {real}.{gap}{first}"


def _gap_words(road: Road) -> str:
    if road.gap is None:
        return f" How fast the distance to the limit falls is not certain: {road.refused['gap']}."
    if road.gap > 1.0 - SAME and road.limit.is_cesaro:
        return " After a fixed number of steps the chain only repeats itself (the gap is 1)."
    if road.gap > 1.0 - SAME:
        return " The limit is reached after a fixed number of steps (the gap is 1)."
    what, ages = "long-run cycle" if road.limit.is_cesaro else "limit", ""
    if road.period != road.limit.period:
        what = f"limit, averaged over {road.period} steps,"
        ages = f" For a very long time the chain behaves as if its period were {road.period}."
    return (
        f" In the end the distance to the {what} falls by {percent(road.gap)} with each step (the "
        f"gap is {road.gap:.4g}).{ages}"
    )


_EIGENVALUE = columns_of("eigenvalue real imaginary modulus")


def _leading(values: Sequence[complex]) -> Table:
    """Return the leading eigenvalues for display."""
    rows = _eigenvalue_rows(values)
    if not any(complex(value).imag for value in values):
        return Table("", _EIGENVALUE[:2], [row[:2] for row in rows])
    return Table("", _EIGENVALUE, rows)


def _eigenvalue_rows(values: Iterable[complex]) -> list[tuple[Any, ...]]:
    rows = enumerate(map(complex, values), 1)
    return [(k, value.real, value.imag, abs(value)) for k, value in rows]


def eigenvalue_table(road: Road) -> Table:
    """Return the eigenvalues found, starting with those equal to 1."""
    values = [] if road.spectrum is None else road.spectrum.values.tolist()
    return Table("eigenvalues", _EIGENVALUE, _eigenvalue_rows(values))


def eigenvector_table(road: Road) -> Table:
    """Return a row for each state with its entries in the right and left eigenvectors.

    The columns are right_1, right_2, ..., left_1, left_2, ..., numbered like the eigenvalues;
    complex vectors are each followed by their imaginary part.
    """
    pairs, entries = road.spectrum, dict[str, Any]()
    sides = () if pairs is None else (("right", pairs.right), ("left", pairs.left.T))
    for side, vectors in sides:
        for k, vector in enumerate(vectors.T, 1):
            entries[f"{side}_{k}"] = vector.real
            if np.iscomplexobj(vectors):
                entries[f"{side}_{k}_imaginary"] = vector.imag
    columns = dict(zip(in_files(entries, exact=True), entries.values(), strict=True))
    return table_by_column("eigenvectors", {"-state": road.chain.states, **columns})


def arcs_table(road: Road) -> Table:
    """Return the arcs, starting with those out of the start, where a file of arcs starts."""
    columns = columns_of("source target probability")
    arcs: list[Any] = sorted(
        road.graph.edges(data="probability"), key=lambda arc: arc[0] != road.chain.start
    )
    return Table("arcs", columns, arcs)


def states_table(road: Road) -> Table:
    """Return the states in the matrix's order, with everything known about each."""
    structure = road.chain.structure
    nodes = [attributes for _, attributes in road.graph.nodes(data=True)]
    return table_by_column(
        "states",
        {
            "-state": road.chain.states,
            "-kind": [node["kind"] for node in nodes],
            "-winner": [node["winner"] for node in nodes],
            "class": structure.label + 1,
            "class_kind": structure.kinds,
            "-period": structure.periods[structure.label],
            "-limit": road.limit.probability,
        },
    )


def classes_table(road: Road) -> Table:
    """Return the communicating classes, upstream first."""
    structure, limit = road.chain.structure, road.limit.probability
    kinds = [structure.kinds[i] for i in structure.order[structure.offsets[:-1]]]
    sums = np.bincount(structure.label, weights=limit, minlength=structure.count)
    return table_by_column(
        "classes",
        {
            "class": range(1, structure.count + 1),
            "states": np.diff(structure.offsets),
            "-kind": kinds,
            "-period": structure.periods,
            "-limit": sums,
        },
    )


def limit_table(road: Road) -> Table:
    """Return each state's limit from every method; methods that can't find it have empty cells."""
    values: dict[Any, Any] = {"-state": road.chain.states}
    for column in in_files(WAY_WORDS, exact=True):
        limit = road.limits.get(column.names[0])
        values[column] = [None] * len(road.chain) if limit is None else limit.probability
    return table_by_column("limit", values)
