"""The story of a night: the log folded again after each result."""

from dataclasses import replace

import pytest

from evenbreak.answers.tournament.story import remarks, story_answer
from evenbreak.sheets.story_drawing import story_svg
from evenbreak.tournaments.evening import story as telling
from evenbreak.tournaments.evening.events import (
    Called,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Result,
    Scored,
    Undone,
)
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.story import story_of

NAMES = ("Ann", "Bo", "Cy", "Di & <Sons>")


def night(*happened):
    entrants = tuple(Entrant(name, 600.0 - 40.0 * k) for k, name in enumerate(NAMES))
    begin = Opened(Plan("single", 5, scale="fargo"), entrants), Drawn(NAMES, (0, 3, 1, 2))
    return evening(
        Event(f"2025-03-01T{19 + k // 6}:{k % 6}0:00", what)
        for k, what in enumerate((*begin, *happened))
    )


FIRST = Result("W1.1", ("Ann", "Di & <Sons>"), (3, 5), "Di & <Sons>")
SECOND = Result("W1.2", ("Bo", "Cy"), (5, 4), "Bo")
HAPPENED = (Called("W1.1", 1, FIRST.players), FIRST, Scored("W1.2", SECOND.players, (4, 4)), SECOND)


def test_each_step_is_the_outlook_of_its_moment():
    state = night(*HAPPENED)
    story = story_of(state)
    assert [step.result and step.result.match for step in story.steps] == [None, "W1.1", "W1.2"]
    title = dict(zip(state.order, Outlook(state, story.steps[-1].at).odds.title, strict=True))
    assert story.steps[-1].title == pytest.approx(title)
    assert story.steps[1].minutes == 10.0
    assert story.upset == story.steps[1]
    assert story.steps[1].chance == pytest.approx(0.105, abs=0.1)
    assert story.closest == story.steps[2]  # from hill-hill


def test_a_correction_and_an_undo_read_as_if_they_had_been_right_at_once():
    wrong = replace(FIRST, score=(5, 3), winner="Ann")
    corrected = night(HAPPENED[0], wrong, *HAPPENED[2:], replace(FIRST, corrects=True))
    undone = night(HAPPENED[0], wrong, Undone(), FIRST, *HAPPENED[2:])
    for state in (corrected, undone):
        told = story_of(state)
        assert [s.title for s in told.steps] == [s.title for s in story_of(night(*HAPPENED)).steps]


def test_a_story_goes_on_where_it_was_and_may_be_told_in_parts():
    whole = story_of(night(*HAPPENED))
    part = story_of(night(*HAPPENED), within=-1.0)
    assert len(part.steps) == 1
    assert not part.whole
    while not part.whole:
        part = story_of(night(*HAPPENED), part, within=-1.0)
    assert part.steps == whole.steps
    later = story_of(night(*HAPPENED), story_of(night(*HAPPENED[:2])))
    assert later == whole


def test_it_is_said_and_drawn_without_markup_of_names():
    state = night(*HAPPENED)
    story = story_of(state)
    said = " ".join(map(str, story_answer(state, story).sentences))
    assert "Upset of the night: Di & <Sons> 5-3 Ann" in " ".join(said.split())
    assert len(remarks(story)) == 3
    drawn = story_svg(story)
    assert "Di &amp; &lt;Sons&gt;" in drawn
    assert "<Sons>" not in drawn
    assert drawn.count("<polyline") == 4


def test_of_a_long_night_each_result_adds_a_step_or_two(monkeypatch):
    monkeypatch.setattr(telling, "MOST_STEPS", 2)
    final = Result("F", ("Di & <Sons>", "Bo"), (5, 1), "Di & <Sons>")
    earlier, later = (story_of(night(*HAPPENED, *more)) for more in ((), (final,)))
    assert set(earlier.folded) <= set(later.folded)
    assert len(later.folded) == len(earlier.folded) + 1 == 3
