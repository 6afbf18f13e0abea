"""Tables that the build of the pages writes into the reference can be made, and lead somewhere."""

import re
from collections import Counter
from itertools import product
from pathlib import Path

import addresses
import answer_tables
import column_tables
import league_keys
import option_tables

from git_host import broken_links, seen_in
from places import ROOT
from rows import each_of

REFERENCE = ROOT / "docs" / "reference"
OTHERS = ("league-file.md", "interface.md", "files.md")
COMMANDS = sorted((REFERENCE / "commands").glob("*.md"))


@each_of("page", [*COMMANDS, *map(REFERENCE.joinpath, OTHERS)])
def test_links_in_tables_that_the_build_writes_lead_somewhere(page: Path) -> None:
    built = text = page.read_text("utf-8")
    for made in (option_tables, answer_tables, league_keys, addresses):
        built = made.with_tables(built)
    built = column_tables.with_tables(built, full=True)
    assert len(built) > len(text) or "<!--" not in text
    assert not re.search("<!-- (?!columns|end of columns)", built)
    assert broken_links(page, seen_in(built), ROOT) == []


def test_every_answer_has_a_table_and_every_meaning_a_key() -> None:
    marks = [m for page in COMMANDS for m in answer_tables.MARK.findall(page.read_text("utf-8"))]
    schemas = answer_tables.SCHEMAS["$defs"]
    assert sorted(marks) == sorted(schemas)
    for command, meanings in answer_tables.MEANINGS.items():
        of_command, _, named = command.partition(":")
        table = answer_tables.table_at(of_command)
        if named:  # what the values of one key mean
            assert f"`{named}`" in table.partition("Values of")[0]
        else:
            assert [key for key, of in meanings.items() if f"| `{key}` | {of} |" not in table] == []


def test_no_option_of_a_command_is_in_two_tables() -> None:
    tables: Counter[tuple[str, str]] = Counter()
    for page in COMMANDS:
        for mark in option_tables.MARK.findall(page.read_text("utf-8")):
            options = re.findall(r"^\| `(--[a-z0-9-]+)", option_tables.table_at(mark), re.MULTILINE)
            tables.update(product(option_tables.commands_of(mark), dict.fromkeys(options)))
    assert len(tables) > 300
    assert [both for both, count in tables.items() if count > 1] == []
