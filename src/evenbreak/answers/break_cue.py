"""Which cue gives an arm the fastest break."""

import math

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Quantities
from evenbreak.answers.shot_units import IMPERIAL, Unit
from evenbreak.answers.worded import worded
from evenbreak.answers.wording import decimals
from evenbreak.physics.tip import best_stick_ratio, break_energy_share

_WORDS = {
    "energy_share": ("share of the stroke's energy that reaches the cue ball", 3),
    "stick_energy_share": ("the same with your cue (--stick)", 3),
    "stick_speed_share": ("speed of the break with your cue / with the best", 3),
}


def break_cue_answer(forearm: float, ball: float, weight: Unit, stick: float | None) -> Answer:
    """Return the weight of the best cue to break with.

    Parameters
    ----------
    forearm, ball, stick
        the masses of forearm and hand, of the cue ball and of a cue to compare, in kilograms.
    weight
        in which the answer is given.

    >>> from evenbreak.physics.units import OUNCE
    >>> answer = break_cue_answer(36.0 * OUNCE, 6.0 * OUNCE, IMPERIAL.mass, 19.0 * OUNCE)
    >>> print(answer.sentences[0])
    The best cue to break with weighs 15.4 ounces. One of 19 ounces breaks 0.7% slower for the
    same effort.
    """
    arm = forearm / ball
    best = best_stick_ratio(arm)
    most = break_energy_share(best, arm)
    share = None if stick is None else break_energy_share(stick / ball, arm)
    speed = None if share is None else math.sqrt(share / most)
    sentence = f"The best cue to break with weighs {weight.text(best * ball)}."
    if stick is not None and speed is not None:
        sentence += f" One of {weight.typed(stick)} breaks {_slower(speed)} for the same effort."
    optimal = weight.quantity("optimal_cue", best * ball, "best cue", 1)
    ounces = IMPERIAL.mass.quantity("optimal_cue", best * ball)
    values = {"energy_share": most, "stick_energy_share": share, "stick_speed_share": speed}
    quantities = [
        *([optimal] if weight is IMPERIAL.mass else [ounces, optimal]),
        *worded(values, _WORDS),
    ]
    return Answer(
        f"Forearm and hand of {weight.typed(forearm)}, cue ball of {weight.typed(ball)}",
        [sentence, Quantities(quantities)],
    )


def _slower(speed: float) -> str:
    """Return how a break compares, from its speed over that with the best cue.

    >>> _slower(0.9877), _slower(0.999996)
    ('1.2% slower', 'as fast')
    """
    percent = decimals(1)(100.0 * (1.0 - speed))
    return f"{percent}% slower" if float(percent) else "as fast"
