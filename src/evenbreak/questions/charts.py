"""Questions about handicap charts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, TypeAlias

from evenbreak.fields.kinds import File, Number, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import (
    GAMES,
    NPL,
    RACE,
    OnScale,
    PlotFile,
    ScaleOf,
    Target,
    chart_names,
)
from evenbreak.ratings.scale import SCALES

_MOST = 1_000_000
_CHART = File("NAME_OR_FILE", chart_names)
_AVERAGE = Field(
    Number(-1e6, 1e6, " isn't a rating. Give a team's average, such as 447"),
    "A team's average rating.",
    argument=True,
)
_POINTS = Number(0.0, 1e6, " isn't 0 or more points", metavar="POINTS")
_BESIDE = Field(_CHART, "A chart to compare with.", many=True)
_MEETINGS = Field(Whole(1, 1000), "How many pairs of players meet in a round.", metavar="K")

Chart: TypeAlias = Annotated[str, Field(_CHART, "The chart.", argument=True)]


@dataclass(frozen=True, kw_only=True)
class ChartList(Question):
    """List the charts, including those in installed packages.

    Each chart is shown with its number of different races and the length of its longest match.
    """


@dataclass(frozen=True, kw_only=True)
class Systems(Question):
    """List the handicap systems, including those in installed packages.

    Each system is shown with the chart that sets its races and the package it comes from; CSV and
    JSON output also has its rule.
    """


@dataclass(frozen=True, kw_only=True)
class ChartShow(Question):
    """Show a chart: who needs how many games.

    NAME_OR_FILE is a chart from `evenbreak chart list` or a CSV file. If the output goes to a pipe
    or a file, the chart is written as a CSV file like that, which you can edit and use.
    """

    examples = """\
  evenbreak chart show npl_10
  evenbreak chart show apa_8ball
  evenbreak chart show npl_8 > ours.csv
"""
    chart: Chart


@dataclass(frozen=True, kw_only=True)
class ChartAudit(Question):
    """Check how fair a chart is, race by race, and which ratings it was made for.

    NAME_OR_FILE is a chart from `evenbreak chart list` or a CSV file, which may have gaps and
    overlaps. The plot shows the stronger player's chance by rating difference.
    """

    examples = """\
  evenbreak chart audit npl_10
  evenbreak chart audit fargo_r6_hot --scale fargo
  evenbreak chart audit ours.csv --plot ours.png --beside npl_10
"""
    chart: Chart
    scale: Annotated[
        ScaleOf, Says(usual="the best fit to the chart; npl for a chart by skill level", more="")
    ] = None
    beside: Annotated[
        str | None,
        _BESIDE,
        Says("Another chart to add to the picture, in the first chart's points.", many=False),
    ] = None
    plot: Annotated[PlotFile, Says(section="", more="Not for a chart by skill level.")] = None

    def check(self) -> None:
        """Refuse a chart for a picture that is not drawn."""
        if self.beside is not None and self.plot is None:
            self.refuse(
                "{beside} adds a chart to the picture. Give {plot} FILE too, or leave {beside} out."
            )


@dataclass(frozen=True, kw_only=True)
class ChartDesign(Question):
    """Design the fairest chart for given ratings, within limits on its races.

    Unfairness is how far the stronger player's chance is from the target. If the output goes to a
    pipe or a file, the chart is written as a CSV file that the other commands read.
    """

    examples = """\
  evenbreak chart design --games 7..9 --least 5:2 --beside npl_10
  evenbreak chart design --games 5..15 --scale fargo --tilt 0 > ours.csv
  evenbreak chart design --games 17..41 --most-rows 10 --games-p90 21
"""
    games: Annotated[tuple[int, int], GAMES]
    least: Annotated[
        tuple[int, int],
        Field(
            RACE,
            "The fewest games that the stronger player and the weaker player may need.",
            metavar="M:N",
        ),
    ] = (2, 2)
    games_p90: Annotated[
        int | None,
        Field(
            Whole(1, _MOST),
            "9 out of 10 matches must end within K games, at every rating difference.",
            metavar="K",
        ),
    ] = None
    most_rows: Annotated[
        int, Field(Whole(1, _MOST), "The chart may have at most N rows.", old=("rows",))
    ] = 12
    scale: OnScale = NPL
    target: Annotated[Target, Says("The stronger player's target chance.")] = 0.5
    tilt: Annotated[
        float,
        Field(
            Number(
                0.0, 1.0, " isn't a number from 0 (the start of a band) to 1 (its end)", metavar="T"
            ),
            "Where in its band a race should be on target: 0 at the start (the stronger player is "
            "never the underdog), 0.5 in the middle, 1 at the end.",
        ),
    ] = 0.5
    up_to: Annotated[
        int | None,
        Field(
            Whole(1, _MOST),
            "The largest rating difference that counts.",
            usual="where the last race of each {beside} chart is even; otherwise where the "
            "hardest race allowed is even",
            metavar="D",
        ),
    ] = None
    beside: Annotated[tuple[str, ...], _BESIDE] = ()


@dataclass(frozen=True, kw_only=True)
class ChartTeam(Question):
    """Find the points that the weaker of two teams gets in a round, the way CSI does.

    AVERAGE_1 and AVERAGE_2 are the average ratings of the two teams. By default, {won} and {lost}
    are the averages in 17-point scoring.
    """

    examples = """\
  evenbreak chart team 417 447
  evenbreak chart team 510 462 --match-ups 5 --single-games 1 --won 10 --lost 3.5
"""
    average_1: Annotated[float, _AVERAGE, Says(metavar="AVERAGE_1")]
    average_2: Annotated[float, _AVERAGE, Says(metavar="AVERAGE_2")]
    match_ups: Annotated[int, _MEETINGS] = 3
    single_games: Annotated[int, _MEETINGS, Says("Games per pair in a round.", old=("games",))] = 2
    won: Annotated[float, Field(_POINTS, "The winner's average score in a game.")] = 13.19
    lost: Annotated[float, Field(_POINTS, "The loser's average score in a game.")] = 3.81
    scale: OnScale = SCALES["fargo"]
