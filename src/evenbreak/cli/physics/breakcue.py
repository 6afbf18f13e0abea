"""`evenbreak physics breakcue`: which cue breaks best for an arm."""

from __future__ import annotations

import math

import click

from evenbreak.cli.kit.callbacks import wants_json
from evenbreak.cli.physics.equipment_options import ball_of, doubts
from evenbreak.cli.physics.units import Measure, Units, decimals, print_answer, wants_metric
from evenbreak.physics.units import OUNCE

EXAMPLES = """\b
Examples:
  evenbreak physics breakcue --forearm 36
  evenbreak physics breakcue --forearm 36 --stick 19
  evenbreak physics breakcue --forearm 1020 --ball 165 --metric
"""


@click.command("breakcue", epilog=EXAMPLES)
@click.option(
    "--forearm",
    metavar="WEIGHT",
    type=Measure(0.0, 1e6, "36"),
    required=True,
    help="Of forearm and hand; of the whole arm, if you break from the shoulder.",
)
@click.option(
    "--ball",
    metavar="WEIGHT",
    type=Measure(0.01, 1e5, "6"),
    help="Of the cue ball.  [default: 6 ounces]",
)
@click.option(
    "--stick",
    metavar="WEIGHT",
    type=Measure(0.01, 1e5, "19"),
    help="Compare with a cue of this weight.",
)
@wants_metric
@wants_json
def command(
    forearm: float, ball: float | None, stick: float | None, units: Units, as_json: bool
) -> None:
    """Tell which cue breaks best for an arm.

    The best cue gives the cue ball the largest share of the energy that the muscles put into
    arm and cue together, for a forearm that swings from the elbow as a uniform rod.
    """
    from evenbreak.physics import best_stick_ratio, break_energy_share

    mass = ball_of(ball, units).mass
    arm = forearm * units.mass / mass
    best = best_stick_ratio(arm)
    most = break_energy_share(best, arm)
    share = None if stick is None else break_energy_share(stick * units.mass / mass, arm)
    in_units, ounces = best * mass / units.mass, best * mass / OUNCE
    answer = {
        "optimal_cue_oz": ounces,
        f"optimal_cue_{units.mass_key}": in_units,
        "energy_share": most,
        "stick_energy_share": share,
        "stick_speed_share": None if share is None else math.sqrt(share / most),
    }
    name = f"optimal_cue_{units.mass_key}"
    heading = f"The best cue to break with weighs {decimals(in_units, 1)} {units.mass_word}."
    if share is not None:
        lost = 100.0 * (1.0 - math.sqrt(share / most))
        heading += (
            f"\nOne of {stick:g} {units.mass_word} breaks {_slower(lost)}, with the same effort."
        )
    heading += doubts(units, forearm=forearm, stick=stick, ball=ball)
    print_answer(
        answer,
        shown={
            name: (f"best cue, {units.mass_word}", 1),
            "energy_share": ("share of the stroke's energy that the cue ball gets", 3),
            "stick_energy_share": ("the same with the cue of --stick", 3),
            "stick_speed_share": ("speed of the break with that cue over the best", 3),
        },
        heading=heading,
        as_json=as_json,
    )


def _slower(lost: float) -> str:
    """Return by how many per cent a break is slower, in words.

    >>> _slower(1.23), _slower(0.0004)
    ('1.2 % slower', 'as fast')
    """
    percent = decimals(lost, 1)
    return f"{percent} % slower" if float(percent) else "as fast"
