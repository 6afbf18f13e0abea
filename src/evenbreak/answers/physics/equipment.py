"""Which cue gives an arm the fastest break."""

import math

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities
from evenbreak.answers.kit.wording import decimals
from evenbreak.answers.physics.units import IMPERIAL, Unit, Units
from evenbreak.physics.rolling import TABLE_SPEEDS, lag_speed, table_speed
from evenbreak.physics.strike import best_stick_ratio, break_energy_share


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
    optimal = weight.quantity("optimal_cue", best * ball)
    ounces = IMPERIAL.mass.quantity("-optimal_cue", best * ball)
    values = {"energy_share": most, "stick_energy_share": share, "stick_speed_share": speed}
    quantities = [
        *([optimal] if weight is IMPERIAL.mass else [ounces, optimal]),
        *quantities_of(values),
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


_LEAST, _MOST = 40.0, 250.0
"""Outside these speeds a wrong time or unit is likelier than such a table."""


def table_speed_answer(lag_time: float, distance: float, units: Units) -> Answer:
    """Return the speed of a table, from seconds and the metres that the ball's centre rolls.

    >>> from evenbreak.answers.physics.units import IMPERIAL
    >>> table_speed_answer(7.0, 2.48285, IMPERIAL).sentences
    ['The table speed is 97: normal.']
    """
    speed = table_speed(lag_time, distance=distance)
    cloth = cloth_class(speed)
    values = {"table_speed": speed, "mu_roll": 1.0 / speed, "cloth": cloth}
    pace = lag_speed(lag_time, distance=distance)
    quantities = [
        *quantities_of(values),
        units.speed.quantity("first_speed", pace),
        units.length.quantity("roll", distance),
    ]
    doubts = []
    if not _LEAST <= speed <= _MOST:
        doubts.append(
            f"hardly any table has a speed of {decimals(0)(speed)}; check the time, and that "
            f"lengths are in {units.length.words}"
        )
    return Answer(
        f"A lag of {lag_time:g} seconds over {units.length.text(distance, 2)}",
        [f"The table speed is {decimals(0)(speed)}: {cloth}.", Quantities(quantities)],
        warnings=doubts,
    )


def cloth_class(speed: float) -> str:
    """Return what a table of this speed is called.

    >>> [cloth_class(speed) for speed in (40.0, 75.0, 100.0, 110.0, 130.0, 160.0)]
    ... # doctest: +NORMALIZE_WHITESPACE
    ['slower than very slow', 'between very slow and normal', 'normal',
     'between normal and very fast', 'very fast', 'fast billiard']
    """
    below = None
    for name, (low, high) in TABLE_SPEEDS.items():
        if speed < low:
            return f"slower than {name}" if below is None else f"between {below} and {name}"
        if speed <= high:
            return name
        below = name
    return str(below)
