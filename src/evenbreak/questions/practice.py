"""Questions about practice: drills, scores, runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, File, Named, Number, Text, TwoWhole, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import CHANCE, ByWay, PlotFile, Seed
from evenbreak.questions.games import MOST_BALLS, Chance, Safety
from evenbreak.questions.results import DATES
from evenbreak.stats.confidence import LARGEST

MOST_LEVELS = 100
EIGHT_BALL_LEVELS = 7
"""At this level of the 8-ball drill all 15 balls are on the table."""

_SUCCESS = (
    f" isn't a list of chances. Give up to {MOST_LEVELS} numbers from 0 to 1, separated "
    "by commas, such as 0.9,0.8,0.5"
)

DrillName: TypeAlias = Annotated[
    str | None, Field(Text("NAME"), "The drill to look at, if the file has several.")
]


def chances_in(text: str) -> tuple[float, ...]:
    """Return the chances in a text, with commas between them.

    >>> chances_in("0.9, 0.5")
    (0.9, 0.5)
    """
    parts = text.split(",")
    try:
        chances = tuple(CHANCE.read(part) for part in parts)
    except InputError:
        chances = ()
    if not 1 <= len(chances) <= MOST_LEVELS:
        raise InputError("{text!r}" + _SUCCESS, text=text)
    return chances


@dataclass(frozen=True, kw_only=True)
class DrillPlayed(Question):
    """Find where a progressive drill settles, and which level to practice.

    A success moves you one level up, and a miss moves you one level down. Describe the drill by
    {p}, {success} or {log}. LOG.csv has the columns level and success; add session or date if there
    are several sessions, and drill if there are several drills.
    """

    examples = """\
  evenbreak drill --p 0.8
  evenbreak drill --p 0.8 --game 8-ball
  evenbreak drill --success 0.95,0.8,0.6,0.3 --json
  evenbreak drill --log drill_log.csv --plot drill.png
"""
    p: Annotated[
        Chance,
        Says(
            "The chance of making a shot; level i takes i - 1 in a row (i in 8-ball).",
            more="So level i succeeds with probability P^(i−1), or P^i in 8-ball.",
        ),
    ] = None
    game: Annotated[
        Literal["9-ball", "8-ball"] | None,
        Field(
            Choice(("9-ball", "8-ball")),
            "The drill that {p} is for: i balls at level i or, in 8-ball, i balls of each group "
            "and the 8-ball.",
            usual="9-ball",
        ),
    ] = None
    success: Annotated[
        tuple[float, ...] | None,
        Field(Named(chances_in, "P,P,..."), "Or the chance of success at each level."),
    ] = None
    log: Annotated[
        str | None, Field(File("LOG.csv"), "Or a log of attempts; - reads standard input.")
    ] = None
    levels: Annotated[
        int | None,
        Field(
            Whole(1, MOST_LEVELS),
            "Number of levels.",
            usual="9 with {p}, 7 in 8-ball, and the log's highest level with {log}",
        ),
    ] = None
    drill: DrillName = None
    seed: Annotated[
        Seed | None, Says("The seed of the simulations used to test a log.", usual="1", rare=False)
    ] = None
    via: Annotated[ByWay, Says(rare=False)] = None
    plot: Annotated[
        PlotFile,
        Says(
            more="The chart shows the fraction of attempts at each level; for a log, compared "
            "with the attempts so far."
        ),
    ] = None

    def check(self) -> None:
        """Refuse a drill that is missing or described twice, and what is not about it."""
        if sum(which is not None for which in (self.p, self.success, self.log)) != 1:
            self.refuse("give exactly one of {p}, {success} and {log}")
        if self.p is None and self.game is not None:
            self.refuse("{game} is only for {p}. Leave it out.")
        if self.game == "8-ball" and (self.levels or 0) > EIGHT_BALL_LEVELS:
            self.refuse(
                "{levels} must be at most 7 in 8-ball, where level 7 has all 15 balls on the "
                "table; you gave {n}",
                n=self.levels,
            )
        if self.success is not None and self.levels is not None:
            self.refuse("{success} already says how many levels there are. Leave {levels} out.")
        if self.log is None and self.seed is not None:
            self.refuse("{seed} matters only with {log}. Leave it out.")
        if self.log is None and self.drill is not None:
            self.refuse("{drill} names a drill in {log}. Leave it out.")
        if self.log is not None and self.via is not None:
            self.refuse("{via} is for a drill with known chances. Leave it out with {log}.")


@dataclass(frozen=True, kw_only=True)
class Scores(Question):
    """Find out from your practice whether you are getting better, and what to practice next.

    SCORES.csv has a score column, with a row for each drill score; or the columns shot, made and
    tried, with a row for each shot on each day. Add a date column if you can. {new} tells you
    whether one more score was luck, and {versus} whether something helped. Use - for standard
    input.
    """

    examples = """\
  evenbreak practice scores.csv
  evenbreak practice shots.csv --plot shots.png
  evenbreak practice scores.csv --new 53 --confidence 0.8
  evenbreak practice before.csv --versus after.csv --plot scores.png
