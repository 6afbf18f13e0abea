"""A question as the fields of a form: what each is called, what it may be, and what was entered."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeVar

from evenbreak.fields.kinds import Choice, Flag, Number, Whole
from evenbreak.fields.question import Declared, declared
from evenbreak.web.forms import Form

Asked = TypeVar("Asked")


class FormField(NamedTuple):
    """A field of a form; its words are sentences, which the page says in the reader's language.

    Parameters
    ----------
    name
        what the form calls it.
    label
        what it asks for.
    shape
        flag, choice, whole, number or text.
    usual
        what it is unless it is changed.
    choices
        each word that may be chosen, with its title.
    formats
        the tournament formats that have it; none if all have.
    longest
        the most letters that may be typed.
    """

    name: str
    label: str
    shape: str
    usual: str
    choices: dict[str, str]
    formats: tuple[str, ...]
    longest: int


def form_fields(fields: Sequence[Declared]) -> list[FormField]:
    """Return fields of a question as those of a form.

    >>> from evenbreak.tournaments.evening.format import Format
    >>> form_fields(declared(Format))[0].choices
    {'true': 'The unbeaten player must lose twice', 'single': 'One match decides'}
    """
    return [_form_field(one) for one in fields]


def _form_field(one: Declared) -> FormField:
    kind, titles = one.kind, one.field.titles
    choices = {word: titles.get(word, word) for word in kind.of} if isinstance(kind, Choice) else {}
    if choices and one.default is None:
        choices = {"": titles.get("", ""), **choices}
    shapes = {Flag: "flag", Choice: "choice", Whole: "whole", Number: "number"}
    has_none = one.required or one.default is None or isinstance(kind, Flag)
    return FormField(
        name=name_of(one),
        label=one.field.label or one.field.help,
        shape=shapes.get(type(kind), "text"),
        usual="" if has_none else kind.words(one.default),
        choices=choices,
        formats=one.field.formats,
        longest=len(str(kind.high)) if isinstance(kind, Whole) else 200,
    )


def name_of(one: Declared) -> str:
    """Return what a form calls a field of a question: as the terminal calls it."""
    return one.name if one.field.argument else one.option.removeprefix("--").replace("-", "_")


def asked_in(question: type[Asked], form: Form, fields: Sequence[Declared], **values: Any) -> Asked:
    """Return what a form asks; what is left empty has its default.

    Parameters
    ----------
    question
        what is asked.
    form
        the form.
    fields
        the fields of the question that the form has.
    values
        fields of the question that are not read from a field of their own.
    """
    read = {one.name: value_of(one, form) for one in fields if form.text(name_of(one))}
    return question(**read, **values)


def value_of(one: Declared, form: Form, name: str = "") -> Any:
    """Return the value of a field, its default if it is left empty; `name` is that of the form."""
    name = name or name_of(one)
    if not form.text(name) and not one.required:
        return one.default
    if isinstance(one.kind, Whole):
        return form.whole(name, one.kind.low, one.kind.high)
    if isinstance(one.kind, Number) and one.kind.low > 0.0:
        return form.above_0(name, one.kind.high)
    if isinstance(one.kind, Choice):
        return one.kind.read(form.one_of(name, tuple(one.kind.of)))
    return one.kind.read(form.text(name))


def fields_named(question: type, *names: str) -> list[Declared]:
    """Return the fields of a question with these names."""
    by_name = {one.name: one for one in declared(question)}
    return [by_name[name] for name in names]
