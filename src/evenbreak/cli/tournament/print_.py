"""`evenbreak tournament print`: score cards, the bracket and the draw on paper."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.terminal import write_file
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import file_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening

EXAMPLES = """\b
Examples:
  evenbreak tournament print cards
  evenbreak tournament print cards --match W1.2 --per-page 1 --out final.pdf
  evenbreak tournament print bracket --out wall.pdf
  evenbreak tournament print draw
"""


@click.command("print", epilog=EXAMPLES)
@click.argument("what", type=click.Choice(["cards", "bracket", "draw"]))
@click.option("--match", metavar="MATCH", help="The card of this match alone.")
@click.option(
    "--per-page",
    type=click.Choice(["1", "4"]),
    default="4",
    help="How many cards are on a page.",
)
@click.option(
    "--out", metavar="FILE.pdf", help="The file.  [default: cards.pdf, bracket.pdf or draw.pdf]"
)
@file_option
@faces(always_text=True)
def command(*, what: str, match: str | None, per_page: str, out: str | None, file: str) -> Answer:
    """Write score cards, the bracket or the draw as a PDF to print.

    Cards are made for all matches whose players are known and that are not over: one each, with
    boxes to tick, where winner and loser go next, and room to sign. The bracket is on A4 if it can
    be read there, else on larger paper. The draw lists everybody by name, with their first match.
    """
    from evenbreak.answers.kit.wording import count_of
    from evenbreak.answers.tournament.printed import printed_answer, score_cards
    from evenbreak.files.store.tournament import read_tournament

    state, name = read_tournament(file), PurePath(file).stem
    if state.plan.form == "chips":
        refuse("a chip tournament has neither score cards nor a bracket to print")
    place = out or f"{what}.pdf"
    if PurePath(place).suffix.lower() != ".pdf":
        refuse(f"--out {place!r}; name a file that ends in .pdf")
    if what != "cards" and match is not None:
        refuse("--match is for cards")
    if what == "draw":
        write_file(place, _draw_list(state, name))
        return printed_answer(state, "The list of the draw", place)
    if what == "bracket":
        from evenbreak.cli.tournament.show import drawing_of

        write_file(place, drawing_of(state, name, ".pdf"))
        return printed_answer(state, "The bracket", place)
    from evenbreak.sheets.paper_pages import score_cards_pdf

    cards = score_cards(state, match)
    if not cards:
        refuse("no match is waiting to be played, so there is no card to print")
    write_file(place, score_cards_pdf(cards, name, per_page=int(per_page)))
    return printed_answer(state, count_of(len(cards), "score card"), place)


def _draw_list(state: Evening, name: str) -> bytes:
    from evenbreak.answers.tournament.printed import first_matches
    from evenbreak.answers.tournament.tournament import races_words
    from evenbreak.sheets.paper_pages import FirstMatch, draw_list_pdf

    players = []
    for one in first_matches(state):
        other = next((player for player in one.pair if player != one.name), "")
        players.append(FirstMatch(one.name, one.seed, one.match or "", other, one.table))
    form = state.bracket.format
    about = f"{form[0].upper()}{form[1:]}. {races_words(state.races)}"
    return draw_list_pdf(players, name, about)
