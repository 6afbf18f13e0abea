"""A form's fields and files, checked as they come in."""

from __future__ import annotations

import hashlib
import io
import tempfile
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias, TypeVar

from starlette.datastructures import ImmutableMultiDict, QueryParams, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import Request

from evenbreak.errors import DataError
from evenbreak.fields.kinds import NUMBER, Choice, Flag, Number, Whole
from evenbreak.fields.question import Declared, declared
from evenbreak.files.lists.roster import LARGEST, RosterFile
from evenbreak.files.tables.names import clean_name, is_name
from evenbreak.files.tables.problems import of_list
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.web.guard import MOST_BYTES, RefusalError
from evenbreak.web.sessions import check_director, check_form
from evenbreak.words import Parameter, say

Asked = TypeVar("Asked")
Read = TypeVar("Read")

_MOST_FIELDS, _MOST_FILES = 1000, 2
_WORKBOOK = b"PK\x03\x04"
_MOST_UNPACKED = 50 << 20
LONGEST_LIST = 200_000
LONGEST = 200
"""The default limit for a field, in characters."""

EVEN, FAIR = "even", "fair"
RACES = {
    EVEN: say("Even: same race for both"),
    FAIR: say("Handicapped: the weaker player needs fewer games"),
}
"""The races that don't come from a chart, and their labels."""

Fields: TypeAlias = ImmutableMultiDict[str, str | bytes]
"""A form's fields by name: a string, or a file's content."""

CHOOSE_IT = say("Choose the rating scale.")
"""What to do about ratings that don't show their scale."""


