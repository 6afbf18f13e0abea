"""From a question about ball, cloth and cue to its answer."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from evenbreak import physics
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics import units as measures
from evenbreak.answers.physics.layout import layout_of, traced_shot
from evenbreak.errors import InputError
from evenbreak.questions import physics as questions

if TYPE_CHECKING:
    from evenbreak.answers.physics.hit import Hit


def units_of(asked: questions.Units) -> measures.Units:
    """Return a question's units."""
    return measures.METRIC if asked.metric else measures.IMPERIAL


def ball_of(weight: float | None, units: measures.Units) -> physics.Ball:
    """Return a pool ball, with a different weight if one was typed."""
    return physics.Ball() if weight is None else physics.Ball(mass=weight * units.mass.size)


def cue_of(weight: float | None, tip_mu: float, units: measures.Units) -> physics.Cue:
    """Return a cue with this tip, with a different weight if one was typed."""
    if weight is None:
        return physics.Cue(tip_friction=tip_mu)
    return physics.Cue(mass=weight * units.mass.size, tip_friction=tip_mu)


def hit_of(asked: questions.Hit) -> Hit:
    """Return the hit described by a question."""
    from evenbreak.answers.physics.hit import Hit

    mu, pace = asked.mu, None
    if asked.speed is not None:
        pace = asked.speed * units_of(asked).speed.size
    if mu is None:
        mu = physics.BALL_FRICTION if pace is None else physics.SlipFriction()
    return Hit(asked.cut, asked.topspin, asked.sidespin, mu, asked.friction, pace)


def speed(asked: questions.TableSpeed) -> Answer:
    """Return how fast a table is."""
    from evenbreak.answers.physics.strike import table_speed_answer

    units = units_of(asked)
    unit, length, diameter = units.length, asked.table_length, asked.ball_diameter
    meters = physics.PoolTable().length if length is None else length * unit.size
    ball = physics.Ball().diameter if diameter is None else diameter * unit.size
    if meters <= ball:
        asked.refuse(
            "{table_length} {long:g} leaves no room for a ball of {wide:g} {words}. Give "
            "both in {words}.",
            long=meters / unit.size,
            wide=ball / unit.size,
            words=unit.words,
        )
    return table_speed_answer(asked.lag_time, meters - ball, units)


def throw(asked: questions.Throw) -> Answer:
    """Return how far friction throws the object ball."""
    from evenbreak.answers.physics.hit import throw_answer

    units = units_of(asked)
    answer = throw_answer(hit_of(asked), units)
    return replace(answer, warnings=measures.unit_doubts(units, speed=asked.speed))


def aim(asked: questions.Aim) -> Answer:
    """Return where to aim."""
    from evenbreak.answers.physics.hit import aim_answer

    units, hit = units_of(asked), hit_of(asked)
    try:
        answer = aim_answer(hit, asked.distance * units.length.size, units, squirt=asked.squirt)
    except InputError:
        asked.refuse(
            "{cut} {angle:g} can't be reached: throw makes every hit fuller than that. "
            "Give a smaller cut angle, or a different {topspin} or {english}.",
            angle=asked.cut,
        )
    return replace(answer, warnings=measures.unit_doubts(units, speed=asked.speed))


def deflect(asked: questions.Deflect) -> Answer:
    """Return where the cue ball goes."""
    from evenbreak.answers.physics.hit import cue_ball_path_answer

    units = units_of(asked)
    answer = cue_ball_path_answer(hit_of(asked), units)
    return replace(answer, warnings=measures.unit_doubts(units, speed=asked.speed))


def strike(asked: questions.Strike) -> Answer:
    """Return the spin and speed of a hit off center."""
    from evenbreak.answers.physics.strike import strike_answer

    units, distance, pace = units_of(asked), asked.distance, asked.stick_speed
    answer = strike_answer(
        physics.strike(
            1.0 if pace is None else pace * units.speed.size,
            asked.offset,
            asked.side_offset,
            ball=ball_of(asked.ball, units),
            cue=cue_of(asked.stick, asked.tip_mu, units),
        ),
        units,
        cloth=physics.Cloth(mu_slide=asked.cloth_mu),
        distance=None if distance is None else distance * units.length.size,
        speed_known=pace is not None,
    )
    typed = {"stick": asked.stick, "ball": asked.ball, "stick_speed": pace}
    return replace(answer, warnings=measures.unit_doubts(units, **typed))


def breakcue(asked: questions.BreakCue) -> Answer:
    """Return the weight of the best break cue."""
    from evenbreak.answers.physics.strike import break_cue_answer

    units = units_of(asked)
    weight = units.mass
    answer = break_cue_answer(
        asked.forearm * weight.size,
        ball_of(asked.ball, units).mass,
        weight,
        None if asked.stick is None else asked.stick * weight.size,
    )
    typed = {"forearm": asked.forearm, "stick": asked.stick, "ball": asked.ball}
    return replace(answer, warnings=measures.unit_doubts(units, **typed))


def shot(asked: questions.Shot) -> Answer:
    """Return a whole shot, traced."""
    from evenbreak.answers.physics.shot import shot_answer

    units = units_of(asked)
    layout = layout_of(asked, units)
    cloth = physics.Cloth(mu_slide=asked.cloth_mu, mu_roll=1.0 / asked.table_speed)
    mu = physics.BALL_FRICTION if asked.mu is None else asked.mu
    traced = traced_shot(_struck(asked, units), layout, cloth=cloth, mu=mu, friction=asked.friction)
    typed = {name: getattr(asked, name) for name in ("stick", "ball", "speed", "stick_speed")}
    answer = shot_answer(traced, units, layout.pocket)
    return replace(answer, warnings=measures.unit_doubts(units, **typed), drawn=traced)


def _struck(asked: questions.Shot, units: measures.Units) -> physics.Strike:
    """Return the tip's hit, or reject it."""
    up, right = asked.offset, asked.side_offset
    most = physics.miscue_offset(asked.tip_mu)
    if math.hypot(up, right) > most:
        asked.refuse(
            "{offset} {up:g} with {side_offset} {right:g} is a miscue: the tip slips beyond "
            "{most:.3g} of the radius. Give smaller offsets, or a higher {tip_mu}.",
            up=up,
            right=right,
            most=most,
        )
    ball, cue = ball_of(asked.ball, units), cue_of(asked.stick, asked.tip_mu, units)
    if asked.speed is not None:
        return physics.strike_for_speed(
            asked.speed * units.speed.size, up, right, ball=ball, cue=cue
        )
    pace = (asked.stick_speed or 0.0) * units.speed.size
    return physics.strike(pace, up, right, ball=ball, cue=cue)
