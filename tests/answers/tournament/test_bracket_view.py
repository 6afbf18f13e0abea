"""Where the matches of a bracket are drawn: every match once, nothing over anything else."""

from itertools import pairwise

import pytest
from matplotlib.text import Text

from evenbreak.answers.tournament.bracket_view import bracket_panels
from evenbreak.sheets.bracket_drawing import bracket_figure, bracket_pdf
from evenbreak.sheets.bracket_page import bracket_html
from evenbreak.tournaments.brackets.knockout import seeded_lines
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Result, Scored
from evenbreak.tournaments.evening.fold import evening
from rows import each_of


def drawn(form: str, count: int, names: tuple[str, ...] = ()):
    players = names or tuple(f"Player {k}" for k in range(1, count + 1))
    plan = Plan(form, 5)
    begun = Opened(plan, tuple(Entrant(name, 80.0) for name in players))
    lines = None if form == "round-robin" else tuple(seeded_lines(count))
    return evening([Event("2025-03-01T19:30:00", what) for what in (begun, Drawn(players, lines))])


@each_of("form", ["single", "double", "consolation"])
@each_of("count", [2, 3, 5, 8, 13, 16, 32])
def test_every_match_has_a_place_of_its_own(form: str, count: int) -> None:
    if form == "consolation" and count < 4:
        count = 6
    state = drawn(form, count)
    panels = bracket_panels(state)
    boxes = [(panel, box) for panel in panels for box in panel.boxes]
    assert sorted(box.match for _, box in boxes) == sorted(m.name for m in state.bracket.matches)
    for panel in panels:
        for column in panel.columns:
            heights = [box.height for box in column]
            assert all(0.0 < height < 1.0 for height in heights)
            gaps = [b - a for a, b in pairwise(heights)]
            assert all(gap > 0.99 / panel.most for gap in gaps)
        names = {box.match for box in panel.boxes}
        assert all(box.to in names for box in panel.boxes if box.to)


def test_winners_lines_lead_to_where_winners_go() -> None:
    state = drawn("double", 16)
    graph = state.bracket.graph
    for panel in bracket_panels(state):
        for box in panel.boxes:
            if box.to:
                assert "winner" in graph.edges[box.match, box.to]
                later = next(one for one in panel.boxes if one.match == box.to)
                assert later.column == box.column + 1


@pytest.mark.parametrize("players", [("Player 1", "Player 4"), ("Player 4", "Player 1")])
def test_a_match_in_play_shows_its_score_and_a_race_is_not_a_score(
    players: tuple[str, str],
) -> None:
    events = list(drawn("single", 4).events)
    events.append(Event("2025-03-01T19:40:00", Scored("W1.1", players, (3, 0))))
    boxes = {box.match: box for panel in bracket_panels(evening(events)) for box in panel.boxes}
    scores = {line.text: line.score for line in boxes["W1.1"].lines}
    assert scores == dict(zip(players, ("3", "0"), strict=True))
    assert [line.score for line in boxes["W1.2"].lines] == ["", ""]
    assert [boxes[name].race for name in ("W1.1", "W1.2", "F")] == ["race to 5", "race to 5", ""]
    written = bracket_figure(bracket_panels(evening(events)), ["Night"])
    texts = [text.get_text() for text in written.findobj(Text)]
    assert texts.count("race to 5") == 2
    assert "5:5" not in texts


def test_names_of_any_script_are_text_everywhere() -> None:
    names = ("<b>Ann</b> & Co", "$x^2$ \\alpha", "選手 一", "A" * 70)
    panels = bracket_panels(drawn("single", 4, names))
    page = bracket_html(panels, ["<i>Night</i>"]).decode()
    assert "<b>Ann" not in page
    assert "&lt;b&gt;Ann&lt;/b&gt; &amp; Co" in page
    assert "選手" in page
    assert bracket_pdf(panels, ["Night"], "Night").startswith(b"%PDF-")
    assert bracket_figure(panels, ["Night"]).get_size_inches()[0] > 4.0


def test_scores_and_what_is_over_are_shown() -> None:
    state = drawn("single", 4)
    match = state.standing.to_play[0]
    one, other = state.pair(match)
    after = evening(
        [*state.events, Event("2025-03-01T20:00:00", Result(match, (one, other), (5, 3), one))]
    )
    (panel,) = bracket_panels(after)
    box = next(box for box in panel.boxes if box.match == match)
    assert box.state == "over"
    assert [(line.score, line.won) for line in box.lines] == [("5", True), ("3", False)]
