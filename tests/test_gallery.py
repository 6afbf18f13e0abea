import ast
import re
from collections.abc import Iterator
from importlib import import_module
from types import ModuleType

import click
import pytest

from evenbreak.cli.program import program
from places import DOCS, SRC


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(DOCS / "images")
    return import_module("shown")


@pytest.fixture(scope="module")
def options() -> dict[str, set[str]]:
    """Return the options of every command."""
    return {
        words: {option for param in command.params for option in param.opts}
        for words, command in commands(program)
    }


def figures() -> set[str]:
    """Return the public functions of the room that return a picture of their own."""
    return {
        node.name
        for module in (SRC / "plots").glob("*.py")
        for node in ast.parse(module.read_text("utf-8")).body
        if isinstance(node, ast.FunctionDef)
        and not node.name.startswith("_")
        and node.returns is not None
        and (
            ast.unparse(node.returns) == "Picture"
            or (ast.unparse(node.returns) == "Axes" and node.name.startswith("draw"))
        )
    }


def commands(
    group: click.Group, words: tuple[str, ...] = ()
) -> Iterator[tuple[str, click.Command]]:
    ctx = click.Context(group)
    for name in group.list_commands(ctx):
        one = group.get_command(ctx, name)
        assert one is not None
        if isinstance(one, click.Group):
            yield from commands(one, (*words, name))
        else:
            yield " ".join((*words, name)), one


def test_every_figure_has_its_picture_in_the_gallery(shown: ModuleType) -> None:
    drawn = {name for group in shown.SHOWN.values() for one in group for name in one.draws.split()}
    assert figures() == drawn


def test_every_command_that_plots_is_in_the_gallery(
    shown: ModuleType, options: dict[str, set[str]]
) -> None:
    asked = [one.command for group in shown.SHOWN.values() for one in group]
    for words, known in options.items():
        if "--plot" in known:
            assert any(line.startswith(f"{words} ") for line in asked), words


def test_the_essentials_name_commands_and_options_that_there_are(
    options: dict[str, set[str]],
) -> None:
    page = (DOCS / "_static" / "essentials.html").read_text("utf-8")
    asked = [
        re.sub("<.*?>", "", line)
        for line in re.findall(r"<(?:b|code|br)>(evenbreak .*?)(?:</b>|</code>|<br>)", page)
    ]
    assert len(asked) > 30
    for line in asked:
        (words,) = (one for one in options if f"{line} ".startswith(f"evenbreak {one} "))
        assert set(re.findall(r"--[a-z-]+", line)) <= {*options[words], "--help", "--html"}, line


def test_the_gallery_shows_them_all(shown: ModuleType) -> None:
    page = (DOCS / "gallery.md").read_text("utf-8")
    for one in (one for group in shown.SHOWN.values() for one in group):
        name = re.split("/", one.name)[-1]
        assert f"(images/{name})" in page
        assert (DOCS / "images" / name).stat().st_size > 0
        assert (DOCS / one.page.partition("#")[0]).exists()
