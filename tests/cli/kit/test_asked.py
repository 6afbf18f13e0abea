"""A question as a command: its help, old spellings, and what is read from what is typed."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any

import click
import pytest
from click.testing import CliRunner

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import AskedCommand, command_of
from evenbreak.cli.program import program
from evenbreak.fields.kinds import Choice, Flag, Number, Text, Whole
from evenbreak.fields.question import Field, Question, declared

MOST_LINES = 40
"""The lines of a help text that a screen has."""


def commands(
    group: click.Group = program, path: tuple[str, ...] = ()
) -> Iterator[tuple[str, click.Command]]:
    ctx = click.Context(group)
    for name in group.list_commands(ctx):
        command = group.get_command(ctx, name)
        assert command is not None
        if isinstance(command, click.Group):
            yield from commands(command, (*path, name))
        else:
            yield " ".join((*path, name)), command


ASKED = {name: one for name, one in commands() if isinstance(one, AskedCommand)}


@dataclass(frozen=True, kw_only=True)
class Walk(Question):
    """Walk along a {road}.

    As far as you like.
    """

    examples = "  walk --steps 3\n"
    old_words = ("steps",)
    steps: Annotated[int | None, Field(Whole(1, 9), "How many steps.", old=("paces",))] = None
    road: Annotated[str, Field(Choice({"here": "h", "there": "t"}), "Which road.")] = "h"
    slope: Annotated[float, Field(Number(-9.0, 9.0), "Its slope.", rare=True)] = 0.0
    hats: Annotated[int, Field(Whole(0, 9), "Hats.", section="Luggage")] = 0
    bags: Annotated[int, Field(Whole(0, 9), "Bags.", section="Luggage")] = 0
    maps: Annotated[int, Field(Whole(0, 9), "Maps.", section="Luggage")] = 0
    dogs: Annotated[tuple[str, ...], Field(Text(), "With whom.", option="dog", many=True)] = ()
    pair: Annotated[
        tuple[tuple[str, str], ...], Field(Text("A B"), "Who walks.", many=True, words=2)
    ] = ()
    alone: Annotated[bool, Field(Flag(), "Without {dogs}.", section="Company")] = False

    def check(self) -> None:
        if self.alone and self.dogs:
            self.refuse("{alone} is without {dogs}")


seen: list[Walk] = []


@command_of(Walk, "walk")
def walk(asked: Walk) -> Answer:
    seen.append(asked)
    return Answer("A walk", ["Done."])


def typed(*words: str) -> tuple[Any, Walk | None]:
    seen.clear()
    result = CliRunner().invoke(walk, words)
    return result, seen[0] if seen else None


def test_values_are_read_and_the_others_have_their_defaults() -> None:
    company = ("--dog", "Rex", "--dog", "Ben", "--pair", "Ann", "Bo")
    words = ("--steps", "3", "--road", "there", "--slope", "-1.5", *company)
    assert typed(*words)[1] == Walk(
        steps=3, road="t", dogs=("Rex", "Ben"), pair=(("Ann", "Bo"),), slope=-1.5
    )
    assert typed()[1] == Walk()


def test_what_contradicts_itself_names_options() -> None:
    result, asked = typed("--alone", "--dog", "Rex")
    assert (result.exit_code, asked) == (2, None)
    assert "Error: --alone is without --dog\n" in result.stderr


def test_an_old_spelling_is_taken_with_a_note() -> None:
    result, asked = typed("--paces=3")
    assert asked == Walk(steps=3)
    assert "Note: --paces is now called --steps.\n" in result.stderr


def test_a_value_without_its_option_is_taken_with_a_note() -> None:
    result, asked = typed("3")
    assert asked == Walk(steps=3)
    assert "Note: write --steps 3 in place of 3.\n" in result.stderr
    assert typed("3", "--steps", "4")[0].exit_code == 2
    assert typed("3", "4")[0].exit_code == 2
    assert "from 1 to 9" in typed("10")[0].stderr


def test_a_number_below_zero_is_no_option_but_an_option_is_none() -> None:
    assert "No such option '--step'" in typed("--step", "3")[0].stderr
    assert "No such option '-x'" in typed("-1", "-x")[0].stderr


def test_the_help_has_what_is_needed_most_and_help_all_the_rest() -> None:
    short, whole = (typed(word)[0].stdout for word in ("--help", "--help-all"))
    assert "Walk along a --road." in short
    assert "--slope" not in short
    assert "Luggage     --hats, --bags, --maps" in short
    assert "--slope X" in whole
    assert "Without --dog." in whole
    assert "As far as you like." not in short
    assert "As far as you like." in whole
    assert "walk --steps 3" in short


@pytest.mark.parametrize("name", ASKED)
def test_the_help_of_a_command_fits_a_screen(name: str) -> None:
    text = CliRunner().invoke(program, [*name.split(), "--help"]).stdout
    assert len(text.splitlines()) <= MOST_LINES, text


@pytest.mark.parametrize("name", ASKED)
def test_help_all_explains_every_option(name: str) -> None:
    text = CliRunner().invoke(program, [*name.split(), "--help-all"]).stdout
    for one in declared(ASKED[name].question):
        assert one.field.argument or one.option in text


@pytest.mark.parametrize("name", ASKED)
def test_an_option_that_takes_one_value_is_refused_twice(name: str) -> None:
    command = ASKED[name]
    for param in command.params:
        if isinstance(param, click.Option) and not (param.is_flag or param.multiple):
            words = [param.opts[-1], *["1"] * param.nargs] * 2
            with pytest.raises(click.UsageError, match=r"is given twice\. Give it once: --"):
                command.make_context(name, words)
