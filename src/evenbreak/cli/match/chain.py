"""`evenbreak chain`: the stochastic limit of any chain, from a file of arcs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, print_json, say
from evenbreak.errors import AccuracyError, DataError

if TYPE_CHECKING:
    from evenbreak.chains.chain import Chain
    from evenbreak.chains.limits import Limit

EXAMPLES = """\b
Examples:
  evenbreak chain arcs.csv
  evenbreak chain arcs.csv --start S2 --json
  evenbreak chain arcs.csv --steps 10
"""


@click.command("chain", epilog=EXAMPLES)
@click.argument("arcs", metavar="ARCS.csv")
@click.option("--start", metavar="STATE", help="Where to begin.  [default: the first row's source]")
@click.option(
    "--steps",
    type=click.IntRange(0),
    metavar="N",
    help="Print the density after N steps in place of the limit.",
)
@wants_json
def command(arcs: str, start: str | None, steps: int | None, as_json: bool) -> None:
    """Find the stochastic limit of any chain, from a file of arcs.

    The columns of ARCS.csv are source, target and probability; - reads standard input.
    The arcs out of each state sum to 1; a state that is only a target absorbs. Where
    the chain goes round for ever, the limit is the long-run average.
    """
    from evenbreak.chains.explore import chain_from_arrays
    from evenbreak.chains.limits import stochastic_limit
    from evenbreak.chains.powers import propagate
    from evenbreak.files.arcs import read_arcs

    file = read_arcs(arcs)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    if start is None:
        start = file.states[file.sources[0]]
    elif start not in file.states:
        known = ", ".join(repr(state) for state in file.states[:5])
        raise DataError([f"{file.source}: start {start!r} is no state; its states begin {known}"])
    built = chain_from_arrays(file.states, *file[1:4], start=start)
    if steps is not None and not as_json:
        _print_csv(file.states, propagate(built, steps=steps).tolist())
        return
    limit = stochastic_limit(built)
    if as_json:
        print_json(_answer(built, limit, steps))
        return
    for note in _notes(limit):
        say(f"Note: {note}")
    _print_csv(file.states, limit.probability.tolist())


def _notes(limit: Limit) -> Iterator[str]:
    """Yield what a reader of the bare numbers should know."""
    if limit.is_cesaro:
        yield f"this is the long-run average; the chain goes round with period {limit.period}"
    if limit.residual is not None:
        yield f"solved with residual {limit.residual:.3g}, without a bound for each entry"


def _answer(built: Chain, limit: Limit, steps: int | None) -> dict[str, Any]:
    """Return what --json prints."""
    from evenbreak.chains.powers import propagate

    states, structure = built.states, built.structure
    classes = zip(structure.label.tolist(), structure.kinds, strict=True)
    density = None if steps is None else propagate(built, steps=steps).tolist()
    return {
        "start": built.start,
        "limit": limit.to_dict(),
        "states": {
            state: {"class": label, "kind": kind}
            for state, (label, kind) in zip(states, classes, strict=True)
        },
        "period": limit.period,
        "mean_steps": _mean_steps(built),
        "residual": limit.residual,
        "steps": steps,
        "density": density and dict(zip(states, density, strict=True)),
        "schema_version": SCHEMA_VERSION,
    }


def _mean_steps(built: Chain) -> float | None:
    """Return the mean number of steps to absorption; None too where no float can hold it."""
    from evenbreak.chains.passage_times import steps_to_absorption

    try:
        return steps_to_absorption(built).mean
    except AccuracyError as error:
        click.echo(
            f"Note: mean_steps is null because it could not be computed ({error}); absorption "
            "may be certain all the same",
            err=True,
        )
        return None


def _print_csv(states: list[str], chances: list[float]) -> None:
    """Print each state with its probability, in the shortest text that reads back the same."""
    from evenbreak.files.csv_writer import text_cell

    # A state called -1 is a number, as any spreadsheet would read it, and no formula.
    names = (state if NUMBER.fullmatch(state) else text_cell(state) for state in states)
    rows = [f"{name},{p!r}\n" for name, p in zip(names, chances, strict=True)]
    click.echo("".join(["state,probability\n", *rows]).encode(), nl=False)
