"""`evenbreak oneball`: which shot to take."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, PlainCommand, chance, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    chance_text,
    paragraphs,
    print_json,
    print_table,
    to_terminal,
)
from evenbreak.cli.kit.plot import plot_option, write_plot

if TYPE_CHECKING:
    from evenbreak.practice.shots import RankedShot

HEADINGS = {
    "shot": "shot",
    "kind": "kind",
    "p1": "you\nmake",
    "p2": "miss\nleaves",
    "p_win_infinite": "you win,\nrepeated",
    "p_win_two_shots": "you win,\n2 shots",
    "critical_p2": "even\nat",
    "behind": "behind\nbest",
    "turning_p2": "best\nup to",
}
"""The columns, with what a terminal calls them."""

LOOK_AHEADS = {"infinite": "infinite", "two": "two shots"}

SAME = 1e-12
"""Two chances that differ by less are the same but for rounding."""

EXAMPLES = """\b
Examples:
  evenbreak oneball 0.4 0.8
  evenbreak oneball 0.4 0.8 --or 0.3:0.3 --or 0.5:0.9
  evenbreak oneball 0.4 0.8 --or 0.3:0.3 --plot shots.png
"""


def _shots(
    ctx: click.Context, param: click.Parameter, values: Sequence[str]
) -> list[tuple[float, float]]:
    """Return the two chances of each further shot, such as 0.3:0.3."""
    shots = []
    for value in values:
        parts = [part.strip() for part in value.split(":")]
        numbers = [float(part) if NUMBER.fullmatch(part) else math.nan for part in parts]
        if len(numbers) != 2 or not all(0.0 <= number <= 1.0 for number in numbers):
            raise click.BadParameter(
                f"{value!r}; give two numbers from 0 to 1 with a colon between them, such as "
                "0.3:0.3",
                ctx=ctx,
                param=param,
            )
        shots.append((numbers[0], numbers[1]))
    return shots


@click.command("oneball", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("p1", metavar="P1", callback=chance)
@click.argument("p2", metavar="P2", callback=chance)
@click.option(
    "--or",
    "others",
    metavar="P1:P2",
    multiple=True,
    callback=_shots,
    help="Another shot to choose from; may be given more than once.",
)
@click.option(
    "--look-ahead",
    type=click.Choice(list(LOOK_AHEADS)),
    default="infinite",
    show_default=True,
    help="Rank by the shots repeated for ever, or by two shots and then an even game.",
)
@wants_json
@plot_option
def command(
    p1: float,
    p2: float,
    others: list[tuple[float, float]],
    look_ahead: str,
    as_json: bool,
    plot: str | None,
) -> None:
    """Answer who wins the one-ball game, and which shot is best.

    P1 is your chance to make the shot, P2 the opponent's chance to make what your miss
    leaves. Each --or is another shot that you could take instead.
    """
    from evenbreak.practice.shots import ShotChoice, compare_shots

    shots = [
        ShotChoice(str(number), *chances)
        for number, chances in enumerate([(p1, p2), *others], start=1)
    ]
    ahead = LOOK_AHEADS[look_ahead]
    ranked = compare_shots(shots, look_ahead=ahead)
    rows = [_row(one) for one in ranked]
    if plot is not None:
        from evenbreak.plots.shot_choice import shots_figure

        write_plot(shots_figure(shots, look_ahead=ahead), plot)
    if as_json:
        listed = [dict(zip(HEADINGS, row, strict=True)) for row in rows]
        print_json({"look_ahead": ahead, "shots": listed, "schema_version": SCHEMA_VERSION})
        return
    print_table(
        list(HEADINGS),
        rows,
        headings=list(HEADINGS.values()),
        heading=_heading(ahead),
        text=_text,
        left=2,
    )
    if to_terminal():
        otherwise = compare_shots(shots, look_ahead=_other(ahead))
        click.echo("\n" + paragraphs(advice(ranked, otherwise)))


def _row(one: RankedShot) -> tuple[Any, ...]:
    from evenbreak.practice.shots import critical_p2

    shot, critical = one.shot, critical_p2(one.shot.p1)
    return (
        int(shot.name),
        shot.region,
        shot.p1,
        shot.p2,
        shot.win(),
        shot.win("two shots"),
        critical if critical <= 1.0 else None,
        one.behind,
        one.turning_p2,
    )


def _heading(look_ahead: str) -> str:
    told = "You shoot first; 'even at' and 'best up to' are chances that a miss leaves.\n"
    if look_ahead == "two shots":
        return f"{told}Ranked by 2 shots: after two misses the game is even."
    return f"{told}Ranked by what you win if the two shots are repeated until one is made."


def _other(look_ahead: str) -> str:
    return "infinite" if look_ahead == "two shots" else "two shots"


def advice(ranked: Sequence[RankedShot], otherwise: Sequence[RankedShot]) -> str:
    """Return in words what to do, and what it hangs on.

    Parameters
    ----------
    ranked, otherwise
        the shots as ranked by the look-ahead asked for, and by the other one.

    >>> from evenbreak.practice import ShotChoice, compare_shots
    >>> shots = [ShotChoice("1", 0.4, 0.8), ShotChoice("2", 0.3, 0.3)]
    >>> print(advice(compare_shots(shots), compare_shots(shots, look_ahead="two shots")))
    Take shot 2: it wins 0.1337 more than shot 1, and is the best while it leaves less than 0.5143.
    """
    best = ranked[0]
    if best.shot.p1 == best.shot.p2 == best.win == 0.0:
        return "Nobody ever makes a ball: nobody wins."
    if len(ranked) == 1:
        return _alone(best)
    equals = sorted((one.shot.name for one in ranked if one.behind < SAME), key=int)
    if len(equals) > 1:
        return f"Shots {', '.join(equals[:-1])} and {equals[-1]} are equally good."
    second, turn = ranked[1], best.turning_p2
    told = f"Take shot {best.shot.name}: it wins {chance_text(second.behind)} more than shot "
    told += second.shot.name
    if turn is None:
        told += ", whatever it leaves."
    else:
        told += f", and is the best while it leaves less than {turn:.4f}."
    if next(one for one in otherwise if one.shot is best.shot).behind > SAME:
        told += f"\nThe other look-ahead prefers shot {otherwise[0].shot.name}."
    return told


def _alone(one: RankedShot) -> str:
    from evenbreak.practice.shots import critical_p2

    critical = critical_p2(one.shot.p1)
    if critical == 0.0:
        return "You are not the favourite, whatever a miss leaves."
    if critical > 1.0:
        return "You are the favourite, whatever a miss leaves."
    if abs(critical - one.shot.p2) < SAME:
        return "The game is even; a little less left makes you the favourite."
    verb = "are" if one.shot.p2 < critical else "would be"
    return f"You {verb} the favourite if a miss leaves less than {critical:.4f}."


def _text(column: str, value: Any) -> str:
    if column in ("shot", "kind"):
        return str(value)
    return f"{value:g}" if column in ("p1", "p2") else chance_text(value)
