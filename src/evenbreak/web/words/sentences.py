"""The sentences of answers and refusals, as the pages say them.

They are made elsewhere, in English and for all faces. Here each is known by its pattern, such as
`{} goes to {} and meets {}.`, and said anew: in another language, or, where it names a command, in
the words of the page. What stands in the places of a pattern may be such a pattern itself, but
never a name: names, and whatever is quoted, are taken out before a sentence is looked at, and put
back as they were.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Any, TypeAlias

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Part, Quantity, Table
from evenbreak.files.catalogues import face_in
from evenbreak.words import Sentence, in_face

Say: TypeAlias = Callable[[str], str]

_NUMBER = re.compile(r"([<>+-]?)(\d{1,3}(?:,\d{3})*|\d+)(\.\d+)?(%?)", re.ASCII)
_FIRST, _LAST = "\U000f0000", "\U000ffffd"  # private letters, each in place of a name
_SENTENCE_ENDS = re.compile(rf"(?<=[.!?]) (?=[A-Z0-9{_FIRST}-{_LAST}])")
_QUOTED = r"""(?<!\w)(?:'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")(?!\w)"""
_PAIR = " - "
_LIST_ENDS = re.compile(r"(, | and |; )")


def number_in(language: str, text: str) -> str:
    """Return a number as it is written in a language; what is no number stays as it is."""
    found = _NUMBER.fullmatch(text)
    if found is None:
        return text
    face, (sign, whole, part, unit) = face_in(language), found.groups("")
    digits = whole.replace(",", face.group) + part.replace(".", face.decimal)
    return face.percent.format(n=sign + digits) if unit else sign + digits


@cache
def patterns(language: str) -> Mapping[str, str]:
    """Return what is said in place of each pattern.

    >>> patterns("de")["{} players are drawn."]
    '{0} Spieler sind ausgelost.'
    """
    text = files(__package__).joinpath(f"sentences_{language}.json").read_text(encoding="utf-8")
    found: Mapping[str, str] = json.loads(text)
    return found


@cache
def _compiled(language: str) -> list[tuple[re.Pattern[str], str]]:
    """Return the patterns as regular expressions, those with the most words first."""
    by_words = sorted(patterns(language).items(), key=lambda one: -len(one[0].replace("{}", "")))
    return [
        (re.compile("(.+?)".join(map(re.escape, pattern.split("{}")))), other)
        for pattern, other in by_words
    ]


def in_language(language: str, text: str, names: Collection[str] = ()) -> str:
    """Return sentences as the pages say them; what has no pattern stays as it is.

    Parameters
    ----------
    language
        its code.
    text
        the sentences, in English.
    names
        of players and teams, which stay as they are.

    >>> in_language("de", "Ann beat Bo 7:5 in W1.1.")
    'Ann schlägt Bo 7:5 in W1.1.'
    >>> in_language("de", "W1.1 has a result, Ann beat Bo 7:5; change it with correct W1.1")
    'W1.1 hat ein Ergebnis, Ann schlägt Bo 7:5; geändert wird es unter „Ergebnis korrigieren“'
    >>> in_language("de", "winner of W1.1"), in_language("en", "winner of W1.1")
    ('Sieger von W1.1', 'winner of W1.1')
    >>> in_language("de", "Tom and Jerry beat Bo 7:5 in W1.1.", ["Tom and Jerry", "Bo"])
    'Tom and Jerry schlägt Bo 7:5 in W1.1.'
    """
    if isinstance(text, Sentence):
        told: str = in_face(text, face_in(language))
        if told != str(text):
            return told
    there = sorted((name for name in names if name in text), key=len, reverse=True)
    opaque = [rf"(?<!\w){re.escape(name)}(?!\w)" for name in there if name]
    kept: list[str] = []

    def keep(found: re.Match[str]) -> str:
        kept.append(found[0])
        return chr(ord(_FIRST) + len(kept) - 1)

    hidden = re.sub("|".join([*opaque, _QUOTED, f"[{_FIRST}-{_LAST}]"]), keep, text)
    said = "\n".join(_line(language, line) for line in hidden.split("\n"))
    return re.sub(f"[{_FIRST}-{_LAST}]", lambda found: kept[ord(found[0]) - ord(_FIRST)], said)


def _line(language: str, line: str) -> str:
    if _PAIR in line and not line.endswith("."):  # who plays whom
        return _PAIR.join(_line(language, one) for one in line.split(_PAIR))
    sentences = _SENTENCE_ENDS.split(line)
    if len(sentences) > 1:
        each = [_said(language, sentence) for sentence in sentences]
        if None not in each:
            return " ".join(filter(None, each))
    whole = _said(language, line)
    if whole is not None:
        return whole
    if len(sentences) > 1:
        return " ".join(_line(language, sentence) for sentence in sentences)
    listed = _LIST_ENDS.split(line)
    if len(listed) > 1:
        between = patterns(language)
        return "".join(
            between.get(one, one) if k % 2 else _line(language, one) for k, one in enumerate(listed)
        )
    return number_in(language, line)


def _said(language: str, text: str) -> str | None:
    for pattern, other in _compiled(language):
        if found := pattern.fullmatch(text):
            return other.format(*(_line(language, one) for one in found.groups()))
    return None


def answer_in_language(language: str, answer: Answer, names: Collection[str] = ()) -> Answer:
    """Return an answer with its texts as the pages say them, without details and warnings."""

    def say(text: str) -> str:
        return in_language(language, text, names)

    parts = [_part(say, part) for part in answer.parts]
    heading = say(answer.heading)
    return replace(answer, heading=heading, parts=parts, details=(), warnings=())


def _named(say: Say, one: Column) -> Column:
    """Return a column whose heading and values are said as the pages say them."""

    def show(value: Any) -> str:
        return say(one.show(value))

    words = None if one.words is None else say(one.words)
    return replace(one, words=words, show=show)


def _quantity(say: Say, one: Quantity) -> Quantity:
    return replace(one, column=_named(say, one.column))


def _part(say: Say, part: Part) -> Part:
    if isinstance(part, str):
        return say(part)
    if isinstance(part, Table):
        kept = [k for k, one in enumerate(part.columns) if not one.detail]
        columns = [_named(say, part.columns[k]) for k in kept]
        rows = [[row[k] for k in kept] for row in part.rows]
        return replace(part, columns=columns, rows=rows, title=say(part.title))
    of = [_quantity(say, one) for one in part.of if not one.detail]
    return replace(part, of=of, title=say(part.title))
