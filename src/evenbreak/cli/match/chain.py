"""`evenbreak chain`: the stochastic limit of any chain, from a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak import files
from evenbreak.answers.kit.answer import Answer
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import via_option

if TYPE_CHECKING:
    from collections.abc import Callable

    from evenbreak.chains.matrices import Rows

EXAMPLES = """\b
Examples:
  evenbreak chain arcs.csv
  evenbreak chain arcs.csv --start S2 --json
  evenbreak chain arcs.csv --steps 10
  evenbreak chain graph.graphml
  evenbreak chain matrix.mtx --states states.csv
  evenbreak chain arcs.csv --via eigen
"""


def file_options(function: Callable[..., Answer]) -> Callable[..., Answer]:
    """Add the options that say how a file of a chain is read."""
    start = click.option(
        "--start",
        metavar="STATE",
        help="Where to begin.  [default: the start that the file names, else the first state]",
    )
    states = click.option(
        "--states",
        metavar="STATES.csv",
        help="The names of the states of a matrix, in its order.  [default: 1, 2, ...]",
    )
    rows = click.option(
        "--rows",
        type=click.Choice(["from", "to"]),
        help="What a row of a matrix holds: the chances out of its state, or into it.  [default: "
        "to, so that columns sum to 1]",
    )
    return start(states(rows(function)))


@click.command("chain", epilog=EXAMPLES)
@click.argument("path", metavar="FILE")
@file_options
@click.option(
    "--steps",
    type=click.IntRange(0),
    metavar="N",
    help="Also give the probabilities after N steps; CSV then has only these.",
)
@via_option
@faces()
def command(
    path: str,
    start: str | None,
    steps: int | None,
    states: str | None,
    rows: Rows | None,
    via: Way | None,
) -> Answer:
    """Find where any Markov chain ends, or its long-run average, from a file.

    FILE is a CSV file of arcs with the columns source, target and probability (- reads one from
    standard input), a graph in GraphML (.graphml) or node-link JSON (.json), or a transition
    matrix in Matrix Market form (.mtx). The arcs out of each state sum to 1; the chain ends in a
    state that is only a target.
    """
    from evenbreak.answers.match.chain import chain_answer

    file = files.read_chain(path, states=states, rows=rows)
    return chain_answer(file.chain(start), steps=steps, warnings=file.warnings, via=via)
