"""Who plays: ratings, a game probability, or one for each breaker with a break format."""

from __future__ import annotations

import math
from typing import NamedTuple

import click

from evenbreak.cli.kit.callbacks import Command, chance, refuse
from evenbreak.games.breaks import BREAK_FORMATS, BreakFormat
from evenbreak.games.rack import Rack
from evenbreak.ratings.scale import Scale, scale_of

FORMATS = {
    "winner": BREAK_FORMATS["winner"],
    "loser": BREAK_FORMATS["loser"],
    "alternate": BREAK_FORMATS["alternate"],
    "a": BREAK_FORMATS["player 1"],
    "b": BREAK_FORMATS["player 2"],
}
USUAL = {"npl": (20, 130), "fargo": (200, 850)}
"""From where to where most ratings of a scale lie."""

MEND = "give two ratings A B, or --p, or --p1 and --p2 with --breaks"


class Players(NamedTuple):
    """Two players as the command line knows them; A is player 1."""

    rack: Rack
    breaks: BreakFormat | None
    first_breaker: int
    scale: Scale | None
    description: str

    @property
    def p_game_a(self) -> float | None:
        """P(A wins a game), or None where that depends on who breaks."""
        return None if self.rack.break_matters else float(self.rack.p1)

    @classmethod
    def of(
        cls,
        ratings: tuple[str, ...],
        scale: str | None,
        p: float | None,
        p1: float | None,
        p2: float | None,
        breaks: str | None,
        first_break: str | None,
    ) -> Players:
        """Return the players that the options describe, or refuse what contradicts itself."""
        by_break = p1 is not None or p2 is not None
        ways = bool(ratings) + (p is not None) + by_break
        if ways != 1:
            refuse(("who plays is said twice; " if ways else "who plays is missing; ") + MEND)
        if scale is not None and not ratings:
            refuse("--scale says what ratings mean, and there are none; leave it out")
        if by_break:
            if p1 is None or p2 is None or breaks is None:
                refuse("--p1, --p2 and --breaks go together; give all three")
            first = first_break or ("b" if breaks == "b" else "a")
            told = f"the breaker wins a game with {p1:g} (A) or {p2:g} (B); {_format(breaks)}"
            told += f", {first.upper()} first" if breaks != first else ""
            return cls(Rack(p1, p2), FORMATS[breaks], 1 if first == "a" else 2, None, told)
        if breaks is not None or first_break is not None:
            refuse("the break matters only with --p1 and --p2; leave --breaks, --first-break out")
        if ratings:
            return cls._rated(ratings, scale_of("npl" if scale is None else scale))
        return cls(Rack(p), None, 1, None, f"A wins a game with {p:g}")

    @classmethod
    def _rated(cls, ratings: tuple[str, ...], scale: Scale) -> Players:
        if len(ratings) != 2:
            refuse(f"{len(ratings)} rating(s) given, {', '.join(ratings)}; {MEND}")
        a, b = (float(rating) for rating in ratings)
        if not math.isfinite(a - b):
            refuse("the ratings are too far apart to count with; give two usual numbers")
        if note := scale_note(scale, a, b):
            click.echo(note, err=True)
        told = f"A rated {a:g}, B rated {b:g}, {scale_text(scale)}"
        return cls(Rack(scale.win_probability(a - b)), None, 1, scale, told)


def scale_text(scale: Scale) -> str:
    """Return a scale in words.

    >>> scale_text(scale_of("fargo"))
    'on the fargo scale (100 points double the odds)'
    """
    return f"on the {scale.name} scale ({scale.points_per_doubling:.6g} points double the odds)"


def scale_note(scale: Scale, *ratings: float) -> str | None:
    """Return a note where ratings look like those of another scale.

    Only the difference counts, so somebody may give it as one rating and 0 as the other.

    >>> scale_note(scale_of("npl"), 612, 521)
    'Note: most npl ratings are from 20 to 130; for fargo ratings add --scale fargo'
    >>> scale_note(scale_of("fargo"), 1750, 1612)
    'Note: most fargo ratings are from 200 to 850; for elo ratings add --scale elo'
    """
    if scale.name in USUAL and max(ratings) > 1000:
        other = "elo"
    elif scale.name == "npl" and max(ratings) > 200:
        other = "fargo"
    elif scale.name == "fargo" and 0 < min(ratings) <= max(ratings) < 150:
        other = "npl"
    else:
        return None
    low, high = USUAL[scale.name]
    return (
        f"Note: most {scale.name} ratings are from {low} to {high}; "
        f"for {other} ratings add --scale {other}"
    )


def _format(breaks: str) -> str:
    return f"{breaks.upper()} breaks" if breaks in ("a", "b") else f"{breaks} breaks"


def player_options(command: Command) -> Command:
    """Add the arguments and options that say who plays."""
    for add in (
        click.option(
            "--first-break",
            type=click.Choice(["a", "b"]),
            help="Who breaks the next rack.  [default: a; b with --breaks b]",
        ),
        click.option("--breaks", type=click.Choice(list(FORMATS)), help="Who breaks."),
        click.option(
            "--p2", metavar="P", callback=chance, help="Chance that B wins a game that B breaks."
        ),
        click.option(
            "--p1", metavar="P", callback=chance, help="Chance that A wins a game that A breaks."
        ),
        click.option("--p", metavar="P", callback=chance, help="Chance that A wins a game."),
        click.option(
            "--scale",
            metavar="npl|fargo|elo|POINTS",
            help="What the ratings mean: POINTS of difference double the odds.  [default: npl]",
        ),
        click.argument("ratings", nargs=-1, metavar="[A B]"),
    ):
        command = add(command)
    return command
