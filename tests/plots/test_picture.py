"""Pictures show themselves in a notebook, and plots can be drawn on axes of one's own."""

from __future__ import annotations

import importlib
import inspect
import io
import pkgutil
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import evenbreak.plots
from evenbreak import plots
from evenbreak.errors import InputError
from evenbreak.games import Drill, OneBall
from evenbreak.plots import draw, draw_shots, image_bytes
from evenbreak.plots.picture import (
    LINES,
    figure_of,
    label_beside,
    label_on,
    legend_below,
    mark_points,
    new_axes,
    small_svg,
    unit_axis,
    write_title,
)
from evenbreak.plots.practice import draw_drill, draw_two_lists
from evenbreak.practice import ShotChoice, drill_statistics
from rows import each_of


@pytest.mark.slow
def test_a_picture_shows_itself_where_pyplot_was_never_imported():
    code = (
        "import sys\n"
        "from evenbreak import OneBall\n"
        "from evenbreak.plots import draw\n"
        "picture = draw(OneBall(0.4, 0.8))\n"
        "assert picture._repr_png_()[1:4] == b'PNG'\n"
        "assert '<svg' in picture._repr_svg_()\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    "plot",
    [
        lambda ax: draw(OneBall(0.4, 0.8), title="One-ball", ax=ax),
        lambda ax: draw_shots([ShotChoice("bank", 0.4, 0.8)], ax=ax),
        lambda ax: draw_drill(drill_statistics(Drill.progressive(0.8)), ax=ax),
        lambda ax: draw_two_lists(
            np.array([50.0, 44.0]), np.array([53.0]), ("before", "after"), (None, None), ax=ax
        ),
    ],
)
def test_a_plot_is_drawn_on_the_axes_given_and_on_no_others(plot):
    figure = Figure(figsize=(8, 4))
    left, right = figure.subplots(1, 2)
    assert plot(right) is right
    assert figure.axes == [left, right]
    assert not left.has_data()
    assert figure.get_size_inches().tolist() == [8, 4]
    assert image_bytes(right, "png") == image_bytes(figure, "png")


@pytest.mark.parametrize(
    "ax",
    [
        True,
        Figure(),
        Figure().subplots(1, 2),
        Figure().add_subplot(projection="polar"),
    ],
)
def test_what_is_not_plain_axes_is_refused(ax):
    with pytest.raises(InputError, match="ax must"):
        draw(OneBall(0.4, 0.8), ax=ax)


def test_other_kinds_of_picture_are_refused():
    with pytest.raises(InputError, match="'jpg'"):
        image_bytes(Figure(), "jpg")


def test_a_legend_stands_inside_the_axes_given():
    axes = new_axes("p", "W", ax=Figure().add_subplot())
    axes.plot([0, 1], label="3:3")
    legend_below(axes, axes)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["3:3"]


SEVERAL_PANELS = {
    "breaks_figure",
    "ladder_figure",
    "course_figure",
    "shot_on_table",
    "share_panels",
}


def plot_functions():
    """Yield every function that makes a picture."""
    for path in sorted(Path(evenbreak.plots.__file__).parent.glob("*.py")):
        module = import_module(f"evenbreak.plots.{path.stem}")
        for name, function in vars(module).items():
            if not inspect.isfunction(function) or function.__module__ != module.__name__:
                continue
            returned = str(function.__annotations__.get("return"))
            if "Picture" in returned or ("Axes" in returned and name.startswith("draw")):
                yield name, function


FUNCTIONS = dict(plot_functions())


@each_of("name", sorted(FUNCTIONS))
def test_every_plot_with_one_panel_takes_axes(name):
    takes = "ax" in inspect.signature(FUNCTIONS[name]).parameters
    assert takes != (name in SEVERAL_PANELS)


def test_the_plots_are_found():
    assert set(FUNCTIONS) > SEVERAL_PANELS | {"draw", "draw_shots", "draw_scores"}
    assert isinstance(new_axes("p", "W"), Axes)


# Plots look alike, and no line needs color to be told from the others.


def test_no_two_lines_share_a_color_or_a_dash() -> None:
    assert len({line.color for line in LINES}) == len(LINES)
    assert len({line.linestyle for line in LINES}) == len(LINES)


def test_there_are_lines_for_the_nine_levels_of_a_drill() -> None:
    assert len(LINES) >= 9


def test_no_line_is_too_pale_to_be_read_in_gray() -> None:
    for line in LINES:
        red, green, blue = (int(line.color[i : i + 2], 16) / 255 for i in (1, 3, 5))
        assert 0.299 * red + 0.587 * green + 0.114 * blue < 0.7, line


