import math

import pytest

from evenbreak.physics.leg import CORNER_MOUTH, POCKET_NAMES, pockets
from evenbreak.physics.objects import Ball, PoolTable

RADIUS = Ball().radius
TABLE = PoolTable()


def test_the_pockets_go_round_the_table():
    found = pockets(TABLE)
    assert tuple(pocket.name for pocket in found) == POCKET_NAMES
    middle = (0.5 * TABLE.length, 0.5 * TABLE.width)
    turns = [math.atan2(one.y - middle[1], one.x - middle[0]) for one in found]
    assert turns == sorted(turns)
    for one in found:
        assert math.hypot(one.into_x, one.into_y) == pytest.approx(1.0)


@pytest.mark.parametrize("pocket", pockets(TABLE), ids=POCKET_NAMES)
def test_a_ball_through_the_middle_falls_and_one_beside_it_does_not(pocket):
    room = 0.5 * pocket.mouth - RADIUS
    for beside, falls in ((0.0, True), (0.99 * room, True), (1.01 * room, False)):
        x, y = pocket.x - beside * pocket.into_y, pocket.y + beside * pocket.into_x
        assert pocket.takes(x, y, pocket.into_x, pocket.into_y, RADIUS) is falls
    assert not pocket.takes(pocket.x, pocket.y, -pocket.into_x, -pocket.into_y, RADIUS)
    assert not pocket.takes(pocket.x, pocket.y, 0.0, 0.0, RADIUS)


def test_a_ball_along_the_cushion_just_fits_into_the_corner():
    corner = pockets(TABLE)[2]
    start = TABLE.length - 0.7 * CORNER_MOUTH
    assert corner.takes(start, RADIUS + 0.002, 1.0, 0.0, RADIUS)
    assert not corner.takes(start, RADIUS + 0.03, 1.0, 0.0, RADIUS)


def test_a_ball_far_from_a_pocket_is_not_in_it():
    side = pockets(TABLE)[1]
    assert not side.takes(side.x, 0.5, 0.0, -1.0, RADIUS)
