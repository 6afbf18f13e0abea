"""One drawing of a bracket: every match once and apart from others, every name whole."""

import re
import time
import zlib
from itertools import combinations, pairwise

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Rectangle

from evenbreak.answers.tournament.bracket_view import bracket_panels
from evenbreak.answers.tournament.short_names import rough_width, short_names
from evenbreak.sheets.bracket_drawing import BOX_HIGH, BOX_WIDE, drawing, pages
from evenbreak.sheets.bracket_page import (
    bracket_html,
    bracket_picture,
    bracket_rounds,
    bracket_svg,
)
from evenbreak.sheets.bracket_paper import (
    Sheet,
    bracket_figure,
    bracket_pages,
    bracket_pdf,
)
from evenbreak.sheets.pdf_page import PAPERS, SMALLEST
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import evening

AT = "2025-03-01T19:30:00"
FIRST = ("Maximiliane", "Jean-Christophe", "Bartholomew", "Fatou", "Søren", "Li", "Zoë")
LAST = ("Hohenberger-Wallnöfer", "van der Westhuizen", "Ndiaye-Roy", "Papadopoulos", "Wu")
SHEET = Sheet("A very long name of an event " * 4, "Races to 5", "", "", "http://10.0.0.7:8000/")
DPI = 300  # at a screen's, widths are rounded to whole dots
SLACK = 0.02  # inches: letters lean out of the widths that fonts give them
FORMS = [
    *(("double", count, 0, {}) for count in (2, 3, 4, 5, 7, 8, 13, 33)),
    ("double", 19, 22, {"losers_race": 3}),
    ("double", 4, 9, {}),
    ("double", 32, 8, {"qualifiers": 8}),
    *(("single", count, 3, {"third_place": count > 4}) for count in (2, 5, 13, 64)),
    ("consolation", 15, 9, {}),
    ("pods", 30, 6, {}),
    ("groups", 12, 6, {"groups": 3, "qualifiers": 2}),
    ("round-robin", 7, 6, {}),
    ("swiss", 12, 4, {"rounds": 3}),
    ("king-of-the-hill", 15, 2, {}),
]


def long_names(count):
    """Return names that differ, and one without any blank."""
    made = [f"{FIRST[k % 7]} {LAST[k % 5]}{' Jr.' * (k >= 35)}" for k in range(count - 1)]
    return [*made, "Maschinenbauingenieurin"]


def night(form, players, results, **plan):
    entrants = tuple(Entrant(name, 500.0) for name in players)
    events = [Event(AT, Opened(Plan(form, 5, scale="fargo", **plan), entrants))]
    rng = np.random.default_rng(3)
    events += [Event(AT, what) for what in moves.draw_next(evening(events), rng)]
    for _ in range(results):
        state = evening(events)
        if not state.standing.to_play:
            break
        match = state.standing.to_play[0]
        need = state.needed(match, state.pair(match))
        score = (need[0], int(rng.integers(need[1])))
        events.append(Event(AT, moves.result(state, match, score)))
    state = evening(events)
    for match in state.standing.to_play[:1]:
        events.append(Event(AT, moves.call(state, match, None)))
    return evening(events)


@pytest.mark.parametrize(("form", "count", "results", "plan"), FORMS)
def test_every_match_is_drawn_once_apart_from_others_and_its_line_leads_where_winners_go(
    form, count, results, plan
):
    state = night(form, long_names(count), results, **plan)
    panels = bracket_panels(state)
    drawn = drawing(panels)
    played = {name for name, seats in state.standing.seats.items() if -1 not in seats}
    assert {one.box.match for one in drawn.boxes} == played
    for one, other in combinations(drawn.boxes, 2):
        apart = abs(one.x - other.x) > BOX_WIDE or abs(one.y - other.y) > BOX_HIGH
        assert apart, (one.box, other.box)
    for x, y in ((x, y + dy) for _, x, y in drawn.boxes for dy in (-0.5, 0.5)):
        assert 0.0 <= x <= drawn.wide - BOX_WIDE + 1e-9
        assert -1e-9 <= y <= drawn.high + 1e-9
    left = {(round(x, 6), round(y, 6)): box.match for box, x, y in drawn.boxes}
    below = {(round(x + BOX_WIDE / 2, 6), round(y + BOX_HIGH / 2, 6)): b for b, x, y in drawn.boxes}
    right = {(round(x + BOX_WIDE, 6), round(y, 6)): box.to for box, x, y in drawn.boxes}
    above = {
        (round(x + BOX_WIDE / 2, 6), round(y - BOX_HIGH / 2, 6)): b.to for b, x, y in drawn.boxes
    }
    for corners in drawn.lines:
        start, end = (tuple(round(one, 6) for one in corners[k]) for k in (0, -1))
        to = left.get(end) or below[end].match
        assert to in (right.get(start), above.get(start))
    if any(panel.linked for panel in panels):
        leading = sum(bool(one.box.to) for one in drawn.boxes)
        assert len(drawn.lines) + len(drawn.onward) == leading
    for parts in (pages(panels, 9.0, 3), pages(panels, 4.0, 1)):
        shown = [box.match for part in parts for panel in part for box in panel.boxes]
        assert sorted(shown) == sorted(played)
        assert all(drawing(part).wide <= 3.0 for part in parts)


