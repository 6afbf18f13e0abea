"""What README and docs say is so: examples run, commands, options and names are all described."""

import doctest
import importlib
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import click
import column_tables
import option_tables
import pytest

from cataloged import said_on_pages
from evenbreak.cli.program import COMMANDS, program
from places import ROOT, SRC
from terminal import on_a_terminal

DOCS = sorted(
    page
    for page in (ROOT / "docs").rglob("*.md")
    if not {"_build", "modules"} & {*page.relative_to(ROOT).parts}  # what a build makes
)
PAGES = [*(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")), *DOCS]
PACKAGES = (
    "evenbreak",
    *sorted(
        f"evenbreak.{init.parent.name}"
        for init in (ROOT / "src" / "evenbreak").glob("*/__init__.py")
    ),
)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
LONG_NUMBER = re.compile(r"\d*\.\d{12,}(e-?\d+)?")
GOLDEN = {
    " ".join(line.split()).removeprefix("$ "): answer
    for path in sorted((ROOT / "tests" / "golden").glob("*.txt"))
    for line, _, answer in [path.read_text(encoding="utf-8").partition("\n")]
}
"""The text of an answer, by its command."""

FENCE = re.compile(r"^```(?P<language>[^\n`]*)\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL)


class Block(NamedTuple):
    """A fenced block: its language, its text, and the line where its text begins."""

    language: str
    body: str
    line: int


def blocks(text: str) -> list[Block]:
    return [
        Block(
            found["language"].strip(), found["body"], text.count("\n", 0, found.start("body")) + 1
        )
        for found in FENCE.finditer(text)
    ]


def pages_with(language: str) -> list[Path]:
    return [
        page
        for page in PAGES
        if any(block.language == language for block in blocks(page.read_text(encoding="utf-8")))
        and page.parent.name != "notebooks"  # they run as the pages are built
    ]


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Stand in a directory of one's own, with the sample data, as a reader of the README does."""
    shutil.copytree(ROOT / "data", tmp_path / "data")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow_after(2)
@pytest.mark.usefixtures("desk")
@pytest.mark.parametrize("page", pages_with("python"), ids=name_of)
def test_python_examples(page: Path) -> None:
    names: dict[str, object] = {"__name__": "example"}
    for block in blocks(page.read_text(encoding="utf-8")):
        if block.language != "python":
            continue
        if not re.search("^>>> ", block.body, re.MULTILINE):
            exec(compile(block.body, f"{name_of(page)}:{block.line}", "exec"), names)  # noqa: S102
            continue
        parser = doctest.DocTestParser()
        test = parser.get_doctest(block.body, names, name_of(page), name_of(page), block.line)
        runner = doctest.DocTestRunner(optionflags=FLAGS)
        said: list[str] = []
        runner.run(test, out=said.append, clear_globs=False)
        names.update(test.globs)
        assert not said, "".join(said)


def commands_of(body: str) -> Iterator[tuple[str, str]]:
    """Yield each `$ command` with the output that is printed below it."""
    for part in re.split(r"^\$ ", body, flags=re.MULTILINE)[1:]:
        lines = part.split("\n")
        count = 1
        while lines[count - 1].endswith("\\"):
            count += 1
        yield "\n".join(lines[:count]), "\n".join(lines[count:])


def shortened(text: str) -> str:
    """Round numbers in full precision: their last digit may differ from machine to machine."""
    return LONG_NUMBER.sub(lambda number: f"{float(number[0]):.12g}", text.rstrip()) + "\n"


def words_of(command: str) -> str:
    """Return a command in one line, its words parted by one blank."""
    return " ".join(command.replace("\\\n", " ").split())


def console_examples(page: Path, *, kept: bool) -> Iterator[tuple[str, str, str]]:
    """Yield place, command and output of the examples whose answer is kept in `golden`, or not."""
    for block in blocks(page.read_text(encoding="utf-8")):
        for command, wanted in commands_of(block.body) if block.language == "console" else ():
            # An answer that is kept is without what goes to stderr.
            warns = re.search(r"^(Warning|Note): ", wanted, re.MULTILINE)
            if (words_of(command) in GOLDEN and not warns) is kept:
                yield f"{name_of(page)}:{block.line}", command, wanted


def differs(wanted: str, got: str) -> bool:
    return not doctest.OutputChecker().check_output(shortened(wanted), shortened(got), FLAGS)


def test_examples_whose_answers_are_kept_show_them() -> None:
    """`test_faces.py` asks these, so that they need not be asked here again."""
    examples = [one for page in PAGES for one in console_examples(page, kept=True)]
    assert len(examples) > 10
    wrong = [
        f"{place}: $ {command}\n{GOLDEN[words_of(command)]}"
        for place, command, wanted in examples
        if differs(wanted, GOLDEN[words_of(command)])
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.slow
@pytest.mark.usefixtures("desk")
@pytest.mark.parametrize("page", pages_with("console"), ids=name_of)
def test_console_examples(page: Path) -> None:
    for place, command, wanted in console_examples(page, kept=False):
        got = on_a_terminal(command)
        assert not differs(wanted, got), f"{place}: $ {command}\n{got}"


def test_readme_begins_with_the_two_commands_that_set_up() -> None:
    use, develop, *_ = blocks((ROOT / "README.md").read_text(encoding="utf-8"))
    for block in (use, develop):
        assert block.body.count("\n") == 1
        assert "-m venv" in block.body
    assert "evenbreak report data/demo_league.csv --out sheet" in use.body
    assert "[dev]" in develop.body
    assert "pytest" in develop.body


def test_every_page_is_in_a_table_of_contents() -> None:
    listed = set()
    for page in DOCS:
        if page.name in {"index.md", "api.md", "commands.md"}:
            # docs/conf.py makes a table of contents of the list of links.
            links = re.findall(
                r"^(?:- |\*\*)\[[^]]+\]\(([^)#]+\.md)\)", page.read_text("utf-8"), re.M
            )
            listed |= {(page.parent / link).resolve() for link in links}
    apart = {"index.md", "explanation/decisions/index.md"}  # the second is for contributors
    assert set(DOCS) - listed == {ROOT / "docs" / page for page in apart}


@pytest.mark.slow
@pytest.mark.parametrize(
    "page", ["tutorial/evening-by-page.md", "how-to/a-page-for-phones-and-the-screen.md"]
)
def test_what_a_reader_is_to_tap_is_on_the_page(page: str) -> None:
    # Of a label that ends with a name, such as "Undo: {what}", the part before it.
    labels = {re.sub(r"(?<=:) \{\w+\}$", "", label) for label in said_on_pages()}
    text = (ROOT / "docs" / page).read_text("utf-8")
    assert set(re.findall(r"(?<!\*)\*([^*\n]+)\*(?!\*)", text)) <= labels | {"Deutsch"}


def commands_page(group: str = "") -> str:
    """Return the page of a group of commands, or that of all."""
    page = f"commands/{group}" if group else "commands"
    return (ROOT / "docs" / "reference" / f"{page}.md").read_text(encoding="utf-8")


def page_of_each_command() -> dict[str, tuple[str, str]]:
    """Return the group whose page describes a command, and its section there, in their order."""
    groups = re.findall(r"^\*\*\[.*\]\(commands/(\w+)\.md\)", commands_page(), flags=re.MULTILINE)
    described = {}
    for group in groups:
        parts = re.split(r"^## evenbreak (\w+)$", commands_page(group), flags=re.MULTILINE)
        described |= {
            name: (group, text) for name, text in zip(parts[1::2], parts[2::2], strict=True)
        }
    return described


def described(text: str) -> set[str]:
    """Return the options in the tables of a text."""
    return set(re.findall(r"^\| `(--[a-z0-9-]+)", text, flags=re.MULTILINE))


def command(name: str) -> click.Command:
    found = program.get_command(click.Context(program), name)
    assert found is not None
    return found


def params_of(one: click.Command) -> list[click.Parameter]:
    """Return the options and arguments of a command, and those of the commands within it."""
    if not isinstance(one, click.Group):
        return one.params
    ctx = click.Context(one)
    inner = [one.get_command(ctx, name) for name in one.list_commands(ctx)]
    return one.params + [param for each in inner if each is not None for param in params_of(each)]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_is_described_and_no_other(name: str) -> None:
    options = {
        text
        for option in params_of(command(name))
        for text in (*option.opts, *option.secondary_opts)
        if text.startswith("--")
    }
    common = described(commands_page())
    forms = {"--text", "--csv", "--json", "--html", "--verbose"}
    assert common == {*forms, "--league", "--help-all"}
    section = option_tables.with_tables(page_of_each_command()[name][1])
    assert options - {"--help"} - common <= described(section) <= options


def test_the_tables_of_columns_are_those_of_the_schemas() -> None:
    text = column_tables.PAGE.read_text(encoding="utf-8")
    assert column_tables.with_tables(text) == text, "run make column-tables"
    assert set(column_tables.SCHEMAS) == {mark[2] for mark in column_tables.TABLE.finditer(text)}


def test_every_command_is_described_and_no_other() -> None:
    assert list(page_of_each_command()) == list(COMMANDS)


def test_commands_are_listed_as_the_help_groups_them() -> None:
    title, page, listed = "", "", []
    for heading, file, name, link, line in re.findall(
        r"^\*\*\[(.+)\]\(commands/(\w+)\.md\)\*\*$|^\| \[`(\w+)`\]\((.+)\) \| (.+) \|$",
        commands_page(),
        flags=re.MULTILINE,
    ):
        if heading:
            title, page = heading, file
            assert commands_page(page).startswith(f"# {title}\n")
        else:
            listed.append((title, name, line))
            assert link == f"commands/{page}.md#evenbreak-{name}"
            assert page_of_each_command()[name][0] == page
    assert listed == [(one.section, name, one.help) for name, one in COMMANDS.items()]


def test_every_room_with_public_names_is_in_the_reference() -> None:
    pages = sorted((ROOT / "docs" / "reference" / "api").glob("*.md"))
    reference = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    rooms = {stub.parent.name for stub in SRC.rglob("*/__init__.pyi")}
    assert set(re.findall(r"^```\{room\} (\w+)$", reference, flags=re.MULTILINE)) == rooms
    modules = re.findall(r"^from \.(\w+)", (SRC / "__init__.pyi").read_text(encoding="utf-8"), re.M)
    documented = re.findall(r"^\.\. automodule:: evenbreak\.(\w+)$", reference, flags=re.MULTILINE)
    assert set(modules) <= rooms | set(documented)


def test_every_public_name_can_be_had() -> None:
    for package in PACKAGES:
        module = importlib.import_module(package)
        for name in getattr(module, "__all__", ()):
            assert getattr(module, name) is not None, f"{package}.{name}"
