"""The sentences of answers, as the pages say them."""

import re
from string import Formatter

import pytest

from evenbreak.files.catalogues import face_in
from evenbreak.files.store import evening_file
from evenbreak.web.words.sentences import in_language, patterns
from evenbreak.words import Sentence, in_face, say


def fields(text: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(text) if name}


@pytest.mark.parametrize("text", [*evening_file.WHY.values(), evening_file.DAMAGED])
def test_what_is_wrong_with_the_file_is_said_in_german(text: Sentence) -> None:
    values = {"name": "tonight.db", "error": "database disk image is malformed"}
    sentence = say(text.template, **values)
    assert in_face(sentence, face_in("de")) != sentence


@pytest.mark.parametrize("language", ["en", "de"])
def test_patterns_have_the_places_of_what_is_said_for_them(language: str) -> None:
    for pattern, other in patterns(language).items():
        places = {int(name) for name in fields(other)}
        assert places <= set(range(pattern.count("{}"))), pattern


CONNECTIVES = sorted(
    {
        piece
        for pattern in patterns("de")
        for piece in pattern.split("{}")
        if piece.strip() and len(piece) < 30
    }
)
HOSTILE = (
    *("Tom and Jerry", "W1.1/Final", "table 4", "Bo beat Ann 7:5", "Ann beat Bo", "winner of W1.1"),
    *(
        "Final",
        "the draw",
        "8",
        "Lee, Ann",
        "Jr. Smith",
        "D'Arcy",
        "place",
        "Bo (did you mean Al?)",
    ),
    *(f"Bo{piece}Al".strip() for piece in CONNECTIVES),
)


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "de"])
def test_no_sentence_renames_a_player(language: str) -> None:
    k = 0
    for pattern, other in patterns(language).items():
        used = sorted({int(name) for name in fields(other)})
        for _ in range(max(3, len(HOSTILE) // 60)):
            names = [HOSTILE[(k + n) % len(HOSTILE)] for n in range(pattern.count("{}"))]
            k += len(names) + 1
            apart = re.sub(r"(?<=\w)\{\}", " {}", pattern)  # no sentence glues a name to a word
            said = in_language(language, apart.format(*names), names)
            assert all(names[place] in said for place in used), (pattern, names, said)


@pytest.mark.slow_after(51)
@pytest.mark.parametrize("name", HOSTILE)
def test_a_name_is_left_alone_in_every_kind_of_sentence(name: str) -> None:
    for text in (
        name,
        f"{name} beat Bo Diaz 7:5 in W1.1. {name} goes to W2.1 and meets Cy.",
        f"{name} - Bo Diaz",
        f"W1.1 has a result, {name} beat Bo Diaz 7:5; change it with correct W1.1",
        f"Drawn by lot: Bo Diaz, {name} and Cy.",
    ):
        assert in_language("de", text, [name, "Bo Diaz", "Cy"]).count(name) >= text.count(name)
    assert repr(name) in in_language("de", f"line 3: player {name!r} has 300 letters; write a name")


def test_the_sentence_around_a_name_is_still_said() -> None:
    for name in ("Tom and Jerry", "Bo beat Ann 7:5", "Jr. Smith"):
        said = in_language("de", f"{name} beat Al 7:5 in W1.1. {name} has dropped out.", [name])
        assert said == f"{name} schlägt Al 7:5 in W1.1. {name} ist ausgestiegen."
