"""A bracket on a page: one drawing on a laptop or a wall, one round at a time on a phone.

Both are made here as text, because they are redrawn with every score. Pages supply the look
(bracket.css) and phrase the words in their reader's language.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from html import escape
from typing import Any

from markupsafe import Markup

from evenbreak.answers.tournament.bracket_view import Box, Line, Panel
from evenbreak.answers.tournament.short_names import rough_width, short_names
from evenbreak.sheets.bracket_drawing import BOX_HIGH, BOX_WIDE, Placed, drawing
from evenbreak.sheets.html_page import Section, html_page, own_file, shown_name
from evenbreak.words import Figure, say

COLUMN, ROW = 232.0, 49.0
"""A round's width and a match's height, in the drawing's own pixels."""

LETTERS = 18.5
"""The size of names."""

_WIDE, _HIGH = COLUMN * BOX_WIDE, ROW * BOX_HIGH
_EDGE, _SCORE, _CHANCE = 7.0, 24.0, 38.0  # beside a name
SHAPES = {
    "ready": ("open", "M10 5.5a4.5 4.5 0 1 1-9 0 4.5 4.5 0 1 1 9 0z"),
    "called": ("", "M2 1 10 5.5 2 10z"),
    "playing": ("", "M10 5.5a4.5 4.5 0 1 1-9 0 4.5 4.5 0 1 1 9 0z"),
    "hill": ("", "M0 10 3.5 3 5.5 6.5 7 4 11 10z"),
    "sent": ("open", "M10 5.5a4.5 4.5 0 1 1-9 0 4.5 4.5 0 1 1 9 0zM5.5 1v9M7.7 2v7"),
    "two": ("", "M5.5 0 11 5.5 5.5 11 0 5.5z"),
    "forfeit": ("open", "M1 1l9 9M10 1l-9 9"),
}
"""A match's state as a shape, 11 by 11: whether it is only an outline, and its outline."""

_ON_WHITE = {
    "paper": "#fff",
    "card": "#fff",
    "sunk": "#e9ebef",
    "ink": "#0e151d",
    "ink-2": "#46515e",
    "ink-3": "#5b6572",
    "edge": "#7d8793",
    "rule": "#b9c0c8",
    "live": "#00694c",
    "live-on": "#fff",
    "call": "#8a4600",
    "call-surface": "#ffb32e",
    "call-on": "#221200",
    "stop": "#ad1457",
    "stop-on": "#fff",
    "accent": "#0a57c2",
    "accent-on": "#fff",
}
_WORD = 7.5  # the width of the longest word on a small card, in sizes of its letters
_FEW = 8.0  # rounds that fit on a laptop

Words = Callable[[str], object]
"""Phrases a sentence in the reader's language."""

Link = Callable[[Box], str]
"""A match's address; '' for none."""


def no_link(_: Box) -> str:
    """Return no address, for pages without links."""
    return ""


def bracket_svg(
    panels: Sequence[Panel],
    *,
    words: Words = str,
    link: Link = no_link,
    chosen: str = "",
    within: float = 0.0,
) -> Markup:
    """Return a bracket's drawing as inline SVG, with each match linked and one selected.

    `within` is the aspect ratio (width divided by height) of the space to fill; 0: the usual width.

    >>> "<svg" in bracket_svg([Panel("winners", "", (), ())])
    True
    """
    drawn = drawing(panels)
    high = drawn.high * ROW + 4.0
    column = min(1.7 * COLUMN, max(COLUMN, within * high / max(1.0, drawn.wide)))
    page = _Page(column, words, link, _written(panels, column), chosen)
    wide = drawn.wide * column + 3.0
    lines = "".join(
        "M" + "L".join(f"{_at(x * column)} {_at(y * ROW)}" for x, y in corners)
        for corners in drawn.lines
    )
    lines += "".join(f"M{_at(x * column)} {_at(y * ROW)}h14" for x, y, _ in drawn.onward)
    many = " many" if drawn.wide > _FEW else ""
    text = [
        f'<svg class="drawn{many}" viewBox="0 0 {wide:.0f} {high:.0f}" width="{1.4 * wide:.0f}" '
        f'font-size="{LETTERS}" role="group" aria-label="{_said(words, say("Bracket"))}">',
        f'<path class="to" d="{lines}"/>' if lines else "",
    ]
    for one in drawn.headings:
        kind = "part" if one.large else "head"
        text.append(_text(kind, one.x * column, one.y * ROW, escape(str(words(one.text)))))
    text.append(
        f'<defs><g id="b{column:.0f}"><rect width="{_at(page.wide)}" height="{_HIGH:.1f}" rx="5"/>'
        f'<path class="mid" d="M0 {0.5 * _HIGH:.1f}h{_at(page.wide)}"/></g></defs>'
    )
    text += [page.box(one) for one in drawn.boxes]
    return Markup("".join([*text, "</svg>"]))  # noqa: S704  # every text in it is escaped


