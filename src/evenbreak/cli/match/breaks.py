"""`evenbreak breaks`: what each break format is worth to two players in the long run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import PlainCommand, chance, number, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    chance_text,
    paragraphs,
    print_json,
    print_table,
    to_terminal,
)
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.games.rack import Rack

if TYPE_CHECKING:
    from evenbreak.practice.breaks import BreakFormatValue

HEADINGS = {
    "breaks": "breaks",
    "share_a": "A wins",
    "points_per_rack": "A's points\na rack",
    "sd_points": "luck times\nroot racks",
    "fair_win": "even if\nwin pays",
    "first_break_racks": "first break\nis worth",
    "memory": "left each\nrack",
}
"""The columns, with what a terminal calls them."""

USUAL = ("winner", "loser", "alternate")

SAME = 1e-12
"""Two shares that differ by less are the same but for rounding."""

HIGHEST = 1_000_000
"""The highest stake."""

EXAMPLES = """\b
Examples:
  evenbreak breaks 0.6 0.55
  evenbreak breaks 0.9 0.5 --win 1 --lose 2
  evenbreak breaks 0.9 0.5 --plot breaks.png
"""


def _points(ctx: click.Context, param: click.Parameter, value: str) -> float:
    """Return the points of a stake."""
    wanted = f" is no stake; give a number from 0 to {HIGHEST}"
    return number(value, 0, HIGHEST, wanted, ctx=ctx, param=param)


@click.command("breaks", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("p1", metavar="P1", callback=chance)
@click.argument("p2", metavar="P2", callback=chance)
@click.option(
    "--win",
    metavar="X",
    callback=_points,
    default="1",
    show_default=True,
    help="The points that A wins with each rack won.",
)
@click.option(
    "--lose",
    metavar="Y",
    callback=_points,
    default="1",
    show_default=True,
    help="The points that A loses with each rack lost.",
)
@click.option(
    "--first-break",
    type=click.Choice(["a", "b"]),
    default="a",
    show_default=True,
    help="Who breaks the first rack; it matters only where the break never passes on.",
)
@wants_json
@plot_option
def command(
    p1: float,
    p2: float,
    win: float,
    lose: float,
    first_break: str,
    as_json: bool,
    plot: str | None,
) -> None:
    """Weigh the break formats for two players, in the long run: the best for A first.

    P1 is A's chance to win a rack that A breaks, P2 is B's chance to win a rack that B
    breaks.
    """
    from evenbreak.practice.breaks import compare_break_formats

    rack = Rack(p1, p2)
    first = 1 if first_break == "a" else 2
    values = compare_break_formats(rack, win=win, lose=lose, first_breaker=first)
    rows = [_row(value, lose) for value in values]
    if plot is not None:
        from evenbreak.plots.break_formats import breaks_figure

        write_plot(breaks_figure(rack, first_breaker=first), plot)
    if as_json:
        listed = [dict(zip(HEADINGS, row, strict=True)) for row in rows]
        print_json({"formats": listed, "schema_version": SCHEMA_VERSION})
        return
    print_table(
        list(HEADINGS),
        rows,
        headings=list(HEADINGS.values()),
        heading=f"A wins {p1:g} of the racks that A breaks, B wins {p2:g} of those that B breaks\n"
        f"A wins {win:g} with each rack won and loses {lose:g} with each rack lost",
        text=_text,
        left=1,
    )
    if to_terminal():
        click.echo("\n" + paragraphs(f"{luck(values)}\n{advice(values)}"))


def _row(value: BreakFormatValue, lose: float) -> tuple[Any, ...]:
    fair_win = value.fair_ratio * lose
    head_start = value.name in USUAL and math.isfinite(value.first_break)
    return (
        {"player 1": "a", "player 2": "b"}.get(value.name, value.name),
        value.share,
        value.points,
        value.sd_points,
        fair_win if math.isfinite(fair_win) else None,
        value.first_break if head_start else None,
        value.memory,
    )


def luck(values: Sequence[BreakFormatValue]) -> str:
    """Return in words what the usual format that is best for A brings in a long session.

    >>> from evenbreak.practice import compare_break_formats
    >>> print(luck(compare_break_formats(Rack(0.9, 0.5), win=1, lose=2)))
    In 100 racks with winner breaks A gets 50 points on average, give or take 17.
    """
    best = next(value for value in values if value.name in USUAL)
    points = round(100 * best.points)
    told = f"In 100 racks with {best.name} breaks A gets {points:,} points on average"
    return f"{told}, give or take {10 * best.sd_points:,.0f}."


def advice(values: Sequence[BreakFormatValue]) -> str:
    """Return in words which of the usual formats suits whom, and where the stakes turn.

    >>> from evenbreak.practice import compare_break_formats
    >>> print(advice(compare_break_formats(Rack(0.9, 0.5), win=1, lose=2)))
    Of winner, loser and alternate breaks, A is best off with winner breaks, B with loser breaks.
    At these stakes A gains with winner and alternate breaks, and loses with loser breaks.
    """
    usual = [value for value in values if value.name in USUAL]
    for value in usual:
        if math.isinf(value.first_break):
            told = f"With {value.name} breaks the break never passes on"
            return f"{told}: all hangs on who breaks first."
    best, worst = usual[0], usual[-1]
    if best.share - worst.share < SAME:
        return "Winner, loser and alternate breaks are worth the same to both."
    told = (
        "Of winner, loser and alternate breaks, "
        f"A is best off with {best.name} breaks, B with {worst.name} breaks."
    )
    gains = [value.name for value in usual if value.points > SAME]
    losses = [value.name for value in usual if value.points < -SAME]
    if gains and losses:
        told += f"\nAt these stakes A gains with {' and '.join(gains)} breaks, "
        told += f"and loses with {' and '.join(losses)} breaks."
    return told


def _text(column: str, value: Any) -> str:
    if column == "breaks":
        return str(value).upper() if value in ("a", "b") else str(value)
    if column == "share_a":
        return chance_text(value)
    if abs(value) >= HIGHEST:
        return f"{value:.4g}"
    return f"{round(value, 4) + 0.0:.4f}"  # -0.0 + 0.0 is 0.0
