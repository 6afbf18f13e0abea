"""Questions that results answer: ratings, what is behind them, and whether to trust them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from evenbreak.fields.kinds import File, Flag, Named, NumberOr, Text, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import (
    ChartName,
    Dask,
    EntrantsFile,
    Jobs,
    Lengths,
    OutFolder,
    PaperName,
    PlotFile,
    ScaleByChart,
    ScaleOf,
    Seed,
    Title,
    refuse_workers,
)
from evenbreak.questions.results import ON_STDIN, RESULTS, ROSTER, ByChart, Day, Results
from evenbreak.questions.systems import SystemOf
from evenbreak.ratings.provisional import ESTABLISHED

MOST_PAIRED = 1000
"""The most players that are paired."""

_RATING, _RULE = "How to rate", "A league's own rule"
PROVISIONAL = Field(
    Whole(0, 1_000_000, metavar="GAMES"),
    "Players with fewer games are provisional: listed last, unranked.",
    usual=f"{ESTABLISHED}, or a third of the regulars' if that is less",
    more="See [who has a place](../../explanation/ratings.md#who-has-a-place-in-the-list).",
)
_PLAYER = Field(Named(str, "NAME", offers="players"), argument=True)


@dataclass(frozen=True, kw_only=True)
class Assumed(Question):
    """Assumptions before the results, and how long results count."""

    prior: Annotated[
        float | Literal["best"] | None,
        Field(
            NumberOr("best", metavar="POINTS|best"),
            "Assumed spread of players before any results (standard deviation), or best for "
            "whatever predicts best and, if it helps, separate starting points for newcomers, "
            "teams, divisions and handicap races.",
            usual="best if the file has dates, otherwise one doubling of the odds",
            section=_RATING,
            more="See [what the file knows](../../explanation/ratings.md#what-the-file-knows).",
        ),
    ] = None
    half_life: Annotated[
        float | Literal["none"] | None,
        Field(
            NumberOr(
                "none",
                0.01,
                wanted="a number of days from 0.01 to 1,000,000, such as 180",
                metavar="DAYS|none",
            ),
            "After this many days, a match counts half as much; with none, matches don't fade.",
            usual="whatever clearly predicts better; none with {prior} POINTS",
            section=_RATING,
        ),
    ] = None
    begin: Annotated[
        str | None,
        Field(
            File("RATINGS.csv"),
            "Start from these ratings: the file `evenbreak rate --save` wrote last "
            "season, or any list of rated players.",
            section=_RATING,
            more="See [the file](../files.md#ratings-to-begin-from). Ratings without a standard "
            "error count as much as they help prediction, and ratings from more games "
            "count more. With `--prior POINTS`, they are assumed to be off by as much as "
            "their number of games suggests or, without games, by half the points that "
            "double the odds.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class HowToRate(Assumed, ByChart):
    """How to rate the players of results."""

    as_of: Annotated[
        Day,
        Says(
            "Rate as of this day, leaving out later matches.",
            usual="the last date",
            section=_RATING,
            more="Write it as 2025-03-01, 1.3.2025, or 3/1/2025 with `--dates mdy`. The age of "
            "each match is counted from this day, which may be up to a year ahead, for an "
            "upcoming tournament.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse what is no day."""
        self.day("as_of")


