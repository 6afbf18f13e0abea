"""A sentence: English text that keeps its template and its values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from numbers import Number
from string import Formatter
from types import MappingProxyType
from typing import Any, NamedTuple

from evenbreak.words.faces import PYTHON, Face

NOTHING: Mapping[str, Any] = MappingProxyType({})


class _Values(dict[str, Any]):
    """A sentence's values by name; a name without a value is a parameter's."""

    def __missing__(self, name: str) -> Parameter:
        return Parameter(name)


class _Wording(NamedTuple):
    """A template as in the catalogs: its meaning, its text, and its plural."""

    template: str
    many: str = ""
    count: Any = 1
    meaning: str = ""

    def said(self, face: Face) -> str:
        """Return the template in an output format's language."""
        words = face.translations
        if self.many and self.meaning:
            return words.npgettext(self.meaning, self.template, self.many, self.count)
        if self.many:
            return words.ngettext(self.template, self.many, self.count)
        if self.meaning:
            return words.pgettext(self.meaning, self.template)
        return words.gettext(self.template) if self.template else ""


class Sentence(str):
    """A string in English that keeps its parts, so that each output format can phrase it.

    `wording` is the template; or singular and plural templates with the number that decides; or
    with its meaning. Values that are sentences are phrased by the format too; everything else is
    unchanged.
    """

    wording: _Wording
    values: Mapping[str, Any]

    def __new__(cls, wording: _Wording, values: Mapping[str, Any] = NOTHING) -> Sentence:
        """Return the sentence; its text is phrased for `PYTHON`."""
        template = wording.said(PYTHON)
        filled = _Values(values)
        text = _ended(template, template.format_map(filled)) if values else template
        sentence = super().__new__(cls, text)
        sentence.wording, sentence.values = wording, filled
        return sentence

    @property
    def template(self) -> str:
        """The sentence with `{name}` for each value."""
        return self.wording.template

    def said(self, face: Face) -> str:
        """Return the text phrased for an output format."""
        template = self.wording.said(face)
        if not self.values:
            return template
        return _ended(template, _InFace(face).vformat(template, (), self.values))

    def is_ours(self, face: Face) -> bool:
        """Return whether it starts with a word of the template, not with a value."""
        template = self.wording.said(face)
        if not template.startswith("{") or not self.values:
            return True
        first = next(name for _, name, _, _ in Formatter().parse(template) if name)
        value = self.values[first]
        return isinstance(value, Sentence) and value.is_ours(face)

    def __add__(self, after: str) -> Sentence:
        """Return this sentence followed by another text."""
        return Joined((self, after), "")

    def __radd__(self, before: str) -> Sentence:
        """Return another text followed by this sentence."""
        return Joined((before, self), "")

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the arguments for copying it to another process."""
        return type(self), (self.wording, dict(self.values))


def _ended(template: str, text: str) -> str:
    """Return text with only one period at its end if the last value, such as 'Jr.', has one too."""
    dots = len(text) - len(text.rstrip("."))
    twice = template.endswith("}.") and dots in (2, 4)  # "Jr..", and "1, 2, ...."
    return text[:-1] if twice else text


class _InFace(Formatter):
    """Fill in a template, phrasing sentences, parameters and numbers for an output format."""

    def __init__(self, face: Face) -> None:
        self.face = face

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return a value as shown in an output format."""
        if isinstance(value, Number):
            return self.face.number(value, format_spec)
        return str(format(in_face(value, self.face), format_spec))

    def convert_field(self, value: Any, conversion: Any) -> Any:
        """Return a value, in quotation marks if the template has `!r`."""
        return super().convert_field(in_face(value, self.face), conversion)


