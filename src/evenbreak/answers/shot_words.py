"""What happens in a shot, in sentences."""

import math

from evenbreak.answers.hit import cut_words, friction_words, spin_words
from evenbreak.answers.shot_units import Units
from evenbreak.answers.strike import tip_words
from evenbreak.answers.wording import decimals
from evenbreak.physics.aimed import AimedShot
from evenbreak.physics.leg import Leg
from evenbreak.physics.pockets import Pocket
from evenbreak.physics.shot import Shot, spin_ratios


def shot_heading(found: Shot, units: Units, pocket: Pocket | None) -> str:
    """Return what is played, in two lines, and what friction is assumed."""
    length = units.length
    if pocket is None:
        apart = math.dist(found.approach.slide.position, found.object_position)
        where = f"{cut_words(_degrees(found.cut))}; {length.typed(apart)} between the centres"
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
    """Return what happens: first where the balls end, then how the shot is aimed and hits."""
    state = found.at_hit
    if state is None:
        how = {"cushion": "meets a cushion", "pocket": "drops", "rest": "stops"}
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
    aim = [*_aim(aimed, pocket, units)] if aimed and pocket else []
    return [" ".join(filter(None, ends)), " ".join([*aim, arrival])]


def _motion(approach: Leg) -> str:
    """Return whether the ball only slides, or only rolls, up to the hit."""
    words = {"slides": ", still sliding", "rolls": ", rolling from the start"}
    return words.get("".join(phase.motion for phase in approach.phases), "")


def _end(leg: Leg, units: Units, ball: str) -> str:
    """Return where and how the way of a ball ends."""
    if leg.ending == "rest" and not leg.phases:
        return f"{ball} stops dead."
    end = leg.state(leg.end)
    pace = f"at {units.speed.text(end.speed)}"
    if leg.ending == "pocket":
        return f"{ball} drops into the {leg.pocket} pocket {pace}."
    x, y = (decimals(1)(place / units.length.size) for place in map(float, end.position))
    place = f"{x} {units.length.words} from the head cushion and {y} from the right one"
    if leg.ending == "rest":
        return f"{ball} stops after {decimals(2)(leg.end)} s, {place}."
    return f"{ball} meets a cushion {pace}, {place}; it is not followed further."


def _miss(found: Shot, pocket: Pocket, units: Units) -> str:
    """Return why the object ball does not drop; nothing if it does."""
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
        why = "a cushion is in the way"
    return f"The object ball does not drop: {why}."


def _aim(aimed: AimedShot, pocket: Pocket, units: Units) -> list[str]:
    """Return where to aim, and how far throw would take the ball off."""
    length = units.length
    goal, sentences = "the middle of the pocket", []
    x, y = aimed.target - aimed.shot.object_position
    beside = (pocket.x - aimed.target[0]) * y - (pocket.y - aimed.target[1]) * x
    # How far to the right of the middle the target is, seen from the object ball.
    right = -float(beside) / aimed.distance
    if right:
        goal = "that point"
        sentences.append(
            "A cushion is in the way of the middle of the pocket, so play for a point "
            f"{length.text(abs(right), 2)} to the {'right' if right > 0.0 else 'left'} of it."
        )
    right = math.copysign(1.0, aimed.unaided.cut) * aimed.offset
    amount = length.text(abs(right), 2)
    if amount.startswith("0.00 "):
        return [*sentences, f"Aim at {goal}: there is hardly any throw."]
    side = "right" if right > 0.0 else "left"
    aim = f"Aim {amount} to the {side} of {goal}"
    if aimed.unaided.throw is None:
        return [*sentences, f"{aim}: throw brings the ball back."]
    miss = length.text(abs(aimed.miss), 2)
    return [*sentences, f"{aim}; without that, throw takes the ball {miss} off line."]


def _degrees(angle: float) -> float:
    """Return an angle in degrees as it was typed."""
    return round(math.degrees(angle), 9)
