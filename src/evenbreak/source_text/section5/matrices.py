"""The transition matrices of P5.23, P5.24 and P5.27 in symbols, and their eigenvalues.

An entry is the chance of the arrow from the state of its column to that of its row, so each
column sums to 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from evenbreak.source_text.markdown import markdown_table
from evenbreak.source_text.section5.rows import Row


class Matrix(NamedTuple):
    """A matrix in symbols, q = 1 - p.

    Parameters
    ----------
    problem
        the problem whose matrix it is.
    states
        the states, in the order of rows and columns; in P5.27 each lead has the name of
        the handicap that starts there.
    entries
        row by row.
    eigenvalues
        all of them.
    """

    problem: str
    states: Sequence[str]
    entries: Sequence[Sequence[str]]
    eigenvalues: Sequence[str]


def _leads(games: int) -> Sequence[Sequence[str]]:
    """Return the matrix of a match by lead, from L over the leads between to W."""
    places = range(games + 1)
    arrows = {(0, 0): "1", (games, games): "1"}
    for lead in range(1, games):
        arrows |= {(lead + 1, lead): "p", (lead - 1, lead): "q"}
    return [[arrows.get((row, column), "0") for column in places] for row in places]


MATRICES: Mapping[str, Matrix] = {
    "M": Matrix(
        "P5.23",
        ("W", "S1", "S2", "L"),
        (
            ("1", "p1", "0", "0"),
            ("0", "0", "q2", "0"),
            ("0", "q1", "0", "0"),
            ("0", "0", "p2", "1"),
        ),
        ("1", "1", "sqrt(q1 q2)", "-sqrt(q1 q2)"),
    ),
    "limit of M^n": Matrix(
        "P5.23",
        ("W", "S1", "S2", "L"),
        (
            ("1", "p1/(1 - q1 q2)", "p1 q2/(1 - q1 q2)", "0"),
            ("0", "0", "0", "0"),
            ("0", "0", "0", "0"),
            ("0", "q1 p2/(1 - q1 q2)", "p2/(1 - q1 q2)", "1"),
        ),
        ("1", "1", "0", "0"),
    ),
    "M, winner breaks": Matrix(
        "P5.24", ("S1", "S2"), (("p1", "q2"), ("q1", "p2")), ("1", "p1 + p2 - 1")
    ),
    "M, loser breaks": Matrix(
        "P5.24", ("S1", "S2"), (("q1", "p2"), ("p1", "q2")), ("1", "1 - p1 - p2")
    ),
    "M, alternate breaks": Matrix("P5.24", ("S1", "S2"), (("0", "1"), ("1", "0")), ("1", "-1")),
    "M, six games between the ends": Matrix(
        "P5.27",
        ("L", "5:1", "4:2", "3:3", "2:4", "1:5", "W"),
        _leads(6),
        ("1", "1", "sqrt(3 p q)", "sqrt(p q)", "0", "-sqrt(p q)", "-sqrt(3 p q)"),
    ),
}
"""The matrices by name."""


def matrix_table(name: str) -> str:
    r"""Return a matrix in Markdown: from the state above, to the state on the left.

    >>> print(matrix_table("M, winner breaks"))
    | to \ from | S1 | S2 |
    |:--|--:|--:|
    | **S1** | p1 | q2 |
    | **S2** | q1 | p2 |
    """
    matrix = MATRICES[name]
    return markdown_table(
        ["to \\ from", *matrix.states],
        [
            [f"**{state}**", *(entry.replace("-", "−") for entry in row)]
            for state, row in zip(matrix.states, matrix.entries, strict=True)
        ],
    )


def matrix_rows(problem: str) -> Iterator[Row]:
    """Yield each entry of the matrices of a problem as a formula.

    >>> next(matrix_rows("P5.24"))
    Row(quantity='formula: M, winner breaks', inputs='to S1 from S1', computed='p1', note='')
    """
    for name, matrix in MATRICES.items():
        if matrix.problem == problem:
            for target, row in zip(matrix.states, matrix.entries, strict=True):
                for source, entry in zip(matrix.states, row, strict=True):
                    yield Row(f"formula: {name}", f"to {target} from {source}", entry)
