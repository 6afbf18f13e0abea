"""A question's parameters: a frozen dataclass whose annotations describe each field completely.

How to declare a question
-------------------------

::

    Seed = Annotated[int, Field(Whole(0, 2**32 - 1), "The seed of all random draws.")]

    @dataclass(frozen=True, kw_only=True)
    class Fair(Players, RaceLimits, Question):
        \"\"\"Find the fairest races for two players, the fairest first.\"\"\"

        target: Annotated[float, Field(CHANCE, "The chance that A should have.")] = 0.5
        top: Annotated[int, Field(Whole(1, 300), "How many races to list.")] = 5
        seed: Annotated[Seed, Says("The seed of the draw.")] = 1

        def check(self) -> None:
            if self.games is None and self.race_to is None:
                self.refuse("missing races: give {games} LO..HI or {race_to} N")

The docstring is the command's help. A field without a default is required; None is the default for
optional fields, and `usual` says in words what applies then. A field shared by several questions
has a name (`Seed`), declared once in `evenbreak.questions.common`; `Says` changes its description
in one question. Fields that go together form a dataclass that questions inherit. Fields are listed
in the order of the bases, then the question's own, by `section`: `--help` explains fields without a
section and names the others; `rare` fields without a section appear only with `--help-all`. `check`
rejects contradictory fields: in `refuse` and in help texts, a name in braces without a value is a
parameter, which is written as its option or its label. The terminal makes a command from it with
`@command_of(Fair)` (`evenbreak.cli.kit.asked`), a page reads it from a form with `asked_in`
(`evenbreak.web.forms`), and the reference has a table of it between the marks `<!-- options: fair
-->` (`docs/option_tables.py`).
"""

from __future__ import annotations

import string
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, dataclass, field, fields, is_dataclass, replace
from functools import cache
from typing import Annotated, Any, ClassVar, NoReturn, get_args, get_origin, get_type_hints

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, Flag, Kind
from evenbreak.words import Parameter, Sentence, say


@dataclass(frozen=True, eq=False)
class Field:
    """What an annotation says about a field.

    `usual` is the default in words, if the value doesn't show it; `section` is the heading in help
    texts, and `rare` fields are shown only with `--help-all`; `formats` are the tournament formats
    that have it, by default all. `argument` values are typed without an option name; `many`:
    several values, or a repeated option; `words` make up one value. `option` is the terminal's
    name, if different, with a short form after a slash; `old` names are accepted for one version,
    with a note. `label` is for forms, `titles` for the words of a choice ('': none chosen), and
    `more` for the reference, in Markdown.
    """

    kind: Kind
    help: str = ""
    usual: str = ""
    metavar: str = ""
    section: str = ""
    rare: bool = False
    formats: tuple[str, ...] = ()
    argument: bool = False
    many: bool = False
    words: int = 1
    option: str = ""
    old: tuple[str, ...] = ()
    label: str = ""
    titles: Mapping[str, str] = field(default_factory=dict)
    more: str = ""


class Says:
    """A field's description in one question, replacing the one in its declaration."""

    def __init__(self, help: str | None = None, **changes: Any) -> None:  # noqa: A002
        self.changes = changes if help is None else {"help": help, **changes}


@dataclass(frozen=True)
class Declared:
    """A field in a question: its name, its description, and its default."""

    name: str
    field: Field
    default: Any

    @property
    def required(self) -> bool:
        """Whether it has no default."""
        return self.default is MISSING

    @property
    def kind(self) -> Kind:
        """Its value type."""
        return self.field.kind

    @property
    def option(self) -> str:
        """The option that sets it, or an argument's name."""
        if self.field.argument:
            return self.metavar.strip("[]")
        return "--" + (self.field.option or self.name).partition("/")[0].replace("_", "-")

    @property
    def short(self) -> str:
        """The option's short form, or ''."""
        return self.field.option.partition("/")[2]

    @property
    def metavar(self) -> str:
        """The placeholder for a value in help texts."""
        if self.field.metavar:
            return self.field.metavar
        return "|".join(self.kind.of) if isinstance(self.kind, Choice) else self.kind.metavar

    @property
    def usual(self) -> str:
        """The default, in typed form or in words; '' if there is none."""
        if self.field.usual or self.required or self.default is None or self.default == ():
            return self.field.usual
        return "" if isinstance(self.kind, Flag) else self.kind.words(self.default)

    def load(self, value: Any) -> Any:
        """Return the value that JSON stands for; reject what `schema` forbids."""
        return _each(value, self._load_one) if self.field.many else self._load_one(value)

    def _load_one(self, value: Any) -> Any:
        if self.field.words > 1:
            return _each(value, self.kind.load, self.field.words)
        return self.kind.load(value)

    def schema(self) -> dict[str, Any]:
        """Return its JSON schema."""
        one: dict[str, Any] = self.kind.schema()
        if self.field.words > 1:
            n = self.field.words
            one = {"type": "array", "items": one, "minItems": n, "maxItems": n}
        said = {"type": "array", "items": one} if self.field.many else dict(one)
        said["description"] = str(worded(self.field.help))
        if self.usual and not self.field.usual:
            is_text = "string" in said.get("type", ())
            said["default"] = self.usual if is_text else self.default
        return said


