"""A shot traced from the tip until both balls stop: where they go, and how they get there."""

import math
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.hit import SQUIRT, friction_values
from evenbreak.answers.parts import Column, Quantities, Quantity, Table
from evenbreak.answers.shot_units import Units
from evenbreak.answers.shot_words import shot_heading, shot_words
from evenbreak.answers.worded import worded
from evenbreak.answers.wording import decimals
from evenbreak.physics.aimed import AimedShot
from evenbreak.physics.deflection import deflection
from evenbreak.physics.leg import Leg, Phase
from evenbreak.physics.pockets import Pocket
from evenbreak.physics.shot import Shot, spin_ratios

_WORDS = {
    "cut_deg": ("cut angle, degrees", 2),
    "hit_spin_speed_ratio": ("topspin J at the hit (1 is natural roll)", 3),
    "hit_side_spin_speed_ratio": ("sidespin J at the hit (above 0 is right)", 3),
    "throw_deg": ("throw of the object ball, degrees", 2),
    "deflection_thrown_deg": ("deflection of the cue ball, degrees", 2),
}
_DETAILS = {
    "deflection_deg": ("deflection without friction between the balls, degrees", 2),
    "energy_lost_at_hit_j": ("energy lost at the hit, joules", 3),
}


def shot_answer(traced: Shot | AimedShot, units: Units, pocket: Pocket | None = None) -> Answer:
    """Return where both balls of a shot go, and how.

    Parameters
    ----------
    traced
        the shot.
    units
        in which the answer is given.
    pocket
        at which an aimed shot is aimed.

    >>> import math
    >>> from evenbreak.answers.shot_units import METRIC
    >>> from evenbreak.physics import shot, strike_for_speed
    >>> found = shot(strike_for_speed(1.1), math.radians(30.0), 0.5)
    >>> print(shot_answer(found, METRIC).sentences[0])
    The object ball stops after 5.15 s, 205.5 centimetres from the head cushion and 11.0 from
    the right one. The cue ball stops after 4.67 s, 175.4 centimetres from the head cushion and
    112.4 from the right one.
    """
    aimed = traced if isinstance(traced, AimedShot) else None
    found = traced.shot if isinstance(traced, AimedShot) else traced
    quantities = [
        *_tip(found, units),
        *_hit(found, units),
        *_aim(aimed, units),
        *_way("approach", "", found.approach, units),
        *_way("cue", "cue ball", found.cue_leg, units),
        *_way("object", "object ball", found.object_leg, units),
    ]
    words = shot_words(found, aimed, units, pocket) + ([SQUIRT] if found.strike.side else [])
    return Answer(
        shot_heading(found, units, pocket),
        [*words, Quantities(quantities), _phases(found, units)],
        data={"phases": [_record(leg, phase, units) for leg, phase in _moves(found)]},
    )


def _tip(found: Shot, units: Units) -> list[Quantity]:
    strike = found.strike
    values = {
        "spin_speed_ratio": strike.topspin,
        "side_spin_speed_ratio": strike.side,
        "direction_deg": _degrees(-math.remainder(found.direction, 2.0 * math.pi)),
        "cut_deg": _degrees(found.cut),
        "reached": found.reached,
    }
    return [
        units.speed.quantity("ball_speed", strike.speed, "speed of the cue ball off the tip"),
        units.speed.quantity("stick_speed", strike.stick_speed),
        *worded(values, _WORDS),
    ]


def _hit(found: Shot, units: Units) -> list[Quantity]:
    """Return what is known of the hit and of the angles after it."""
    state, throw = found.at_hit, found.throw
    speed = topspin = side = object_cut = smooth = lost = None
    if state is not None and throw is not None:
        speed, cut = state.speed, abs(found.cut)
        topspin, side = spin_ratios(state, found.strike.ball.radius)
        object_cut = math.copysign(1.0, found.cut) * (cut - throw)
        lost = found.approach.energy(state.time).total - found.energy(state.time).total
        if cut or abs(topspin) >= 1e-9:  # a full hit with stun leaves the cue ball where it is
            smooth = deflection(cut, topspin)
    values = {
        "hit_spin_speed_ratio": topspin,
        "hit_side_spin_speed_ratio": side,
        "throw_deg": _degrees(throw),
        "object_cut_deg": _degrees(object_cut),
        "deflection_deg": _degrees(smooth),
        "deflection_thrown_deg": _degrees(found.deflection),
        "energy_lost_at_hit_j": lost,
    }
    return [
        Quantity("hit_s", state and state.time),
        units.speed.quantity("hit_speed", speed, "speed of the cue ball at the hit"),
        *worded(friction_values(found.mu, found.collision, found.friction), {}),
        *worded(values, _WORDS, _DETAILS),
    ]


