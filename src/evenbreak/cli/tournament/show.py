"""`evenbreak tournament show`: the bracket as it stands."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.terminal import write_file
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import answer_of, at_option, file_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening

KINDS = (".svg", ".png", ".pdf", ".html")


@click.command("show")
@click.option(
    "--out",
    metavar="FILE",
    help="Also draw the bracket to FILE: .html for phones and screens, .pdf for paper, .svg or "
    ".png as a picture.",
)
@file_option
@at_option
@faces()
def command(*, out: str | None, file: str, at: str) -> Answer:
    """Show the bracket: each match with its players, its score and its table.

    Of a chip tournament it shows the tables, the line and everybody's chips.
    """
    from evenbreak.answers.tournament.night import bracket_table
    from evenbreak.files.store.tournament import read_tournament

    state = read_tournament(file)
    chips = state.plan.form == "chips"
    if out is not None:
        if chips:
            refuse("--out draws a bracket, and a chip tournament has none")
        if PurePath(out).suffix.lower() not in KINDS:
            refuse(f"--out {out!r}; name a file that ends in {', '.join(KINDS)}")
        write_file(out, drawing_of(state, PurePath(file).stem, PurePath(out).suffix.lower()))
    answer = answer_of(file, state, at)
    if not state.drawn or chips:
        return answer
    table = bracket_table(state)
    return replace(answer, parts=[answer.parts[0], table, *answer.parts[1:]], csv=table)


def drawing_of(state: Evening, name: str, kind: str) -> bytes:
    """Return the bracket of a tournament, drawn as .svg, .png, .pdf or .html."""
    from evenbreak.answers.tournament.bracket_view import bracket_panels
    from evenbreak.answers.tournament.tournament import races_words

    panels = bracket_panels(state)
    heading = [name, f"{state.bracket.format}. {races_words(state.races)}"]
    if kind == ".html":
        from evenbreak.sheets.bracket_page import bracket_html

        return bracket_html(panels, heading)
    from evenbreak.sheets.bracket_drawing import bracket_figure, bracket_pdf

    if kind == ".pdf":
        return bracket_pdf(panels, heading, name)
    from evenbreak.plots.picture import image_bytes

    return image_bytes(bracket_figure(panels, heading), "svg" if kind == ".svg" else "png")
