"""No label of a printed bracket is cut, and none lies over another or outside its box."""

import os
import re
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Rectangle

from evenbreak.answers.tournament.bracket_view import bracket_panels, short_names
from evenbreak.sheets.bracket_drawing import READABLE, SIZES, bracket_figure, bracket_pages
from evenbreak.sheets.bracket_page import bracket_html
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import evening

AT = "2025-03-01T19:30:00"
FIRST = ("Maximiliane", "Jean-Christophe", "Bartholomew", "Fatou", "Søren", "Li")
LAST = ("Hohenberger-Wallnöfer", "van der Westhuizen", "Ndiaye-Roy", "Papadopoulos", "Wu")
HEADING = ["A very long name of an event that a director may have typed " * 3, "Races to 5"]
LARGE = [int(count) for count in os.environ.get("EVENBREAK_BRACKETS", "").split()]
"""Further numbers of players, such as '64 128'; each takes seconds."""

DPI = 300  # at a screen's, widths are rounded to whole dots
SLACK = 0.02  # inches: letters lean out of the widths that fonts give them


def names(count, words):
    """Return names that differ; of the same last names, and one without any blank."""
    made = [f"{FIRST[k % 6]} {LAST[k % 5]}{' Jr.' * (k % 2)} {k}"[:words] for k in range(count)]
    return [*made[1:], "Donaudampfschiff" * 2]


def panels_of(form, players, results, **plan):
    entrants = tuple(Entrant(name, 500.0) for name in players)
    events = [Event(AT, Opened(Plan(form, 5, scale="fargo", **plan), entrants))]
    rng = np.random.default_rng(3)
    events += [Event(AT, what) for what in moves.draw_next(evening(events), rng)]
    for _ in range(results):
        state = evening(events)
        match = state.standing.to_play[0]
        score = (5, int(rng.integers(5)))
        events.append(Event(AT, moves.result(state, match, score[:: rng.choice((1, -1))])))
    state = evening(events)
    for match in state.standing.to_play[:1]:
        events.append(Event(AT, moves.call(state, match, None)))
    return bracket_panels(evening(events))


def extents(figure):
    """Return each text with where it is, in inches from the bottom left corner."""
    figure.set_dpi(DPI)
    renderer = FigureCanvasAgg(figure).get_renderer()
    (axes,) = figure.axes
    texts = [text for text in axes.texts if text.get_text()]
    return [(text, text.get_window_extent(renderer).extents / DPI) for text in texts]


def frames(figure):
    (axes,) = figure.axes
    high = figure.get_size_inches()[1]
    boxes = [one for one in axes.patches if isinstance(one, Rectangle) and not one.get_fill()]
    return [
        (one.get_x(), high - one.get_y() - one.get_height(), one.get_width(), one.get_height())
        for one in boxes
    ]


CASES = [
    *(("double", count, 0, {}) for count in (2, 3, 7, 33, *LARGE)),
    *(("single", count, 0, {"third_place": count > 4}) for count in (2, 5, 13, 64, *LARGE)),
    ("double", 19, 12, {}),
    ("double", 32, 8, {"qualifiers": 8}),
    ("consolation", 16, 9, {}),
    ("pods", 16, 6, {}),
    ("groups", 12, 6, {"groups": 3, "qualifiers": 2}),
    ("round-robin", 8, 6, {}),
    ("swiss", 12, 4, {"rounds": 3}),
    ("king-of-the-hill", 6, 2, {}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("form", "count", "results", "plan"), CASES)
def test_every_label_is_whole_and_has_its_own_place(form, count, results, plan):
    players = names(count, 40)
    panels = panels_of(form, players, results, **plan)
    short = short_names(players)
    allowed = {*players, *short.values()}
    drawn = set()
    for figure in (*bracket_pages(panels, HEADING), bracket_figure(panels, HEADING)):
        found, boxes = extents(figure), frames(figure)
        drawn |= {text.get_text() for text, _ in found}
        assert not any("…" in text.get_text() for text, _ in found)
        wide, high = figure.get_size_inches()
        for text, (left, bottom, right, top) in found:
            assert min(left, bottom, wide - right, high - top) >= 0.0, text
        inside(found, boxes, allowed)
        apart(found)
    for panel in panels:
        for box in panel.boxes:
            for line in box.lines:
                assert not line.text or {line.text, short.get(line.text)} & drawn


@pytest.mark.parametrize("count", [4, 19])
def test_the_page_of_a_bracket_cuts_no_name(count):
    players = names(count, 40)
    page = bracket_html(panels_of("double", players, 0), HEADING).decode()
    drawing = "".join(re.findall("<svg.*?</svg>", page, re.DOTALL))
    assert "…" not in drawing
    assert all(name in drawing or short_names(players)[name] in drawing for name in players)
    assert drawing.count("textLength") >= 1  # the one without a blank


def inside(found, boxes, allowed):
    """Every player's name lies in a box."""
    for text, (left, bottom, right, top) in found:
        if text.get_text() in allowed:
            middle = 0.5 * (bottom + top)
            assert any(
                x - SLACK <= left and right <= x + width + SLACK and y <= middle <= y + height
                for x, y, width, height in boxes
            ), text


def apart(found):
    """No two texts lie over each other: they are swept from the left."""
    swept = sorted(found, key=lambda one: one[1][0])
    for k, (text, (_, bottom, right, top)) in enumerate(swept):
        for other, (left, low, _, high) in swept[k + 1 :]:
            if left >= right - SLACK:
                break
            assert low >= top - SLACK or high <= bottom + SLACK, (text, other)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(("count", "paper"), [(8, "a4"), (16, "letter"), (16, "a4"), (19, "a4")])
def test_usual_names_are_readable_on_the_paper_of_a_bar(count, paper):
    players = [f"{FIRST[k % 6]} {LAST[(k // 6) % 5]}" for k in range(count)]
    panels = panels_of("double", list(dict.fromkeys(players)), 0)
    for page in bracket_pages(panels, HEADING, paper):
        assert tuple(page.get_size_inches()) in SIZES[paper][:2]
        sizes = [text.get_size() for text, _ in extents(page) if text.get_text() in players]
        assert min(sizes, default=READABLE) >= READABLE


def test_sizes_of_paper_grow():
    assert all(a[0] < b[0] for sizes in SIZES.values() for a, b in pairwise(sizes))


def test_short_names_are_told_apart():
    players = names(60, 40)
    short = short_names(players)
    assert len(set(short.values())) == len(short)
    assert not set(short.values()) & set(players)