def _written(panels: Sequence[Panel], column: float) -> dict[str, str]:
    """Return how names are written throughout the drawing."""
    room = (column * BOX_WIDE - 2 * _EDGE - _SCORE) / LETTERS
    return short_names(_names(panels), lambda text: rough_width(text, bold=True) <= room)


def _text(kind: str, x: float, y: float, text: str, size: float = 0.0) -> str:
    sized = f' font-size="{size:.1f}"' if size else ""
    return f'<text class="{kind}" x="{_at(x)}" y="{_at(y)}"{sized}>{text}</text>'


def _at(place: float) -> str:
    """Return a coordinate in as few characters as possible."""
    return f"{place:.1f}".removesuffix(".0")


class _Page:
    """How to draw matches on a page."""

    def __init__(
        self, column: float, words: Words, link: Link, written: dict[str, str], chosen: str
    ) -> None:
        self.column, self.words, self.link, self.written = column, words, link, written
        self.chosen = chosen
        self.wide = column * BOX_WIDE

    def box(self, placed: Placed) -> str:
        """Return a match: its number or table, its state, its two players."""
        box = placed.box
        x, y = placed.x * self.column, placed.y * ROW
        top = y - 0.5 * _HIGH
        parts = [f'<use href="#b{self.column:.0f}" x="{_at(x)}" y="{_at(top)}"/>']
        if box.table:
            size = 14.0 if len(box.table) > 2 else 17.0
            room = max(29.0, 0.72 * size * len(box.table) + 8.0)
            left = x - room + 5.0
            parts.append(
                f'<rect class="badge" x="{_at(left)}" y="{_at(y - 14.5)}" width="{_at(room)}" '
                'height="29" rx="6"/>'
            )
            table = escape(box.table)
            parts.append(_text("table", left + 0.5 * room, y + 0.36 * size, table, size))
        else:
            parts.append(_text("no", x - 5.0, y - 4.0, str(box.number)))
        if box.state in SHAPES and (box.table or box.state == "ready"):
            kind, path = SHAPES[box.state]
            at = f"{_at(x - 17.0)} {_at(y + 3.0)}"
            if box.table:  # on the frame, clear of the score
                at = f"{_at(x + self.wide - 18.0)} {_at(top - 7.5)}"
            parts.append(
                f'<path class="shape {kind}" transform="translate({at})scale(.85)" d="{path}"/>'
            )
        parts += [self.line(box, k, one, x, y) for k, one in enumerate(box.lines)]
        address = self.link(box)
        maybe = " maybe" if box.beside < 0 and box.state == "waits" else ""
        kind = f'class="{_kind(box, self.chosen)}{maybe}"'
        if not address:
            return f"<g {kind}>{''.join(parts)}</g>"
        return f'<a {kind} href="{escape(address)}">{"".join(parts)}</a>'

    def line(self, box: Box, k: int, line: Line, x: float, y: float) -> str:
        """Return a match's player."""
        middle = y + (k - 0.5) * 0.5 * _HIGH + 0.36 * LETTERS
        text = self.written.get(line.text, line.text) if line.known else str(self.words(line.text))
        right, parts = x + self.wide - _EDGE, []
        room = self.wide - 2 * _EDGE
        if line.score:
            forfeit = line.score == "forfeit"
            parts.append(_text("score", right, middle, "✕" if forfeit else line.score))
            room -= _SCORE
        if line.chance is not None:
            at = right - (_SCORE if line.score else 0.0)
            chance = Figure(min(max(line.chance, 0.01), 0.99), ".0%")
            parts.append(_text("odds", at, middle, str(self.words(chance))))
            room -= _CHANCE
        wide = rough_width(text, bold=line.known) * LETTERS
        size = LETTERS * max(0.3, room / wide) if wide > room else 0.0
        kind = "name won" if line.won else "name" if line.known else "from"
        lost = " beaten" if line.known and not line.won and box.state in ("done", "forfeit") else ""
        parts.insert(0, _text(kind + lost, x + _EDGE, middle, escape(shown_name(text)), size))
        return "".join(parts)


