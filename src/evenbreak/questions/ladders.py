"""Questions about how ratings move under a handicap system, and about losing on purpose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from evenbreak.fields.kinds import Choice, File, Flag, Number, Text, Whole
from evenbreak.fields.question import Field, Says
from evenbreak.questions.common import ByWay, ChartName, PlotFile, ScaleOf
from evenbreak.questions.results import ON_STDIN, RESULTS, ROSTER, Reading
from evenbreak.questions.systems import DAY_SD, BySystem

LARGEST = 10_000
"""The largest error that can be typed, in points; a ladder says where it ends itself."""

MOST_A_NIGHT = 20

MOST_DRIFT = 0.9
"""A rating that moves a point a match cannot follow a skill that does so each time."""

_OPPONENTS, _FORM, _SETTLING = "Opponents", "Form and skill", "How a new player settles"

_MONEY = Number(0.0, 1e9, " isn't a number from 0 to 1,000,000,000")
_START_ERROR = Field(
    Whole(-LARGEST, LARGEST),
    "The player's rating minus their skill at the start, in points.",
    metavar="ERROR",
    old=("from",),
)
_COMPARE = Field(Flag(), "Compare the system's charts.")


@dataclass(frozen=True, kw_only=True)
class LadderErrors(BySystem):
    """Show how far off a league's ratings are in the long run, and how fair its matches are.

    A rating goes up with each win and down with each loss, and the chart turns the difference
    between two ratings into a race. Opponents are as strong as the player and correctly rated,
    unless an option says otherwise. With a chart of skill levels, the command follows the levels
    instead.
    """

    examples = """\
  evenbreak ladder --chart npl_10
  evenbreak ladder --chart npl_8 --autocorrelated --start-error -30 --newcomer
  evenbreak ladder --chart npl_10 --step 2 --plot step_2.png
  evenbreak ladder --chart apa_8ball
  evenbreak ladder --compare
