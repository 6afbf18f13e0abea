"""What `evenbreak physics shot` answers: quantities, phases and sentences."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from evenbreak.cli.kit.output import aligned, heading_lines
from evenbreak.cli.physics.hit_options import spin_text
from evenbreak.cli.physics.units import Units, decimals

if TYPE_CHECKING:
    from evenbreak.physics import AimedShot, Leg, Phase, Pocket, Shot


def _parts(traced: Shot | AimedShot) -> tuple[Shot, AimedShot | None]:
    from evenbreak.physics.aimed import AimedShot

    return (traced.shot, traced) if isinstance(traced, AimedShot) else (traced, None)


def answer(traced: Shot | AimedShot, units: Units) -> dict[str, Any]:
    """Return every quantity by its name, None where there is none."""
    found, aimed = _parts(traced)
    length, speed = units.length_key, units.speed_key
    hit = found.strike
    return {
        f"ball_speed_{speed}": hit.speed / units.speed,
        f"stick_speed_{speed}": hit.stick_speed / units.speed,
        "spin_speed_ratio": hit.topspin,
        "side_spin_speed_ratio": hit.side,
        "direction_deg": -_degrees(math.remainder(found.direction, 2.0 * math.pi)),
        "cut_deg": _degrees(found.cut),
        "reached": found.reached,
        **_at_hit(found, units),
        "target_x_" + length: aimed and float(aimed.target[0]) / units.length,
        "target_y_" + length: aimed and float(aimed.target[1]) / units.length,
        "aim_offset_" + length: aimed and _right(aimed) * aimed.offset / units.length,
        "aim_turn_deg": aimed and _right(aimed) * _degrees(aimed.turn),
        "miss_" + length: aimed and aimed.miss / units.length,
        **_way("approach", found.approach, units),
        **_way("cue", found.cue_leg, units),
        **_way("object", found.object_leg, units),
    }


def _degrees(angle: float) -> float:
    """Return an angle in degrees, without what rounding leaves of none."""
    return math.degrees(angle) if abs(angle) > 1e-13 else 0.0


def _right(aimed: AimedShot) -> float:
    """Return 1 where thinner is farther to the right, else -1."""
    return math.copysign(1.0, aimed.unaided.cut)


def _at_hit(found: Shot, units: Units) -> dict[str, Any]:
    """Return what is known of the hit, and the angles after it."""
    from evenbreak.physics.deflection import deflection
    from evenbreak.physics.shot import spin_ratios

    state = found.at_hit
    names = [
        *("hit_s", f"hit_speed_{units.speed_key}", "hit_spin_speed_ratio"),
        *("hit_side_spin_speed_ratio", "throw_deg", "object_cut_deg"),
        *("deflection_deg", "deflection_thrown_deg", "energy_lost_at_hit_j"),
    ]
    if state is None or found.collision is None or found.throw is None:
        return dict.fromkeys(names)
    topspin, side = spin_ratios(state, found.strike.ball.radius)
    cut, throw, thrown = abs(found.cut), found.throw, found.deflection
    # A full hit with stun leaves the cue ball where it is.
    smooth = None if cut == 0.0 and abs(topspin) < 1e-9 else math.degrees(deflection(cut, topspin))
    values = (
        state.time,
        state.speed / units.speed,
        topspin,
        side,
        _degrees(throw),
        math.copysign(1.0, found.cut) * _degrees(cut - throw),
        smooth,
        None if thrown is None else math.degrees(thrown),
        found.approach.energy(state.time).total - found.energy(state.time).total,
    )
    return dict(zip(names, values, strict=True))


def _way(name: str, leg: Leg | None, units: Units) -> dict[str, Any]:
    """Return how far a ball slides and rolls, and how and where its way ends."""
    length, speed = units.length_key, units.speed_key
    names = [
        *(f"slide_{length}", f"roll_{length}", "end", "pocket"),
        *(f"end_x_{length}", f"end_y_{length}", "end_s", f"end_speed_{speed}"),
    ]
    if leg is None:
        return dict.fromkeys(f"{name}_{part}" for part in names)
    ways = {phase.motion: phase.length / units.length for phase in leg.phases}
    end = leg.state(leg.end)
    x, y = (float(part) / units.length for part in end.position)
    at_rest = leg.ending == "rest"
    values = [
        *(ways.get("slides", 0.0), ways.get("rolls", 0.0), leg.ending, leg.pocket or None),
        *(x, y, leg.end, 0.0 if at_rest else end.speed / units.speed),
    ]
    return {f"{name}_{part}": value for part, value in zip(names, values, strict=True)}


def shown(units: Units) -> dict[str, tuple[str, int]]:
    """Return what a terminal shows, in its order: words and decimals."""
    length, speed = units.length_key, units.speed_key
    far, fast = units.length_word, units.speed_word
    return {
        "cut_deg": ("cut angle, degrees", 2),
        f"ball_speed_{speed}": (f"speed of the cue ball off the tip, {fast}", 2),
        f"hit_speed_{speed}": (f"its speed at the hit, {fast}", 2),
        "hit_spin_speed_ratio": ("its topspin J at the hit, 1 is natural roll", 3),
        "hit_side_spin_speed_ratio": ("its sidespin J at the hit, right above 0", 3),
        "throw_deg": ("throw of the object ball, degrees", 2),
        "deflection_thrown_deg": ("deflection of the cue ball once it rolls, degrees", 2),
        "deflection_deg": ("the same without friction between the balls", 2),
        f"object_end_x_{length}": (f"object ball ends, {far} from the head cushion", 1),
        f"object_end_y_{length}": (f"and {far} from the right side", 1),
        f"cue_end_x_{length}": (f"cue ball ends, {far} from the head cushion", 1),
        f"cue_end_y_{length}": (f"and {far} from the right side", 1),
    }


def phase_rows(traced: Shot | AimedShot, units: Units) -> list[dict[str, Any]]:
    """Return a row for each phase: what begins and ends when, where, how fast, with what energy."""
    found, _ = _parts(traced)
    return [_phase_row(leg, phase, units) for leg in found.legs for phase in leg.phases]


def _phase_row(leg: Leg, phase: Phase, units: Units) -> dict[str, Any]:
    row: dict[str, Any] = {"ball": phase.ball, "motion": phase.motion}
    for name, state in (("begin", phase.begin), ("end", phase.end)):
        energy = leg.energy(state.time)
        row[f"{name}_s"] = state.time
        for axis, place in zip("xy", state.position, strict=True):
            row[f"{name}_{axis}_{units.length_key}"] = float(place) / units.length
        for axis, pace in zip("xy", state.velocity, strict=True):
            row[f"{name}_v{axis}_{units.speed_key}"] = float(pace) / units.speed
        for axis, turn in zip("xyz", state.spin, strict=True):
            row[f"{name}_spin_{axis}_rad_s"] = float(turn)
        row[f"{name}_energy_j"] = energy.total
    row[f"length_{units.length_key}"] = phase.length / units.length
    return row


def phases_text(traced: Shot | AimedShot, units: Units) -> str:
    """Return the phases as a table for a terminal; nothing where nothing moves."""
    found, _ = _parts(traced)
    if not found.phases:
        return ""
    far, fast = units.length_key, units.speed_key.replace("_", "/")
    headings = ["", "\n", "from\ns", "to\ns", f"way\n{far}", f"speed\n{fast}", "ends with\n" + fast]
    headings += ["energy\njoules", "ends with\njoules"]
    rows = heading_lines(headings)
    for leg in found.legs:
        for phase in leg.phases:
            begin, end = phase.begin, phase.end
            paces = (begin.speed / units.speed, end.speed / units.speed)
            energies = (leg.energy(begin.time).total, leg.energy(end.time).total)
            row = [phase.ball, phase.motion, decimals(begin.time), decimals(end.time)]
            row += [decimals(phase.length / units.length, 1), *map(decimals, paces)]
            rows.append([*row, *(decimals(energy, 3) for energy in energies)])
    return aligned(rows, left=2)


def sentences(traced: Shot | AimedShot, units: Units, pocket: Pocket | None = None) -> str:
    """Return what happens, in sentences; `pocket` is that of an aimed shot."""
    found, aimed = _parts(traced)
    state = found.at_hit
    if state is None:
        how = {"cushion": "meets a cushion", "pocket": "falls", "rest": "stops"}
        return (
            f"The cue ball never reaches the object ball: it {how[found.approach.ending]} after "
            f"{decimals(found.approach.length / units.length, 1)} {units.length_word}."
        )
    told = []
    if aimed and pocket:
        told += [_miss_text(found, pocket, units), _aim_text(aimed, pocket, units)]
    topspin = answer(found, units)["hit_spin_speed_ratio"]
    spin = spin_text(round(topspin, 2) + 0.0)
    after = f"after {decimals(state.time)} s" if found.approach.phases else "at once"
    told.append(f"The cue ball hits {after} with {spin}{_slid_text(found.approach)}.")
    told += [_end_text(leg, units) for leg in (found.object_leg, found.cue_leg) if leg]
    return "\n".join(filter(None, told))


def _slid_text(leg: Leg) -> str:
    motions = [phase.motion for phase in leg.phases]
    words = {"slides": ", still sliding", "rolls": ", rolling from the tip on"}
    return ", rolling by then" if len(motions) > 1 else words.get("".join(motions), "")


def _end_text(leg: Leg, units: Units) -> str:
    if leg.ending == "rest" and not leg.phases:
        return f"The {leg.name} stays where it is."
    end = leg.state(leg.end)
    way = f"The {leg.name} goes {decimals(leg.length / units.length, 1)} {units.length_word} and"
    if leg.ending == "rest":
        return f"{way} comes to rest after {decimals(leg.end)} s."
    pace = f"at {decimals(end.speed / units.speed)} {units.speed_word}"
    if leg.ending == "pocket":
        return f"{way} falls into the pocket {leg.pocket} {pace}."
    return f"{way} meets a cushion {pace}; it is not followed from there."


def _miss_text(found: Shot, pocket: Pocket, units: Units) -> str:
    """Return that the object ball does not fall, and why; nothing where it does."""
    leg = found.object_leg
    if leg is None or leg.ending == "pocket":
        return ""
    end = leg.state(leg.end)
    if leg.ending == "rest":
        left = math.dist(end.position, (pocket.x, pocket.y)) / units.length
        why = f"it comes to rest {decimals(left, 1)} {units.length_word} short of the pocket"
    elif (gap := pocket.width_from(*end.velocity)) < found.strike.ball.diameter:
        why = (
            f"it comes so flat that the mouth is {decimals(gap / units.length)} "
            f"{units.length_word} wide for it, less than the ball"
        )
    else:
        why = "it meets a cushion before the pocket"
    return f"The object ball does not fall: {why}."


def _aim_text(aimed: AimedShot, pocket: Pocket, units: Units) -> str:
    goal, told = "the middle of the pocket", ""
    x, y = aimed.target - aimed.shot.object_position
    beside = (pocket.x - aimed.target[0]) * y - (pocket.y - aimed.target[1]) * x
    # How far to the right of the middle the target is, seen from the object ball.
    right = -float(beside) / aimed.distance / units.length
    if right:
        side = "right" if right > 0.0 else "left"
        goal = "that point"
        told = (
            f"A cushion is in the way of a shot at the middle of the pocket, so play it "
            f"{decimals(abs(right))} {units.length_word} to the {side} of that.\n"
        )
    right = answer(aimed, units)[f"aim_offset_{units.length_key}"]
    amount = decimals(abs(right))
    if float(amount) == 0.0:
        return f"{told}Aim at {goal}: there is no throw to speak of."
    turn = "right" if right > 0.0 else "left"
    aim = f"{told}Aim {amount} {units.length_word} to the {turn} of {goal}: "
    if aimed.unaided.throw is None:
        return f"{aim}throw brings the ball back."
    return (
        f"{aim}without that, throw takes the ball {decimals(abs(aimed.miss) / units.length)} "
        f"{units.length_word} off it."
    )
