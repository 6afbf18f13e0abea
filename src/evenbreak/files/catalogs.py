"""The languages for messages: one gettext catalog (`.po`) each.

They are in `evenbreak/words/locale/<language>/LC_MESSAGES/evenbreak.po`. More catalogs, or other
wordings for a language (even `en`), can be put in the folder named by `EVENBREAK_LOCALE`, laid out
the same way: no language is hard-coded.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache
from gettext import GNUTranslations, NullTranslations
from io import BytesIO
from pathlib import Path
from string import Formatter
from typing import TYPE_CHECKING

from evenbreak.errors import DataError
from evenbreak.words import PYTHON, Face, FilePath, joined, say

if TYPE_CHECKING:
    from babel.messages.catalog import Catalog, Message

OWN = Path(__file__).parent.parent / "words" / "locale"
ELSEWHERE = "EVENBREAK_LOCALE"
"""The environment variable that names a folder of additional catalogs."""

FILE = Path("LC_MESSAGES", "evenbreak.po")


def languages() -> dict[str, str]:
    """Return each language's own name for itself, by language code; English first.

    >>> languages()["de"]
    'Deutsch'
    """
    codes = {
        place.parent.parent.name for folder in _folders() for place in folder.glob(f"*/{FILE}")
    }
    return {code: _own_name(code) for code in ("en", *sorted(codes - {"en"}))}


def face_in(language: str) -> Face:
    """Return the translations for a language; raise DataError if its catalog can't be used.

    >>> face_in("de").number(1234.5, ",.1f")
    '1.234,5'
    """
    return _face(language, _folders())


def language_of(accepted: str) -> str:
    """Return the available language that a browser prefers.

    >>> language_of("xx-XX,de;q=0.8,en;q=0.5"), language_of("")
    ('de', 'en')
    """
    there = languages()
    for wanted in accepted.split(","):
        code = wanted.split(";")[0].split("-")[0].strip().lower()
        if code in there:
            return code
    return "en"


def _folders() -> tuple[Path, ...]:
    elsewhere = os.environ.get(ELSEWHERE)
    return (OWN, Path(elsewhere)) if elsewhere else (OWN,)


_OWN_NAMES = {"en": "English", "de": "Deutsch"}
"""The languages' own names; getting these from Babel would take 4 MB and tenths of a second."""


@cache
def _own_name(code: str) -> str:
    if code in _OWN_NAMES:
        return _OWN_NAMES[code]
    from babel import Locale, UnknownLocaleError

    try:
        name = Locale.parse(code).get_language_name() or code
    except (UnknownLocaleError, ValueError):
        return code
    return name[:1].upper() + name[1:]


@cache
def _face(language: str, folders: tuple[Path, ...]) -> Face:
    translations: NullTranslations | None = None
    for folder in folders:
        place = folder / language / FILE
        if place.is_file():
            read = _translations(place)
            if translations is not None:
                read.add_fallback(translations)
            translations = read
    if translations is None:
        return PYTHON  # English as it is in the code, for which Babel is not needed
    from babel import Locale, UnknownLocaleError
    from babel.numbers import get_decimal_symbol, get_group_symbol

    try:
        locale = Locale.parse(language)
    except (UnknownLocaleError, ValueError):
        return Face(language, translations)
    pattern = locale.percent_formats[None]
    return Face(
        language=language,
        translations=translations,
        decimal=get_decimal_symbol(locale),
        group=get_group_symbol(locale),
        percent=f"{pattern.prefix[0]}{{n}}{pattern.suffix[0]}",
    )


def _translations(place: Path) -> GNUTranslations:
    from babel.messages.mofile import write_mo

    catalog = read_catalog(place)
    problems = [
        joined([FilePath(place), problem], ": ")
        for message in catalog
        if message.id
        for problem in problems_of(message)
    ]
    if problems:
        raise DataError(problems)
    compiled = BytesIO()
    write_mo(compiled, catalog)
    compiled.seek(0)
    return GNUTranslations(compiled)


def read_catalog(place: Path) -> Catalog:
    """Return the catalog in a file; raise DataError if it isn't a catalog."""
    from babel.messages.pofile import PoFileError, read_po

    try:
        with place.open("rb") as file:
            return read_po(file, locale=None, abort_invalid=True)
    except (PoFileError, ValueError) as error:
        raise DataError(
            [say("{file} isn't a gettext catalog: {error}", file=FilePath(place), error=error)]
        ) from None


def fields_of(template: str) -> set[str]:
    """Return the names of a template's placeholders.

    >>> sorted(fields_of("{player!r} needs {p:.1%}"))
    ['p', 'player']
    """
    return {name for _, name, _, _ in Formatter().parse(template) if name is not None}


def problems_of(message: Message) -> Iterator[str]:
    """Yield what is wrong with a translation: placeholders that the English doesn't have."""
    english = _all(message.id)
    for text in filter(None, _all(message.string)):
        try:
            unknown = fields_of(text) - {name for one in english for name in fields_of(one)}
        except ValueError as error:
            yield say("{text!r}: {error}", text=text, error=error)
            continue
        for name in sorted(unknown):
            yield say(
                "{text!r} has {name!r}, which isn't in the English text", text=text, name=name
            )


def _all(text: str | tuple[str, ...] | list[str] | None) -> list[str]:
    return [text] if isinstance(text, str) else list(text or ())
