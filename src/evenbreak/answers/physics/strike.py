"""What a cue does to the cue ball, which cue breaks fastest, and how fast a table is."""

import math
from dataclasses import replace

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities, Quantity
from evenbreak.answers.kit.wording import decimals
from evenbreak.answers.physics.hit import spin_words
from evenbreak.answers.physics.units import IMPERIAL, Unit, Units
from evenbreak.errors import InputError
from evenbreak.physics.friction import miscue_offset, tip_friction_of
from evenbreak.physics.objects import Cloth
from evenbreak.physics.offset import (
    ContactPoint,
    ball_speed_ratio,
    effective_contact,
    roll_side,
    stun_offset,
)
from evenbreak.physics.rolling import TABLE_SPEEDS, lag_speed, table_speed
from evenbreak.physics.slide import drag_distance, roll_speed, stun_distance
from evenbreak.physics.strike import Strike, best_stick_ratio, break_energy_share
from evenbreak.words import Parameter, say

MOST_TIP_FRICTION = 1.0
"""No tip has a higher coefficient of friction."""


def strike_answer(
    strike: Strike,
    units: Units,
    *,
    cloth: Cloth,
    distance: float | None = None,
    speed_known: bool = True,
) -> Answer:
    """Return what a stroke does to the cue ball, and whether it is a miscue.

    The spin is given after `distance` meters on the cloth; if the speed isn't known, there are only
    ratios.
    """
    found = _found(strike, cloth, units, distance, speed_known)
    if strike.miscue:  # the tip slips, and none of this comes true
        found = [replace(one, value=None) for one in found]
        sentence = _miscue_words(strike)
    else:
        values = {one.name: one.value for one in found}
        sentence = _words(strike, units, values, distance, speed_known)
    place = {
        "offset": strike.offset,
        "side_offset": strike.side_offset,
        "off_center": strike.off_center,
        "miscue": strike.miscue,
        "miscue_offset": miscue_offset(strike.cue.tip_friction),
    }
    speed = f"; cue at {units.speed.typed(strike.stick_speed)}" if speed_known else ""
    return Answer(
        f"{tip_words(strike)}{speed}", [sentence, Quantities([*quantities_of(place), *found])]
    )


def tip_words(strike: Strike) -> str:
    """Return where the tip hits, in ball radii.

    >>> from evenbreak.physics import strike
    >>> tip_words(strike(1.0, -0.3, 0.1)), tip_words(strike(1.0))
    ('Tip 0.3 radii below and 0.1 radii right of the center', 'Tip in the center')
    """
    up, right = strike.offset, strike.side_offset
    places = []
    if up:
        places.append(f"{abs(up):g} radii {'above' if up > 0.0 else 'below'}")
    if right:
        places.append(f"{abs(right):g} radii {'right' if right > 0.0 else 'left'} of")
    return f"Tip {' and '.join(places)} the center" if places else "Tip in the center"


def _miscue_words(strike: Strike) -> str:
    needed = math.ceil(1000.0 * tip_friction_of(strike.off_center)) / 1000.0
    limit = miscue_offset(strike.cue.tip_friction)
    if needed > MOST_TIP_FRICTION:
        return say(
            "This is a miscue: the tip slips when you hit that far from the center. Hit no "
            "farther from it than {limit:.3f} of the radius.",
            limit=limit,
        )
    return say(
        "This is a miscue: the tip slips when you hit that far from the center. Hit no farther "
        "from it than {limit:.3f} of the radius, or use a tip whose friction is {needed:g} or "
        "more ({option} {needed:g}).",
        limit=limit,
        needed=needed,
        option=Parameter("tip_mu"),
    )


def _words(
    strike: Strike,
    units: Units,
    found: dict[str, float | None],
    distance: float | None,
    speed_known: bool,
) -> str:
    hand = "right" if strike.side > 0.0 else "left"
    english = f" and {hand} english" if strike.side else ""
    pace = f" at {units.speed.text(strike.speed)}" if speed_known else ""
    text = f"No miscue: the cue ball leaves{pace} with {spin_words(strike.topspin)}{english}."
    stun, roll = (found[f"{name}_{units.length.key}"] for name in ("stun", "slide"))
    if roll:
        start = "" if stun is None else f"is a stun shot after {decimals(1)(stun)} "
        start += f"{units.length.words} and " if start else ""
        text += f" It {start}rolls after {decimals(1)(roll)} {units.length.words}."
    later = found["later_spin_speed_ratio"]
    if distance is not None and later is not None:
        spin = spin_words(round(later, 2) + 0.0)
        text += f" After {units.length.typed(distance)} it has {spin}."
    return text


