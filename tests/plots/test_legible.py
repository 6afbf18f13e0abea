"""Every picture of the gallery and of the reports can be read, and so can plots of odd answers."""

from collections.abc import Callable
from importlib import import_module
from unittest import mock

import pytest
from matplotlib.figure import Figure

from evenbreak.games import Race, Rack
from evenbreak.matches import live_odds
from evenbreak.plots.contours import breaks_figure
from evenbreak.plots.matches import course_figure
from evenbreak.plots.picture import figure_of, new_axes
from evenbreak.source_text.reproduce import figures
from legible import faults
from places import DOCS
from rows import each_of


@pytest.mark.slow
def test_every_picture_of_the_gallery_can_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(DOCS / "images")
    desk, groups = import_module("at_work").desk, import_module("shown").SHOWN.values()
    make, save = import_module("make_images").make, Figure.savefig
    drawn: list[Figure] = []

    def saved(figure: Figure, *args: object, **kwargs: object) -> None:
        drawn.append(figure)
        save(figure, *args, **kwargs)

    found = {}
    with desk() as place, mock.patch.object(Figure, "savefig", saved):
        for one in (one for group in groups for one in group):
            make(one, place)
            found |= {f"{one.name} {k}": faults(figure) for k, figure in enumerate(drawn)}
            drawn.clear()
    assert len(found) > 30
    assert {name: faulty for name, faulty in found.items() if faulty} == {}


@pytest.mark.slow
@each_of("name", list(figures()))
def test_every_figure_of_the_text_can_be_read(name: str) -> None:
    assert faults(figures()[name]()) == []


ODD: dict[str, Callable[[], Figure]] = {
    "a dot in a corner": lambda: breaks_figure(Rack(0.98, 0.03)),
    "a dot on a line": lambda: breaks_figure(Rack(0.6, 0.6)),
    "a long match": lambda: course_figure(live_odds(Race(9, 9, Rack(0.5)), [1, 2] * 8)),
}


@pytest.mark.slow
@each_of("name", ODD)
def test_plots_of_odd_answers_can_be_read(name: str) -> None:
    assert faults(ODD[name]()) == []


def test_counts_have_whole_ticks_however_few_they_are() -> None:
    axes = new_axes("matches won", "share", counts="x")
    axes.plot([0, 1], [0, 1])
    assert faults(figure_of(axes)) == []
    axes = new_axes("matches won", "share")
    axes.plot([0, 1], [0, 1])
    assert faults(figure_of(axes)) == ["'matches won' has ticks between whole numbers"]
