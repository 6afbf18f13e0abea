"""The fields of a form, checked as they come in."""

from __future__ import annotations

import hashlib
from typing import TypeAlias

from starlette.datastructures import ImmutableMultiDict, QueryParams, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import Request

from evenbreak.fields.kinds import NUMBER
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.web.guard import MOST_BYTES
from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import check_form
from evenbreak.words import Parameter, say

_MOST_FIELDS, _MOST_FILES = 1000, 2
LONGEST = 200
"""Characters of a field, if nothing else is said."""

EVEN, FAIR = "even", "fair"
RACES = {
    EVEN: say("Even: same race for both"),
    FAIR: say("Handicapped: the weaker player gets games"),
}
"""The races that are not those of a chart, with their words."""


Fields: TypeAlias = ImmutableMultiDict[str, str | bytes]
"""The fields of a form by name: a text, or what is in a file."""


CHOOSE_IT = say("choose the rating scale")
"""What to do about ratings that do not show their scale."""


class Form:
    """The fields of a form, and what is in the files that came with it.

    >>> form = Form(Fields([("race", "7"), ("name", " Ann ")]))
    >>> form.whole("race", 1, 100), form.text("name"), form.whole("tables", 1, 9, default=4)
    (7, 'Ann', 4)
    """

    def __init__(self, fields: Fields | QueryParams) -> None:
        self.fields = fields

    def text(self, name: str, *, longest: int = LONGEST) -> str:
        """Return a text without the blanks around it; '' if it was left empty."""
        value = self.fields.get(name, "")
        if not isinstance(value, str):
            raise RefusalError("{field} is not text.", field=Parameter(name))
        if len(value) > longest:
            raise RefusalError(
                "{field} must not be longer than {longest} characters.",
                field=Parameter(name),
                longest=longest,
            )
        return value.strip()

    def content(self, name: str) -> bytes:
        """Return what is in the file of a field; nothing if no file was chosen."""
        value = self.fields.get(name, b"")
        return value if isinstance(value, bytes) else b""

    def texts(self, name: str) -> list[str]:
        """Return the texts of all fields of a name, without the blanks around them."""
        given = self.fields.getlist(name)
        return [Form(Fields([(name, one)])).text(name) for one in given]

    def whole(self, name: str, low: int, high: int, *, default: int | None = None) -> int:
        """Return a whole number between two others."""
        text = self.text(name)
        return default if not text and default is not None else whole(name, text, low, high)

    def above_0(self, name: str, high: float = 1e6) -> float | None:
        """Return a number above 0, with a point or a comma; None if the field was left empty.

        >>> Form(Fields([("cap", "22,5")])).above_0("cap")
        22.5
        """
        text = self.text(name).replace(",", ".")
        if not text:
            return None
        number = float(text) if NUMBER.fullmatch(text) else 0.0
        if not 0.0 < number <= high:
            raise RefusalError(
                "{field} must be a number above 0; you entered {value!r}.",
                field=Parameter(name),
                value=text,
            )
        return number

    def key(self, *more: str) -> str:
        """Return what a form is known by if it comes in again; refuse one without a number.

        Somebody who goes back and changes a field sends another form.

        >>> forms = [Form(Fields([("once", "7"), ("race", race)])) for race in ("5", "5", "6")]
        >>> [form.key() == forms[0].key() for form in forms]
        [True, True, False]
        """
        if not self.text("once"):
            raise RefusalError(
                "This form is from an earlier visit. Open the page again and repeat what you did."
            )
        sent = sorted((k, repr(v)) for k, v in self.fields.multi_items() if k != "csrf")
        return hashlib.sha256(repr([*more, sent]).encode()).hexdigest()

    def one_of(self, name: str, allowed: tuple[str, ...]) -> str:
        """Return one of several words."""
        text = self.text(name)
        if text not in allowed:
            raise RefusalError(
                "{field} must be one of {allowed}; you entered {value!r}.",
                field=Parameter(name),
                value=text,
                allowed=", ".join(allowed),
            )
        return text


def whole(name: str, text: str, low: int, high: int) -> int:
    """Return the whole number in a field, between two others.

    >>> whole("race", "07", 1, 100)
    7
    """
    if not text:
        raise RefusalError(
            "{field} is blank; enter a whole number from {low} to {high}.",
            field=Parameter(name),
            low=low,
            high=high,
        )
    if not text.isascii() or not text.isdigit() or not low <= int(text) <= high:
        raise RefusalError(
            "{field} must be a whole number from {low} to {high}; you entered {value!r}.",
            field=Parameter(name),
            value=text,
            low=low,
            high=high,
        )
    return int(text)


def scale_in(form: Form) -> Scale | None:
    """Return the scale that a form states; None: the ratings show it.

    >>> scale_in(Form(Fields([("scale", "")]))), scale_in(Form(Fields([("scale", "npl")]))).name
    (None, 'npl')
    """
    return SCALES.get(form.one_of("scale", ("", *SCALES)))


async def form_of(request: Request) -> Form:
    """Read a form of this session with its files; refuse one that it was not given."""
    read: Form | None = getattr(request.state, "form", None)
    if read is not None:
        return read
    try:
        form = await _read(request)
    except (ValueError, LookupError):  # such as a charset that cannot be read with
        raise HTTPException(400) from None
    check_form(request, form.text("csrf"))
    request.state.form = form
    return form


async def _read(request: Request) -> Form:
    limits = {"max_files": _MOST_FILES, "max_fields": _MOST_FIELDS, "max_part_size": MOST_BYTES}
    async with request.form(**limits) as sent:
        return Form(
            Fields(
                [
                    (name, await value.read() if isinstance(value, UploadFile) else value)
                    for name, value in sent.multi_items()
                ]
            )
        )
