"""Every word of the pages, in each language: one file a language."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

LANGUAGES = {"en": "English", "de": "Deutsch"}
"""Each language by its code, with its name in itself."""


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
