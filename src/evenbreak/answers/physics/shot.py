"""A shot traced from the tip until both balls stop: where they go, and how they get there."""

import math
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, quantities_of, quantity_of
from evenbreak.answers.kit.parts import Quantities, Quantity, Table
from evenbreak.answers.kit.wording import decimals
from evenbreak.answers.physics.hit import (
    SQUIRT,
    cut_words,
    friction_values,
    friction_words,
    spin_words,
)
from evenbreak.answers.physics.strike import tip_words
from evenbreak.answers.physics.units import Units
from evenbreak.physics.aimed import AimedShot
from evenbreak.physics.deflection import deflection
from evenbreak.physics.leg import Leg, Phase, Pocket
from evenbreak.physics.shot import Shot, spin_ratios


def shot_answer(traced: Shot | AimedShot, units: Units, pocket: Pocket | None = None) -> Answer:
    """Return where both balls of a shot go, and how."""
    aimed = traced if isinstance(traced, AimedShot) else None
    found = traced.shot if isinstance(traced, AimedShot) else traced
    quantities = [
        *_tip(found, units),
        *_hit(found, units),
        *_aim(aimed, units),
        *_way("approach", found.approach, units),
        *_way("cue", found.cue_leg, units),
        *_way("object", found.object_leg, units),
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
        "-spin_speed_ratio": strike.topspin,
        "-side_spin_speed_ratio": strike.side,
        "direction_deg": _degrees(-math.remainder(found.direction, 2.0 * math.pi)),
        "cut_deg": _degrees(found.cut),
        "reached": found.reached,
    }
    return [
        units.speed.quantity("speed_off_tip", strike.speed),
        units.speed.quantity("stick_speed", strike.stick_speed),
        *quantities_of(values),
    ]


def _hit(found: Shot, units: Units) -> list[Quantity]:
    """Return everything known about the hit and the angles after it."""
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
        "-object_cut_deg": _degrees(object_cut),
        "deflection_deg": _degrees(smooth),
        "deflection_thrown_deg": _degrees(found.deflection),
        "energy_lost_at_hit_j": lost,
    }
    return [
        quantity_of("hit_s", state and state.time),
        units.speed.quantity("hit_speed", speed),
        *quantities_of(friction_values(found.mu, found.collision, found.friction)),
        *quantities_of(values),
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
        quantity_of("aim_turn_deg", _degrees(turn)),
        length("miss", miss),
    ]


def _way(name: str, leg: Leg | None, units: Units) -> list[Quantity]:
    """Return how far a ball slides and rolls, and where and how its path ends."""
    slides = rolls = x = y = time = speed = ending = pocket = None
    if leg is not None:
        lengths = {phase.motion: phase.length for phase in leg.phases}
        slides, rolls = lengths.get("slides", 0.0), lengths.get("rolls", 0.0)
        end = leg.state(leg.end)
        x, y = map(float, end.position)
        ending, pocket, time = leg.ending, leg.pocket or None, leg.end
        speed = 0.0 if ending == "rest" else end.speed
    length = units.length.quantity
    return [
        length(f"{name}_slide", slides),
        length(f"{name}_roll", rolls),
        *quantities_of({f"{name}_end": ending, f"{name}_pocket": pocket}),
        length(f"{name}_end_x", x),
        length(f"{name}_end_y", y),
        quantity_of(f"{name}_end_s", time),
        units.speed.quantity(f"{name}_end_speed", speed),
    ]


def _degrees(angle: float | None) -> float | None:
    """Return an angle in degrees; a rounding error counts as 0."""
    return None if angle is None else math.degrees(angle) if abs(angle) > 1e-13 else 0.0


def _moves(found: Shot) -> list[tuple[Leg, Phase]]:
    return [(leg, phase) for leg in found.legs for phase in leg.phases]


def _phases(found: Shot, units: Units) -> Table:
    """Return the phases for display."""
    length, speed = units.length, units.speed
    far, fast = length.key, speed.key.replace("_", "/")
    columns = columns_of(
        "ball motion begin_s end_s phase_length speed end_speed energy end_energy",
        far=far,
        fast=fast,
    )
    rows = []
    for leg, phase in _moves(found):
        ends = (phase.begin, phase.end)
        times, paces = [end.time for end in ends], [end.speed / speed.size for end in ends]
        energies = [leg.energy(time).total for time in times]
        way = phase.length / length.size
        rows.append([phase.ball, phase.motion, *times, way, *paces, *energies])
    return Table("", columns, rows)


def _record(leg: Leg, phase: Phase, units: Units) -> dict[str, Any]:
    """Return a phase for JSON: when, where, how fast, and with what spin and energy."""
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