class Form:
    """A form's fields, and the content of its files.

    >>> form = Form(Fields([("race", "7"), ("name", " Ann ")]))
    >>> form.whole("race", 1, 100), form.text("name"), form.whole("tables", 1, 9, default=4)
    (7, 'Ann', 4)
    """

    def __init__(self, fields: Fields | QueryParams) -> None:
        self.fields = fields

    def text(self, name: str, *, longest: int = LONGEST) -> str:
        """Return a string without surrounding spaces; '' if it was left empty."""
        value = self.fields.get(name, "")
        if not isinstance(value, str):
            raise RefusalError("{field} isn't text.", field=Parameter(name))
        if len(value) > longest:
            raise RefusalError(
                "{field} must not be longer than {longest} characters.",
                field=Parameter(name),
                longest=longest,
            )
        return value.strip()

    def content(self, name: str) -> bytes:
        """Return the file content in a field; nothing if no file was chosen."""
        value = self.fields.get(name, b"")
        return value if isinstance(value, bytes) else b""

    def texts(self, name: str) -> list[str]:
        """Return all fields with a name, without surrounding spaces."""
        given = self.fields.getlist(name)
        return [Form(Fields([(name, one)])).text(name) for one in given]

    def whole(self, name: str, low: int, high: int, *, default: int | None = None) -> int:
        """Return a whole number within limits."""
        text = self.text(name)
        return default if not text and default is not None else whole(name, text, low, high)

    def above_0(self, name: str, high: float = 1e6) -> float | None:
        """Return a positive number, with a point or a comma; None if the field was left empty.

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
        """Return the key that identifies a form if it comes in again; reject one without a number.

        Going back and changing a field makes it a different form.

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
    """Return the whole number in a field, within limits.

    >>> whole("race", "07", 1, 100)
    7
    """
    if not text:
        raise RefusalError(
            "{field} is blank. Enter a whole number from {low} to {high}.",
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
    """Return the scale stated in a form; None: the ratings show it.

    >>> scale_in(Form(Fields([("scale", "")]))), scale_in(Form(Fields([("scale", "npl")]))).name
    (None, 'npl')
    """
    return SCALES.get(form.one_of("scale", ("", *SCALES)))


async def form_of(request: Request) -> Form:
    """Read a form with its files; reject a form that wasn't given to this session."""
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


async def directors_form(request: Request) -> Form:
    """Read a form from a director's session; reject everyone else's."""
    form = await form_of(request)
    check_director(request)
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


class FormField(NamedTuple):
    """A field in a form; its words are sentences, translated by the page.

    The shape is flag, choice, whole, number or text; without `formats`, all have it.
    """

    name: str
    label: str
    shape: str
    usual: str
    choices: dict[str, str]
    formats: tuple[str, ...]
    longest: int


def form_fields(fields: Sequence[Declared]) -> list[FormField]:
    """Return a question's fields as form fields.

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
    """Return a form's name for a question's field: the same as on the terminal."""
    return one.name if one.field.argument else one.option.removeprefix("--").replace("-", "_")


def asked_in(question: type[Asked], form: Form, fields: Sequence[Declared], **values: Any) -> Asked:
    """Return the question asked by a form; empty fields get their defaults."""
    read = {one.name: value_of(one, form) for one in fields if form.text(name_of(one))}
    return question(**read, **values)


def value_of(one: Declared, form: Form, name: str = "") -> Any:
    """Return a field's value, its default if left empty; `name` is the form's name for it."""
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
    """Return a question's fields with these names."""
    by_name = {one.name: one for one in declared(question)}
    return [by_name[name] for name in names]


def entered_name(form: Form, field: str = "name") -> str:
    """Return the name in a form, read as in a list; '' if the field was left empty."""
    name = clean_name(form.text(field, longest=80))
    if name and not is_name(name):
        raise RefusalError("The name {value!r} can't be printed. Type it again.", value=name)
    return name


def entered_rating(form: Form) -> float | None:
    """Return the rating in a form; None if the field was left empty."""
    stated = form.text("rating", longest=12).replace(",", ".")
    if not stated:
        return None
    try:
        rating = float(stated)
    except ValueError:
        raise RefusalError(
            "{value!r} isn't a rating. Enter a number, such as 520.", value=stated
        ) from None
    if not abs(rating) <= LARGEST:
        raise RefusalError("{value!r} isn't a rating. Enter a number, such as 520.", value=stated)
    return rating


def list_of(form: Form, text: str, file: str, *, longest: int = LONGEST_LIST) -> bytes:
    """Return the file in a form's field, or else the text in another field."""
    return form.content(file) or form.text(text, longest=longest).encode()


def ending_of(content: bytes) -> str:
    """Return the file extension for this content.

    >>> ending_of(b"player,rating")
    'csv'
    """
    return "xlsx" if content.startswith(_WORKBOOK) else "csv"


def read_upload(content: bytes, read: Callable[[Path], Read]) -> Read:
    """Return a file reader's result for some content; its problems name only the line.

    The file is read from a temporary path whose name we choose.

    >>> read_upload(b"a,b", lambda path: path.read_text())
    'a,b'
    """
    if ending_of(content) == "xlsx":
        _check_size(content)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder, f"list.{ending_of(content)}")
        place.write_bytes(content)
        try:
            return read(place)
        except DataError as error:
            problems = [_nameless(of_list(problem), place) for problem in error.problems]
            raise DataError(problems) from None


def warnings_of(file: RosterFile, name: str = "") -> list[str]:
    """Return the warnings about a submitted list, using its name instead of the file's."""
    return [_nameless(of_list(text, name), file.source, name) for text in file.warnings]


def _nameless(text: str, place: object, name: str = "") -> str:
    """Return a message that may still name the temporary file, using the list's name."""
    source = str(place)
    return text.replace(source, name or say("the list")) if source in text else text


def _check_size(content: bytes) -> None:
    """Reject a workbook that unpacks to far more than was sent."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as packed:
            size = sum(one.file_size for one in packed.infolist())
    except zipfile.BadZipFile:
        raise RefusalError("This workbook can't be read. Save it again, or as CSV.") from None
    if size > _MOST_UNPACKED:
        raise RefusalError(
            "This workbook is too large. Save the sheet with the results as CSV.", status=413
        )