def _kind(box: Box, chosen: str) -> str:
    """Return a match's CSS classes: its state, whether it is on a table, whether it was tapped."""
    on = " is-on" if box.table else ""
    return f"m {box.state}{on}{' chosen' if box.match == chosen else ''}"


def bracket_rounds(
    panels: Sequence[Panel],
    *,
    words: Words = str,
    link: Link = no_link,
    chosen: str = "",
    sight: bool = True,
) -> Markup:
    """Return a bracket for a phone: one round at a time.

    With `sight`, the next round is visible too, which takes a third more bytes.
    """
    say_it = partial(_said, words)
    card = partial(_card, words=words, chosen=chosen, written=_small(panels))
    text = ['<div class="phone">']
    for number, panel in enumerate(panels, 1):
        text.append(f'<section class="side" id="r{number}"><h2>{say_it(panel.title)}</h2>')
        if len(panels) > 1:
            names = [(f"r{k}", say_it(one.title)) for k, one in enumerate(panels, 1)]
            text.append(_nav("sides", say_it(say("Parts")), names, f"r{number}"))
        columns = panel.columns
        rounds = [k for k, column in enumerate(columns) if column]
        turns = [(f"r{number}-{k}", say_it(panel.rounds[k].short or str(k + 1))) for k in rounds]
        now = _round_now(panel)
        text.append('<div class="rounds" tabindex="0" role="group">')
        for k in rounds:
            here = f"r{number}-{k}"
            kind = "round now" if k == now else "round"
            title = say_it(panel.rounds[k].title or panel.title)
            text.append(f'<section class="{kind}" id="{here}"><h3>{title}</h3>')
            if len(rounds) > 1:
                text.append(_nav("turns", say_it(say("Rounds")), turns, here))

            def there(box: Box, here: str = here) -> str:
                address = link(box)
                return f"{address}#{here}" if address else ""

            text += _round(panel, k, partial(card, link=there), sight=sight)
            text.append("</section>")
        text.append("</div></section>")
    return Markup("".join([*text, "</div>"]))  # noqa: S704  # every text in it is escaped


def _small(panels: Sequence[Panel]) -> dict[str, str]:
    """Return names for the next round's small cards, where words aren't broken."""

    def fits(text: str) -> bool:
        return max(rough_width(word, bold=True) for word in re.split(r"[ -]", text)) <= _WORD

    return short_names(_names(panels), fits)


def _names(panels: Sequence[Panel]) -> list[str]:
    return [one.text for p in panels for box in p.boxes for one in box.lines if one.known]


def _said(words: Words, text: str) -> str:
    return escape(str(words(text)))


def _nav(kind: str, label: str, links: Sequence[tuple[str, str]], here: str) -> str:
    """Return links within the page, marking the one to the current place."""
    text = [f'<div class="{kind}" role="group" aria-label="{label}">']
    for to, word in links:
        current = ' aria-current="true"' if to == here else ""
        text.append(f'<a href="#{to}"{current}>{word}</a>')
    return "".join([*text, "</div>"])


def _round_now(panel: Panel) -> int:
    """Return the first unfinished round; the last if all are finished."""
    over = ("done", "forfeit")
    still = [box.column for box in panel.boxes if box.state not in over and box.beside >= 0]
    return min(still, default=max((box.column for box in panel.boxes), default=0))


def _round(panel: Panel, column: int, card: Callable[..., str], *, sight: bool) -> list[str]:
    """Return a round's matches, each with the others that lead to the same match."""
    names = {box.match: box for box in panel.boxes}
    groups: dict[str, list[Box]] = {}
    for box in panel.columns[column]:
        meet = sight and panel.linked and box.to in names
        groups.setdefault(box.to if meet else box.match, []).append(box)
    text = []
    for to, boxes in groups.items():
        text.append(f'<div class="meet{" two" if len(boxes) > 1 else ""}"><div>')
        text += [card(box) for box in boxes]
        then = f'<div class="then">{card(names[to], small=True)}</div>' if to == boxes[0].to else ""
        text.append(f"</div>{then}</div>")
    return text


