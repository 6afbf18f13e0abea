"""What JSON gives is read as what is typed; what the schema forbids is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from option_tables import commands_asking

from evenbreak.errors import EvenbreakError, InputError
from evenbreak.fields.kinds import Flag, Kind, NumberOr, TwoWhole, Whole
from evenbreak.fields.question import Declared, Field, declared

FIELDS = [one for question in commands_asking() for one in declared(question)]
KINDS = list({repr(one.kind): one.kind for one in FIELDS}.values())
TYPES = sorted({type(kind) for kind in KINDS}, key=lambda one: one.__name__)

PLAIN = (
    st.none()
    | st.booleans()
    | st.integers(-(10**20), 10**20)
    | st.integers(-3, 30)
    | st.floats(-2, 30)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(max_size=9)
    | st.sampled_from(["7", "7:5", "true", "yes", "0.5", "none", ""])
)
ANYTHING = st.recursive(
    PLAIN, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=2)
)


def allowed(schema: dict[str, Any]) -> st.SearchStrategy[Any]:
    """Return values that a schema of a field allows, for the words that fields use."""
    if "anyOf" in schema:
        return st.one_of([allowed(one) for one in schema["anyOf"]])
    if "const" in schema:
        return st.just(schema["const"])
    if "enum" in schema:
        return st.sampled_from(schema["enum"])
    low, high = schema.get("minimum"), schema.get("maximum")
    if schema["type"] == "integer":
        whole = st.integers(low, high)
        return whole | whole.filter(lambda n: abs(n) < 2**53).map(float)
    if schema["type"] == "number":
        whole = (
            st.integers(int(-(-low // 1)), int(high // 1)) if high >= -(-low // 1) else st.nothing()
        )
        return st.floats(low, high) | whole
    if schema["type"] == "array":
        inner = allowed(schema["items"])
        return st.lists(
            inner, min_size=schema.get("minItems", 0), max_size=schema.get("maxItems", 3)
        )
    return st.booleans() if schema["type"] == "boolean" else st.text(max_size=9) | st.just("npl")


def typed(kind: Kind, value: Any) -> str:
    """Return how a value of JSON is typed."""
    if isinstance(kind, Flag):
        return "yes" if value else "no"
    if isinstance(kind, TwoWhole):
        return kind.words((int(value[0]), int(value[1])))
    if isinstance(value, list):
        return ":".join(str(int(one)) for one in value)
    if isinstance(kind, Whole):
        return str(int(value))
    return value if isinstance(value, str) else repr(value)


def outcome(read: Callable[[Any], Any], value: Any) -> tuple[object, ...]:
    try:
        return "read", repr(read(value))
    except EvenbreakError as error:
        return type(error), str(error)
    except (ArithmeticError, ValueError) as error:  # a reader's own matter
        return (type(error),)


def some_kind(data: st.DataObject, of: type[Kind]) -> Kind:
    return data.draw(st.sampled_from([kind for kind in KINDS if type(kind) is of]))


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("of", TYPES)
@settings(max_examples=40)
@given(data=st.data())
def test_what_json_gives_is_read_as_what_is_typed(of: type[Kind], data: st.DataObject) -> None:
    kind = some_kind(data, of)
    value = data.draw(allowed(kind.schema()))
    assert Draft202012Validator(kind.schema()).is_valid(value)
    assert outcome(kind.load, value) == outcome(kind.read, typed(kind, value))


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("of", TYPES)
@settings(max_examples=40)
@given(data=st.data())
def test_what_the_schema_forbids_is_refused(of: type[Kind], data: st.DataObject) -> None:
    kind, value = some_kind(data, of), data.draw(ANYTHING)
    if not Draft202012Validator(kind.schema()).is_valid(value):
        with pytest.raises(InputError):
            kind.load(value)


@settings(max_examples=40)
@given(data=st.data())
def test_fields_of_several_values_take_lists(data: st.DataObject) -> None:
    one = data.draw(
        st.sampled_from([one for one in FIELDS if one.field.many or one.field.words > 1])
    )
    value, validator = data.draw(ANYTHING), Draft202012Validator(one.schema())
    if not validator.is_valid(value):
        with pytest.raises(InputError):
            one.load(value)
    fits = data.draw(allowed(one.schema()))
    assert validator.is_valid(fits)
    if outcome(one.load, fits)[0] == "read":
        assert isinstance(one.load(fits), tuple)


def test_a_refusal_says_what_came_and_what_is_wanted() -> None:
    with pytest.raises(InputError, match=r'^"7" is text\. Leave out the quotes\.$'):
        Whole(1, 9).load("7")
    with pytest.raises(InputError, match=r"^true isn't a number$"):
        Whole(1, 9).load(True)
    with pytest.raises(InputError, match="isn't a list of two numbers"):
        TwoWhole(wanted="isn't M:N").load("7:5")
    with pytest.raises(InputError, match=r"^'Best ' isn't a number of points, or best$"):
        NumberOr("best").load("Best ")
    pairs = Declared("pairs", Field(TwoWhole(), many=True), ())
    with pytest.raises(InputError, match="in a list"):
        pairs.load(7)