def _each(value: Any, load: Callable[[Any], Any], many: int | None = None) -> tuple[Any, ...]:
    if not isinstance(value, list):
        raise InputError("the values must be in a list, such as {example}", example="[1, 2]")
    if many is not None and len(value) != many:
        raise InputError("give {n} values in a list", n=many)
    return tuple(load(one) for one in value)


class AskedError(InputError):
    """Raised if a question contradicts itself, or lacks something."""


def worded(template: str, **values: Any) -> Sentence:
    """Return text in which each name in braces without a value is a parameter.

    >>> worded("{games} is {n}", n=7).values["games"]
    'games'
    """
    names = [name for _, name, _, _ in string.Formatter().parse(template) if name]
    return say(template, **{name: values.get(name, Parameter(name)) for name in names})


def refuse(template: str, /, **values: Any) -> NoReturn:
    """Reject the question; a name in braces without a value is a parameter."""
    raise AskedError(worded(template, **values))


@dataclass(frozen=True, kw_only=True)
class Question:
    """The base of all questions; see the module's docstring."""

    examples: ClassVar[str] = ""
    """The end of its command's help."""
    old_words: ClassVar[tuple[str, ...]] = ()
    """Options whose values used to be typed without them; accepted for one version."""

    def __post_init__(self) -> None:
        for check in _checks(type(self)):
            check(self)

    @classmethod
    def split(cls, typed: dict[str, Any]) -> dict[str, Any]:
        """Return what was typed, separating arguments that were typed as one list."""
        return typed

    refuse = staticmethod(refuse)

    @property
    def given(self) -> dict[str, Any]:
        """The fields that differ from their defaults."""
        question: Any = type(self)
        return {
            one.name: getattr(self, one.name)
            for one in declared(question)
            if getattr(self, one.name) != one.default
        }


def _checks(question: Any) -> Iterator[Callable[[Any], None]]:
    """Yield the checks of the bases, then the question's own."""
    seen: dict[Any, None] = {}
    for base in question.__bases__:
        seen |= dict.fromkeys(_checks(base))
    if check := vars(question).get("check"):
        seen[check] = None
    yield from seen


@cache
def declared(question: Any) -> tuple[Declared, ...]:
    """Return a question's fields in order, ignoring any without a `Field`."""
    hints = get_type_hints(question, include_extras=True)
    defaults = {one.name: one.default for one in fields(question)}
    every = [(name, field_in(hints[name])) for name in dict.fromkeys(_names(question))]
    return tuple(Declared(name, said, defaults[name]) for name, said in every if said is not None)


def declaration(question: type, name: str) -> Declared:
    """Return a question's field by name."""
    return next(one for one in declared(question) if one.name == name)


def from_afar(question: type) -> tuple[Declared, ...]:
    """Return a question's fields for other computers, where none names a file."""
    kinds = [(one, one.kind.from_afar()) for one in declared(question)]
    return tuple(
        replace(one, field=replace(one.field, kind=kind)) for one, kind in kinds if kind is not None
    )


def _names(question: type) -> Iterator[str]:
    for base in question.__bases__:
        yield from _names(base)
    if is_dataclass(question):
        yield from (one.name for one in fields(question))


def field_in(hint: Any) -> Field | None:
    """Return the `Field` in an annotation, with the changes from `Says`, or None."""
    if get_origin(hint) is Annotated:
        inner, *said = get_args(hint)
        result = field_in(inner)
        for one in said:
            if isinstance(one, Field):
                result = one
            elif isinstance(one, Says) and result is not None:
                result = replace(result, **one.changes)
        return result
    return next(filter(None, map(field_in, get_args(hint))), None)


def schema_of(question: type) -> dict[str, Any]:
    """Return a question's JSON schema."""
    every = declared(question)
    return {
        "title": question.__name__,
        "type": "object",
        "properties": {one.name: one.schema() for one in every},
        "required": [one.name for one in every if one.required],
        "additionalProperties": False,
    }
