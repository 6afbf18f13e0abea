"""Each kind reads a text, or says how to write it; a schema says the same."""

import pytest

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, Flag, Kind, Named, Number, TwoWhole, Whole

PAIR = TwoWhole(wanted="give M:N", one=True)
SPAN = TwoWhole(r"\.\.", wanted="give LO..HI", metavar="LO..HI", rising=True)


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        (Whole(1, 9), " 07 ", 7),
        (Number(0.0, 1.0), "-0", 0.0),
        (Number(-5.0, 5.0), "1e0", 1.0),
        (PAIR, "7", (7, 7)),
        (PAIR, "7/5", (7, 5)),
        (SPAN, "5..9", (5, 9)),
        (Choice(("a", "b")), "a", "a"),
        (Choice({"half-shift": "half shift"}), "half-shift", "half shift"),
        (Flag(), "yes", True),
        (Flag(), "", False),
        (Named(str.upper), "npl", "NPL"),
    ],
)
def test_a_text_is_read(kind: Kind, text: str, value: object) -> None:
    assert kind.read(text) == value


@pytest.mark.parametrize(
    ("kind", "text", "wanted"),
    [
        (Whole(1, 9), "10", "from 1 to 9"),
        (Whole(1, 9), "1_0", "from 1 to 9"),
        (Whole(1, 9), "7.0", "from 1 to 9"),
        (Number(0.0, 1.0), "80%", "80% is 0.8"),
        (Number(0.0, 1.0), "nan", "from 0 to 1"),
        (PAIR, "0:5", "give M:N"),
        (SPAN, "9..5", "give LO..HI"),
        (SPAN, "9", "give LO..HI"),
        (Choice(("a", "b")), "c", "'a', 'b'"),
    ],
)
def test_what_is_wrong_is_refused_with_the_remedy(kind: Kind, text: str, wanted: str) -> None:
    with pytest.raises(InputError, match=wanted):
        kind.read(text)


@pytest.mark.parametrize(
    ("kind", "value", "typed"),
    [
        (PAIR, (7, 5), "7:5"),
        (SPAN, (5, 9), "5..9"),
        (Choice({"half-shift": "half shift"}), "half shift", "half-shift"),
        (Number(0.0, 1.0), 0.5, "0.5"),
    ],
)
def test_a_value_is_written_as_it_is_typed(kind: Kind, value: object, typed: str) -> None:
    assert kind.words(value) == typed
    assert kind.read(typed) == value


def test_a_schema_has_the_limits() -> None:
    assert Whole(1, 9).schema() == {"type": "integer", "minimum": 1, "maximum": 9}
    assert PAIR.schema()["items"]["maximum"] == 1000
    assert Choice(("a", "b")).schema()["enum"] == ["a", "b"]
