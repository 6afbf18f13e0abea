"""The catalogues: complete, with the same fields, and every word in use."""

import re
from string import Formatter

import pytest

from evenbreak.web.words import LANGUAGES, catalogue
from places import SRC

PAGES = "\n".join(
    path.read_text(encoding="utf-8")
    for path in (SRC / "web").rglob("*")
    if path.suffix in {".py", ".html"}
)


def fields(text: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(text) if name}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_language_says_everything(language: str) -> None:
    english, other = catalogue("en"), catalogue(language)
    assert list(other) == list(english)
    assert {key: fields(text) for key, text in other.items()} == {
        key: fields(text) for key, text in english.items()
    }


def test_every_word_is_used() -> None:
    used = set(re.findall(r"""["']([a-z_]+)["']""", PAGES))
    families = ("format_", "seeding_")
    assert [
        key for key in catalogue("en") if key not in used and not key.startswith(families)
    ] == []


def test_every_word_used_is_there() -> None:
    asked = set(re.findall(r"""\bt\(["']([a-z_]+)["']""", PAGES))
    asked |= set(re.findall(r"""RefusalError\(\s*["']([a-z_]+)["']""", PAGES))
    assert asked - {"format_", "seeding_"} - set(catalogue("en")) == set()
