"""The page "From graph to limit": prose from `page.md`, numbers from the tables."""

from __future__ import annotations

from typing import Any

from evenbreak.chains.ways import WAYS
from evenbreak.source_text.cells import Tables, markdown_table, short
from evenbreak.source_text.graph_to_limit.tables import GAMES, places, roads
from evenbreak.source_text.page import filled


def graph_to_limit_page(tables: Tables) -> str:
    """Return the page in Markdown.

    Parameters
    ----------
    tables
        those of `game_tables`.
    """
    return filled(
        "graph_to_limit",
        {
            "graphs": lambda _: _graphs(tables),
            "answers": lambda _: _answers(tables),
            "matrix": _matrix,
            "pairs": _pairs,
            "limit": lambda name: _limit(name, tables),
        },
    )


def _graphs(tables: Tables) -> str:
    """Return each game with its graph, its leading eigenvalues and its gap."""
    values: dict[str, list[str]] = {}
    for row in tables["game_eigenvalues"]:
        values.setdefault(row["game"], []).append(short(row["real"]))
    rows = [
        [
            f"[{GAMES[row['game']].words}](game_{row['game']}.csv)",
            row["states"],
            row["arcs"],
            f"{row['classes']} ({row['closed_classes']})",
            row["period"],
            ", ".join(values[row["game"]])
            if row["complete"]
            else f"1 ({row['eigenvectors']} times), 0 (all others)",
            _gap(row["gap"]),
        ]
        for row in tables["game_graphs"]
    ]
    header = ["game", "states", "arcs", "classes (never left)", "period", "eigenvalues", "gap"]
    return markdown_table(header, rows)


def _gap(gap: Any) -> str:
    return gap if isinstance(gap, str) else short(gap)


def _answers(tables: Tables) -> str:
    rows = [
        [GAMES[row["game"]].words, row["answer"], *(row[way] for way in WAYS), row["apart"]]
        for row in tables["game_answers"]
    ]
    header = ["game", "what", "kernel", "elimination", "eigenvectors", "difference"]
    return markdown_table(header, rows, left=2)


def _matrix(name: str) -> str:
    chain = roads()[name].chain
    rows = [
        [f"**{state}**", *map(short, row)]
        for state, row in zip(chain.states, chain.matrix.toarray().tolist(), strict=True)
    ]
    return markdown_table(["to / from", *map(str, chain.states)], rows)


def _pairs(name: str) -> str:
    """Return the eigenvalues with their left vectors on the start, and their right vectors."""
    pairs = roads()[name].spectrum
    assert pairs is not None  # noqa: S101  each of these games has eigenvectors
    chain = pairs.chain
    at = chain.index(chain.start)
    rows = [
        [
            short(places(float(value), 8)),
            short(places(float(pairs.left[k, at]), 8)),
            *(short(places(float(p), 8)) for p in pairs.right[:, k]),
        ]
        for k, value in enumerate(pairs.values[: pairs.units])
    ]
    return markdown_table(["eigenvalue", "L v", *(f"R, {s}" for s in chain.states)], rows)


def _limit(name: str, tables: Tables) -> str:
    rows = [
        [row["state"], row["kind"], row["elimination"], row["eigen"], row["apart"]]
        for row in tables[f"game_{name}"]
    ]
    header = ["state", "kind", "elimination", "eigenvectors", "difference"]
    return markdown_table(header, rows, left=2)
