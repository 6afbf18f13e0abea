"""An answer in one output format: in the reader's language, with its names for options."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.parts import Column, Part, Quantity, Table
from evenbreak.words import Face, capital_in_face, in_face

if TYPE_CHECKING:
    from evenbreak.answers.kit.answer import Answer

Said = Callable[[Any], Any]


def answer_in_face(answer: Answer, face: Face) -> Answer:
    """Return an answer with all its text as an output format phrases it."""

    def said(text: Any) -> Any:
        return in_face(text, face)

    return replace(
        answer,
        heading=said(answer.heading),
        parts=[_part(part, face, said) for part in answer.parts],
        details=[_part(part, face, said) for part in answer.details],
        warnings=[said(warning) for warning in answer.warnings],
    )


def brief(answer: Answer) -> Answer:
    """Return an answer without its details and warnings."""
    parts: list[Part] = []
    for part in answer.parts:
        if isinstance(part, Table):
            kept = [k for k, one in enumerate(part.columns) if not one.detail]
            columns = [part.columns[k] for k in kept]
            rows = [[row[k] for k in kept] for row in part.rows]
            parts.append(replace(part, columns=columns, rows=rows))
        elif isinstance(part, str):
            parts.append(part)
        else:
            parts.append(replace(part, of=[one for one in part.of if not one.detail]))
    return replace(answer, parts=parts, details=(), warnings=())


def _part(part: Part, face: Face, said: Said) -> Part:
    if isinstance(part, str):
        return capital_in_face(part, face)
    title = said(part.title)
    if isinstance(part, Table):
        columns = [_column(one, said) for one in part.columns]
        return replace(part, columns=columns, title=title)
    return replace(part, of=[_quantity(one, said) for one in part.of], title=title)


def _column(column: Column, said: Said) -> Column:
    def show(value: Any) -> str:
        # First the value: `str` of a sentence would be its English text.
        shown: str = said(column.show(said(value)))
        return shown

    return replace(column, words=said(column.words), show=show)


def _quantity(quantity: Quantity, said: Said) -> Quantity:
    return replace(quantity, column=_column(quantity.column, said), note=said(quantity.note))