@dataclass(frozen=True, kw_only=True)
class Rate(Results, HowToRate):
    """Rate players from their results, and show how certain each rating is.

    RESULTS.csv has one match per row, with the columns player_a, player_b, score_a and score_b; or
    winner, loser and score, such as 7-5. If the score isn't known, race and winner are enough;
    racks (who won each rack, such as abba) can replace the score. RESULTS.csv may also be a
    workbook (.xlsx, .ods) or a tournament saved from CueScore, Challonge or brackets-manager. -
    reads standard input. Several files, such as one for each season, are rated as one.
    """

    examples = """\
  evenbreak rate season.csv --scale fargo
  evenbreak rate last.csv this.csv --half-life 180
  evenbreak rate last.csv --save ratings.csv
  evenbreak rate this.csv --begin ratings.csv
  evenbreak rate season.csv --prior 20 --half-life 180
  evenbreak rate season.csv --anchor "Ann Lee=95" --pair "Ann Lee" "Bo Diaz"
  evenbreak rate --system npl --roster last.csv tonight.csv
"""
    scale: Annotated[
        ScaleOf,
        Says(
            usual="npl; fargo with a chart by skill level; or the only scale that fits the "
            "{anchor} points",
            more="",
        ),
    ] = None
    anchor: Annotated[
        tuple[str, ...],
        Field(
            Text("POINTS|NAME=POINTS"),
            "The mean rating, or a named player's rating.",
            usual="the middle of the scale",
            many=True,
            more="If you name several connected players, all ratings connected to theirs are "
            "shifted so that the named players have these ratings on average.",
        ),
    ] = ()
    save: Annotated[
        str | None,
        Field(
            File("RATINGS.csv"),
            "Also write the ratings to this file, for next season's {begin}.",
        ),
    ] = None
    pair: Annotated[
        tuple[tuple[str, str], ...],
        Field(
            Text("A B"),
            "Show the gap between two players, and how certain it is.",
            many=True,
            words=2,
        ),
    ] = ()
    provisional: Annotated[int | None, PROVISIONAL] = None
    break_advantage: Annotated[
        float | Literal["fit"] | None,
        Field(
            NumberOr("fit", -1e6, metavar="POINTS|fit"),
            "How many points better the breaker plays; fit estimates this if the file says who "
            "broke.",
            usual="the break doesn't matter",
            section=_RATING,
        ),
    ] = None
    system: Annotated[
        SystemOf,
        Says(
            "Apply a league's own rule to {roster} instead, such as npl or 'step 2'.",
            usual="",
            section=_RULE,
            more="See [Systems](../systems.md).",
        ),
    ] = None
    roster: Annotated[
        str | None,
        ROSTER,
        Says(
            "With {system}: the list of ratings before these results.",
            metavar="LAST.csv",
            section=_RULE,
        ),
    ] = None
    chart: Annotated[
        ChartName,
        Says(
            "The chart that set the races if the file states skill levels (or ratings) but no "
            "races; with {system}, if it states neither race nor winner.",
            usual="with {system}, the system's chart if only one of them fits all scores",
        ),
    ] = None

    @property
    def reading(self) -> dict[str, Any]:
        """How to read the results; a system looks its ratings up in the chart itself."""
        own = super().reading
        return own if self.system is None else {**own, "chart": None}

    def check(self) -> None:
        """Refuse options of a fit for a league's own rule, and the other way round."""
        if self.system is None:
            if self.roster is not None:
                self.refuse("{roster} is for {system}. Give {system} npl too, or leave it out.")
            return
        of_fit = ("anchor", "prior", "half_life", "begin", "save", "as_of", "provisional")
        given = [
            f"{{{name}}}"
            for name in (*of_fit, "break_advantage", "pair", "scale")
            if name in self.given
        ]
        if given:
            self.refuse("{system} has its own rule. Leave out " + ", ".join(given))
        if self.roster is None:
            self.refuse("{system} needs the ratings before these results. Give {roster} LAST.csv.")
        if len(self.results) > 1:
            self.refuse(
                "{system} takes one file of results. Leave out {file}.", file=self.results[1]
            )
        if [self.results[0], self.roster, self.chart, self.aliases].count("-") > 1:
            self.refuse(ON_STDIN)


@dataclass(frozen=True, kw_only=True)
class Why(HowToRate, Lengths):
    """Explain two ratings: the matches behind them, and what one more match would change.

    A and B are two players in RESULTS.csv, which is read in the same way as for `report` and
    `rate`. Each of their matches is left out in turn, to see what it is worth to the rating. Then
    one more match between them is added, once with A winning and once with B winning.
    """

    examples = """\
  evenbreak why "Ann Lee" "Bo Diaz" --results season.csv
  evenbreak why "Ann Lee" "Bo Diaz" --results season.csv --race-to 9 --scale fargo
"""
    player_a: Annotated[str, _PLAYER, Says(metavar="A")]
    player_b: Annotated[str, _PLAYER, Says(metavar="B")]
    results: Annotated[
        tuple[str, ...],
        RESULTS,
        Says("The results.", metavar="RESULTS.csv", argument=False, old=("from",)),
    ]
    scale: ScaleByChart = None


