"""The question that puts a league on the web."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from evenbreak.fields.kinds import File, Named
from evenbreak.fields.question import Field, Says
from evenbreak.files.league import values
from evenbreak.league.tables.rules import USUAL_RULES
from evenbreak.questions.common import (
    ChartName,
    EvenRace,
    Lengths,
    OutFolder,
    ScaleOf,
    folder,
    title_in,
)
from evenbreak.questions.results import ROSTER, Results
from evenbreak.questions.tables import TablePoints, TeamScore, TeamsFile, Ties

_TABLE = "The table"
_LOOK = "The look"


@dataclass(frozen=True, kw_only=True)
class Publish(Results, Lengths):
    """Publish a league as a static site: standings, ratings, races, a page for each player.

    RESULTS.csv is what `evenbreak report` reads; several files are read as one. The site is a
    folder of plain files that you can put on any web host, a flash drive or a phone. It fetches
    nothing from other sites and works without a server. In a league's folder, league.toml fills in
    what you leave out and says how individual players are named. Files from an earlier run that are
    no longer needed are removed. The same results give the same files, byte for byte.
    """

    examples = """\
  evenbreak publish
  evenbreak publish season.csv --title "Tuesday league"
  evenbreak publish season.csv --names initials --color "#1b6e53" --logo logo.png
  evenbreak publish season.csv --chart apa_8ball --tournaments nights
"""
    out: Annotated[OutFolder, Says("The site's folder; created if needed.")] = "site"
    scale: Annotated[
        ScaleOf,
        Says(
            usual="the scale of {roster} or the chart; otherwise npl, or fargo for skill levels",
            more="",
        ),
    ] = None
    race: EvenRace = None
    chart: Annotated[
        ChartName,
        Says(
            "The league's chart, by name or in a file.",
            usual="the fairest races",
            more="With a chart of skill levels, the levels are read from `--roster`; without "
            "it, each player's last level in the results is used.",
        ),
    ] = None
    roster: Annotated[
        str | None,
        ROSTER,
        Says("The league's own list of ratings or levels, which sets the races."),
    ] = None
    schedule: Annotated[
        str | None,
        Field(
            File("FIXTURES.csv"),
            "Who plays who, in a file written by `evenbreak league fixtures`; the site shows "
            "the matches still to be played.",
        ),
    ] = None
    tournaments: Annotated[
        str | None,
        Field(
            Named(folder, "DIR", offers="files"),
            "A folder of tournaments saved by `evenbreak tournament` or the page; finished ones "
            "are shown with their brackets.",
        ),
    ] = None
    teams: Annotated[TeamsFile, Says(section=_TABLE)] = None
    count: Annotated[TeamScore, Says(section=_TABLE)] = "sets"
    table_points: Annotated[TablePoints, Says(section=_TABLE)] = USUAL_RULES
    ties: Annotated[Ties, Says(section=_TABLE)] = USUAL_RULES.ties
    title: Annotated[str, Field(Named(title_in, "TEXT"), "The league's name.", section=_LOOK)] = (
        "League"
    )
    naming: Annotated[
        values.Shown, Field(values.NAMES, "How players are named.", option="names", section=_LOOK)
    ] = "full"
    color: Annotated[
        str | None,
        Field(
            values.COLOR,
            "The site's color, such as #1b6e53.",
            usual="blue",
            section=_LOOK,
            more="Where text in this color would be hard to read, the color is darkened by day "
            "and lightened by night.",
        ),
    ] = None
    logo: Annotated[
        str | None,
        Field(
            File("PICTURE"), "A PNG, JPEG or WebP picture of up to 200,000 bytes.", section=_LOOK
        ),
    ] = None

    def check(self) -> None:
        """Refuse two ways to set races."""
        super().check()
        ways = [name for name in ("chart", "race", "games", "race_to") if name in self.given]
        if len(ways) > 1:
            self.refuse(f"{{{ways[0]}}} and {{{ways[1]}}} can't be used together. Leave one out.")
