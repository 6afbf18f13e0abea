"""Questions about chip tournaments and their charts."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import File, Named, Number, Whole
from evenbreak.fields.question import Field, Says
from evenbreak.questions.common import CHIPS, ScaleOf, Seed, Starters
from evenbreak.tournaments.evening.format import Tables

MOST_CHIPS, MOST_ROWS = 100, 30

Chips: TypeAlias = Annotated[int, Field(Whole(1, 50))]


def chips_left(text: str) -> dict[str, int]:
    """Return the chips that players have left.

    >>> chips_left("Ann=2, Bo=1")
    {'Ann': 2, 'Bo': 1}
    """
    left: dict[str, int] = {}
    for part in text.split(","):
        match = re.fullmatch(r"\s*(.+?)\s*=\s*(\d{1,3})\s*", part)
        if match is None or not 1 <= int(match[2]) <= MOST_CHIPS:
            raise InputError(
                f"{part.strip()!r} isn't a player with chips. Write each "
                "player's, such as Ann=2,Bo=1."
            )
        if match[1] in left:
            raise InputError(f"{match[1]!r} is listed twice")
        left[match[1]] = int(match[2])
    if len(left) < 2:
        raise InputError("give two or more players")
    return left


def bands(text: str) -> list[float]:
    """Return the ratings at which the rows of a chart begin.

    >>> bands("450,350")
    [350.0, 450.0]
    """
    parts = text.split(",")
    try:
        ratings = [Number(-1e6, 1e6).read(part) for part in parts]
    except InputError:
        ratings = []
    if not 1 <= len(ratings) <= MOST_ROWS:
        raise InputError(
            f"{text!r} isn't a list of ratings. Give the ratings at which the rows "
            "start, such as 350,450,550."
        )
    return sorted(set(ratings))


@dataclass(frozen=True, kw_only=True)
class ChipField(Starters):
    """The players of a chip tournament, and its tables."""

    tables: Tables = 4
    scale: Annotated[ScaleOf, Says(usual="inferred from the ratings; without a file, fargo")] = None
    seed: Annotated[Seed, Says("The seed of the simulation.")] = 0


@dataclass(frozen=True, kw_only=True)
class ChipOdds(ChipField):
    """Find each player's odds of winning a chip tournament.

    The tournament is played out 10,000 times. The ratings are treated as exact.
    """

    examples = """\
  evenbreak chips odds entrants.csv --chips hoboken --tables 4
  evenbreak chips odds entrants.csv --left "Ann=2,Bo=1,Cy=3"
"""
    entrants: Annotated[str, Field(File("ENTRANTS.csv"), argument=True)]
    chips: Annotated[
        str | None,
        Field(
            CHIPS,
            "The chips at the start: hoboken, pharaohs, or a file.",
            old=("chart",),
            more="A [file](../files.md#chip-charts) has the columns `rating_from` and `chips`.",
        ),
    ] = None
    left: Annotated[
        dict[str, int] | None,
        Field(
            Named(chips_left, "NAME=CHIPS,..."),
            "Instead of {chips}: the players still in, at one table, with the chips they have "
            "left, in the order of the line; the first one holds the table.",
            more="The second is the challenger. With up to four players the odds are exact.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a tournament that starts twice, or not at all."""
        if (self.chips is None) == (self.left is None):
            self.refuse("give either {chips} NAME or {left} NAME=CHIPS,...")


@dataclass(frozen=True, kw_only=True)
class ChipAudit(ChipField):
    """Check who a chip chart favors: hoboken, pharaohs, or one in a file.

    It checks a whole tournament, and a final between two players who still have all their chips.
    The ratings are treated as exact.
    """

    examples = """\
  evenbreak chips audit hoboken
  evenbreak chips audit pharaohs --entrants entrants.csv --tables 6
"""
    chart: Annotated[str, Field(CHIPS, "The chart.", argument=True)]
    entrants: Annotated[
        str | None,
        Field(
            File("FILE.csv"),
            "The players in the tournament.",
            usual="16 players, spread over four doublings of the odds",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class ChipDesign(ChipField):
    """Design a chip chart that makes a tournament as even as possible for its players.

    Without ENTRANTS.csv, the field is 16 players, spread over four doublings of the odds. If the
    output goes to a file, the chart is written as CSV, which chips audit and chips odds can read.
    The ratings are treated as exact.
    """

    examples = """\
  evenbreak chips design
  evenbreak chips design entrants.csv --bands 351,451,501,601 --most 12 > ours.csv
"""
    entrants: Annotated[
        str | None, Field(File("ENTRANTS.csv"), metavar="[ENTRANTS.csv]", argument=True)
    ] = None
    fewest: Annotated[
        Chips, Says("The fewest chips a player starts with. More chips make a longer tournament.")
    ] = 2
    most: Annotated[Chips, Says("The most chips a player starts with.")] = 10
    bands: Annotated[
        list[float] | None,
        Field(
            Named(bands, "RATING,..."),
            "The ratings at which the rows start.",
            usual="every half doubling of the odds",
        ),
    ] = None

    def check(self) -> None:
        """Refuse more chips at least than at most."""
        if self.fewest > self.most:
            self.refuse(
                "{fewest} ({low}) must not be more than {most} ({high})",
                low=self.fewest,
                high=self.most,
            )
