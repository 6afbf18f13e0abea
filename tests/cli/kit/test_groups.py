"""Groups list their commands without importing them."""

import sys

import click
import pytest
from click.testing import CliRunner

from evenbreak.cli.kit.groups import Entry, LazyGroup

TABLE = {
    "first": Entry("Does one thing.", "start:reproduce", "Early"),
    "second": Entry("Does another.", "no.such.module", "Late"),
    "third": Entry("Does a third.", "neither.is.this", "Late"),
}


@pytest.fixture
def group() -> LazyGroup:
    return LazyGroup("group", table=TABLE)


def test_the_help_lists_the_commands_by_section(group: LazyGroup) -> None:
    lines = CliRunner().invoke(group, ["--help"]).output.splitlines()
    listed = lines[lines.index("Early:") :]
    assert listed == [
        "Early:",
        "  first   Does one thing.",
        "",
        "Late:",
        "  second  Does another.",
        "  third   Does a third.",
    ]


def test_only_the_command_that_is_asked_for_is_imported(group: LazyGroup) -> None:
    sys.modules.pop("evenbreak.cli.start", None)
    context = click.Context(group)
    assert group.get_command(context, "fourth") is None
    assert "evenbreak.cli.start" not in sys.modules
    command = group.get_command(context, "first")
    assert isinstance(command, click.Command)
    with pytest.raises(ModuleNotFoundError):
        group.get_command(context, "second")


def test_an_unknown_command_gets_a_suggestion(group: LazyGroup) -> None:
    result = CliRunner().invoke(group, ["secnd"])
    assert result.exit_code == 2
    assert "'second'" in result.stderr
