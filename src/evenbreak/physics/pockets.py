"""The six pockets of a table, as gaps between the cushions that a ball fits through or not.

A corner of the table is (0, 0); x runs along it from the head cushion to the foot cushion, and y
to the left of that. A pocket is a straight mouth between the noses of two cushions: across the
corner, or along the side. The source text has no pockets; the mouths here are 4 1/2 inches at the
corners and 5 inches at the sides, the tightest in common use.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from evenbreak.checks import kind_of
from evenbreak.physics.objects import PoolTable
from evenbreak.physics.units import INCH

CORNER_MOUTH = 4.5 * INCH
"""Between the noses at a corner, in metres."""

SIDE_MOUTH = 5.0 * INCH
"""Between the noses at a side pocket, in metres."""

POCKET_NAMES = ("head-right", "side-right", "foot-right", "foot-left", "side-left", "head-left")
"""The pockets, counterclockwise from the corner (0, 0)."""


class Pocket(NamedTuple):
    """A pocket: where its mouth is, the direction into it, and its width.

    Parameters
    ----------
    name
        one of `POCKET_NAMES`.
    x, y
        the middle of the mouth, in metres.
    into_x, into_y
        the unit vector straight into it.
    mouth
        its width between the noses of the cushions, in metres.
    """

    name: str
    x: float
    y: float
    into_x: float
    into_y: float
    mouth: float

    def takes(self, x: float, y: float, along_x: float, along_y: float, radius: float) -> bool:
        """Return whether a ball that goes straight on from (x, y) fits through the mouth.

        Parameters
        ----------
        x, y
            the ball's centre in metres, no farther away than the mouth is wide.
        along_x, along_y
            its direction, a vector of any length.
        radius
            of the ball, in metres.

        >>> pocket = pockets(PoolTable())[1]
        >>> pocket.takes(pocket.x, 0.03, 0.0, -1.0, 0.0286)
        True
        >>> pocket.takes(pocket.x, 0.03, 1.0, -0.3, 0.0286)
        False
        """
        length = math.hypot(along_x, along_y)
        near = math.hypot(self.x - x, self.y - y) <= self.mouth
        if not near or length == 0.0:
            return False
        beside = abs((self.x - x) * along_y - (self.y - y) * along_x) / length
        return beside <= 0.5 * self.width_from(along_x, along_y) - radius + 1e-9

    def width_from(self, along_x: float, along_y: float) -> float:
        """Return how wide the mouth is for a ball coming in this direction, in metres.

        At an angle it is as narrow as it looks from there; from behind it is below 0.

        >>> pocket = pockets(PoolTable())[1]
        >>> pocket.width_from(0.0, -2.0) == pocket.mouth, pocket.width_from(1.0, 0.0)
        (True, 0.0)
        """
        facing = along_x * self.into_x + along_y * self.into_y
        return self.mouth * facing / math.hypot(along_x, along_y)


def pockets(table: PoolTable) -> tuple[Pocket, ...]:
    """Return the six pockets of a table, in the order of `POCKET_NAMES`.

    Parameters
    ----------
    table
        its length and width in metres.

    >>> [pocket.name for pocket in pockets(PoolTable())][2]
    'foot-right'
    """
    kind_of(table, "table", PoolTable)
    slant = math.sqrt(0.5)
    inset = 0.5 * slant * CORNER_MOUTH
    far, across, middle = table.length - inset, table.width - inset, 0.5 * table.length
    places = (
        (inset, inset, -slant, -slant, CORNER_MOUTH),
        (middle, 0.0, 0.0, -1.0, SIDE_MOUTH),
        (far, inset, slant, -slant, CORNER_MOUTH),
        (far, across, slant, slant, CORNER_MOUTH),
        (middle, table.width, 0.0, 1.0, SIDE_MOUTH),
        (inset, across, -slant, slant, CORNER_MOUTH),
    )
    return tuple(Pocket(name, *place) for name, place in zip(POCKET_NAMES, places, strict=True))
