"""Who plays: two ratings, one game probability, or one for each breaker with a break format."""

from __future__ import annotations

import math

import click

from evenbreak.answers.two_players import FORMATS, TwoPlayers
from evenbreak.cli.kit.options import Command, scale_option
from evenbreak.cli.kit.values import CHANCE, refuse
from evenbreak.games.rack import Rack
from evenbreak.ratings.scale import Scale, scale_of

REMEDY = "give two ratings A B, or --p, or --p1 and --p2 with --breaks"


def players_of(
    ratings: tuple[str, ...],
    scale: Scale | None,
    p: float | None,
    p1: float | None,
    p2: float | None,
    breaks: str | None,
    first_break: str | None,
) -> TwoPlayers:
    """Return the players that the options describe, or refuse options that contradict."""
    by_break = p1 is not None or p2 is not None
    ways = bool(ratings) + (p is not None) + by_break
    if ways != 1:
        refuse(("the players are given twice; " if ways else "the players are missing; ") + REMEDY)
    if scale is not None and not ratings:
        refuse("--scale says what ratings mean, but none are given; leave it out")
    if by_break:
        if p1 is None or p2 is None or breaks is None:
            refuse("--p1, --p2 and --breaks go together; give all three")
        first = first_break or ("b" if breaks == "b" else "a")
        return TwoPlayers(Rack(p1, p2), breaks, 1 if first == "a" else 2)
    if breaks is not None or first_break is not None:
        refuse("the break matters only with --p1 and --p2; leave --breaks and --first-break out")
    if p is not None:
        return TwoPlayers(Rack(p))
    if len(ratings) != 2:
        given = "only one rating is" if len(ratings) == 1 else f"{len(ratings)} ratings are"
        refuse(f"{given} given, {' '.join(ratings)}; {REMEDY}")
    a, b = (float(rating) for rating in ratings)
    if not math.isfinite(a - b):
        refuse("the ratings are too far apart to calculate with; give smaller numbers")
    return TwoPlayers.rated(a, b, scale or scale_of("npl"))


def player_options(command: Command) -> Command:
    """Add the arguments and options that describe the players."""
    for add in (
        click.option(
            "--first-break",
            type=click.Choice(["a", "b"]),
            help="Who breaks the next game.  [default: a; b with --breaks b]",
        ),
        click.option("--breaks", type=click.Choice(list(FORMATS)), help="Who breaks."),
        click.option(
            "--p2", metavar="P", type=CHANCE, help="Chance that B wins a game that B breaks."
        ),
        click.option(
            "--p1", metavar="P", type=CHANCE, help="Chance that A wins a game that A breaks."
        ),
        click.option("--p", metavar="P", type=CHANCE, help="Chance that A wins a game."),
        scale_option(fixed=False),
        click.argument("ratings", nargs=-1, metavar="[A B]"),
    ):
        command = add(command)
    return command
