"""Groups of commands, each of which is imported only when it runs."""

from __future__ import annotations

import importlib
import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import click

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem


class Entry(NamedTuple):
    """Where a command is, and its line and section in the help text.

    The module is that of `evenbreak.cli` whose `command` it is, with a colon before another name
    (`start:demo`); '' where an answer is all there is to it (`evenbreak.answers.asked`).
    """

    help: str
    module: str = ""
    section: str = "Commands"


class LazyGroup(click.Group):
    """A click group that lists its commands, in the order of the table, without importing them."""

    def __init__(self, *args: Any, table: Mapping[str, Entry], **options: Any) -> None:
        super().__init__(*args, **options)
        self._table = table

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of the commands, in the order of the help text."""
        return list(self._table)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import and return the command of this name, or None if there is none."""
        if cmd_name not in self._table:
            return None
        place, _, name = self._table[cmd_name].module.partition(":")
        if place:
            module = importlib.import_module(f"evenbreak.cli.{place}")
            command: click.Command = getattr(module, name or "command")
        else:
            from evenbreak.cli.kit.asked import answered

            of_program = self.name in (None, "evenbreak")
            command = answered(cmd_name if of_program else f"{self.name} {cmd_name}")
        if ctx.resilient_parsing:  # a shell asks what may come next
            from evenbreak.cli.kit.completion import complete_files

            complete_files(command)
        from evenbreak.cli.kit.said import runs

        runs(command)
        return command

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Return the commands that begin like this, without importing any."""
        from click.shell_completion import CompletionItem

        commands = [
            CompletionItem(name, help=entry.help)
            for name, entry in self._table.items()
            if name.startswith(incomplete)
        ]
        return [*commands, *click.Command.shell_complete(self, ctx, incomplete)]

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command that the first word names, or suggest the most similar one."""
        name = args[0]
        if name not in self._table and not name.startswith("-"):
            from difflib import get_close_matches

            near = get_close_matches(name, self._table, n=1)
            ctx.fail(f"No such command {name!r}." + (f" Did you mean {near[0]!r}?" if near else ""))
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands, section by section, without importing any."""
        widest = max(len(name) for name in self._table)
        for section, entries in itertools.groupby(
            self._table.items(), lambda item: item[1].section
        ):
            with formatter.section(section):
                formatter.write_dl([(name.ljust(widest), entry.help) for name, entry in entries])
