"""`evenbreak reproduce`: every table, figure and number of the source text."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import out_option
from evenbreak.cli.kit.terminal import say

EXAMPLES = """\b
Examples:
  evenbreak reproduce --out text
"""


@click.command("reproduce", epilog=EXAMPLES)
@out_option("Where the files go; created if it does not exist.")
@faces(page=False, always_text=True)
def command(out: str) -> Answer:
    """Write every table, figure and number of the source text, computed anew.

    Start with DIR/index.md for section 5, statistics, DIR/physics.md for sections 1 to 4, the
    physics of the table, or DIR/graph_to_limit.md for each game as graph, matrix, eigenvalues and
    limit. They show and explain every number, point out the errors of the
    text and link to the CSV files. The files are the same to the byte each time. If a number
    is not the one expected, the command says so and ends with exit code 1.
    """
    from collections import Counter

    from evenbreak.answers.written import reproduction_answer
    from evenbreak.files.store.folder import check_folder, write_files
    from evenbreak.source_text.published import differing
    from evenbreak.source_text.reproduce import all_findings, reproduction

    check_folder(out)
    files = reproduction(say)
    write_files(out, files)
    found = all_findings()
    if problems := list(differing(found)):
        raise click.ClickException("\n".join(["the files are written, but", *problems]))
    return reproduction_answer(out, Counter(finding.verdict for finding in found), files)