@dataclass(frozen=True, kw_only=True)
class Validate(Results, Assumed):
    """Find out whether a league's ratings can be trusted.

    RESULTS.csv is a file like the ones `rate` reads, with dates; - reads standard input; several
    files are read as one. The results of each date are predicted only from earlier dates, then
    compared with what happened.
    """

    examples = """\
  evenbreak validate season.csv
  evenbreak validate season.csv --plot calibration.png
  evenbreak validate season.csv --prior 20 --half-life 365
"""
    scale: Annotated[ScaleByChart, Says("The scale whose points are used for priors.")] = None
    seed: Annotated[Seed, Says("The seed of the intervals and simulated seasons.", rare=False)] = 1
    plot: Annotated[
        PlotFile,
        Says(
            section="",
            more="The chart shows the predicted chances against how often favorites won, with "
            "95% intervals.",
        ),
    ] = None
    jobs: Annotated[Jobs, Says(section="The work")] = 1
    dask: Annotated[Dask, Says(section="The work")] = None

    def check(self) -> None:
        """Refuse two kinds of workers at once."""
        refuse_workers(self)


@dataclass(frozen=True, kw_only=True)
class Report(Results, HowToRate, Lengths):
    """Make a league's fair-race sheet from its results.

    RESULTS.csv has a match in each row, with the columns player_a, player_b, score_a, score_b and,
    if known, date, race_a, race_b, winner, first_break, break_format, racks, event and forfeit;
    `evenbreak rate --help-all` lists other layouts. - reads standard input. The sheet gives each
    player's rating and the fairest race for each pair. It lists all players, strongest first; those
    with few games come last. Several files are read as one. The sheet is printed to the terminal,
    and sheet.pdf is for the wall; {page} adds a page to hand out, and {excel} adds a workbook.
    """

    examples = """\
  evenbreak report season.csv --out sheet
  evenbreak report season.csv --out sheet --scale fargo --race-to 9
  evenbreak report season.csv --out sheet --games 7..13 --players "Ann Lee,Bo Diaz"
  evenbreak report season.csv --out sheet --page --excel --title "Tuesday league"
"""
    out: Annotated[
        OutFolder,
        Says("Folder for ratings.csv, matchups.csv, summary.csv and sheet.pdf; created if needed."),
    ] = "sheet"
    scale: ScaleByChart = None
    players: Annotated[
        tuple[str, ...],
        Field(Text("NAMES"), "Players to pair, separated by commas.", many=True),
    ] = ()
    top: Annotated[
        int | None,
        Field(
            Whole(2, MOST_PAIRED),
            "Pair only the N players with the most games.",
            usual="everyone, or the 96 with the most games",
        ),
    ] = None
    players_file: Annotated[
        EntrantsFile,
        Says(
            more="Players without results are [new players](../files.md#entrants) at the mean; "
            "a rating stated for them in the file is not used."
        ),
    ] = None
    title: Title = ""
    paper: Annotated[PaperName, Says(rare=True)] = None
    provisional: Annotated[int | None, PROVISIONAL] = None
    page: Annotated[
        bool, Field(Flag(), "Also write sheet.html, for phones and printers.", old=("html",))
    ] = False
    excel: Annotated[
        bool,
        Field(
            Flag(),
            "Also write sheet.xlsx, a workbook of all tables.",
            more="Needs XlsxWriter: `pip install XlsxWriter`, or the extra `evenbreak[excel]`.",
        ),
    ] = False
    excel_csv: Annotated[
        bool, Field(Flag(), "Write the CSV files for Excel, with BOM and CRLF.")
    ] = False

    def check(self) -> None:
        """Refuse two ways to name the players."""
        ways = [f"{{{name}}}" for name in ("players", "top", "players_file") if name in self.given]
        if len(ways) > 1:
            self.refuse(" and ".join(ways) + " can't be used together. Leave all but one out.")
