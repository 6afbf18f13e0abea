"""An answer as a piece of HTML: headings, paragraphs and tables that work in a screen reader."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape

from evenbreak.answers.kit.parts import Column, Content, Part, Quantities, Table
from evenbreak.answers.kit.remarks import Remark, Remarks
from evenbreak.files.tables.problems import printable

_OTHERS = re.compile("[^\N{NO-BREAK SPACE}\N{NARROW NO-BREAK SPACE}]+")
"""All whitespace except the spaces that some languages use within numbers."""


def to_html(answer: Content) -> str:
    """Return an answer as a section of HTML, with all text escaped and no styling."""
    return "\n".join(["<section>", *_lines(answer), "</section>"]) + "\n"


def _lines(answer: Content) -> Iterator[str]:
    first, *more = answer.heading.split("\n")
    yield f"<h2>{_text(first)}</h2>"
    yield from (f"<p>{_text(line)}</p>" for line in more)
    yield from body_lines(answer)


def body_lines(answer: Content) -> Iterator[str]:
    """Yield the HTML of an answer without its heading."""
    for part in answer.parts:
        yield from part_lines(part)
    if answer.details:
        yield "<details><summary>Details</summary>"
        for part in answer.details:
            yield from part_lines(part)
        yield "</details>"
    yield from (f'<p role="note">{_text(warning)}</p>' for warning in answer.warnings)


def part_lines(part: Part) -> Iterator[str]:
    """Yield the HTML for a part of an answer."""
    match part:
        case Remarks():
            if part.above:
                yield f"<p>{_text(part.above)}:</p>"
            yield "<ul>"
            yield from (f"<li>{_remark(item)}</li>" for item in part.items)
            yield "</ul>"
        case Quantities():
            yield "<table>" + _caption(part.title)
            for one in part.shown(verbose=True):
                value = f'<td class="number">{_text(one.text)}</td>'
                note = f"<td>{_text(one.note)}</td>" if one.note else ""
                yield f'<tr><th scope="row">{_text(one.label)}</th>{value}{note}</tr>'
            yield "</table>"
        case Table():
            shown = part.shown(verbose=True)
            yield "<table>" + _caption(part.title)
            heads = "".join(_head(column) for _, column in shown)
            yield f"<thead><tr>{heads}</tr></thead><tbody>"
            for row in part.shown_rows:
                cells = "".join(
                    f"<td{_look(column.left)}>{_text(column.text(row[k]))}</td>"
                    for k, column in shown
                )
                yield f"<tr>{cells}</tr>"
            yield "</tbody></table>"
        case _:
            yield from (f"<p>{_text(line)}</p>" for line in part.split("\n"))


def _remark(item: Remark) -> str:
    """Return a remark as HTML, with each name in it isolated."""
    what = _text(item.what)
    if item.names:
        names = ", ".join(f"<bdi>{_text(name)}</bdi>" for name in item.shown_names)
        more = f" and {item.more_names:,} more" if item.more_names else ""
        what = f"{what} ({names}{more})"
    return f"<strong>{what}</strong>: {_text(item.why)}."


def _head(column: Column) -> str:
    """Return a column's heading; an empty heading would be missing in a screen reader."""
    if not column.words:
        return f"<td{_look(column.left)}></td>"
    return f'<th scope="col"{_look(column.left)}>{_text(column.words)}</th>'


def _caption(title: str) -> str:
    return f"<caption>{_text(title)}</caption>" if title else ""


def _look(left: bool) -> str:
    return "" if left else ' class="number"'


def _text(text: str) -> str:
    lines = (_OTHERS.sub(lambda found: printable(found[0]), line) for line in text.split("\n"))
    return "<br>".join(map(escape, lines))
