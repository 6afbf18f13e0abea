"""Pictures show themselves in a notebook, and plots can be drawn on axes of one's own."""

import inspect
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import evenbreak.plots
from evenbreak.errors import InputError
from evenbreak.games import Drill, OneBall
from evenbreak.plots import draw, draw_shots, image_bytes
from evenbreak.plots.picture import legend_below, new_axes
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
    with pytest.raises(InputError, match="ax is"):
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