class Joined(Sentence):
    """Concatenated texts, some of which are sentences."""

    parts: tuple[str, ...]
    between: str

    def __new__(cls, parts: Iterable[str], between: str) -> Joined:
        """Return the parts, with `between` in between."""
        kept = tuple(parts)
        sentence = str.__new__(cls, between.join(kept))
        sentence.wording, sentence.values = _Wording(""), NOTHING
        sentence.parts, sentence.between = kept, between
        return sentence

    def is_ours(self, face: Face) -> bool:
        """Return whether it starts with a word of ours, not with a value."""
        first = self.parts[0] if self.parts else ""
        return isinstance(first, Sentence) and first.is_ours(face)

    def said(self, face: Face) -> str:
        """Return the text phrased for an output format."""
        between: str = in_face(self.between, face)
        return between.join(in_face(part, face) for part in self.parts)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the arguments for copying it to another process."""
        return type(self), (self.parts, self.between)


class _Thing(Sentence):
    """A value for which an output format has its own name or its own spelling."""

    arguments: tuple[Any, ...]

    def __new__(cls, *arguments: Any) -> Any:
        """Return it, with its text in Python."""
        sentence = str.__new__(cls, cls.shown(PYTHON, *arguments))
        sentence.wording, sentence.values = _Wording(""), NOTHING
        sentence.arguments = arguments
        return sentence

    @staticmethod
    def shown(face: Face, *arguments: Any) -> str:
        """Return it as shown in an output format."""
        raise NotImplementedError

    def is_ours(self, face: Face) -> bool:  # noqa: ARG002
        """Return whether it starts with a word of ours, not with a value."""
        return isinstance(self, Parameter)

    def said(self, face: Face) -> str:
        """Return the text phrased for an output format."""
        return self.shown(face, *self.arguments)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the arguments for copying it to another process."""
        return type(self), self.arguments


class Figure(_Thing):
    """A number by itself: `Figure(0.0005, ".1%", sign="<")`.

    >>> Figure(1234.5, ",.1f"), Figure(0.001, ".1%", sign="<")
    ('1,234.5', '<0.1%')
    """

    def __new__(cls, value: Any, spec: str = "", sign: str = "") -> Figure:
        """Return the number."""
        figure: Figure = super().__new__(cls, value, spec, sign)
        return figure

    @staticmethod
    def shown(face: Face, *arguments: Any) -> str:
        """Return it as shown in an output format."""
        value, spec, sign = arguments
        return f"{sign}{face.number(value, spec)}"


class Parameter(_Thing):
    """A parameter's name: `--win-by` on a terminal, its field's label on a page.

    >>> Parameter("win_by")
    'win_by'
    """

    def __new__(cls, name: str) -> Parameter:
        """Return the name."""
        parameter: Parameter = super().__new__(cls, name)
        return parameter

    @staticmethod
    def shown(face: Face, *arguments: Any) -> str:
        """Return it as shown in an output format."""
        return face.parameter(str(arguments[0]))


class Command(_Thing):
    """A terminal command, or its equivalent on a page.

    >>> Command("tournament result", "W1.2", "5-3")
    'evenbreak tournament result W1.2 5-3'
    """

    def __new__(cls, name: str, *words: str) -> Command:
        """Return the command, with the words that follow it."""
        command: Command = super().__new__(cls, name, *words)
        return command

    @staticmethod
    def shown(face: Face, *arguments: Any) -> str:
        """Return it as shown in an output format."""
        name, *words = (str(in_face(argument, face)) for argument in arguments)
        return face.command(name, words)


class FilePath(_Thing):
    """A file, by its path; on a page read by strangers, only its name is shown.

    >>> FilePath("club/results.csv")
    'club/results.csv'
    """

    def __new__(cls, path: object) -> FilePath:
        """Return the path."""
        place: FilePath = super().__new__(cls, str(path))
        return place

    @staticmethod
    def shown(face: Face, *arguments: Any) -> str:
        """Return it as shown in an output format."""
        return face.file(str(arguments[0]))