def test_the_final_stands_above_the_last_round_of_the_losers_and_byes_leave_no_box():
    drawn = drawing(bracket_panels(night("double", [f"P{k}" for k in range(19)], 0)))
    at = {one.box.number: (one.x, one.y) for one in drawn.boxes}
    assert sorted(at) == list(range(1, 38))
    assert at[36][0] == at[35][0] == drawn.wide - BOX_WIDE
    assert at[36][1] < at[35][1]
    assert round(drawn.wide) == 7  # rounds: the whole night


def texts_of(figure):
    """Return each text with where it is, in inches from the bottom left corner."""
    figure.set_dpi(DPI)
    renderer = FigureCanvasAgg(figure).get_renderer()
    (axes,) = figure.axes
    texts = [text for text in axes.texts if text.get_text()]
    return [(text, text.get_window_extent(renderer).extents / DPI) for text in texts]


def frames_of(figure):
    (axes,) = figure.axes
    high = figure.get_size_inches()[1]
    boxes = [one for one in axes.patches if isinstance(one, Rectangle) and not one.get_fill()]
    return [
        (b.get_x(), high - b.get_y() - b.get_height(), b.get_width(), b.get_height()) for b in boxes
    ]


@pytest.mark.slow
@pytest.mark.parametrize(("form", "count", "results", "plan"), FORMS)
def test_on_paper_every_name_is_whole_in_its_box_and_no_text_lies_on_another(
    form, count, results, plan
):
    players = long_names(count)
    panels = bracket_panels(night(form, players, results, **plan))
    for figure in (*bracket_pages(panels, SHEET), bracket_figure(panels, SHEET)):
        found, frames = texts_of(figure), frames_of(figure)
        wide, high = figure.get_size_inches()
        words = {word for name in players for word in re.findall(r"\S+", name)}
        swept = sorted(found, key=lambda one: one[1][0])
        for k, (text, (left, bottom, right, top)) in enumerate(swept):
            assert "…" not in text.get_text()
            assert min(left, bottom, wide - right, high - top) >= 0.0, text
            if set(re.findall(r"\S+", text.get_text())) & words:  # in a box
                middle = 0.5 * (bottom + top)
                assert any(
                    x - SLACK <= left and right <= x + w + SLACK and y <= middle <= y + h
                    for x, y, w, h in frames
                ), text
            for other, (start, low, _, up) in swept[k + 1 :]:
                if start >= right - SLACK:
                    break
                assert low >= top - SLACK or up <= bottom + SLACK, (text, other)


def written_in(pdf):
    """Return the pieces of text in a PDF, each with its size; of letters in Latin-1 alone."""
    pieces = []
    for stream in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", pdf, re.DOTALL):
        try:
            content = zlib.decompress(stream).decode("latin-1")
        except zlib.error:
            continue
        for shown in re.findall(r"\bBT\n(.*?)\nET\b", content, re.DOTALL):
            size = float(re.search(r"/F\S+ (\S+) Tf", shown)[1])
            letters = re.findall(r"\(((?:\\.|[^\\)])*)\)", shown)
            pieces.append((re.sub(r"\\(.)", r"\1", "".join(letters)), size))
    return pieces


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("paper", PAPERS)
@pytest.mark.parametrize("count", [5, 7, 8])
def test_a_page_is_filled_by_few_players_and_19_have_one(paper, count):
    short = [f"{first} {last}" for first in FIRST[3:] for last in ("Lee", "Oduya", "Vandermeer")]
    panels = bracket_panels(night("double", [*short, *(f"No {k}" for k in range(7))], 0))
    assert len(bracket_pages(panels, SHEET, paper)) == 1
    (page,) = bracket_pages(bracket_panels(night("double", short[:count], 0)), SHEET, paper)
    frames, high = frames_of(page), PAPERS[paper].high
    assert min(y for _, y, *_ in frames) < 0.25 * high
    assert max(x + w for x, _, w, _ in frames) > 0.9 * PAPERS[paper].wide


