"""Languages are folders: one more needs no code, and English can be worded anew too."""

from pathlib import Path

import pytest

from evenbreak.errors import DataError
from evenbreak.files.catalogs import face_in, language_of, languages
from evenbreak.words import PYTHON, listed, say, say_count

HEADER = (
    'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=utf-8\\n"\n"Plural-Forms: {}\\n"\n\n'
)
TWO = "nplurals=2; plural=(n > 1);"


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Return what writes a catalog into a folder of one's own."""
    monkeypatch.setenv("EVENBREAK_LOCALE", str(tmp_path))

    def write_catalog(language: str, *entries: str) -> None:
        place = tmp_path / language / "LC_MESSAGES" / "evenbreak.po"
        place.parent.mkdir(parents=True)
        place.write_text(HEADER.format(TWO) + "\n\n".join(entries), encoding="utf-8")

    return write_catalog


def test_a_third_language_is_a_folder(write) -> None:
    write(
        "fr",
        'msgid "{player} goes to {match}."\nmsgstr "{player} va en {match}."',
        'msgid "{most} and {last}"\nmsgstr "{most} et {last}"',
        'msgid "{n} game"\nmsgid_plural "{n} games"\n'
        'msgstr[0] "{n} partie"\nmsgstr[1] "{n} parties"',
    )
    assert languages() == {"en": "English", "de": "Deutsch", "fr": "Français"}
    assert language_of("fr-CA,de;q=0.5") == "fr"
    french = face_in("fr")
    said = say("{player} goes to {match}.", player="Tom and Jerry", match="W2.1").said(french)
    assert said == "Tom and Jerry va en W2.1."
    assert listed(["Tom and Jerry", "the Shark"]).said(french) == "Tom and Jerry et the Shark"
    assert say_count("{n} game", "{n} games", 0).said(french) == "0 partie"
    assert french.number(1234.5, ",.1f") == "1\u202f234,5"
    assert french.number(0.5, ".0%") == "50\u00a0%"


def test_english_needs_no_catalog() -> None:
    assert face_in("en") is PYTHON


def test_english_can_be_worded_anew(write) -> None:
    write("en", 'msgid "The draw has been made: {n} players."\nmsgstr "We drew {n} players."')
    assert (
        say("The draw has been made: {n} players.", n=8).said(face_in("en")) == "We drew 8 players."
    )
    assert say("Something else").said(face_in("en")) == "Something else"


def test_one_sentence_of_german_can_be_changed_and_the_others_stay(write) -> None:
    write("de", 'msgid "{most} or {last}"\nmsgstr "{most} bzw. {last}"')
    assert listed(["A", "B"], "or").said(face_in("de")) == "A bzw. B"
    assert listed(["A", "B"]).said(face_in("de")) == "A und B"


def test_a_value_that_english_does_not_have_is_refused(write) -> None:
    write("fr", 'msgid "{player} won"\nmsgstr "{joueur} a gagné"')
    with pytest.raises(DataError, match=r"evenbreak\.po: .* has 'joueur', which isn't in"):
        face_in("fr")


def test_what_is_no_catalog_is_refused(write) -> None:
    write("fr", "this is no catalog")
    with pytest.raises(DataError, match="isn't a gettext catalog"):
        face_in("fr")
