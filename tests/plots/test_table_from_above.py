import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from evenbreak.physics import PoolTable, pockets
from evenbreak.physics.units import INCH
from evenbreak.plots.traced_shot import bare_axes, draw_ball, draw_table


@pytest.fixture(scope="module")
def axes():
    axes = bare_axes(Figure(), (0.0, 0.0, 1.0, 1.0))
    draw_table(axes, PoolTable())
    return axes


def test_the_table_is_to_scale(axes):
    assert axes.get_aspect() == 1.0
    rail, cloth = (patch for patch in axes.patches if isinstance(patch, Rectangle))
    assert cloth.get_bbox().extents == pytest.approx([0, 0, 100, 50])
    assert rail.get_bbox().contains(*cloth.get_bbox().max)


def test_each_pocket_is_a_hole_behind_its_mouth(axes):
    holes = [patch.center for patch in axes.patches if isinstance(patch, Circle)]
    assert len(holes) == 6
    for pocket, (x, y) in zip(pockets(PoolTable()), holes, strict=True):
        deep = (x - pocket.x / INCH) * pocket.into_x + (y - pocket.y / INCH) * pocket.into_y
        assert deep > 0.0


def test_the_diamonds_part_the_rails(axes):
    (diamonds,) = axes.lines
    x, y = diamonds.get_data()
    assert sorted({place for place in x if 0 < place < 100}) == [12.5, 25, 37.5, 62.5, 75, 87.5]
    assert sorted({place for place in y if 0 < place < 50}) == [12.5, 25, 37.5]


def test_a_ball_is_drawn_where_it_is(axes):
    draw_ball(axes, (30.0, 15.0), 1.125, fc="white")
    ball = axes.patches[-1]
    assert (ball.center, ball.radius) == ((30.0, 15.0), 1.125)
