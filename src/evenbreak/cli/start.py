"""The commands `demo`, `serve` and `reproduce`."""

from importlib import import_module

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.league import league_in
from evenbreak.cli.kit.terminal import say
from evenbreak.questions.start import Demo, Reproduce, Serve


@command_of(Demo, "demo", always_text=True)
def demo(asked: Demo) -> Answer:
    """Write made-up files."""
    from evenbreak.answers.written import demo_answer
    from evenbreak.files.demo import DEMO, write_demo

    return demo_answer(asked.folder, DEMO, write_demo(asked.folder))


@command_of(Reproduce, "reproduce", page=False, always_text=True)
def reproduce(asked: Reproduce) -> Answer:
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


@command_of(Serve, "serve", answers=False)
def serve(asked: Serve) -> None:
    """Open tonight's tournament or team night as a page."""
    # By its name, because the terminal and the page know nothing of each other.
    import_module("evenbreak.web.command").serve(asked, league_in(click.get_current_context()))
