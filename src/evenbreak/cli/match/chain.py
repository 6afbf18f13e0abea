"""`evenbreak chain`: the stochastic limit of any chain, from a file of arcs."""

from __future__ import annotations

import click

from evenbreak import chains, files
from evenbreak.answers.answer import Answer
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import via_option
from evenbreak.errors import DataError

EXAMPLES = """\b
Examples:
  evenbreak chain arcs.csv
  evenbreak chain arcs.csv --start S2 --json
  evenbreak chain arcs.csv --steps 10
  evenbreak chain arcs.csv --via eigen
"""


@click.command("chain", epilog=EXAMPLES)
@click.argument("arcs", metavar="ARCS.csv")
@click.option("--start", metavar="STATE", help="Where to begin.  [default: the first row's source]")
@click.option(
    "--steps",
    type=click.IntRange(0),
    metavar="N",
    help="Also give the probabilities after N steps; CSV then has only these.",
)
@via_option
@faces()
def command(arcs: str, start: str | None, steps: int | None, via: Way | None) -> Answer:
    """Find where any Markov chain ends, or its long-run average, from a file of arcs.

    The columns of ARCS.csv are source, target and probability; - reads standard input.
    The arcs out of each state sum to 1; the chain ends in a state that is only a target.
    """
    from evenbreak.answers.chain import chain_answer

    file = files.read_arcs(arcs)
    if start is None:
        start = file.states[file.sources[0]]
    elif start not in file.states:
        known = ", ".join(repr(state) for state in file.states[:5])
        raise DataError(
            [f"{file.source}: start {start!r} is not a state; the first states are {known}"]
        )
    chain = chains.chain_from_arrays(
        file.states, file.sources, file.targets, file.probabilities, start=start
    )
    return chain_answer(chain, steps=steps, warnings=file.warnings, via=via)
