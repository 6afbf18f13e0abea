"""`evenbreak reproduce`: every table, figure and number of the source text."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.terminal import say
from evenbreak.questions.start import Reproduce


@command_of(Reproduce, "reproduce", page=False, always_text=True)
def command(asked: Reproduce) -> Answer:
    """Write the source text anew."""
    from collections import Counter

    from evenbreak.answers.written import reproduction_answer
    from evenbreak.files.store.folder import check_folder, write_files
    from evenbreak.source_text.published import differing
    from evenbreak.source_text.reproduce import all_findings, reproduction

    check_folder(asked.out)
    files = reproduction(say)
    write_files(asked.out, files)
    found = all_findings()
    if problems := list(differing(found)):
        raise click.ClickException("\n".join(["the files are written, but", *problems]))
    return reproduction_answer(asked.out, Counter(finding.verdict for finding in found), files)