def in_face(text: Any, face: Face) -> Any:
    """Return text phrased for an output format; anything but a sentence is unchanged.

    >>> comma = Face(decimal=",")
    >>> in_face(say("{player} needs {p}.", player="Tom and Jerry", p=0.5), comma)
    'Tom and Jerry needs 0,5.'
    >>> in_face("0.5", comma)
    '0.5'
    """
    return text.said(face) if isinstance(text, Sentence) else text


def capital_in_face(text: str, face: Face) -> str:
    """Return text phrased for an output format, with each line capitalized unless it is a name.

    >>> capital_in_face(say("match {match} is over", match="W1.1"), PYTHON)
    'Match W1.1 is over'
    >>> capital_in_face(say("{player} has entered", player="the Shark"), PYTHON)
    'the Shark has entered'
    """
    if isinstance(text, Joined) and text.between == "\n":
        return "\n".join(capital_in_face(part, face) for part in text.parts)
    said: str = in_face(text, face)
    if isinstance(text, Sentence) and text.is_ours(face):
        return said[:1].upper() + said[1:]
    return said


def say(template: str, /, **values: Any) -> Sentence:
    """Return a sentence with its values filled in.

    A name without a value is a parameter's: `say("{games} is {n}", n=3)`. Without any values, the
    template is the text itself.

    >>> sentence = say("{player} goes to {match}.", player="Player and Son", match="W2.1")
    >>> sentence, sentence.template, dict(sentence.values)["player"]
    ('Player and Son goes to W2.1.', '{player} goes to {match}.', 'Player and Son')
    """
    return Sentence(_Wording(template), values)


def say_as(meaning: str, template: str, /, **values: Any) -> Sentence:
    """Return a sentence whose English has several meanings, stating which is meant.

    >>> say_as("heading of a column", "race")
    'race'
    """
    return Sentence(_Wording(template, meaning=meaning), values)


def say_count(one: str, many: str, n: Any, /, **values: Any) -> Sentence:
    """Return a sentence whose wording depends on a number, which appears in it as `{n}`.

    >>> say_count("{n} game", "{n:,} games", 1), say_count("{n} game", "{n:,} games", 1200)
    ('1 game', '1,200 games')
    """
    return Sentence(_Wording(one, many, n), {"n": n, **values})


def joined(parts: Iterable[str], between: str = " ") -> Sentence:
    """Return texts concatenated, each phrased by the output format.

    >>> joined([say("{n} players are drawn.", n=8), "Ann"])
    '8 players are drawn. Ann'
    """
    return Joined(parts, between)


def ordinal(n: int) -> Sentence:
    """Return an ordinal number.

    >>> ordinal(1), ordinal(12), ordinal(22), ordinal(103)
    ('1st', '12th', '22nd', '103rd')
    """
    if n // 10 % 10 == 1 or n % 10 not in (1, 2, 3):
        return say("{n}th", n=n)
    return {1: say("{n}st", n=n), 2: say("{n}nd", n=n), 3: say("{n}rd", n=n)}[n % 10]


def tally(games: Iterable[Any]) -> Sentence:
    """Return a score: the games each of two players has won, as written in the reader's language.

    >>> tally((5, 4))
    '5-4'
    """
    a, b = games
    return say_as("score", "{a}-{b}", a=a, b=b)


def race(needs: Iterable[Any]) -> str:
    """Return a race: the games each of two players needs.

    >>> race((7, 5))
    '7:5'
    """
    return "{}:{}".format(*needs)


def listed(parts: Sequence[Any], last: str = "and") -> Sentence:
    """Return a list for a sentence, with 'and' or 'or' before the last item.

    >>> listed(["Ann"]), listed(["Ann", "Bo"]), listed(["Ann", "Bo", "Cy"], "or")
    ('Ann', 'Ann and Bo', 'Ann, Bo or Cy')
    """
    *most, end = (part if isinstance(part, str) else str(part) for part in parts)
    if not most:
        return joined([end])
    before = joined(most, ", ")
    if last == "or":
        return say("{most} or {last}", most=before, last=end)
    return say("{most} and {last}", most=before, last=end)
