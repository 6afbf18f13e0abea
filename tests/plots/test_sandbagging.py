"""Pictures of sandbagging show the lines that they say."""

import numpy as np

from evenbreak.handicaps import Ladder
from evenbreak.league import Watched, sandbagging
from evenbreak.plots.league import MOST_NAMED, draw_pay, draw_watch


def test_each_line_is_the_chance_to_win():
    pays = sandbagging(Ladder("npl"), dumped=4, earnest=6)
    axes = draw_pay(pays)
    assert len(axes.lines) == 5
    for dumped, line in enumerate(axes.lines):
        assert list(line.get_ydata()) == pays.p_win[dumped].tolist()


def test_the_most_suspicious_are_named_and_all_are_drawn():
    rows = np.arange(2)
    watched = [
        Watched(f"p{k}", rows, rows > 0, np.array([0.0, k]), np.array([0.0, 0.0]), "any", 0.05)
        for k in range(MOST_NAMED + 3)
    ]
    axes = draw_watch(watched, alpha=0.05)
    assert len(axes.lines) == 1 + len(watched)
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["alarm", *(f"p{k}" for k in range(MOST_NAMED + 2, 2, -1))]
    assert axes.lines[0].get_ydata()[0] == 20.0


def test_dollars_in_a_name_are_not_set_as_a_formula():
    rows, e = np.arange(1), np.zeros(1)
    axes = draw_watch([Watched("$x$", rows, rows > 0, e, e, "any", 0.01)], alpha=0.01)
    assert not axes.get_legend().get_texts()[1].get_parse_math()