"""
    step: Annotated[
        int | None,
        Field(
            Whole(1, 100),
            "Instead of {system}: ratings go up K for a win and down K for a loss.",
            metavar="K",
        ),
    ] = None
    scale: Annotated[
        ScaleOf,
        Says(
            usual="the system's",
            more="The ratings of `--league` [must fit it](../files.md#the-scale-of-a-list).",
        ),
    ] = None
    start_error: Annotated[
        int | None, _START_ERROR, Says(usual="one doubling of the odds too low", section=_SETTLING)
    ] = None
    within: Annotated[
        int | None,
        Field(
            Whole(0, LARGEST),
            "How close a rating must be to the skill to count as settled.",
            usual="a sixth of a doubling of the odds",
            metavar="POINTS",
            section=_SETTLING,
            more="That is 5 points in the National Pool League.",
        ),
    ] = None
    newcomer: Annotated[
        bool,
        Field(
            Flag(),
            "At first, the player's rating moves by the system's longer steps for newcomers.",
            section=_SETTLING,
        ),
    ] = False
    compare: Annotated[bool, _COMPARE, Says("Compare systems, charts and step sizes instead.")] = (
        False
    )
    plot: Annotated[
        PlotFile,
        Says(
            section="",
            more="The chart shows the distribution of the error and how players settle or, with "
            "`--compare`, the systems.",
        ),
    ] = None
    autocorrelated: Annotated[
        bool,
        Field(
            Flag(),
            "Opponents are rated at the player's skill, with rating errors like the player's.",
            section=_OPPONENTS,
        ),
    ] = False
    equal_skill: Annotated[
        bool,
        Field(
            Flag(),
            "Opponents are as strong as the player, with rating errors like the player's.",
            section=_OPPONENTS,
        ),
    ] = False
    league: Annotated[
        str | None,
        Field(
            File("ROSTER.csv"),
            "Opponents are drawn from a league, with rating errors like the player's.",
            section=_OPPONENTS,
            more="They are the rated players on [a roster](../files.md#roster).",
        ),
    ] = None
    skill: Annotated[
        int | None,
        Field(
            Whole(-LARGEST, LARGEST),
            "With {league}: the player's own skill.",
            usual="the league's median rating",
            metavar="S",
            section=_OPPONENTS,
        ),
    ] = None
    day_sd: Annotated[float, DAY_SD, Says(section=_FORM)] = 0.0
    matches_a_night: Annotated[
        int | None,
        Field(
            Whole(1, MOST_A_NIGHT),
            "With {day_sd}: how many matches are played on the same day, with the same form.",
            usual="1",
            section=_FORM,
        ),
    ] = None
    match_sd: Annotated[
        float,
        DAY_SD,
        Says(
            "Additional variation of everyone's form from match to match (standard deviation).",
            section=_FORM,
        ),
    ] = 0.0
    drift: Annotated[
        float,
        Field(
            Number(-MOST_DRIFT, MOST_DRIFT, f" isn't a number from {-MOST_DRIFT} to {MOST_DRIFT}"),
            "How much the player's skill rises per match on average: it rises by a whole point "
            "with this probability. If negative, skill falls.",
            metavar="POINTS",
            section=_FORM,
        ),
    ] = 0.0
    via: Annotated[
        ByWay,
        Says("How the distribution of the error is calculated from the chances in each match."),
    ] = None

    def check(self) -> None:
        """Refuse what does not go together."""
        for name in self.given:
            if self.compare and name not in _COMPARED:
                self.refuse("{compare} goes through several systems. Leave {" + name + "} out")
        if self.chart == self.league == "-":
            self.refuse(
                "- means standard input, which can stand for only one file. Name the other."
            )
        if self.system is not None and self.step is not None:
            self.refuse(
                "{step} {k} is a system of its own. Leave out {system} or {step}.", k=self.step
            )
        if self.matches_a_night is not None and not self.day_sd:
            self.refuse(
                "{matches_a_night} is how long a day's form lasts. Give {day_sd}, or leave "
                "{matches_a_night} out."
            )
        meets = [f"{{{name}}}" for name in _MEETS if getattr(self, name)]
        if len(meets) > 1:
            listed = f"{', '.join(meets[:-1])} and {meets[-1]}"
            self.refuse(f"{listed} can't be used together. Keep one.")
        if self.skill is not None and self.league is None:
            self.refuse(
                "{skill} is for a player in a league. Give {league} ROSTER.csv, or leave "
                "{skill} out."
            )


_MEETS = ("autocorrelated", "equal_skill", "league")
_COMPARED = ("compare", "chart", "plot", "skill", *_MEETS)


@dataclass(frozen=True, kw_only=True)
class SandbagPay(BySystem):
    """Show how much losing matches on purpose pays.

    Opponents are as strong as the player and correctly rated. The player loses up to D matches on
    purpose, then plays E matches that count while the rating climbs back. Systems that move ratings
    or levels after each match are solved exactly; the others are simulated many times, and the
    error is stated.
    """

    examples = """\
  evenbreak sandbag pay
  evenbreak sandbag pay --chart npl_12 --stake 100 --dumped-stake 5 --plot pay.png
  evenbreak sandbag pay --in-a-row 4 --prize 500 --stake 0
  evenbreak sandbag pay --compare
  evenbreak sandbag pay --system tap-like
