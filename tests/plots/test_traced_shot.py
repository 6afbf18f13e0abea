import math

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from evenbreak.physics import PoolTable, aimed_shot, pockets, shot, strike, strike_for_speed
from evenbreak.physics.units import INCH
from evenbreak.plots.picture import image_bytes
from evenbreak.plots.traced_shot import bare_axes, draw_ball, draw_table, shot_on_table

FOUND = shot(strike_for_speed(60 * INCH, -0.3), math.radians(30), 24 * INCH)
CORNER = pockets(PoolTable())[3]
AIMED = aimed_shot(strike(1.5, -0.2), (0.7, 0.4), (1.2, 0.4), (CORNER.x, CORNER.y))


def words(figure):
    return " ".join(text.get_text() for axes in figure.axes for text in axes.texts)


def lines_of(axes, color):
    return [line for line in axes.lines if line.get_color() == color]


def test_the_paths_are_those_of_the_shot_full_where_the_balls_slide():
    whole, near, _ = shot_on_table(FOUND).axes
    for axes in (whole, near):
        blue = lines_of(axes, "#0072B2")
        assert [line.get_linestyle() for line in blue] == ["-", "--"] * 2
        parts = [leg.path(motion=m) for leg in FOUND.legs[:2] for m in ("slides", "rolls")]
        for line, part in zip(blue, parts, strict=True):
            drawn = np.array(line.get_data()).T
            assert drawn == pytest.approx(part[:, :2] / INCH)


def test_balls_and_table_are_to_scale():
    whole, near, _ = shot_on_table(FOUND).axes
    for axes in (whole, near):
        assert axes.get_aspect() == 1.0
    balls = [one for one in near.patches if getattr(one, "radius", None) is not None]
    assert {round(ball.radius, 9) for ball in balls} == {1.125}
    centers = [ball.center for ball in balls]
    ghost, standing = FOUND.ghost_position / INCH, FOUND.object_position / INCH
    for wanted in (ghost, standing):
        assert min(math.dist(wanted, center) for center in centers) < 1e-9
    assert math.dist(ghost, standing) == pytest.approx(2.25)
    assert whole.get_xlim()[1] - whole.get_xlim()[0] > 100.0


@pytest.mark.parametrize("cut", [-60, -30, 30, 60])
def test_a_word_on_the_end_of_a_way_lies_beside_its_ball(cut):
    found = shot(strike_for_speed(150 * INCH, -0.3), math.radians(cut), 24 * INCH)
    figure = shot_on_table(found)
    whole = figure.axes[0]
    image_bytes(figure)
    for leg, text in zip(found.legs[-2:], whole.texts, strict=True):
        box = text.get_window_extent().transformed(whole.transData.inverted())
        x, y = leg.state(leg.end).position / INCH
        gap = max(box.x0 - x, x - box.x1, box.y0 - y, y - box.y1)
        assert gap > 1.0


def test_the_angles_are_written():
    said = words(shot_on_table(FOUND))
    assert "cut 30.0° to the right" in said
    assert f"throw {math.degrees(FOUND.throw):.1f}°" in said
    assert said.count("stops") == 2


def test_an_aimed_shot_shows_target_and_allowance():
    figure = shot_on_table(AIMED)
    assert f"aim {math.degrees(AIMED.turn):.1f}° thinner" in words(figure)
    assert "drops" in words(figure)
    crosses = [line for line in figure.axes[0].lines if line.get_marker() == "x"]
    assert [np.ravel(line.get_data()) * INCH for line in crosses] == [pytest.approx(AIMED.target)]


def test_english_that_throws_the_ball_backward_asks_for_a_fuller_hit():
    english = strike(1.5, 0.2, -0.4)
    figure = shot_on_table(
        aimed_shot(english, (0.7, 0.6), (1.0, 0.6), (CORNER.x, PoolTable().width - CORNER.y))
    )
    assert "° fuller" in words(figure)
    assert "throw \N{MINUS SIGN}" in words(figure)


def test_a_shot_that_hits_nothing_is_drawn_too():
    figure = shot_on_table(shot(strike(0.01), 0.3, 0.5))
    assert [axes.get_title() for axes in figure.axes] == ["", "As aimed", ""]
    assert "no hit" in words(figure)


def test_the_picture_is_the_same_every_time():
    assert image_bytes(shot_on_table(AIMED)) == image_bytes(shot_on_table(AIMED))


def key_of(found):
    return [text.get_text() for text in shot_on_table(found).axes[-1].get_legend().get_texts()]


def test_the_key_has_only_what_is_drawn_ghost_balls_as_they_are_drawn():
    assert key_of(FOUND)[:4] == [
        *("cue ball, slides", "cue ball, rolls", "object ball, slides", "object ball, rolls")
    ]
    soft = shot(strike_for_speed(0.1, 0.4), 0.3, 0.5)  # rolls from the tip on, and stops
    assert key_of(soft) == ["cue ball, rolls", "line of centers", "tangent line", "ghost ball"]
    figure = shot_on_table(AIMED)
    ghosts = [one for one in figure.axes[-1].get_legend().legend_handles if hasattr(one, "radius")]
    # Black and green circles; the standing balls are filled.
    drawn = [
        one
        for one in figure.axes[1].patches
        if hasattr(one, "radius") and one.get_facecolor()[3] == 0
    ]
    assert [one.get_edgecolor() for one in ghosts] == [one.get_edgecolor() for one in drawn]
    assert len({one.get_edgecolor() for one in ghosts}) == 2


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("cut", [-1.2, -0.5, 0.0, 0.5, 1.2])
def test_the_word_on_an_end_stands_on_the_cloth(cut):
    whole = shot_on_table(shot(strike_for_speed(3.0), cut, 24 * INCH)).axes[0]
    assert any(text.get_text() == "cushion" for text in whole.texts)
    for text in whole.texts:
        box = text.get_window_extent().transformed(whole.transData.inverted())
        assert min(box.x0, box.y0) >= 0.0
        assert (box.x1 <= 100.0, box.y1 <= 50.0) == (True, True)


def test_a_full_hit_has_no_side():
    assert "full hit" in words(shot_on_table(shot(strike_for_speed(1.0), 0.0, 24 * INCH)))


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
