"""The option --html of `evenbreak matchups`, and writing the page."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import refuse
from evenbreak.cli.kit.output import say

if TYPE_CHECKING:
    from evenbreak.answers.roster_matchups import RosterMatchups
    from evenbreak.cli.league.matchups_words import Told
    from evenbreak.files.roster import RosterFile


def _page(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    if value is not None and PurePath(value).suffix.lower() not in (".html", ".htm"):
        raise click.BadParameter(f"{value!r}; name a file that ends in .html", ctx=ctx, param=param)
    return value


html_option = click.option(
    "--html", metavar="FILE", callback=_page, help="Write a page to print or to send to FILE."
)
"""The option --html: where the page goes."""


def refuse_page(players: int, matches: int | None) -> None:
    """Refuse a page of more than it holds; `matches` is None where all pairs are asked for."""
    from evenbreak.sheets.html_round import MOST_ACROSS, MOST_MATCHES

    if matches is None and players > MOST_ACROSS:
        refuse(
            f"{players:,} players are too many for --html, which holds all pairs of {MOST_ACROSS} "
            "at most; name those who meet with --pairs PAIRS.csv"
        )
    if matches is not None and matches > MOST_MATCHES:
        refuse(
            f"{matches:,} matches are too many for --html, which holds {MOST_MATCHES} at most; "
            "make a list and a page for each part of the round"
        )


def write_page(
    path: str,
    file: RosterFile,
    told: Told,
    answer: RosterMatchups,
    ends: list[dict[str, Any]],
    *,
    listed: bool,
) -> None:
    """Write the page of the round to a file, and say so on stderr."""
    from evenbreak.files.folder import write_files
    from evenbreak.sheets.html_round import Round, round_html

    made_of = Round(
        file=file,
        roster=told.roster,
        scale=told.scale,
        chart=told.chart,
        limits=told.limits,
        minutes_per_game=told.minutes,
        listed=listed,
        evening=[line.replace("\n", " ") for line in told.evening_lines(ends)],
    )
    place = PurePath(path)
    write_files(str(place.parent), {place.name: round_html(made_of, answer)})
    say(f"Wrote {path}")
