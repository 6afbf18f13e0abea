"""Plots look alike, and no line needs colour to be told from the others."""

import importlib
import inspect
import pkgutil

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from evenbreak import plots
from evenbreak.plots.picture import (
    LINES,
    figure_of,
    label_beside,
    label_on,
    new_axes,
    unit_axis,
    write_title,
)


def test_no_two_lines_share_a_colour_or_a_dash() -> None:
    assert len({line.color for line in LINES}) == len(LINES)
    assert len({line.linestyle for line in LINES}) == len(LINES)


def test_there_are_lines_for_the_nine_levels_of_a_drill() -> None:
    assert len(LINES) >= 9


def test_no_line_is_too_pale_to_be_read_in_grey() -> None:
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
