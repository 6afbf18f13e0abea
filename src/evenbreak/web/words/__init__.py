"""Every word of the pages, in each language: one file a language."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

LANGUAGES = {"en": "English", "de": "Deutsch"}
"""Each language by its code, with its name in itself."""

_NUMBER = re.compile(r"([<>+-]?)(\d{1,3}(?:,\d{3})*|\d+)(\.\d+)?(%?)", re.ASCII)


@cache
def catalogue(language: str) -> Mapping[str, str]:
    """Return the words of a language by key.

    >>> catalogue("en")["tables"], catalogue("de")["tables"]
    ('Tables', 'Tische')
    """
    text = files(__package__).joinpath(f"{language}.json").read_text(encoding="utf-8")
    words: Mapping[str, str] = json.loads(text)
    return words


def say(language: str, key: str, **values: object) -> str:
    """Return a sentence in a language, with what it holds filled in.

    >>> say("en", "ends_about", at="22:15")
    'Ends about 22:15'
    """
    return catalogue(language)[key].format(**values)


def number_in(language: str, text: str) -> str:
    """Return a number as it is written in a language; what is no number stays as it is.

    >>> number_in("de", "1,234.5"), number_in("de", "<0.1%"), number_in("de", "W1.1")
    ('1.234,5', '<0,1 %', 'W1.1')
    """
    found = _NUMBER.fullmatch(text)
    if found is None:
        return text
    words, (sign, whole, part, unit) = catalogue(language), found.groups("")
    digits = whole.replace(",", words["thousands"]) + part.replace(".", words["decimal"])
    return words["percent"].format(n=sign + digits) if unit else sign + digits


def language_of(accepted: str) -> str:
    """Return the language that a browser asks for first, of those that there are.

    >>> language_of("fr-FR,de;q=0.8,en;q=0.5"), language_of("")
    ('de', 'en')
    """
    for wanted in accepted.split(","):
        code = wanted.split(";")[0].split("-")[0].strip().lower()
        if code in LANGUAGES:
            return code
    return "en"