@pytest.mark.slow
@pytest.mark.parametrize("paper", ["a4", "letter"])
@pytest.mark.parametrize(("count", "most"), [(19, 2), (64, 6)])
def test_the_pdf_holds_every_name_in_full_at_eight_points_and_more(paper, count, most):
    players = long_names(count)
    panels = bracket_panels(night("double", players, count))
    pdf = bracket_pdf(panels, SHEET._replace(title="Night"), paper=paper)
    assert len(re.findall(rb"/Type /Page\b", pdf)) <= most
    size = " ".join(f"{72 * side:g}" for side in PAPERS[paper])
    assert re.search(rf"/MediaBox \[ ?0 0 {size}".encode(), pdf)
    pieces = written_in(pdf)
    assert min(size for _, size in pieces) >= SMALLEST - 1e-9
    halves = [text for text, _ in pieces]
    pairs = {f"{one}{gap}{other}" for one, other in pairwise(halves) for gap in ("", " ")}
    assert not set(players) - set(halves) - pairs
    assert {str(box.number) for panel in panels for box in panel.boxes} <= set(halves)


@pytest.mark.parametrize("count", [8, 19, 64])
def test_on_a_page_no_name_is_cut_and_all_fit_their_boxes(count):
    players = long_names(count)
    state = night("double", players, count)
    chances = dict.fromkeys(state.standing.to_play, 0.62)
    panels = bracket_panels(state, chances)
    page = bracket_svg(panels)
    assert "…" not in page
    shown = re.findall(r'class="name[^"]*"[^>]*?(?: font-size="([\d.]+)")?>([^<]*)<', page)
    forms = dict.fromkeys(text for _, text in shown)
    initials = {name.split(" ")[-1][0] for name in players}
    assert len(forms) <= count
    assert all(text.split(" ")[-1][0] in initials for text in forms)
    room = 232.0 * BOX_WIDE
    for size, text in shown:
        assert float(size or 18.5) * rough_width(text) < room
    assert page.count("62%") == sum(name in chances for name in state.standing.to_play)
    rounds = bracket_rounds(panels)
    assert all(f"<bdi>{name}</bdi>" in rounds for name in players)


def test_short_forms_are_no_longer_than_needed_and_nobody_elses():
    players = ["Renée Dubois-Lachapelle", "Dave Przybylski-Thornton", "Ann Lee", "Kev"]
    for room, form in ((30, players[0]), (20, "R. Dubois-Lachapelle"), (12, "R. Dubois-L.")):
        assert short_names(players, lambda text, most=room: len(text) <= most)[players[0]] == form
    many = long_names(64)
    for room in (1, 8, 14, 18, 22):
        written = short_names(many, lambda text, most=room: len(text) <= most)
        assert list(written) == many
        assert len(set(written.values())) == len(many)


@pytest.mark.parametrize("draw", [bracket_svg, bracket_rounds])
def test_names_of_any_script_are_text(draw):
    names = ["<b>Ann</b> & Co", "$x^2$ \\alpha", "選手 一", "A" * 70]
    panels = bracket_panels(night("single", names, 0))
    for page in (draw(panels), bracket_html(panels, ["<i>Night</i>"]).decode()):
        assert "<b>Ann" not in page
        assert "選手" in page
    assert bracket_picture(panels).startswith(b"<svg xmlns=")
    assert bracket_pdf(panels, SHEET).startswith(b"%PDF-")


def test_states_are_shapes_and_scores_are_not_races():
    events = list(night("single", ["Ann", "Bo", "Cy", "Di"], 0).events)
    state = evening(events)
    called = state.on_tables.keys()
    (match,) = called
    boxes = {box.match: box for panel in bracket_panels(state) for box in panel.boxes}
    assert boxes[match].state == "called"
    assert [line.needs for line in boxes[match].lines] == [5, 5]
    for games, shape in (((3, 0), "playing"), ((4, 4), "hill")):
        events.append(Event(AT, moves.score(evening(events), match, games)))
        panels = bracket_panels(evening(events), {match: 0.25})
        box = next(box for panel in panels for box in panel.boxes if box.match == match)
        assert box.state == shape
        assert [line.score for line in box.lines] == [str(n) for n in games]
        assert [line.chance for line in box.lines] == [0.25, 0.75]
        assert f'class="m {shape} is-on"' in bracket_svg(panels)
    by_phones = bracket_panels(evening(events), states={match: "two"})
    assert 'class="m two is-on"' in bracket_svg(by_phones)


def test_nineteen_players_are_drawn_in_less_than_five_milliseconds():
    state = night("double", long_names(19), 20)
    assert state.standing.to_play

    def took():
        start = time.process_time()
        panels = bracket_panels(state)
        bracket_svg(panels)
        bracket_rounds(panels)
        return time.process_time() - start

    assert min(took() for _ in range(10)) < 0.005
