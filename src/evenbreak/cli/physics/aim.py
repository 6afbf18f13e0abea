"""`evenbreak physics aim`: how to allow for throw."""

from __future__ import annotations

import math
from typing import Any

import click

from evenbreak.cli.kit.callbacks import refuse, wants_json
from evenbreak.cli.physics.hit_options import Hit, hit_options
from evenbreak.cli.physics.units import Measure, Units, decimals, print_answer, wants_metric
from evenbreak.errors import InputError

EXAMPLES = """\b
Examples:
  evenbreak physics aim --cut 14.5 --distance 36
  evenbreak physics aim --cut -14.5 --distance 36 --topspin 0 --mu 0.06
  evenbreak physics aim --cut 30 --distance 100 --side 0.2 --metric
"""


@click.command("aim", epilog=EXAMPLES)
@hit_options
@click.option(
    "--distance",
    metavar="LENGTH",
    type=Measure(0.1, 1e5, "36"),
    required=True,
    help="From the object ball to the pocket.",
)
@wants_metric
@wants_json
def command(distance: float, units: Units, as_json: bool, **how: Any) -> None:
    """Tell where to aim, so that the thrown ball goes in.

    --cut is the angle at which the object ball has to leave. The answer is a point beside
    the middle of the pocket: aim for it as if there were no throw. The rule by hand is
    friction x distance x share of the friction that throws; for natural roll without
    english that share is the sine of the cut angle, 1/2 for a half-ball hit.
    """
    from evenbreak.physics import aim

    hit = Hit(**how)
    try:
        found = aim(
            hit.angle,
            distance,
            hit.topspin,
            hit.side_in_frame,
            mu=hit.mu,
            friction=hit.friction,
        )
    except InputError:
        refuse(
            f"--cut {hit.cut:g} cannot be reached: friction throws every hit fuller than that; "
            "give a smaller cut angle, or other --topspin and --side"
        )
    mirror = -1.0 if hit.cut < 0.0 else 1.0
    offset, rule = f"offset_{units.length_key}", f"rule_offset_{units.length_key}"
    answer = {
        **hit.as_answer(),
        f"distance_{units.length_key}": distance,
        "throw_deg": math.degrees(found.throw),
        "aim_cut_deg": mirror * math.degrees(found.cut),
        offset: mirror * found.offset,
        rule: mirror * found.offset_of_text,
    }
    print_answer(
        answer,
        shown={
            "throw_deg": ("throw, degrees", 2),
            "aim_cut_deg": ("cut angle to aim for, degrees", 2),
            offset: (f"aim right of the pocket's centre, {units.length_word}", 2),
            rule: ("the same by the rule", 2),
        },
        heading=f"{hit.text}\n{_advice(answer[offset], found.cut, hit, units)}",
        as_json=as_json,
    )


def _advice(offset: float, cut: float, hit: Hit, units: Units) -> str:
    """Return where to aim, in a sentence; an offset above 0 is to the right.

    `cut` is the cut angle to aim for, below 0 where it is to the other side.
    """
    amount = decimals(abs(offset))
    if float(amount) == 0.0:
        return f"Aim at the pocket's centre: throw is less than 0.01 {units.length_word} there."
    turn = "right" if offset > 0.0 else "left"
    thin = ", a thinner cut" if turn == hit.turn else ", a fuller cut"
    if hit.cut == 0.0:
        thin = ""
    elif cut < 0.0:
        thin = f", a cut to the {hit.other_turn}"
    return (
        f"Aim {amount} {units.length_word} to the {turn} of the pocket's centre{thin}: the throw "
        "brings the ball back."
    )