def test_axes_carry_their_labels_and_title() -> None:
    axes = new_axes("rack", "chance", title="Racks", size=(3.0, 2.0))
    assert axes.figure.axes == [axes]
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title()) == ("rack", "chance", "Racks")
    assert tuple(axes.figure.get_size_inches()) == (3.0, 2.0)


def test_only_the_axes_named_run_from_0_to_1() -> None:
    axes = new_axes("p", "W")
    axes.set_ylim(0, 7)
    unit_axis(axes, "x")
    assert axes.get_xlim() == (0, 1)
    assert axes.get_ylim() == (0, 7)
    ticks = [*axes.get_xticks(), *axes.get_xticks(minor=True)]
    assert sorted(ticks) == pytest.approx([tenth / 10 for tenth in range(11)])


def test_names_of_curves_stand_on_or_beside_their_point() -> None:
    axes = new_axes("p", "W")
    unit_axis(axes, "x", "y")
    on = label_on(axes, 0.5, 0.5, "3:3")
    beside = {side: label_beside(axes, 0.5, 0.5, "3:3", side) for side in ("left", "right")}
    above = label_beside(axes, 0.5, 0.5, "3:3", "above")
    axes.figure.canvas.draw()
    x, y = axes.transData.transform((0.5, 0.5))
    assert on.get_window_extent().contains(x, y)
    assert beside["left"].get_window_extent().x1 < x < beside["right"].get_window_extent().x0
    assert above.get_window_extent().y0 > y


def test_a_long_title_is_written_in_lines_that_fit():
    figure = figure_of(new_axes("p", "W", size=(6.0, 4.0)))
    write_title(figure, "Race 7:5\n" + "A rated 600, B rated 540, on the Fargo scale " * 3)
    FigureCanvasAgg(figure).draw()
    lines = figure.get_suptitle().splitlines()
    assert lines[0] == "Race 7:5"
    box = figure._suptitle.get_window_extent()
    assert 0 <= box.x0 < box.x1 <= figure.bbox.x1


def test_every_figure_is_drawn_in_our_own_look() -> None:
    figures = {
        function
        for module in pkgutil.iter_modules(plots.__path__, "evenbreak.plots.")
        for name, function in inspect.getmembers(importlib.import_module(module.name))
        if inspect.isfunction(function) and function.__module__ == module.name
        for returned in [str(function.__annotations__.get("return"))]
        if "tuple" not in returned
        if "Picture" in returned or ("Axes" in returned and name.startswith("draw"))
    }
    assert len(figures) > 20
    assert [figure.__name__ for figure in figures if not hasattr(figure, "__wrapped__")] == []


# A small SVG shows what matplotlib drew.


PLACE = re.compile(r'translate\(([-\d.]+) ([-\d.]+)\)|[" ]x="([-\d.]+)"')


def places(svg: str) -> list[float]:
    return [float(number) for found in PLACE.findall(svg) for number in found if number]


def test_it_is_smaller_and_nothing_moves_by_more_than_a_twentieth_of_a_point() -> None:
    whole = io.StringIO()
    draw(OneBall(0.4, 0.8)).figure.savefig(whole, format="svg")
    small = small_svg(whole.getvalue())
    assert len(small) < 0.75 * len(whole.getvalue())
    before, after = places(whole.getvalue()), places(small)
    assert len(before) == len(after) > 10
    assert max(abs(x - y) for x, y in zip(before, after, strict=True)) < 0.051


def test_every_shape_that_is_used_is_there() -> None:
    svg = image_bytes(draw(OneBall(0.4, 0.8))).decode()
    ET.fromstring(svg)  # noqa: S314
    used = set(re.findall(r"[\"(]#([\w.-]+)", svg))
    assert used
    assert used == set(re.findall(r' id="([\w.-]+)"', svg))


# Dots stand at their points, and names where the square has room.


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("x", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("y", [0.0, 0.5, 1.0])
def test_a_name_stays_inside_the_square(x: float, y: float) -> None:
    axes = new_axes("", "")
    unit_axis(axes, "x", "y")
    mark_points(axes, [(x, y, "1")])
    axes.figure.canvas.draw()
    square, name = axes.get_window_extent(), axes.texts[0].get_window_extent()
    assert square.x0 < name.x0 < name.x1 < square.x1
    assert square.y0 < name.y0 < name.y1 < square.y1


def test_points_in_one_place_share_a_dot_and_a_bare_dot_has_no_name() -> None:
    axes = new_axes("", "")
    mark_points(axes, [(0.2, 0.3, "1"), (0.2, 0.3, "2"), (0.7, 0.3, "")])
    assert [tuple(line.get_xydata()[0]) for line in axes.lines] == [(0.2, 0.3), (0.7, 0.3)]
    assert [text.get_text() for text in axes.texts] == ["1, 2"]
