"""A field added to what a tournament is planned by is one line, and every face has it."""

import json
from dataclasses import dataclass, replace
from typing import Annotated

import click
import option_tables
from click.testing import CliRunner
from starlette.datastructures import ImmutableMultiDict

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.evenings.log import read_json
from evenbreak.fields.kinds import Whole
from evenbreak.fields.question import Field, declared, schema_of
from evenbreak.questions.tournament import NewTournament
from evenbreak.tournaments.evening.events import Plan
from evenbreak.tournaments.evening.format import Format
from evenbreak.web.forms import Form, asked_in, form_fields


@dataclass(frozen=True, kw_only=True)
class WithTimeouts(Format):
    timeouts: Annotated[int, Field(Whole(0, 5), "Timeouts in a match.", formats=("double",))] = 1


@dataclass(frozen=True, kw_only=True)
class Asked(WithTimeouts, NewTournament):
    """Start a tournament."""


@dataclass(frozen=True)
class Planned(WithTimeouts, Plan):
    pass


@command_of(Asked, "new")
def new(asked: Asked) -> Answer:
    return Answer("", [str(asked.of_format | {"timeouts": asked.timeouts})])


def typed(*words: str) -> click.testing.Result:
    return CliRunner().invoke(new, ["entrants.csv", "--race", "5", *words])


def test_it_is_an_option() -> None:
    assert "'timeouts': 3" in typed("--timeouts", "3", "--text").output
    assert "'timeouts': 1" in typed("--text").output
    refused = typed("--timeouts", "6")
    assert refused.exit_code == 2
    assert "--timeouts" in refused.output
    assert "from 0 to 5" in refused.output


def test_the_help_and_the_reference_have_it() -> None:
    assert "--timeouts N  Timeouts in a match.  [0 to 5; default: 1]" in " ".join(
        typed("--help").output.split()
    ).replace("N Timeouts", "N  Timeouts").replace(". [0", ".  [0")
    assert (
        "| `--timeouts N` | Timeouts in a match (from 0 to 5; formats: double; default: 1). |"
        in (option_tables.table_of(Asked))
    )


def test_it_is_a_field_of_the_form() -> None:
    field = next(one for one in form_fields(declared(Asked)) if one.name == "timeouts")
    assert (field.label, field.shape, field.usual) == ("Timeouts in a match.", "whole", "1")
    form = Form(ImmutableMultiDict([("timeouts", "4")]))
    asked = asked_in(Asked, form, declared(WithTimeouts), entrants="", race=5)
    assert asked.timeouts == 4


def test_the_schema_and_the_plan_have_it() -> None:
    schema = schema_of(Asked)["properties"]["timeouts"]
    assert (schema["maximum"], schema["default"]) == (5, 1)
    plan = replace(read_json(Planned, '{"form": "double", "race": 5}'), timeouts=2)
    assert json.loads(json.dumps(plan.__dict__, default=str))["timeouts"] == 2
