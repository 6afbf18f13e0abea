"""The commands that show, print or list what the tournament under way has."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.kit.terminal import write_file
from evenbreak.cli.tournament.evening import answer_of, moment, outlook_of
from evenbreak.cli.tournament.odds import paid_places
from evenbreak.questions.evening import Export, Next, Print, Programs, Show
from evenbreak.words import FilePath, say, say_count

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening

KINDS = (".svg", ".png", ".pdf", ".html")


@command_of(Show, "show")
def show(asked: Show) -> Answer:
    """Show the bracket."""
    from evenbreak.answers.tournament.night import bracket_table
    from evenbreak.files.store.tournament import read_tournament

    state, out = read_tournament(asked.path, asked.event), asked.out
    chips = state.plan.form == "chips"
    if out is not None:
        kind = PurePath(out).suffix.lower()
        if chips:
            asked.refuse("{out} draws a bracket, and a chip tournament has none")
        if kind not in KINDS:
            asked.refuse(
                "{out} must be a file name that ends in {kinds}; you gave {name!r}",
                name=out,
                kinds=", ".join(KINDS),
            )
        write_file(out, _drawing(state, asked, kind))
    answer = answer_of(asked, state)
    if not state.drawn or chips:
        return answer
    table = bracket_table(state)
    return replace(answer, parts=[answer.parts[0], table, *answer.parts[1:]], csv=table)


@command_of(Next, "next")
def next_matches(asked: Next) -> Answer:
    """Show who plays next, and on which table."""
    from evenbreak.answers.tournament.night import night_answer
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.tournaments.evening.outlook import Outlook

    state = read_tournament(asked.path, asked.event)
    if asked.prizes is not None and state.plan.form == "chips":
        asked.refuse("{prizes} is for matches; in a chip tournament no single rack decides them")
    return night_answer(
        Outlook(state, moment(asked.at, asked.path)),
        decides=True,
        prizes=paid_places(asked.prizes, len(state.entrants)),
        source=PurePath(asked.path).name,
    )


@command_of(Export, "export")
def export(asked: Export) -> Answer:
    """List the matches that were played, or all that happened."""
    from evenbreak.answers.faces.to_csv import to_csv
    from evenbreak.answers.tournament.printed import (
        tournament_events_answer,
        tournament_matches_answer,
    )
    from evenbreak.files.store.tournament import read_events, read_tournament

    name = PurePath(asked.path).stem
    if asked.story:
        return _story(asked)
    if asked.out is not None and PurePath(asked.out).suffix.lower() in (".html", ".htm"):
        return _night_page(asked)
    if asked.events:
        answer = tournament_events_answer(read_events(asked.path, asked.event), name)
    else:
        answer = tournament_matches_answer(read_tournament(asked.path, asked.event), name)
    if asked.out is not None:
        write_file(asked.out, "".join(to_csv(answer)).encode())
    return answer


def _night_page(asked: Export) -> Answer:
    """Write the night as one page that can be sent on."""
    from evenbreak.answers.tournament.night import night_answer
    from evenbreak.files.store.prizes import kept_prizes
    from evenbreak.sheets.night_page import night_html
    from evenbreak.tournaments.evening.story import story_of
    from evenbreak.tournaments.money.payouts import with_prizes

    outlook = outlook_of(asked.path, moment(None, asked.path))
    state, money = outlook.state, kept_prizes(asked.path)
    answer = night_answer(outlook)
    rows = answer.to_dict().get("places", [])
    prizes = money.amounts(len(state.entrants), state.payers) if money else []
    unit = money.unit if money else 0.0
    places = with_prizes([(row["place"], row["name"]) for row in rows], prizes, unit)
    assert asked.out is not None  # noqa: S101 - it is what is asked for
    name = PurePath(asked.path).stem
    write_file(asked.out, night_html(state, places, story_of(state), name))
    return replace(answer, parts=[say("The night is in {file}.", file=FilePath(asked.out))])


def _story(asked: Export) -> Answer:
    """Return the story of the night, and write it as a table or a picture."""
    from evenbreak.answers.faces.to_csv import to_csv
    from evenbreak.answers.tournament.story import story_answer
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.tournaments.evening.story import story_of

    state = read_tournament(asked.path, asked.event)
    _ = state.bracket  # which refuses a tournament without a draw
    story = story_of(state)
    answer = story_answer(state, story)
    if asked.out is not None and PurePath(asked.out).suffix.lower() == ".svg":
        from evenbreak.sheets.story_drawing import story_svg

        write_file(asked.out, story_svg(story).encode())
    elif asked.out is not None:
        write_file(asked.out, "".join(to_csv(answer)).encode())
    return answer


@command_of(Programs, "token", always_text=True)
def token(asked: Programs) -> Answer:
    """Create a token, revoke one, or list them."""
    from evenbreak.answers.tournament.programs import programs_answer, scope_in
    from evenbreak.files.store.tokens import create_token, kept_tokens, revoke_token
    from evenbreak.files.store.tournament import read_tournament

    plan, created = read_tournament(asked.path, asked.event).plan, ""
    if asked.name is not None and asked.revoke:
        revoke_token(asked.path, asked.name)
    elif asked.name is not None:
        at = moment(asked.at, asked.path)
        created = create_token(asked.path, asked.name, scope_in(asked.may, plan), at)
    return programs_answer([*kept_tokens(asked.path, used=True).values()], plan, created)


@command_of(Print, "print", always_text=True)
def print_paper(asked: Print) -> Answer:
    """Write score cards, the bracket or the draw as a PDF."""
    from evenbreak.answers.tournament.printed import printed_answer, score_cards
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.sheets.paper_pages import score_cards_pdf
    from evenbreak.sheets.pdf_page import usual_paper

    state = read_tournament(asked.path, asked.event)
    if state.plan.form == "chips":
        refuse("a chip tournament has neither score cards nor a bracket to print")
    place = asked.out or f"{asked.what}.pdf"
    if PurePath(place).suffix.lower() != ".pdf":
        asked.refuse("{out} must be a file name that ends in .pdf; you gave {name!r}", name=place)
    if asked.what == "draw":
        write_file(place, _draw_list(state, asked))
        return printed_answer(
            state, "The draw", say("The draw list is in {file}.", file=FilePath(place))
        )
    if asked.what == "bracket":
        write_file(place, _drawing(state, asked, ".pdf"))
        written = say("The bracket is in {file}.", file=FilePath(place))
        return printed_answer(state, "The bracket", written)
    cards = score_cards(state, asked.match)
    if not cards:
        refuse("no match is waiting to be played, so there's no card to print")
    paper = asked.paper or usual_paper()
    write_file(
        place, score_cards_pdf(cards, _title(state, asked), per_page=asked.per_page, paper=paper)
    )
    written = say_count(
        "{n} score card is in {file}.",
        "{n} score cards are in {file}.",
        len(cards),
        file=FilePath(place),
    )
    return printed_answer(state, "Score cards", written)


def _title(state: Evening, asked: Show | Print) -> str:
    stem = PurePath(asked.path).stem
    return asked.title or state.plan.name or stem[:1].upper() + stem[1:]


def _drawing(state: Evening, asked: Show | Print, kind: str) -> bytes:
    """Return the bracket of a tournament, drawn as .svg, .png, .pdf or .html."""
    from evenbreak.answers.tournament.bracket_view import bracket_panels
    from evenbreak.answers.tournament.printed import paper_words

    panels = bracket_panels(state)
    about, foot, champion = paper_words(state)
    if kind == ".html":
        from evenbreak.sheets.bracket_page import bracket_html

        return bracket_html(panels, [_title(state, asked), about])
    if kind == ".svg":
        from evenbreak.sheets.bracket_page import bracket_picture

        return bracket_picture(panels, _title(state, asked), about)
    from evenbreak.sheets.bracket_paper import Sheet, bracket_figure, bracket_pdf
    from evenbreak.sheets.pdf_page import usual_paper

    sheet = Sheet(_title(state, asked), about, foot if kind == ".pdf" else "", champion)
    if kind == ".pdf":
        return bracket_pdf(panels, sheet, paper=asked.paper or usual_paper())
    from evenbreak.plots.picture import image_bytes

    return image_bytes(bracket_figure(panels, sheet), "png")


def _draw_list(state: Evening, asked: Print) -> bytes:
    from evenbreak.answers.tournament.printed import first_matches
    from evenbreak.answers.tournament.tournament import races_words
    from evenbreak.sheets.paper_pages import FirstMatch, draw_list_pdf
    from evenbreak.sheets.pdf_page import usual_paper

    players = []
    for one in first_matches(state):
        other = next((player for player in one.pair if player != one.name), "")
        table = "" if one.table is None else state.plan.table_name(one.table)
        players.append(FirstMatch(one.name, one.seed, one.match or 0, other, table))
    form = state.bracket.format
    about = f"{form[0].upper()}{form[1:]}. {races_words(state.races)}"
    return draw_list_pdf(players, _title(state, asked), about, paper=asked.paper or usual_paper())
