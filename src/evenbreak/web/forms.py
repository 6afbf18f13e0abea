"""The fields of a form, checked as they come in."""

from __future__ import annotations

import hashlib

from starlette.datastructures import FormData, QueryParams
from starlette.requests import Request

from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import check_form

_MOST_FIELDS, _MOST_FILES = 60, 1
_LONGEST = 200

EVEN, FAIR = "even", "fair"
RACES = {EVEN: "races_even", FAIR: "races_fair"}
"""The races that are not those of a chart, with their words."""


class Form:
    """The fields of a form.

    >>> form = Form(FormData([("race", "7"), ("name", " Ann ")]))
    >>> form.whole("race", 1, 100), form.text("name"), form.whole("tables", 1, 9, default=4)
    (7, 'Ann', 4)
    """

    def __init__(self, fields: FormData | QueryParams) -> None:
        self.fields = fields

    def text(self, name: str, *, longest: int = _LONGEST) -> str:
        """Return a text without the blanks around it; '' if it was left empty."""
        value = self.fields.get(name, "")
        if not isinstance(value, str):
            raise RefusalError("refused_field", field=name)
        if len(value) > longest:
            raise RefusalError("refused_long", field=name, longest=longest)
        return value.strip()

    def texts(self, name: str) -> list[str]:
        """Return the texts of all fields of a name, without the blanks around them."""
        given = self.fields.getlist(name)
        return [Form(FormData([(name, one)])).text(name) for one in given]

    def whole(self, name: str, low: int, high: int, *, default: int | None = None) -> int:
        """Return a whole number between two others."""
        text = self.text(name)
        return default if not text and default is not None else whole(name, text, low, high)

    def key(self, *more: str) -> str | None:
        """Return what a form is known by if it comes in again; None if it has no number.

        Somebody who goes back and changes a field sends another form.

        >>> forms = [Form(FormData([("once", "7"), ("race", race)])) for race in ("5", "5", "6")]
        >>> [form.key() == forms[0].key() for form in forms]
        [True, True, False]
        """
        if not self.text("once"):
            return None
        fields = sorted((k, v) for k, v in self.fields.multi_items() if isinstance(v, str))
        sent = [one for one in fields if one[0] != "csrf"]
        return hashlib.sha256(repr([*more, sent]).encode()).hexdigest()

    def one_of(self, name: str, allowed: tuple[str, ...]) -> str:
        """Return one of several words."""
        text = self.text(name)
        if text not in allowed:
            raise RefusalError("refused_choice", field=name, value=text, allowed=", ".join(allowed))
        return text


def whole(name: str, text: str, low: int, high: int) -> int:
    """Return the whole number in a field, between two others.

    >>> whole("race", "7", 1, 100)
    7
    """
    if not text:
        raise RefusalError("refused_empty", field=name, low=low, high=high)
    if not text.isascii() or not text.isdigit() or not low <= int(text[:9]) <= high:
        raise RefusalError("refused_whole", field=name, value=text, low=low, high=high)
    return int(text)


async def form_of(request: Request) -> Form:
    """Read a form of this session; refuse one that it was not given."""
    async with request.form(max_files=_MOST_FILES, max_fields=_MOST_FIELDS) as fields:
        form = Form(fields)
        check_form(request, form.text("csrf"))
        return form