def shot_heading(found: Shot, units: Units, pocket: Pocket | None) -> str:
    """Return what is played, in two lines, and the assumed friction."""
    length = units.length
    if pocket is None:
        apart = math.dist(found.approach.slide.position, found.object_position)
        cut = cut_words(round(math.degrees(found.cut), 9))  # as it was typed
        where = f"{cut}; {length.typed(apart)} between the centers"
    else:
        places = (found.approach.slide.position, found.object_position)
        cue, standing = (f"({x / length.size:g}, {y / length.size:g})" for x, y in places)
        where = f"Cue ball at {cue}, object ball at {standing} {length.words}; pocket {pocket.name}"
    speed = units.speed.typed(found.strike.speed)
    friction = friction_words(found.mu, found.collision, found.friction)
    return f"{where}\n{tip_words(found.strike)}; cue ball at {speed}\n{friction}"


def shot_words(
    found: Shot, aimed: AimedShot | None, units: Units, pocket: Pocket | None
) -> list[str]:
    """Return what happens: first where the balls end up, then how the shot is aimed and hit."""
    state = found.at_hit
    if state is None:
        how = {"cushion": "hits a rail", "pocket": "drops", "rest": "stops"}
        return [
            f"The cue ball never reaches the object ball: it {how[found.approach.ending]} after "
            f"{units.length.text(found.approach.length)}."
        ]
    miss = "" if pocket is None else _miss(found, pocket, units)
    ends = [miss]
    if found.object_leg and found.cue_leg:
        ends.append(_end(found.object_leg, units, "It" if miss else "The object ball"))
        ends.append(_end(found.cue_leg, units, "The cue ball"))
    after = f"after {decimals(2)(state.time)} s" if found.approach.phases else "at once"
    topspin, _ = spin_ratios(state, found.strike.ball.radius)
    spin = spin_words(round(topspin, 2) + 0.0)
    arrival = f"The cue ball arrives {after} with {spin}{_motion(found.approach)}."
    aim = [*_aim_in_words(aimed, pocket, units)] if aimed and pocket else []
    return [" ".join(filter(None, ends)), " ".join([*aim, arrival])]


def _motion(approach: Leg) -> str:
    """Return whether the ball only slides, or only rolls, before the hit."""
    words = {"slides": ", still sliding", "rolls": ", rolling from the start"}
    return words.get("".join(phase.motion for phase in approach.phases), "")


def _end(leg: Leg, units: Units, ball: str) -> str:
    """Return where and how the ball's path ends."""
    if leg.ending == "rest" and not leg.phases:
        return f"{ball} stops dead."
    end = leg.state(leg.end)
    pace = f"at {units.speed.text(end.speed)}"
    if leg.ending == "pocket":
        return f"{ball} drops into the {leg.pocket} pocket {pace}."
    x, y = (decimals(1)(place / units.length.size) for place in map(float, end.position))
    place = f"{x} {units.length.words} from the head rail and {y} from the right rail"
    if leg.ending == "rest":
        return f"{ball} stops after {decimals(2)(leg.end)} s, {place}."
    return f"{ball} hits a rail {pace}, {place}; it isn't followed any further."


def _miss(found: Shot, pocket: Pocket, units: Units) -> str:
    """Return why the object ball doesn't drop; nothing if it does."""
    leg = found.object_leg
    if leg is None or leg.ending == "pocket":
        return ""
    end = leg.state(leg.end)
    length = units.length
    if leg.ending == "rest":
        left = math.dist(end.position, (pocket.x, pocket.y))
        why = f"it stops {length.text(left)} short of the pocket"
    elif (gap := pocket.width_from(*end.velocity)) < found.strike.ball.diameter:
        why = f"from this angle the pocket is only {length.text(gap, 2)} wide, less than the ball"
    else:
        why = "a rail is in the way"
    return f"The object ball does not drop: {why}."


def _aim_in_words(aimed: AimedShot, pocket: Pocket, units: Units) -> list[str]:
    """Return where to aim, and how far throw would move the ball off its line."""
    length = units.length
    goal, sentences = "the middle of the pocket", []
    x, y = aimed.target - aimed.shot.object_position
    beside = (pocket.x - aimed.target[0]) * y - (pocket.y - aimed.target[1]) * x
    # How far to the right of the middle the target is, seen from the object ball.
    right = -float(beside) / aimed.distance
    if right:
        goal = "that point"
        sentences.append(
            "A rail is in the way of the middle of the pocket, so aim for a point "
            f"{length.text(abs(right), 2)} to the {'right' if right > 0.0 else 'left'} of it."
        )
    right = math.copysign(1.0, aimed.unaided.cut) * aimed.offset
    amount = length.text(abs(right), 2)
    if length.is_nothing(right, 2):
        return [*sentences, f"Aim at {goal}: there is hardly any throw."]
    side = "right" if right > 0.0 else "left"
    aim = f"Aim {amount} to the {side} of {goal}"
    if aimed.unaided.throw is None:
        return [*sentences, f"{aim}: throw brings it back in line."]
    miss = length.text(abs(aimed.miss), 2)
    return [*sentences, f"{aim}; without that, throw takes the ball {miss} off line."]