"""
    dumped: Annotated[
        int,
        Field(
            Whole(1, 100),
            "The most matches to lose on purpose.",
            metavar="D",
            more="The table has a row for each number up to this one.",
        ),
    ] = 12
    earnest: Annotated[int, Field(Whole(1, 500), "Matches that count afterward.", metavar="E")] = 20
    stake: Annotated[
        float, Field(_MONEY, "How much more a win is worth than a loss in a match that counts.")
    ] = 10.0
    dumped_stake: Annotated[
        float, Field(_MONEY, "How much winning one of the dumped matches is worth.")
    ] = 1.0
    in_a_row: Annotated[
        int,
        Field(
            Whole(1, 50),
            "How many wins in a row it takes to win a tournament.",
            metavar="K",
            more="During it, players keep the ratings that they entered with.",
        ),
    ] = 3
    prize: Annotated[
        float,
        Field(
            _MONEY,
            "The tournament's prize.",
            more="The tournament is played before the matches that count, and it moves no ratings.",
        ),
    ] = 0.0
    start_error: Annotated[int, _START_ERROR, Says(kind=Whole(-100, 100))] = 0
    compare: Annotated[
        bool, _COMPARE, Says(more="Each is shown with the number of dumped matches that pays most.")
    ] = False
    plot: Annotated[
        PlotFile,
        Says(section="", more="The chart shows the chance of winning each match that counts."),
    ] = None

    def check(self) -> None:
        """Refuse one chart where all are compared."""
        if self.compare and (self.chart is not None or self.plot is not None):
            self.refuse("{compare} takes all of the system's charts. Leave {chart} and {plot} out.")


@dataclass(frozen=True, kw_only=True)
class SandbagWatch(BySystem, Reading):
    """Check a league's results for sandbagging.

    RESULTS.csv is a file like the ones `report` reads; - reads standard input. The ratings of
    ROSTER.csv are updated night by night. The evidence against a player grows with each result that
    is more likely from a sandbagger than from an honest player; when it reaches 1 / alpha, the
    player is flagged. This is evidence, not a verdict.
    """

    examples = """\
  evenbreak sandbag watch season.csv --roster start.csv
  evenbreak sandbag watch season.csv --roster start.csv --dumps-in "League night"
  evenbreak sandbag watch season.csv --roster start.csv --player "Bo Diaz"
"""
    results: Annotated[str, RESULTS, Says(metavar="RESULTS.csv", many=False)]
    roster: Annotated[
        str,
        ROSTER,
        Says(
            "The ratings before the first match in the results.",
            more="Every player must have a rating.",
        ),
    ]
    chart: Annotated[
        ChartName,
        Says(
            "The chart that sets the races if the results don't state them.",
            usual="",
            more="Without it, a match whose race isn't stated is read as an even race to the "
            "winner's number of games, with a warning, as in `validate`.",
        ),
    ] = None
    scale: Annotated[
        ScaleOf,
        Says(
            usual="the list's own, otherwise inferred from the ratings",
            more="If the results contradict that scale, the command stops and shows both readings.",
        ),
    ] = None
    alpha: Annotated[
        float,
        Field(
            Number(1e-9, 0.5, " isn't a number from 1e-09 to 0.5", metavar="P"),
            "The largest chance of ever flagging an honest player.",
        ),
    ] = 0.01
    honest: Annotated[
        Literal["any", "established"],
        Field(
            Choice(("any", "established")),
            "Who counts as honest: players of any skill, or players whose ratings are as accurate "
            "as ratings are in the long run.",
            more="`any`: players of any skill within 180 points of their ratings (on a scale "
            "where 30 double the odds), including those who steadily improve or decline. "
            "`established` detects sandbaggers sooner, but flags honest players whose "
            "ratings are far off. A warning tells you if a tenth or more of the players "
            "start without a rating of their own.",
        ),
    ] = "any"
    day_sd: Annotated[
        float,
        DAY_SD,
        Says(
            "Variation of honest players' form from day to day (standard deviation).",
            more="With 0, honest players are flagged too often if their form really varies a "
            "lot; a warning then gives the value that fits the results.",
        ),
    ] = 0.0
    dumps_in: Annotated[
        tuple[str, ...],
        Field(
            Text("EVENT"),
            "An event that counts for little; only matches in it may be dumped.",
            usual="every event in the file is tried",
            many=True,
            more="If there are more than 20, only the 20 with the most matches are tried.",
        ),
    ] = ()
    player: Annotated[
        str | None,
        Field(
            Text("NAME"),
            "Show what each of one player's matches adds to the evidence.",
            more="Case and spacing in the name don't matter.",
        ),
    ] = None
    plot: Annotated[
        PlotFile, Says(section="", more="The chart shows the evidence match by match.")
    ] = None

    def check(self) -> None:
        """Refuse standard input for several files."""
        if [self.results, self.roster, self.chart, self.aliases].count("-") > 1:
            self.refuse(ON_STDIN)
