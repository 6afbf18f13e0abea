"""`evenbreak physics shot`: a shot traced whole, and drawn."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NoReturn

import click

from evenbreak.cli.kit.callbacks import NUMBER, refuse, wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, print_json, to_terminal
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.physics.equipment_options import ball_of, cue_of, doubts, kit_options
from evenbreak.cli.physics.units import Measure, Units, print_answer, wants_metric

if TYPE_CHECKING:
    from evenbreak.cli.kit.callbacks import Command
    from evenbreak.physics import AimedShot, Pocket, Shot, Strike, Table

EXAMPLES = """\b
Examples:
  evenbreak physics shot --cut 30 --distance 24 --speed 80 --offset -0.3
  evenbreak physics shot --cut -45 --distance 20 --speed 50 --plot shot.svg
  evenbreak physics shot --cue-ball 25,16 --object-ball 50,25 --pocket foot-left --speed 60
"""


def _place(
    ctx: click.Context, param: click.Parameter, value: str | None
) -> tuple[float, float] | None:
    """Return the two numbers of a place, such as 25,16."""
    if value is None:
        return None
    parts = [part.strip() for part in re.split(r"[,;]", value)]
    if len(parts) != 2 or not all(NUMBER.fullmatch(part) for part in parts):
        raise click.BadParameter(
            f"{value!r}; give two numbers with a comma between them, such as 25,16: along the "
            "table from the head cushion, and across it from its right side",
            ctx=ctx,
            param=param,
        )
    return float(parts[0]), float(parts[1])


def _option(
    name: str, low: float, high: float, example: str, text: str, **more: Any
) -> Callable[[Command], Command]:
    wanted = Measure(low, high, example)
    return click.option(name, type=wanted, help=text, **{"metavar": "NUMBER", **more})


@click.command("shot", epilog=EXAMPLES)
@_option("--cut", -89.0, 89.0, "30", "Cut angle, to 89; below 0 to the left.", metavar="DEGREES")
@_option("--distance", 0.1, 1e4, "24", "Between the centres of the two balls.", metavar="LENGTH")
@click.option(
    "--cue-ball",
    metavar="X,Y",
    callback=_place,
    help="Where it is: X from the head cushion, Y from the right one.  [default: 25,25 inches]",
)
@click.option(
    "--object-ball", metavar="X,Y", callback=_place, help="Where it is, in place of --cut."
)
@click.option(
    "--pocket",
    metavar="NAME",
    help="Aim there, throw allowed for: head-, side- or foot-, then left or right.",
)
@_option("--speed", 0.0, 1e4, "80", "Of the cue ball just after the tip.", metavar="SPEED")
@_option("--stick-speed", 0.0, 1e4, "60", "Of the cue, in place of --speed.", metavar="SPEED")
@_option(
    "--offset",
    -1.0,
    1.0,
    "-0.3",
    "How far above the centre the tip hits, over the ball's radius; below 0 for draw.",
    metavar="B",
    default=0.0,
    show_default=True,
)
@_option(
    "--side-offset",
    -1.0,
    1.0,
    "0.1",
    "How far to the right of the centre; below 0 to the left.",
    metavar="B",
    default=0.0,
    show_default=True,
)
@_option(
    "--table-speed",
    5.0,
    1000.0,
    "100",
    "How far the balls roll, as `physics speed` tells it.",
    default=100.0,
    show_default=True,
)
@_option(
    "--table-length",
    20.0,
    1e4,
    "88",
    "Between the end cushions; half as wide.  [default: 100 inches]",
    metavar="LENGTH",
)
@_option(
    "--mu", 0.0, 1.0, "0.06", "Friction between the balls.  [default: 4/72]", default=4.0 / 72.0
)
@click.option(
    "--friction",
    type=click.Choice(["limited", "shepard"]),
    default="limited",
    show_default=True,
    help="Let friction end when the slip does, or be the law of the source text.",
)
@kit_options
@wants_metric
@wants_json
@plot_option
def command(
    units: Units, mu: float, friction: str, as_json: bool, plot: str | None, **how: Any
) -> None:
    """Trace a shot: where both balls go, and where they come to rest.

    Either --cut and --distance say where the object ball is, the shot along the middle of
    the table; or --cue-ball, --object-ball and --pocket say where the balls are and where
    the object ball shall go. The way of a ball ends at the first cushion.
    """
    from evenbreak.cli.physics.shot_words import answer, phase_rows, phases_text, sentences, shown
    from evenbreak.physics import Cloth, Table

    table = Table()
    if how["table_length"] is not None:
        length = how["table_length"] * units.length
        table = Table(length=length, width=0.5 * length)
    cloth = Cloth(mu_slide=how["cloth_mu"], mu_roll=1.0 / how["table_speed"])
    hit = _strike(how, units)
    pocket = _pocket(how, table)
    kit: dict[str, Any] = {"cloth": cloth, "table": table, "mu": mu, "friction": friction}
    traced = _traced(hit, how, units, pocket=pocket, **kit)
    if plot is not None:
        from evenbreak.plots.traced_shot import shot_on_table

        write_plot(shot_on_table(traced), plot)
    found = answer(traced, units)
    if as_json:
        rows = phase_rows(traced, units)
        print_json({**found, "phases": rows, "schema_version": SCHEMA_VERSION})
        return
    typed = {name: how[name] for name in ("stick", "ball", "speed", "stick_speed")}
    heading = sentences(traced, units, pocket) + doubts(units, **typed)
    print_answer(found, shown=shown(units), heading=heading, as_json=False)
    phases = phases_text(traced, units)
    if phases and to_terminal():
        click.echo(f"\n{phases}", nl=False)


def _strike(how: dict[str, Any], units: Units) -> Strike:
    """Return the hit of the tip, or refuse it."""
    from evenbreak.physics import miscue_offset
    from evenbreak.physics.strike import strike, strike_for_speed

    if (how["speed"] is None) == (how["stick_speed"] is None):
        refuse("Give --speed, of the cue ball, or --stick-speed, of the cue: one of the two")
    up, right = how["offset"], how["side_offset"]
    most = miscue_offset(how["tip_mu"])
    if math.hypot(up, right) > most:
        refuse(
            f"--offset {up:g} with --side-offset {right:g} is a miscue: the tip slips beyond "
            f"{most:.3g} of the radius; give less, or a higher --tip-mu"
        )
    kit: dict[str, Any] = {
        "ball": ball_of(how["ball"], units),
        "cue": cue_of(how["stick"], how["tip_mu"], units),
    }
    if how["speed"] is not None:
        return strike_for_speed(how["speed"] * units.speed, up, right, **kit)
    return strike(how["stick_speed"] * units.speed, up, right, **kit)


def _pocket(how: dict[str, Any], table: Table) -> Pocket | None:
    """Return the pocket of that name, None where there is none; refuse half of a layout."""
    from evenbreak.physics import POCKET_NAMES, pockets

    angles = [f"--{name}" for name in ("cut", "distance") if how[name] is not None]
    names = {"object_ball": "--object-ball", "pocket": "--pocket"}
    where = [option for name, option in names.items() if how[name] is not None]
    if len(angles) % 2 or len(where) % 2 or bool(angles) == bool(where):
        both = angles and where
        refuse(
            "Say where the balls are"
            + (f" in one way, not with {angles[0]} beside {where[-1]}" if both else "")
            + ": give --cut and --distance, or --cue-ball, --object-ball and --pocket"
        )
    if angles:
        return None
    if how["pocket"] not in POCKET_NAMES:
        refuse(f"--pocket {how['pocket']!r}; give one of {', '.join(POCKET_NAMES)}")
    return pockets(table)[POCKET_NAMES.index(how["pocket"])]


def _traced(
    hit: Strike, how: dict[str, Any], units: Units, *, pocket: Pocket | None, **kit: Any
) -> Shot | AimedShot:
    """Return the shot of either way to say where the balls are, or refuse it."""
    from evenbreak.errors import InputError
    from evenbreak.physics import pocketed_shot, shot

    table: Table = kit["table"]
    places = [_metres(how[name], units) for name in ("cue_ball", "object_ball")]
    _check_places(places, table, hit.ball.radius, units)
    start = places[0] or (0.25 * table.length, 0.5 * table.width)
    standing = places[1] or start
    try:
        if pocket is None:
            apart = how["distance"] * units.length
            return shot(hit, math.radians(how["cut"]), apart, cue_ball=start, **kit)
        if math.dist(standing, (pocket.x, pocket.y)) <= hit.ball.radius:
            refuse(
                f"--object-ball hangs in --pocket {how['pocket']}, where any hit that pushes it "
                "in will do; put it farther out, or say --cut and --distance"
            )
        found = pocketed_shot(hit, start, standing, pocket, **kit)
    except InputError:
        apart = how["distance"] * units.length if pocket is None else math.dist(start, standing)
        _refuse_layout(how, units, apart, hit.ball.diameter)
    if found.shot.collision is None and found.shot.approach.ending != "rest":
        x, y = how["object_ball"]
        refuse(
            f"--object-ball {x:g},{y:g} is so near a cushion that the cue ball would have to be "
            f"in it to send the ball into --pocket {pocket.name}, throw allowed for; put it "
            "farther out, name another pocket, or give outside english (--side-offset), which "
            "throws less"
        )
    return found


def _metres(place: tuple[float, float] | None, units: Units) -> tuple[float, float] | None:
    return None if place is None else (place[0] * units.length, place[1] * units.length)


def _check_places(
    places: list[tuple[float, float] | None], table: Table, radius: float, units: Units
) -> None:
    """Refuse a ball that is not on the table."""
    for name, place in zip(("--cue-ball", "--object-ball"), places, strict=True):
        if place is None:
            continue
        if not all(
            radius - 1e-9 <= at <= size - radius + 1e-9
            for at, size in zip(place, (table.length, table.width), strict=True)
        ):
            x, y = (f"{at / units.length:g}" for at in place)
            room = [f"{size / units.length:g}" for size in (table.length, table.width)]
            refuse(
                f"{name} {x},{y} is not on the table, which is {' by '.join(room)} "
                f"{units.length_word}; a ball's centre is at least "
                f"{radius / units.length:.4g} from each cushion"
            )


def _refuse_layout(how: dict[str, Any], units: Units, apart: float, diameter: float) -> NoReturn:
    """Say why there is no shot where the balls were said to be."""
    touching = f"{diameter / units.length:.4g} {units.length_word}"
    if how["pocket"] is not None:
        if apart < diameter * (1.0 - 1e-9):
            refuse(f"--cue-ball and --object-ball overlap; put them more than {touching} apart")
        if apart < diameter * (1.0 + 1e-9):
            refuse(
                "--cue-ball and --object-ball touch: but for throw the object ball goes along the "
                f"line through them, wherever you aim; put them more than {touching} apart"
            )
        refuse(
            f"--pocket {how['pocket']} is where no cut sends the object ball: it would take a "
            "right angle or more; name another pocket"
        )
    if apart < diameter:
        refuse(
            f"--distance {how['distance']:g} is between the centres; give {touching}, where the "
            "balls touch, or more"
        )
    refuse(
        f"--distance {how['distance']:g} puts the object ball off the table; give less, or "
        "another --cue-ball"
    )
