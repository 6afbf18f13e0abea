"""`evenbreak physics shot`: a shot traced whole, and drawn."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import click

from evenbreak import physics, plots
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import numbers, refuse
from evenbreak.cli.physics.equipment_options import ball_of, cue_of, equipment_options
from evenbreak.cli.physics.hit_options import friction_options, tip_options
from evenbreak.cli.physics.layout import layout_of, traced_shot
from evenbreak.cli.physics.measures import LENGTH, Measure, metric_option

EXAMPLES = """\b
Examples:
  evenbreak physics shot --cut 30 --distance 24 --speed 80 --offset -0.3
  evenbreak physics shot --cut 30 --distance 24 --speed 80 --mu by-speed
  evenbreak physics shot --cut -45 --distance 20 --speed 50 --plot shot.svg
  evenbreak physics shot --cue-ball 25,16 --object-ball 50,25 --pocket foot-left --speed 60
"""


PACE = Measure("speed", 0.0, 1e4, "80")


PLACE = numbers(
    "[,;]",
    range(2, 3),
    -math.inf,
    math.inf,
    "give two numbers with a comma between them, such as 25,16: along "
    "the table from the head cushion, and across it from the right cushion",
)


@click.command("shot", epilog=EXAMPLES)
@click.option(
    "--cut", type=Measure("degrees", -89.0, 89.0, "30"), help="Cut angle, to the left below 0."
)
@click.option("--distance", type=LENGTH, help="Between the centres of the two balls.")
@click.option(
    "--cue-ball",
    metavar="X,Y",
    type=PLACE,
    help="Where it is: X from the head cushion, Y from the right one.  [default: 25,25 inches]",
)
@click.option("--object-ball", metavar="X,Y", type=PLACE, help="Where it is, in place of --cut.")
@click.option(
    "--pocket",
    metavar="NAME",
    help="Aim there, allowing for throw: head-, side- or foot-, then left or right.",
)
@click.option("--speed", type=PACE, help="Speed of the cue ball just after the tip.")
@click.option("--stick-speed", type=PACE, help="Speed of the cue, in place of --speed.")
@tip_options(default=0.0)
@click.option(
    "--table-speed",
    type=Measure("number", 5.0, 1000.0, "100"),
    default=100.0,
    help="How fast the table is, as found by `physics speed`.",
)
@click.option(
    "--table-length",
    type=Measure("length", 20.0, 1e4, "88"),
    help="Between the end cushions; half as wide.  [default: 100 inches]",
)
@friction_options
@equipment_options
@metric_option
@plot_option
@faces()
def command(units: Units, plot: str | None, **how: Any) -> Answer:
    """Trace a shot: where both balls go, and where they stop.

    Say where the object ball is with --cut and --distance (the shot then goes along the
    middle of the table), or give --cue-ball, --object-ball and --pocket, and the shot is
    aimed there. A ball is followed up to its first cushion.
    """
    from evenbreak.answers.physics.shot import shot_answer
    from evenbreak.answers.physics.units import unit_doubts

    places = ("cut", "distance", "cue_ball", "object_ball", "pocket", "table_length")
    layout = layout_of(units, **{name: how[name] for name in places})
    cloth = physics.Cloth(mu_slide=how["cloth_mu"], mu_roll=1.0 / how["table_speed"])
    mu = physics.BALL_FRICTION if how["mu"] is None else how["mu"]
    friction = {"mu": mu, "friction": how["friction"]}
    traced = traced_shot(_strike(how, units), layout, cloth=cloth, **friction)
    if plot is not None:
        write_plot(plots.shot_on_table(traced), plot)
    typed = {name: how[name] for name in ("stick", "ball", "speed", "stick_speed")}
    return replace(shot_answer(traced, units, layout.pocket), warnings=unit_doubts(units, **typed))


def _strike(how: dict[str, Any], units: Units) -> physics.Strike:
    """Return the hit of the tip, or refuse it."""
    if (how["speed"] is None) == (how["stick_speed"] is None):
        refuse("give either --speed, that of the cue ball, or --stick-speed, that of the cue")
    up, right = how["offset"], how["side_offset"]
    most = physics.miscue_offset(how["tip_mu"])
    if math.hypot(up, right) > most:
        refuse(
            f"--offset {up:g} with --side-offset {right:g} is a miscue: the tip slips beyond "
            f"{most:.3g} of the radius; give less, or a higher --tip-mu"
        )
    ball, cue = ball_of(how["ball"], units), cue_of(how["stick"], how["tip_mu"], units)
    if how["speed"] is not None:
        return physics.strike_for_speed(
            how["speed"] * units.speed.size, up, right, ball=ball, cue=cue
        )
    return physics.strike(how["stick_speed"] * units.speed.size, up, right, ball=ball, cue=cue)
