"""Where the balls are in a shot, according to its question, and the shot traced from there."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NoReturn

from evenbreak import physics
from evenbreak.answers.physics.units import Units
from evenbreak.fields.question import refuse
from evenbreak.questions.physics import Shot
from evenbreak.words import Parameter

Place = tuple[float, float]


@dataclass(frozen=True)
class Layout:
    """A table with two balls on it, in the question's units.

    Either `cut` (degrees) and `distance` (between centers), or the object ball and its pocket; by
    default, the cue ball is in the middle of the head string.
    """

    units: Units
    table: physics.PoolTable
    cut: float | None
    distance: float | None
    cue_ball: Place | None
    object_ball: Place | None
    pocket: physics.Pocket | None

    def meters(self, place: Place) -> Place:
        """Return a position in meters."""
        size = self.units.length.size
        return place[0] * size, place[1] * size

    @property
    def start(self) -> Place:
        """The cue ball's position, in meters."""
        if self.cue_ball is None:
            return 0.25 * self.table.length, 0.5 * self.table.width
        return self.meters(self.cue_ball)


def layout_of(asked: Shot, units: Units) -> Layout:
    """Return the layout described by a question."""
    table = physics.PoolTable()
    if asked.table_length is not None:
        length = asked.table_length * units.length.size
        table = physics.PoolTable(length=length, width=0.5 * length)
    goal = None
    if asked.pocket is not None:
        names = physics.POCKET_NAMES
        if asked.pocket not in names:
            asked.refuse(
                "{pocket} {name!r}. Give one of {names}.", name=asked.pocket, names=", ".join(names)
            )
        goal = physics.pockets(table)[names.index(asked.pocket)]
    return Layout(units, table, asked.cut, asked.distance, asked.cue_ball, asked.object_ball, goal)


def traced_shot(
    strike: physics.Strike, layout: Layout, **kit: Any
) -> physics.Shot | physics.AimedShot:
    """Return a layout's shot, or reject a layout in which it can't be played.

    `kit` is the cloth and the friction between the balls.
    """
    from evenbreak.errors import InputError

    length, pocket = layout.units.length, layout.pocket
    _check_places(layout, strike.ball.radius)
    kit["table"] = layout.table
    if pocket is None or layout.object_ball is None:
        cut, distance = layout.cut or 0.0, layout.distance or 0.0
        try:
            return physics.shot(
                strike, math.radians(cut), distance * length.size, cue_ball=layout.start, **kit
            )
        except InputError:
            _refuse_distance(layout, strike.ball.diameter)
    standing = layout.meters(layout.object_ball)
    if math.dist(standing, (pocket.x, pocket.y)) <= strike.ball.radius:
        refuse(
            "{object_ball} hangs in the {name} pocket, where any hit will do. Move it "
            "away from the pocket, or give {cut} and {distance}.",
            name=pocket.name,
        )
    try:
        found = physics.pocketed_shot(strike, layout.start, standing, pocket, **kit)
    except InputError:
        _refuse_places(layout, math.dist(layout.start, standing), strike.ball.diameter)
    if found.shot.collision is None and found.shot.approach.ending != "rest":
        x, y = layout.object_ball
        refuse(
            "{object_ball} {x:g},{y:g} is so close to a rail that the cue ball would have to be "
            "inside the rail to send it into {pocket} {name}. Move the object ball away from "
            "the rail, name another pocket, or give outside english ({side_offset}), which "
            "reduces throw.",
            x=x,
            y=y,
            name=pocket.name,
        )
    return found


def _check_places(layout: Layout, radius: float) -> None:
    """Reject a ball that isn't on the table."""
    size, unit = (layout.table.length, layout.table.width), layout.units.length
    for name, place in (("cue_ball", layout.cue_ball), ("object_ball", layout.object_ball)):
        if place is None:
            continue
        at = layout.meters(place)
        if not all(
            radius - 1e-9 <= x <= most - radius + 1e-9 for x, most in zip(at, size, strict=True)
        ):
            room = " by ".join(f"{most / unit.size:g}" for most in size)
            refuse(
                "{ball} {x:g},{y:g} isn't on the table, which is {room} {units}; a ball's "
                "center is at least {least:.4g} from each rail",
                ball=Parameter(name),
                x=place[0],
                y=place[1],
                room=room,
                units=unit.words,
                least=radius / unit.size,
            )


def _refuse_distance(layout: Layout, diameter: float) -> NoReturn:
    """Raise an error saying why a distance between the balls is wrong."""
    unit, distance = layout.units.length, layout.distance or 0.0
    if distance * unit.size < diameter:
        refuse(
            "{distance} {far:g} is measured between the centers. Give at least {least:.4g} "
            "{units}, the distance at which the balls touch.",
            far=distance,
            least=diameter / unit.size,
            units=unit.words,
        )
    refuse(
        "{distance} {far:g} puts the object ball off the table. Give a shorter distance, or "
        "another {cue_ball}.",
        far=distance,
    )


def _refuse_places(layout: Layout, apart: float, diameter: float) -> NoReturn:
    """Raise an error saying why the object ball can't be sent into the pocket from this layout."""
    unit = layout.units.length
    touching = f"{diameter / unit.size:.4g} {unit.words}"
    if apart < diameter * (1.0 - 1e-9):
        refuse(
            "{cue_ball} and {object_ball} overlap. Put them more than {touching} apart.",
            touching=touching,
        )
    if apart < diameter * (1.0 + 1e-9):
        refuse(
            "{cue_ball} and {object_ball} touch: apart from throw the object ball goes "
            "along the line through them wherever you aim. Put them more than {touching} apart.",
            touching=touching,
        )
    name = layout.pocket.name if layout.pocket else ""
    refuse(
        "{pocket} {name} can't be reached from here: the cut would be 90 degrees or "
        "more. Choose another pocket.",
        name=name,
    )
