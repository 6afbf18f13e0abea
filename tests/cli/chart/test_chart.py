"""The group `evenbreak chart`, and what holds for all its commands."""

import click
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.groups import CHART as COMMANDS
from evenbreak.cli.groups import chart as command


def test_the_group_lists_its_commands(run):
    output = run("chart", "--help").output
    for name, entry in COMMANDS.items():
        assert f"{name} " in output
        assert entry.help in output
    assert run("chart", "audiit").exit_code == 2


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_of_the_group_exists(name):
    found = command.get_command(click.Context(command), name)
    assert found.name == name
    for option in found.params:
        assert isinstance(option, click.Argument) or option.help


words = st.sampled_from(
    ["list", "show", "audit", "npl_8", "apa_8ball", "--scale", "fargo", "--json", "--beside", "-"]
) | st.text(max_size=3)


@pytest.mark.slow
@given(st.lists(words, max_size=5))
def test_no_words_make_a_traceback(run, line):
    assert run("chart", *line).exit_code in (0, 2, 3)
