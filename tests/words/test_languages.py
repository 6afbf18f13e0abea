"""Every language says all that a page can show, with the values that the English has."""

from collections.abc import Iterator

import pytest
from babel.messages.catalog import Message

from catalogued import collected
from evenbreak.files.catalogues import FILE, OWN, face_in, languages, problems_of, read_catalogue

CODES = [code for code in languages() if (OWN / code / FILE).is_file()]


def texts(message: Message) -> Iterator[str]:
    yield from (message.string,) if isinstance(message.string, str) else message.string


@pytest.mark.parametrize("code", CODES)
def test_every_sentence_is_in_the_catalogue(code: str) -> None:
    catalogue = read_catalogue(OWN / code / FILE)
    missing = [
        message.id
        for message in collected()
        if message.id
        and not (
            (there := catalogue.get(message.id, message.context))
            and there.id == message.id
            and all(texts(there))
            and not there.fuzzy
        )
    ]
    assert missing == [], "run `make catalogues` and translate these"


@pytest.mark.parametrize("code", CODES)
def test_every_sentence_of_the_catalogue_is_used(code: str) -> None:
    used = collected()
    assert [
        message.id
        for message in read_catalogue(OWN / code / FILE)
        if message.id and not used.get(message.id, message.context)
    ] == []


@pytest.mark.parametrize("code", CODES)
def test_translations_have_the_values_of_the_english(code: str) -> None:
    assert face_in(code).language == code
    for message in read_catalogue(OWN / code / FILE):
        assert list(problems_of(message)) == []