def _card(
    box: Box,
    *,
    words: Words,
    link: Link,
    chosen: str,
    written: Mapping[str, str],
    small: bool = False,
) -> str:
    """Return a match as a card; a small card has short names."""
    lines = []
    over = box.state in ("done", "forfeit")
    for one in box.lines:
        text = one.text if one.known else str(words(one.text))
        text = written.get(text, text) if small else text
        kind = "won" if one.won else "from" if not one.known else "beaten" if over else ""
        score = "✕" if one.score == "forfeit" else one.score
        name = escape(shown_name(text))
        of_kind, games = (f' class="{kind}"' if kind else ""), (f" <b>{score}</b>" if score else "")
        lines.append(f"<span{of_kind}><bdi>{name}</bdi>{games}</span>")
    note = str(box.number)
    if box.table:
        note += f" · {_said(words, say('table {n}', n=box.table))}"
    elif box.title:
        note += f" · {_said(words, box.title)}"
    if box.state in SHAPES and box.state != "forfeit":
        kind, path = SHAPES[box.state]
        shape = f'<path class="{kind}" d="{path}"/>'
        note = f'<svg viewBox="-1 -1 13 13" aria-hidden="true">{shape}</svg>{note}'
    inside = f'<small>{note}</small><span class="lines">{"".join(lines)}</span>'
    address, kind = link(box), _kind(box, chosen)
    if small or not address:
        return f'<span class="{kind}"{" aria-hidden=true" if small else ""}>{inside}</span>'
    return f'<a class="{kind}" id="c{box.number}" href="{escape(address)}">{inside}</a>'


def bracket_html(panels: Sequence[Panel], heading: Sequence[str]) -> bytes:
    """Return the bracket as a page of HTML in UTF-8; the heading starts with its name.

    >>> page = bracket_html([Panel("", "", (), ())], ["Tuesday"])
    >>> b"<h1>Tuesday</h1>" in page
    True
    """
    section = Section("bracket", "Bracket", bracket_both(panels))
    around: dict[str, Any] = {"links": [], "below": "", "made_of": ""}
    style = f"{own_file('bracket.css')}.bracket{{{_on_white()}padding:1rem;overflow-x:auto}}"
    return html_page(heading=list(heading), sections=[section], more_style=style, **around)


def bracket_both(
    panels: Sequence[Panel],
    *,
    words: Words = str,
    link: Link = no_link,
    chosen: str = "",
    sight: bool = True,
) -> Markup:
    """Return a bracket's drawing and its rounds; the stylesheet shows one of them, by width."""
    drawn = bracket_svg(panels, words=words, link=link, chosen=chosen)
    rounds = bracket_rounds(panels, words=words, link=link, chosen=chosen, sight=sight)
    return Markup('<div class="bracket">{}{}</div>').format(drawn, rounds)


def _on_white() -> str:
    """Return the colors for a standalone drawing, dark letters on white."""
    colors = "".join(f"--{name}:{color};" for name, color in _ON_WHITE.items())
    return f"{colors}background:#fff;color:#0e151d;"


_TITLE, _ABOUT = 50.0, 18.0  # heights above the drawing, the line below the title included


def bracket_picture(panels: Sequence[Panel], title: str = "", about: str = "") -> bytes:
    """Return a bracket's drawing as an SVG file, dark letters on white."""
    above = _TITLE * bool(title) + _ABOUT * bool(about)
    style = (
        f"svg{{{_on_white()}font-family:system-ui,'Segoe UI',Roboto,'Noto Sans',"
        f"sans-serif}}{own_file('bracket.css').partition('.phone')[0]}"
    )
    style += ".title{font-weight:700}.drawn .about{fill:var(--ink-2)}"
    head, _, drawn = str(bracket_svg(panels)).partition(">")
    head = head.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1)
    wide, high = map(float, re.findall(r'viewBox="0 0 (\d+) (\d+)"', head)[0])
    head = re.sub(
        "viewBox=.*? w", f'viewBox="-8 {-8 - above:g} {wide + 16:g} {high + above + 16:g}" w', head
    )
    for text, kind, size, y in ((title, "title", 30.0, 24.0), (about, "about", 19.0, 56.0)):
        if text:
            small = min(size, (wide - 40.0) / max(1.0, rough_width(text, bold=kind == "title")))
            drawn = _text(kind, 34.0, y - above, escape(text), small) + drawn
    return f"{head}><style>{style}</style>{drawn}\n".encode()
