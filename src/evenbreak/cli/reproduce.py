"""`evenbreak reproduce`: every table, figure and number of the source text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import click

from evenbreak.cli.kit.callbacks import refuse
from evenbreak.cli.kit.output import say

EXAMPLES = """\b
Examples:
  evenbreak reproduce --out text
"""


@click.command("reproduce", epilog=EXAMPLES)
@click.option(
    "--out",
    required=True,
    metavar="DIR",
    type=click.Path(file_okay=False),
    help="Where the files go; made if it is not there.",
)
@click.pass_context
def command(ctx: click.Context, out: str) -> None:
    """Write every table, figure and number of the source text, computed anew.

    Begin with DIR/index.md for section 5, statistics, or DIR/physics.md for sections 1 to
    4, the table: they show and explain it all, name the slips of the text and link to the
    CSV files. Printed numbers stand beside computed ones. The files are the same to the byte
    each time; if a number differs from what is expected of it, the command says so and ends
    with 1.
    """
    if not out.strip():
        refuse("--out is empty; name a folder, or . for this one")
    from evenbreak.files.folder import check_folder, write_files
    from evenbreak.source_text.physics.numbers import physics_findings
    from evenbreak.source_text.reproduce import differing, reproduction
    from evenbreak.source_text.section5.numbers import findings

    check_folder(out)
    files = reproduction(say)
    write_files(out, files)
    say(f"Wrote {_kinds(files)} to {out}")
    if problems := list(differing([*physics_findings(), *findings()])):
        for problem in problems:
            say(f"Differs: {problem}")
        ctx.exit(1)


def _kinds(names: Iterable[str]) -> str:
    """Return what was written, in short.

    >>> _kinds(["index.md", "physics.md", "a.csv", "b.csv", "a.png", "a.svg"])
    'index.md, physics.md, 2 tables (CSV) and 1 figure (PNG and SVG)'
    """
    names = list(names)
    count = Counter(name.rsplit(".", 1)[1] for name in names)
    pages = ", ".join(name for name in names if name.endswith(".md"))
    figures = "1 figure" if count["png"] == 1 else f"{count['png']} figures"
    return f"{pages}, {count['csv']} tables (CSV) and {figures} (PNG and SVG)"
