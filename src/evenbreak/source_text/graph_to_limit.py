"""The page "From graph to limit": each game's graph, leading eigenvalues and limit.

Its prose is in `templates/graph_to_limit.md`, and its numbers come from the tables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from decimal import ROUND_HALF_EVEN, Decimal
from functools import cache, partial
from typing import Any, NamedTuple

from evenbreak.answers.match.chain import Road, road_of
from evenbreak.answers.match.graph import SAME
from evenbreak.chains.ways import WAYS, Way
from evenbreak.game import Game
from evenbreak.games import (
    Ahead,
    Drill,
    OneBall,
    Race,
    Rack,
    Series,
    alternate_breaks,
    loser_breaks,
    winner_breaks,
)
from evenbreak.handicaps import Ladder, chart
from evenbreak.matches import win_probability
from evenbreak.practice import drill_statistics, long_run_share, one_ball_win
from evenbreak.source_text.cells import Rows, Tables, markdown_table, short
from evenbreak.source_text.pages import filled

LEADING = 6
"""How many eigenvalues are listed for each game."""

PLACES = 10
"""How many decimals limits have: rounding differs between machines only beyond that."""


class Asked(NamedTuple):
    """A game, and a question about it, which `answer` answers with each method (`via`)."""

    words: str
    game: Game
    question: str
    answer: Callable[..., float]


def _mean_level(drill: Drill, *, via: Way) -> float:
    return float(drill_statistics(drill, via=via).distribution.mean)


def _sd(ladder: Ladder, *, via: Way) -> float:
    return float(ladder.law(via=via).sd)


def _games() -> Iterator[tuple[str, Asked]]:
    yield (
        "one_ball",
        Asked(
            "one-ball, p1 = .4, p2 = .8",
            OneBall(0.4, 0.8),
            "player 1 wins",
            partial(one_ball_win, 0.4, 0.8),
        ),
    )
    for breaks in (winner_breaks, loser_breaks, alternate_breaks):
        yield (
            breaks.__name__,
            Asked(
                f"{breaks.__name__.replace('_', ' ')}, p1 = .9, p2 = .5",
                Series(Rack(0.9, 0.5), breaks=breaks),
                "racks that player 1 wins",
                partial(long_run_share, 0.9, 0.5, breaks),
            ),
        )
    for balls, drill in (("9", Drill.progressive(0.8)), ("8", Drill.eight_ball(0.8))):
        yield (
            f"drill_{balls}_ball",
            Asked(
                f"progressive {balls}-ball drill, p = .8",
                drill,
                "mean level",
                partial(_mean_level, drill),
            ),
        )
    for name in ("npl_8", "npl_10", "npl_12", "npl_20"):
        ladder = Ladder(chart(name))
        yield (
            name,
            Asked(
                f"ladder of Chart-{name.removeprefix('npl_')}",
                ladder,
                "standard deviation of a rating",
                partial(_sd, ladder),
            ),
        )
    for name, words, match in (
        ("ahead_3_3", "ahead 3:3, p = .6", Ahead(3, 3, Rack(0.6))),
        ("ahead_5_3", "ahead 5:3, p = .6", Ahead(5, 3, Rack(0.6))),
        ("race_9_5", "race 9:5, p = 2/3", Race(9, 5, Rack(2 / 3))),
    ):
        yield (
            name,
            Asked(
                words,
                match,
                "player 1 wins",
                partial(win_probability, match),
            ),
        )


GAMES: dict[str, Asked] = dict(_games())
"""The games by file name."""


@cache
def roads() -> dict[str, Road]:
    """Return each game's path from graph to limit."""
    return {name: road_of(asked.game) for name, asked in GAMES.items()}


def game_tables() -> Tables:
    """Return the tables for all games, with each game's limit in a separate table."""
    limits = {f"game_{name}": limit_rows(road) for name, road in roads().items()}
    return {
        "game_graphs": [_graph_row(name, road) for name, road in roads().items()],
        "game_eigenvalues": eigenvalue_rows(),
        "game_answers": answer_rows(),
        **limits,
    }


def _graph_row(name: str, road: Road) -> dict[str, Any]:
    """Return a game's row: its states, arcs, classes, period and gap."""
    structure, pairs = road.chain.structure, road.spectrum
    assert pairs is not None  # noqa: S101  each of these games has eigenvectors
    complete = len(pairs.values) == len(road.chain)
    return {
        "game": name,
        "states": len(road.chain),
        "arcs": road.graph.number_of_edges(),
        "classes": structure.count,
        "closed_classes": int(structure.closed.sum()),
        "period": road.limit.period,
        "eigenvectors": len(pairs.values),
        "complete": complete,
        "gap": small(road.gap or 0.0, 8),
    }


def eigenvalue_rows() -> Rows:
    """Return each game's eigenvalues with the largest modulus, at most six."""
    rows = []
    for name, road in roads().items():
        assert road.spectrum is not None  # noqa: S101  as above
        leading = map(complex, road.spectrum.values[:LEADING])
        for number, value in enumerate(leading, 1):
            rows.append(
                {
                    "game": name,
                    "number": number,
                    "real": places(value.real, 8),
                    "imaginary": places(value.imag, 8),
                    "modulus": places(abs(value), 8),
                }
            )
    return rows


def answer_rows() -> Rows:
    """Return the requested number for each game from every method, and how much they differ."""
    rows = []
    for name, asked in GAMES.items():
        by_way: dict[str, float] = {way: asked.answer(via=way) for way in WAYS}
        apart = max(by_way.values()) - min(by_way.values())
        rows.append(
            {
                "game": name,
                "answer": asked.question,
                **{way: places(value) for way, value in by_way.items()},
                "apart": small(apart),
            }
        )
    return rows


def limit_rows(road: Road) -> Rows:
    """Return each state's limit from every method; empty if a method has none for the chain."""
    return [
        {
            "state": state,
            "kind": kind,
            **{
                way: places(road.limits[way][state]) if way in road.limits else None for way in WAYS
            },
            "apart": small(
                max(abs(road.limits[way][state] - road.limit[state]) for way in road.limits)
            ),
        }
        for state, kind in zip(road.chain.states, road.chain.structure.kinds, strict=True)
    ]


def places(value: float, decimals: int = PLACES) -> Decimal:
    """Return a number with this many decimals, zero without a sign.

    >>> places(2 / 3, 4), places(-1e-15)
    (Decimal('0.6667'), Decimal('0'))
    """
    return Decimal(value).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_EVEN) or Decimal(0)


def small(value: float, decimals: int = PLACES) -> Decimal | str:
    """Return a number that may be zero except for rounding errors.

    >>> small(3e-16), small(0.25, 2)
    ('below 1e-12', Decimal('0.25'))
    """
    return f"below {SAME:.0e}" if value < SAME else places(value, decimals)


def graph_to_limit_page(tables: Tables) -> str:
    """Return the page in Markdown, from `game_tables`."""
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
    """Return the eigenvalues with their left vectors at the start, and their right vectors."""
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
