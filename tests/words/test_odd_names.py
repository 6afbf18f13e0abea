"""Names with braces, percent signs and backslashes are values: every sentence shows them whole."""

import pickle

from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError, InputError
from evenbreak.fields.question import AskedError, Question
from evenbreak.files.catalogs import face_in
from evenbreak.files.tables.problems import Problems, of_list, refusal, warning
from evenbreak.words import PYTHON, Command, FilePath, Sentence, joined, listed, say, say_count

NAMES = st.one_of(
    st.sampled_from(["{x}", "100%", "{", "}}", "{0}", "{p1!r:>9}", "%(n)s", "%s", r"\1", "{n:,}"]),
    st.text("{}%()$\\:!.,'\"ab01 ", min_size=1, max_size=12),
)
FACES = [PYTHON, face_in("de")]


def of_problems(name: str) -> str:
    """Return the problem of a row that names a player."""
    problems = Problems("r.csv")
    problems.add(7, "{name} is on the list twice", name=name)
    return problems.listed()[0]


def asked(name: str) -> Sentence:
    """Return what a question says that refuses a name."""
    try:
        Question.refuse("{player} {name} is not in the file; give {p1}", name=name)
    except AskedError as error:
        return error.sentence


WAYS = {
    "say": lambda name: say("{player} goes to {match}.", player=name, match="W1.1"),
    "in a sentence": lambda name: say("{a}!", a=say("{player} won", player=name)),
    "say_count": lambda name: say_count("{n} game for {p}", "{n} games for {p}", 2, p=name),
    "joined": lambda name: joined([say("so"), name], ": "),
    "before": lambda name: name + say(" won"),
    "listed": lambda name: listed([name, "Bo"]),
    "an error": lambda name: InputError("{name} has not entered", name=name).sentence,
    "plain text": lambda name: InputError(f"{name} has not entered").sentence,
    "a list": lambda name: DataError([f"{name} is twice", say("so")]).sentence,
    "a question": asked,
    "a refusal": lambda name: refusal("r.csv", "{name} is twice", name=name).sentence,
    "a file": lambda name: warning(name, 3, "is tied"),
    "a row": of_problems,
    "a list of names": lambda name: of_list(warning("r.csv", 3, "{name} is tied", name=name), name),
    "a path": lambda name: say("{file} is empty", file=FilePath(name)),
}


@given(NAMES)
def test_a_name_comes_whole_through_every_kind_of_sentence(name: str) -> None:
    for kind, way in WAYS.items():
        sentence = way(name)
        copied = pickle.loads(pickle.dumps(sentence))  # noqa: S301  our own
        for face in FACES:
            assert name in sentence.said(face), kind
            assert copied.said(face) == sentence.said(face), kind
        assert name in str(sentence), kind


@given(NAMES)
def test_a_name_comes_whole_into_a_command(name: str) -> None:
    assert name.replace("'", "") in Command("tournament late", name).replace("'\"'\"'", "")
