"""A sentence keeps its template and its values; a face says it in its own way."""

import copy
import pickle
from dataclasses import replace
from gettext import NullTranslations
from typing import Any

import pytest

from evenbreak.errors import DataError, EvenbreakError, InputError
from evenbreak.words import (
    PYTHON,
    Command,
    Face,
    Figure,
    FilePath,
    Parameter,
    Sentence,
    in_face,
    joined,
    listed,
    say,
    say_as,
    say_count,
)
from rows import each_of


class Backwards(NullTranslations):
    """A language in which every template is said with <> around it, and several with >>."""

    def gettext(self, message: str) -> str:
        return f"<{message}>"

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return f"<{msgid1}>" if n == 1 else f">{msgid2}<"

    def pgettext(self, context: str, message: str) -> str:
        return f"<{context}: {message}>"


FACE = Face(
    translations=Backwards(),
    decimal=",",
    group=".",
    percent="{n} %",
    parameter=lambda name: f"--{name}",
    command=lambda name, words: f"“{name}”({', '.join(words)})",
    file=lambda path: path.rpartition("/")[2],
)
EVERY_KIND = [
    say("{player} goes to {match}.", player="Tom and Jerry", match="W2.1"),
    say("nothing to undo"),
    say("{outer}!", outer=say("{inner}", inner=say_count("{n} game", "{n} games", 2))),
    say_as("heading", "race"),
    joined([say("a"), "b", say("c")], "; "),
    listed(["Ann", say("the winner of {match}", match="W1.1")]),
    Figure(0.0005, ".1%", sign="<"),
    Parameter("win_by"),
    Command("tournament result", "W1.2"),
    FilePath("club/tonight.db"),
]


def again(value: Any) -> Any:
    """Return a copy as another process gets it."""
    return pickle.loads(pickle.dumps(value))  # noqa: S301  our own


def test_a_sentence_is_its_english_text() -> None:
    sentence = say("{player!r} has {p:.1%} of {n:,}", player="a{b}", p=0.123, n=1200)
    assert sentence == "'a{b}' has 12.3% of 1,200"
    assert isinstance(sentence, str)
    assert hash(sentence) == hash(str(sentence))


def test_a_template_without_values_has_no_fields() -> None:
    assert say("a {b} c") == "a {b} c" == say("a {b} c").said(PYTHON)


@pytest.mark.parametrize(
    "name", ["Tom and Jerry", "the Shark", "winner of W1.1", "{player}", "1.5"]
)
def test_a_name_is_never_looked_into(name: str) -> None:
    assert in_face(name, FACE) == name
    assert say("{who} won", who=name).said(FACE) == f"<{name} won>"
    assert say("{who!r} won", who=name).said(FACE) == f"<{name!r} won>"
    assert joined([name, name], " - ").said(FACE) == f"{name} - {name}"
    assert listed([name, name]).said(FACE) == f"<{name} and {name}>"


def test_values_that_are_sentences_are_said_too() -> None:
    winner = say("the winner of {match}", match="W1.1")
    assert say("{a} meets {b}", a="Ann", b=winner).said(FACE) == "<Ann meets <the winner of W1.1>>"


def test_numbers_are_written_in_the_way_of_the_face() -> None:
    sentence = say("{p:.1%} of {games:,.1f} or {n}", p=0.907, games=1234.5, n=3)
    assert sentence == "90.7% of 1,234.5 or 3"
    assert sentence.said(FACE) == "<90,7 % of 1.234,5 or 3>"
    assert Figure(0.0005, ".1%", sign="<").said(FACE) == "<0,1 %"
    assert Figure(0.5).said(FACE) == "0,5"


def test_a_number_decides_between_one_and_many() -> None:
    one, many = (say_count("{n} game left", "{n:,} games left", n) for n in (1, 1200))
    assert (one, many) == ("1 game left", "1,200 games left")
    assert (one.said(FACE), many.said(FACE)) == ("<1 game left>", ">1.200 games left<")


def test_a_word_of_several_meanings_has_the_one_that_is_meant() -> None:
    assert say_as("heading", "race") == "race"
    assert say_as("heading", "race").said(FACE) == "<heading: race>"


def test_parameters_commands_and_files_are_named_by_the_face() -> None:
    sentence = say("{name} must be above 0", name=Parameter("scale"))
    assert (sentence, sentence.said(FACE)) == ("scale must be above 0", "<--scale must be above 0>")
    command = Command("tournament result", "W1.2", "Ann Lee")
    assert command == "evenbreak tournament result W1.2 'Ann Lee'"
    assert command.said(FACE) == "“tournament result”(W1.2, Ann Lee)"
    assert FilePath("club/tonight.db").said(FACE) == "tonight.db"


@each_of("sentence", EVERY_KIND)
def test_a_copy_says_the_same(sentence: Sentence) -> None:
    for same in (again(sentence), copy.deepcopy(sentence)):
        assert same == sentence
        assert same.said(FACE) == sentence.said(FACE)
        assert type(same) is type(sentence)


@each_of("sentence", EVERY_KIND)
def test_python_says_the_text_itself(sentence: Sentence) -> None:
    assert sentence.said(PYTHON) == sentence
    assert sentence.said(replace(PYTHON)) == sentence


def test_an_error_keeps_its_sentence_in_another_process() -> None:
    error = InputError("{name} is {value!r}; use a number", name=Parameter("scale"), value="x")
    assert str(error) == "scale is 'x'; use a number"
    copied = again(error)
    assert copied.sentence.said(FACE) == "<--scale is 'x'; use a number>"
    assert InputError(error.sentence).sentence is error.sentence


def test_an_error_with_braces_in_its_text_is_shown_as_it_is() -> None:
    assert str(EvenbreakError("'{x}' is no name")) == "'{x}' is no name"


def test_the_problems_of_a_file_are_sentences() -> None:
    error = DataError([say("line {n}: empty", n=2), "r.csv: more"])
    assert str(error) == "line 2: empty\nr.csv: more"
    copied = again(error)
    assert copied.problems == error.problems
    assert copied.sentence.said(FACE) == "<line 2: empty>\nr.csv: more"
