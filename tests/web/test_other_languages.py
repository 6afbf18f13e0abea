"""A page in a language that no code knows, and in other English words."""

from pathlib import Path

import pytest

from web.phones import Phone, answering

HEAD = 'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=utf-8\\n"\n'


@pytest.fixture
def locale(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder of one's own for catalogs, which the page reads."""
    folder = tmp_path / "locale"
    monkeypatch.setenv("EVENBREAK_LOCALE", str(folder))
    return folder


def catalog(folder: Path, language: str, sentences: dict[str, str]) -> None:
    place = folder / language / "LC_MESSAGES" / "evenbreak.po"
    place.parent.mkdir(parents=True)
    entries = (f'msgid "{english}"\nmsgstr "{said}"\n' for english, said in sentences.items())
    place.write_text("\n".join([HEAD, *entries]), encoding="utf-8")


def begin(site: object) -> Phone:
    director = Phone(site, director=True)
    entrants = "player,rating\nTom and Jerry,612\nthe Shark,590"
    plan = {"format": "single", "races": "even", "race": 3, "tables": 2, "seeding": "listed"}
    director.send("/new", entrants=entrants, discipline="9-ball", scale="fargo", **plan)
    director.send("/desk/draw")
    return director


@pytest.mark.slow
def test_a_page_speaks_a_language_that_is_only_a_folder(tmp_path: Path, locale: Path) -> None:
    said = {
        "Tonight": "Ce soir",
        "{a} against {b}": "{a} contre {b}",
        "Fair race": "Match équitable",
    }
    won = {"{winner} beat {loser} {score}": "{winner} bat {loser} {score}"}
    catalog(locale, "fr", said | won)
    with answering(tmp_path / "tonight.db") as site:
        begin(site)
        director = Phone(site, director=True, language="fr")
        shown = director.open("/")
        assert 'lang="fr"' in shown.text
        assert "Ce soir" in shown.words
        assert "English" in shown.words
        assert "Français" in Phone(site).open("/").words
        assert "Bracket" in shown.words  # what it does not say is said in English
        words = director.send("/desk/result", match="F", a=3, b=1).words
        assert "Tom and Jerry bat the Shark 3-1" in words


@pytest.mark.slow
def test_english_can_be_said_in_other_words(tmp_path: Path, locale: Path) -> None:
    catalog(locale, "en", {"{winner} beat {loser} {score}": "{loser} lost to {winner}"})
    with answering(tmp_path / "tonight.db") as site:
        director = begin(site)
        words = director.send("/desk/result", match="F", a=3, b=1).words
        assert "the Shark lost to Tom and Jerry" in words