def _aim(aimed: AimedShot | None, units: Units) -> list[Quantity]:
    x = y = offset = turn = miss = None
    if aimed is not None:
        x, y = map(float, aimed.target)
        right = math.copysign(1.0, aimed.unaided.cut)  # thinner is to the right in a cut to it
        offset, turn, miss = right * aimed.offset, right * aimed.turn, aimed.miss
    length = units.length.quantity
    return [
        length("target_x", x),
        length("target_y", y),
        length("aim_offset", offset),
        Quantity("aim_turn_deg", _degrees(turn)),
        length("miss", miss),
    ]


def _way(name: str, ball: str, leg: Leg | None, units: Units) -> list[Quantity]:
    """Return how far a ball slides and rolls, and where and how its way ends."""
    slides = rolls = x = y = time = speed = ending = pocket = None
    if leg is not None:
        lengths = {phase.motion: phase.length for phase in leg.phases}
        slides, rolls = lengths.get("slides", 0.0), lengths.get("rolls", 0.0)
        end = leg.state(leg.end)
        x, y = map(float, end.position)
        ending, pocket, time = leg.ending, leg.pocket or None, leg.end
        speed = 0.0 if ending == "rest" else end.speed
    length = units.length.quantity
    heading = f"{ball} ends, from the head cushion" if ball else None
    return [
        length(f"{name}_slide", slides),
        length(f"{name}_roll", rolls),
        Quantity(f"{name}_end", ending),
        Quantity(f"{name}_pocket", pocket),
        length(f"{name}_end_x", x, heading, 1, detail=True),
        length(f"{name}_end_y", y, "and from the right one" if ball else None, 1, detail=True),
        Quantity(f"{name}_end_s", time),
        units.speed.quantity(f"{name}_end_speed", speed),
    ]


def _degrees(angle: float | None) -> float | None:
    """Return an angle in degrees; what rounding leaves of none is none."""
    return None if angle is None else math.degrees(angle) if abs(angle) > 1e-13 else 0.0


def _moves(found: Shot) -> list[tuple[Leg, Phase]]:
    return [(leg, phase) for leg in found.legs for phase in leg.phases]


def _phases(found: Shot, units: Units) -> Table:
    """Return the phases as a person reads them."""
    length, speed = units.length, units.speed
    far, fast = length.key, speed.key.replace("_", "/")
    hundredths, joules = decimals(2), decimals(3)
    columns = [
        Column("ball", "", left=True),
        Column("motion", "", left=True),
        Column("begin_s", "from\ns", hundredths),
        Column("end_s", "to\ns", hundredths),
        Column("length", f"travels\n{far}", decimals(1)),
        Column("speed", f"speed\n{fast}", hundredths),
        Column("end_speed", f"at end\n{fast}", hundredths),
        Column("energy", "energy\njoules", joules, detail=True),
        Column("end_energy", "at end\njoules", joules, detail=True),
    ]
    rows = []
    for leg, phase in _moves(found):
        ends = (phase.begin, phase.end)
        times, paces = [end.time for end in ends], [end.speed / speed.size for end in ends]
        energies = [leg.energy(time).total for time in times]
        way = phase.length / length.size
        rows.append([phase.ball, phase.motion, *times, way, *paces, *energies])
    return Table("", columns, rows)


def _record(leg: Leg, phase: Phase, units: Units) -> dict[str, Any]:
    """Return a phase as JSON holds it: when, where, how fast, with what spin and energy."""
    far, fast = units.length, units.speed
    row: dict[str, Any] = {"ball": phase.ball, "motion": phase.motion}
    for name, state in (("begin", phase.begin), ("end", phase.end)):
        row[f"{name}_s"] = state.time
        for axis, place in zip("xy", state.position, strict=True):
            row[f"{name}_{axis}_{far.key}"] = float(place) / far.size
        for axis, pace in zip("xy", state.velocity, strict=True):
            row[f"{name}_v{axis}_{fast.key}"] = float(pace) / fast.size
        for axis, turn in zip("xyz", state.spin, strict=True):
            row[f"{name}_spin_{axis}_rad_s"] = float(turn)
        row[f"{name}_speed_{fast.key}"] = state.speed / fast.size
        row[f"{name}_energy_j"] = leg.energy(state.time).total
    row[f"length_{far.key}"] = phase.length / far.size
    return row
