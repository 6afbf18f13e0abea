"""Every language says all that a page can show, with the values that the English has."""

import ast
from collections.abc import Iterator

import pytest
from babel.messages.catalog import Message

from cataloged import collected
from evenbreak.files.catalogs import FILE, OWN, face_in, languages, problems_of, read_catalog
from places import SRC, trees_of

CODES = [code for code in languages() if (OWN / code / FILE).is_file()]


def texts(message: Message) -> Iterator[str]:
    yield from (message.string,) if isinstance(message.string, str) else message.string


@pytest.mark.parametrize("code", CODES)
def test_every_sentence_is_in_the_catalog(code: str) -> None:
    catalog = read_catalog(OWN / code / FILE)
    missing = [
        message.id
        for message in collected()
        if message.id
        and not (
            (there := catalog.get(message.id, message.context))
            and there.id == message.id
            and all(texts(there))
            and not there.fuzzy
        )
    ]
    assert missing == [], "run `make catalogs` and translate these"


@pytest.mark.parametrize("code", CODES)
def test_every_sentence_of_the_catalog_is_used(code: str) -> None:
    used = collected()
    assert [
        message.id
        for message in read_catalog(OWN / code / FILE)
        if message.id and not used.get(message.id, message.context)
    ] == []


@pytest.mark.parametrize("code", CODES)
def test_translations_have_the_values_of_the_english(code: str) -> None:
    assert face_in(code).language == code
    for message in read_catalog(OWN / code / FILE):
        assert list(problems_of(message)) == []


INDIRECT = (ast.JoinedStr, ast.Subscript)
SAYING = {"say": 1, "say_as": 2, "say_count": 2}
ROOMS = ("answers", "tournaments", "teams", "files", "web", "questions")


@pytest.mark.parametrize("room", ROOMS)
def test_templates_are_literals_that_can_be_collected(room: str) -> None:
    """A template that is a variable or an f-string would never reach a catalog."""
    paths = sorted((SRC / room).rglob("*.py"))
    wrong = [
        f"{path.relative_to(SRC)}:{node.lineno}"
        for path, tree in zip(paths, trees_of(paths), strict=True)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and any(isinstance(one, INDIRECT) for one in node.args[: SAYING.get(node.func.id, 0)])
    ]
    assert wrong == []


def test_no_sentence_of_a_page_is_an_f_string(capsys: pytest.CaptureFixture[str]) -> None:
    """Babel says so of each; it cannot be translated."""
    collected.cache_clear()
    collected()
    assert "f-string" not in capsys.readouterr().err
