"""A finished night as one page to share: places, prizes, bracket, story, results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape

from markupsafe import Markup

from evenbreak.answers.tournament.bracket_view import bracket_panels
from evenbreak.answers.tournament.printed import paper_words
from evenbreak.answers.tournament.story import remarks
from evenbreak.sheets.bracket_page import bracket_both
from evenbreak.sheets.html_page import Section, html_page, own_file, shown_name
from evenbreak.sheets.story_drawing import story_svg
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.story import Story
from evenbreak.words import PYTHON, Face, in_face, say, tally


def night_html(
    state: Evening,
    places: Sequence[tuple[str, str, float]],
    story: Story | None,
    name: str,
    face: Face = PYTHON,
) -> bytes:
    """Return a night as one self-contained page of HTML in UTF-8.

    Places have names and prizes; `name` is for a plan without one.
    """

    def said(text: str) -> str:
        return str(in_face(text, face))

    sections = [Section("places", said(say("Places")), _places(places, said))] if places else []
    if state.plan.form != "chips":
        drawn = bracket_both(bracket_panels(state), words=said, sight=False)
        sections.append(Section("bracket", said(say("Bracket")), drawn))
    if story is not None and len(story.steps) > 1:
        sections.append(
            Section("story", said(say("Story of the night")), _story(story, face, said))
        )
    sections.append(Section("results", said(say("Results")), _results(state, said)))
    about = paper_words(state)[0] if state.plan.form != "chips" else ""
    heading = [state.plan.name or name, *filter(None, (state.plan.date, about))]
    return html_page(
        heading=heading,
        links=[(one.id, one.title) for one in sections],
        sections=sections,
        below="",
        made_of="",
        more_style=own_file("bracket.css") + own_file("night.css"),
        drawings=True,
    )


def _text(name: str) -> str:
    return escape(shown_name(name))


def _money(amount: float) -> str:
    return f"{amount:,.0f}" if amount == round(amount) else f"{amount:,.2f}"


def _places(places: Sequence[tuple[str, str, float]], said: Callable[[str], str]) -> Markup:
    first, rest = places[0], places[1:]
    paid = f" · {_money(first[2])}" if first[2] else ""
    lines = [
        f'<div class="champion"><p>{escape(said(say("Champion")))}{paid}</p>'
        f'<p class="big"><bdi>{_text(first[1])}</bdi></p></div>',
        '<table class="places">',
    ]
    for place, name, amount in rest:
        money = _money(amount) if amount else ""
        lines.append(
            f'<tr><td class="number">{escape(place)}</td><th><bdi>{_text(name)}</bdi></th>'
            f'<td class="number">{money}</td></tr>'
        )
    return Markup("\n".join([*lines, "</table>"]))  # noqa: S704 - every name is escaped


def _story(story: Story, face: Face, said: Callable[[str], str]) -> Markup:
    small = story_svg(story, face, size=(480, 420))
    lines = [f'<div class="story wide">{story_svg(story, face)}</div>']
    lines.append(f'<div class="story small">{small}</div>')
    for one in remarks(story):
        words = ", ".join(said(part) for part in one[1:])
        lines.append(f"<p><strong>{escape(said(one[0]))}:</strong> {_text(words)}</p>")
    return Markup("\n".join(lines))  # noqa: S704 - every text is escaped


def _results(state: Evening, said: Callable[[str], str]) -> Markup:
    lines = ['<table class="results">']
    for match, result in state.counted.items():
        number = state.match_numbers.get(match, "")
        # After a correction the loser may have been let play on.
        winner, loser = (
            (result.loser, result.winner) if result.stands else (result.winner, result.loser)
        )
        forfeit, on = (escape(said(one)) for one in (say("forfeit"), say("played on")))
        played_on = f" ({on})" if result.stands else ""
        score = forfeit if result.forfeit else tally((result.games[winner], result.games[loser]))
        lines.append(
            f'<tr><td class="number">{number}</td><th><bdi>{_text(winner)}</bdi></th>'
            f'<td class="score">{score}</td><td><bdi>{_text(loser)}</bdi>{played_on}</td></tr>'
        )
    return Markup("\n".join([*lines, "</table>"]))  # noqa: S704 - every name is escaped