def _found(
    strike: Strike, cloth: Cloth, units: Units, distance: float | None, speed_known: bool
) -> list[Quantity]:
    """Return the ball's spins, speeds and distances."""
    ratio = ball_speed_ratio(strike.off_center, strike.ball.mass / strike.cue.mass)
    spins = {
        "spin_speed_ratio": strike.topspin,
        "side_spin_speed_ratio": strike.side,
        "roll_side_spin_speed_ratio": roll_side(-strike.side_offset, 1.0 + strike.offset),
        "ball_speed_ratio": ratio,
        "roll_speed_ratio": roll_speed(ratio, ratio * strike.topspin),
    }
    spin, pace = strike.topspin, strike.speed
    stun = stun_distance(pace, spin, cloth) if spin < 0.0 else None
    speed, length = units.speed.quantity, units.length.quantity
    moving = [
        speed("ball_speed", pace),
        speed("stick_speed_after", strike.stick_speed_after),
        speed("roll_speed", roll_speed(pace, pace * spin)),
        length("slide", drag_distance(pace, spin, cloth)),
        length("stun", stun),
    ]
    if not speed_known:
        moving = [replace(one, value=None) for one in moving]
    later = quantities_of(_later(strike, cloth, distance))
    return [*quantities_of(spins), *moving, *later]


def _later(strike: Strike, cloth: Cloth, distance: float | None) -> dict[str, float | None]:
    """Return the spin after a distance, and where to hit for a stun shot at that distance."""
    names = ("later_spin_speed_ratio", "later_side_spin_speed_ratio", "later_offset", "stun_offset")
    if distance is None:
        return dict.fromkeys(names)
    struck = ContactPoint(-strike.side_offset, 1.0 + strike.offset)
    now = effective_contact(struck, strike.speed, _time_to(distance, strike, cloth), cloth)
    stun = _stun(strike, distance, cloth)
    return dict(zip(names, (2.5 * (now.z - 1.0), -2.5 * now.y, now.z - 1.0, stun), strict=True))


def _stun(strike: Strike, distance: float, cloth: Cloth) -> float | None:
    """Return the offset for a stun shot after a distance; None if it would be a miscue."""
    try:
        offset = float(stun_offset(strike.speed, distance, cloth))
    except InputError:  # a ball of this speed does not slide so far
        return None
    return offset if -offset <= miscue_offset(strike.cue.tip_friction) else None


def _time_to(distance: float, strike: Strike, cloth: Cloth) -> float:
    """Return when the ball has slid a distance, or starts rolling before that, in seconds."""
    speed, slip = float(strike.speed), 1.0 - float(strike.topspin)
    slowing = math.copysign(cloth.mu_slide * cloth.gravity, slip)
    rolls = 2.0 * abs(slip) * speed / (7.0 * abs(slowing))
    left = speed**2 - 2.0 * slowing * distance
    return rolls if left < 0.0 else min(rolls, 2.0 * distance / (speed + math.sqrt(left)))


def break_cue_answer(forearm: float, ball: float, weight: Unit, stick: float | None) -> Answer:
    """Return the weight of the best break cue; masses are in kilograms."""
    arm = forearm / ball
    best = best_stick_ratio(arm)
    most = break_energy_share(best, arm)
    share = None if stick is None else break_energy_share(stick / ball, arm)
    speed = None if share is None else math.sqrt(share / most)
    sentence = f"The best cue to break with weighs {weight.text(best * ball)}."
    if stick is not None and speed is not None:
        weighing = f" One that weighs {weight.typed(stick)}"
        sentence += f"{weighing} breaks {_slower(speed)} for the same effort."
    optimal = weight.quantity("optimal_cue", best * ball)
    ounces = IMPERIAL.mass.quantity("-optimal_cue", best * ball)
    values = {"energy_share": most, "stick_energy_share": share, "stick_speed_share": speed}
    quantities = [
        *([optimal] if weight is IMPERIAL.mass else [ounces, optimal]),
        *quantities_of(values),
    ]
    return Answer(
        f"Forearm and hand: {weight.typed(forearm)}; cue ball: {weight.typed(ball)}",
        [sentence, Quantities(quantities)],
    )


def _slower(speed: float) -> str:
    """Return how a break compares with the best cue's, given the ratio of their speeds.

    >>> _slower(0.9877), _slower(0.999996)
    ('1.2% slower', 'as fast')
    """
    percent = decimals(1)(100.0 * (1.0 - speed))
    return f"{percent}% slower" if float(percent) else "as fast"


_LEAST, _MOST = 40.0, 250.0
"""Outside these speeds, a wrong time or unit is likelier than such a table."""


def table_speed_answer(lag_time: float, distance: float, units: Units) -> Answer:
    """Return a table's speed, from the seconds and meters that the ball's center rolls.

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
            f"hardly any table has a speed of {decimals(0)(speed)}. Check the time, and make "
            f"sure that lengths are in {units.length.words}."
        )
    return Answer(
        f"A lag of {lag_time:g} seconds over {units.length.text(distance, 2)}",
        [f"The table speed is {decimals(0)(speed)}: {cloth}.", Quantities(quantities)],
        warnings=doubts,
    )


def cloth_class(speed: float) -> str:
    """Return what a table this fast is called.

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