"""
    scores: Annotated[str, Field(File("SCORES.csv"), argument=True)]
    new: Annotated[
        float | None,
        Field(
            Number(-LARGEST, LARGEST, " isn't a score. Give a number, such as 53", metavar="SCORE"),
            "Was this one score luck?",
        ),
    ] = None
    versus: Annotated[
        str | None, Field(File("OTHER.csv"), "Have the scores changed since SCORES.csv?")
    ] = None
    confidence: Annotated[
        float,
        Field(
            Number(
                1e-9,
                1.0 - 1e-9,
                " isn't a confidence level. Give a number between 0 and 1, such as 0.95",
                metavar="C",
            ),
            "The confidence level of the intervals.",
        ),
    ] = 0.95
    drill: DrillName = None
    dates: Annotated[Literal["mdy", "dmy"] | None, DATES, Says(section="")] = None
    plot: Annotated[PlotFile, Says(section="")] = None

    def check(self) -> None:
        """Refuse two questions in one."""
        if self.new is not None and self.versus is not None:
            self.refuse("{new} and {versus} can't be used together. Leave one out.")
        if self.scores == self.versus == "-":
            self.refuse("only one list can come from standard input. Name a file for the other.")


@dataclass(frozen=True, kw_only=True)
class Runs(Question):
    """Find how long a player's runs are, and the total score of several innings.

    Describe the player by {mean} or by {p}.
    """

    examples = """\
  evenbreak runs --mean 24 --at-least 100
  evenbreak runs --mean 24 --over 20
  evenbreak runs --p 0.96 --innings 5 --between 100..150
  evenbreak runs --p 0.96 --safety 0.8 --plot runs.png
"""
    mean: Annotated[
        float | None,
        Field(
            Number(
                0,
                MOST_BALLS,
                f" isn't a number of balls per inning from 0 to {MOST_BALLS}",
                metavar="BALLS",
            ),
            "The player's average, in balls per inning.",
        ),
    ] = None
    p: Annotated[
        Chance, Says("Or the chance that the player makes a shot.", more="It must be below 1.")
    ] = None
    safety: Annotated[
        Safety, Says(more="`--mean` is then the average against such an opponent.")
    ] = 1.0
    innings: Annotated[
        int,
        Field(
            Whole(), "Show the score over M innings instead of the run in one inning.", metavar="M"
        ),
    ] = 1
    at_least: Annotated[
        int | None, Field(Whole(0, MOST_BALLS), "Also show the chance of N or more.")
    ] = None
    between: Annotated[
        tuple[int, int] | None,
        Field(
            TwoWhole(
                r"\.\.",
                0,
                MOST_BALLS,
                "isn't a range of balls. Give the fewest and the most, 0 to "
                f"{MOST_BALLS}, such as 50..75",
                metavar="LO..HI",
                rising=True,
            ),
            "Also show the chance of LO to HI.",
        ),
    ] = None
    over: Annotated[
        float | None,
        Field(
            Number(
                0,
                MOST_BALLS,
                f" isn't a number of balls from 0 to {MOST_BALLS}, such as 20 or 20.5",
                metavar="N",
            ),
            "A bet on more than N, such as 20 or 20.5.",
            more="Its chances of winning and losing are shown.",
        ),
    ] = None
    plot: Annotated[
        PlotFile,
        Says(
            section="",
            more="The chart shows the probability of each score, with mean, median and mode; "
            "the scores asked for are shaded.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a player who is missing, or described twice."""
        if (self.mean is None) == (self.p is None):
            self.refuse("give either {mean} or {p}")
