"""What holds for every figure of the text."""

from importlib.resources import files

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from drawings import figure
from evenbreak.plots.picture import image_bytes
from evenbreak.source_text.reproduce import figures
from places import SHARED
from rows import each_of

PLOTS = [
    *(f"figure_5_{n}" for n in (1, 3, 6, 8, 9, 11)),
    *(f"figure_{n}" for n in ("3_1", "3_2", "3_3", "3_4", "4_4", "4_5", "4_7", "4_8")),
]
SKETCHES = [f"figure_{n}" for n in ("1_1", "1_2", "2_1", "4_1", "4_2", "4_3", "4_6")]
DIAGRAMS = ["figure_p5_24", *(f"figure_5_{n}" for n in (2, 4, 5, 7, 10))]
CHOSEN = [name for name in PLOTS if name < "figure_4_7" or name == "figure_4_8"]
"""Where the copy of the text has lost for which values it drew its curves."""


def caption(name):
    """Return what the page says of a figure of sections 1 to 4."""
    page = files("evenbreak.source_text").joinpath("templates/physics.md").read_text("utf-8")
    number = name.removeprefix("figure_").replace("_", ".")
    return page.partition("{{figure " + number + " ")[2].partition("}}")[0]


def test_every_figure_of_the_text_is_here():
    assert set(figures()) == {*PLOTS, *SKETCHES, *DIAGRAMS}
    facts = SHARED / "seed" / "physics_figures.csv"
    if facts.exists():
        numbers = {line.split(",")[0] for line in facts.read_text("utf-8").splitlines()[1:]}
        assert {f"figure_{number.replace('.', '_')}" for number in numbers} <= set(figures())


@each_of("name", PLOTS)
def test_every_panel_says_what_its_axes_measure(name):
    for axes in figure(name).axes:
        # The second scale of Fig. 4.7 shares the cut angles of the first.
        shares = name == "figure_4_7" and axes is figure(name).axes[1]
        assert shares or axes.get_xlabel()
        assert axes.get_ylabel()


@pytest.mark.parametrize("name", CHOSEN)
def test_what_is_chosen_is_said_in_the_picture_and_beside_it(name):
    drawn = figure(name)
    texts = [axes.get_title() for axes in drawn.axes]
    if drawn.get_suptitle():
        texts.append(drawn.get_suptitle())
    assert any("chosen" in text for text in texts)
    assert "chosen" in caption(name)


@pytest.mark.parametrize("name", SKETCHES)
def test_a_sketch_says_that_it_is_one(name):
    assert "sketch" in caption(name)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["figure_5_11", "figure_5_5", "figure_3_3"])
def test_a_readers_own_settings_do_not_change_a_figure(name):
    draw = figures()[name]
    usual = image_bytes(draw(), "svg")
    own = {"font.size": 20, "font.sans-serif": ["DejaVu Sans Mono"], "mathtext.fontset": "stix"}
    with mpl.rc_context(own | {"axes.linewidth": 3, "savefig.bbox": "tight"}):
        assert image_bytes(draw(), "svg") == usual


@pytest.mark.parametrize("name", PLOTS)
def test_plots_are_of_moderate_size(reports, name):
    assert 900 <= figure(name).get_size_inches()[0] * 150 <= 1400
    assert len(reports[f"{name}.svg"]) < 200_000


def boxes(axes, room=0.0):
    """Return the boxes of the names in a panel, and so many pixels of room around each."""
    found = [text.get_window_extent() for text in axes.texts if text.get_text()]
    return [box.padded(room) for box in found]


@pytest.mark.slow_after(4)
@pytest.mark.parametrize("name", [*PLOTS, *SKETCHES])
def test_no_two_names_touch(name):
    drawn = figure(name)
    FigureCanvasAgg(drawn).draw()
    for axes in [panel for one in drawn.axes for panel in (one, *one.child_axes)]:
        found = boxes(axes, 0.5)
        for here, box in enumerate(found):
            assert not any(box.overlaps(other) for other in found[here + 1 :])


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("name", ["figure_3_1", "figure_3_4", "figure_4_5", "figure_5_1"])
def test_no_name_lies_on_a_curve_or_leaves_its_panel(name):
    drawn = figure(name)
    FigureCanvasAgg(drawn).draw()
    for axes in [panel for one in drawn.axes for panel in (one, *one.child_axes)]:
        frame = axes.get_window_extent()
        curves = [axes.transData.transform(line.get_xydata()) for line in axes.lines]
        for box in boxes(axes):
            assert frame.x0 <= box.x0 < box.x1 <= frame.x1
            assert frame.y0 <= box.y0 < box.y1 <= frame.y1
            for points in curves:
                along = np.linspace(points[:-1], points[1:], 20).reshape(-1, 2)
                assert not box.count_contains(along)
