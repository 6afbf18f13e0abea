"""The tables of options in the reference, made from the questions that the commands ask.

The build of the pages puts them where a mark stands: `<!-- options: fair -->`.
`<!-- options: NAME, not OTHER -->` has those that the other command does not have,
`<!-- options: NAME, as OTHER -->` those it has too, and
`<!-- options: GROUP NAME + OTHER + ... -->` those of several commands of a group.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import click

from evenbreak.cli.kit.asked import spelled
from evenbreak.cli.kit.said import said
from evenbreak.cli.program import program
from evenbreak.fields.question import Declared, declared, worded

MARK = re.compile(r"^<!-- options: ([^>]+) -->$", re.MULTILINE)


def question_of(name: str) -> type:
    """Return the question that a command asks, by the words of the command."""
    command: Any = program
    for word in name.split():
        command = command.get_command(click.Context(command), word)
    question: type = command.question
    return question


def commands_asking(group: Any = program) -> Iterator[type]:
    """Yield the questions of all commands."""
    for name in group.list_commands(click.Context(group)):
        command: Any = group.get_command(click.Context(group), name)
        if isinstance(command, click.Group):
            yield from commands_asking(command)
        elif hasattr(command, "question"):
            yield command.question


def table_of(question: type, fields: Iterable[Declared] | None = None) -> str:
    """Return the table of the options of a question, or of some of them."""
    rows = list(declared(question) if fields is None else fields)
    sections = ["", *(one.field.section for one in rows)]
    rows.sort(key=lambda one: sections.index(one.field.section))
    lines = [_row(question, one) for one in rows if not one.field.argument]
    return "\n".join(["| option | meaning |", "|---|---|", *lines, ""])


def joint_table(group: str, names: Sequence[str]) -> str:
    """Return the table of the options of several commands, with the commands that have each."""
    having: dict[str, list[str]] = {}
    for name in names:
        question = question_of(f"{group} {name}")
        for one in declared(question):
            if not one.field.argument:
                having.setdefault(_row(question, one), []).append(name)
    lines = ["| option | commands | meaning |", "|---|---|---|"]
    for row, commands in having.items():
        typed, _, meaning = row.partition("` | ")
        others = [name for name in names if name not in commands]
        listed = ", ".join(f"`{name}`" for name in min(commands, others, key=len))
        if len(others) < len(commands):
            listed = f"all but {listed}" if others else "all"
        lines.append(f"{typed}` | {listed} | {meaning}")
    return "\n".join([*lines, ""])


def _row(question: type, one: Declared) -> str:
    typed = f"{one.option} {one.metavar}".strip().replace("|", "\\|")
    short = f", `{one.short}`" if one.short else ""
    notes = [f"{'from ' * bool(one.kind.limits)}{one.kind.limits}"] if one.kind.limits else []
    if one.field.formats:
        notes.append("formats: " + ", ".join(one.field.formats))
    if one.required:
        notes.append("required")
    elif one.usual:
        notes.append(f"default: {one.usual}")
    if one.field.many and not one.field.argument:
        notes.append("can be repeated")
    note = f" ({'; '.join(notes)})" if notes else ""
    text = one.field.help.removesuffix(".") + note
    text += "" if text.endswith("?") else "."
    meaning = said(worded(text), _spell(question))
    meaning += f" {one.field.more}" if one.field.more else ""
    return f"| `{typed}`{short} | {meaning.replace('|', chr(92) + '|')} |"


def _spell(question: type):
    return lambda name: f"`{spelled(question, name)}`"


def commands_of(mark: str) -> list[str]:
    """Return the commands whose options a mark asks for."""
    first, *others = re.split(r", (?:as|not) ", mark)[0].split(" + ")
    group = first.rpartition(" ")[0]
    return [first, *(f"{group} {name}" for name in others)]


def table_at(mark: str) -> str:
    """Return the table that a mark asks for."""
    name, *others = commands_of(mark)
    if others:
        group = name.rpartition(" ")[0]
        return joint_table(group, [one.removeprefix(f"{group} ") for one in (name, *others)])
    question = question_of(name)
    rows = list(declared(question))
    which = re.split(r", (as|not) ", mark)[1:]
    for how, other in zip(which[::2], which[1::2], strict=True):
        names = {one.name for one in declared(question_of(other))}
        rows = [one for one in rows if (one.name in names) == (how == "as")]
    return table_of(question, rows)


def with_tables(text: str) -> str:
    """Return a page with its tables."""
    return MARK.sub(lambda found: table_at(found[1]), text)
