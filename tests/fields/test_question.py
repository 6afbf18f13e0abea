"""What is read off a question: its fields, checks, schema and refusals."""

from dataclasses import dataclass
from typing import Annotated, TypeAlias

import pytest

from evenbreak.fields.kinds import Flag, Whole
from evenbreak.fields.question import (
    AskedError,
    Field,
    Question,
    Says,
    declaration,
    declared,
    schema_of,
)

Length: TypeAlias = Annotated[int, Field(Whole(1, 9), "How long.")]


@dataclass(frozen=True, kw_only=True)
class Sides(Question):
    left: Annotated[bool, Field(Flag(), "The left side, without {right}.")] = False
    right: Annotated[bool, Field(Flag(), "The right side.")] = False

    def check(self) -> None:
        if self.left and self.right:
            self.refuse("{left} and {right} exclude each other in {place}", place="a {room}")


@dataclass(frozen=True, kw_only=True)
class Walk(Sides):
    steps: Length
    back: Annotated[Length | None, Says("How long back.", usual="as far")] = None

    def check(self) -> None:
        if self.back is not None and self.back > self.steps:
            self.refuse("{back} is above {steps}")


def test_fields_come_in_the_order_of_the_bases() -> None:
    assert [one.name for one in declared(Walk)] == ["left", "right", "steps", "back"]


def test_a_field_that_is_declared_once_may_say_something_else() -> None:
    steps, back = declaration(Walk, "steps"), declaration(Walk, "back")
    assert (steps.field.help, back.field.help) == ("How long.", "How long back.")
    assert steps.kind is back.kind
    assert (steps.required, back.required, back.usual) == (True, False, "as far")


def test_every_check_is_made_and_parameters_are_named() -> None:
    with pytest.raises(AskedError, match="back is above steps"):
        Walk(steps=2, back=3)
    with pytest.raises(AskedError) as caught:
        Walk(steps=2, left=True, right=True)
    assert str(caught.value) == "left and right exclude each other in a {room}"


def test_what_is_given_differs_from_its_default() -> None:
    assert Walk(steps=2, left=True, back=None).given == {"left": True, "steps": 2}


def test_the_schema_has_kinds_limits_and_what_must_be_given() -> None:
    schema = schema_of(Walk)
    assert schema["required"] == ["steps"]
    assert schema["properties"]["left"]["description"] == "The left side, without right."
    assert schema["properties"]["steps"] == {
        "type": "integer",
        "minimum": 1,
        "maximum": 9,
        "description": "How long.",
    }
