"""Fields that several questions have, each declared once."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Annotated, Any, TypeAlias

from evenbreak.chains.ways import WAYS, Way
from evenbreak.errors import InputError
from evenbreak.fields.kinds import LONGEST, Choice, File, Flag, Named, Number, Text, TwoWhole, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.files.league.values import PAPER, SCALE
from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES, Scale
from evenbreak.tournaments.evening.format import LONGEST_RACE

HIGHEST_SEED = 2**32 - 1
MOST_JOBS = 512


def chart_names() -> list[str]:
    """Return the names of charts, ours and those of installed packages."""
    from evenbreak.handicaps.charts import chart_of

    return chart_of.chart_names()


def chip_names() -> list[str]:
    """Return the names of the chip charts that come with the program."""
    from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS

    return list(CHIP_CHARTS)


CHART = File("NAME|FILE", chart_names)
CHIPS = File("NAME|FILE.csv", chip_names)
CHANCE = Number(0.0, 1.0, " is not a probability; give a number from 0 to 1", metavar="P")
SHARE = Number(metavar="SHARE")
RACE = TwoWhole(
    wanted=f"give a whole number from 1 to {LONGEST}, such as 7, "
    "or one for each player with a colon between them, such as 7:5",
    metavar="N|M:N",
    one=True,
)
"""The games that each player needs: 7:5, 7-5 or 7/5; 7 alone means 7:7."""
SCORE = TwoWhole(
    low=0,
    wanted=f"give two whole numbers from 0 to {LONGEST} with a colon between them, such as 3:0",
    metavar="I:J",
)
SPAN = TwoWhole(
    r"\.\.",
    wanted=f"give the least and the most games, from 1 to {LONGEST}, "
    "with two dots between them, such as 7..13",
    metavar="LO..HI",
    rising=True,
)
_SCALE = Field(
    SCALE,
    "The scale of the ratings: POINTS double the odds of winning a game.",
    usual="what the ratings show",
    more="Unless given, [the one that the ratings show]"
    "(../files.md#the-scale-of-a-list), or that the list states in its column `scale`.",
)
ScaleOf: TypeAlias = Annotated[Scale | None, _SCALE]
OnScale: TypeAlias = Annotated[Scale, _SCALE, Says(usual="", more="")]
"""A scale that does not depend on a list."""
ScaleByChart: TypeAlias = Annotated[Scale | None, _SCALE, Says(usual="npl; levels: fargo", more="")]
"""The scale of estimated ratings, which is that of `handicaps.scale_of_chart` unless given."""

NPL = SCALES[DEFAULT_SCALE]
Seed: TypeAlias = Annotated[
    int, Field(Whole(0, HIGHEST_SEED), "The seed of all random draws.", rare=True)
]
GAMES = Field(
    SPAN,
    "Races whose longest possible match has LO to HI games.",
    more="The longest possible match of a race m:n has m + n − 1 games.",
)
RACE_TO = Field(Whole(1, LONGEST), "Races in which the stronger player needs N games.")
EntrantsFile: TypeAlias = Annotated[
    str | None,
    Field(
        File("FILE"),
        "Who has entered: a name on each line, or a CSV file with player and rating.",
        more="[Those who are not on the list](../files.md#entrants) are new players.",
    ),
]
Target: TypeAlias = Annotated[float, Field(CHANCE, "The chance of winning that A should have.")]
ChartName: TypeAlias = Annotated[str | None, Field(CHART, "The chart of the races.")]
LevelResults: TypeAlias = Annotated[
    str | None,
    Field(
        File("RESULTS.csv"),
        "With a chart by skill level: the league's own results, to show how strong its levels are.",
        usual="other leagues' results, else the chart",
        more="See [what a level is worth](../../explanation/charts.md#skill-levels).",
    ),
]
_RACE = Whole(1, LONGEST_RACE)
EvenRace: TypeAlias = Annotated[int | None, Field(_RACE, "Even races to N games.")]
HandicappedRace: TypeAlias = Annotated[
    int | None,
    Field(
        _RACE,
        "Handicapped races instead: the stronger player needs N games, the weaker as many as is "
        "fairest.",
    ),
]
ChartOfRaces: TypeAlias = Annotated[
    ChartName, Says("Races by this chart of rating differences instead.")
]
Sure: TypeAlias = Annotated[
    bool, Field(Flag(), "Take the ratings as right, even if they have standard errors.")
]
Jobs: TypeAlias = Annotated[
    int,
    Field(
        Whole(1, MOST_JOBS),
        "How many processes work at a time; the answer is the same.",
        metavar="J",
    ),
]
Dask: TypeAlias = Annotated[
    str | None,
    Field(
        Text("ADDRESS"),
        "Use the dask cluster whose scheduler is at ADDRESS, such as tcp://10.0.0.5:8786.",
        more="Needs the extra `evenbreak[dask]`.",
    ),
]


def has_levels(chart: str | None) -> bool:
    """Return whether a chart, by its name or in a file, is one of games by skill level."""
    if chart is None:
        return False
    from evenbreak.files.charts import find_chart
    from evenbreak.handicaps.charts.level_chart import LevelChart

    return chart == "-" or isinstance(find_chart(chart), LevelChart)


def refuse_workers(asked: Any) -> None:
    """Refuse two kinds of workers at once, and a cluster without an address."""
    if asked.dask is not None and asked.jobs > 1:
        asked.refuse("{dask} and {jobs} cannot be combined; the cluster has workers of its own")
    if asked.dask is not None and not asked.dask.strip():
        asked.refuse("{dask} is empty; give the scheduler's address, such as tcp://10.0.0.5:8786")


FormOfDay: TypeAlias = Annotated[
    float | None,
    Field(
        Number(0.0, 3.0, "; give a number from 0 to 3, such as 0.35", metavar="SD"),
        "Form of the day: how much the log-odds of a game vary from match to match.",
        usual="what the list of ratings states, else 0",
        section="Details",
        more="A standard deviation, as `evenbreak rate` finds it; see [form of the day]"
        "(../../explanation/ratings.md#day-to-day-form).",
    ),
]
ByWay: TypeAlias = Annotated[
    Way | None,
    Field(
        Choice(tuple(WAYS)),
        "The way to the answer: a formula, or the game's graph and matrix.",
        section="Details",
        rare=True,
        more="The fast formula (kernel), elimination of states, or eigenvectors; they are "
        "compared. See [the same answer by another way]"
        "(../../how-to/your-own-chain.md#the-same-answer-by-another-way).",
    ),
]


def picture(text: str) -> str:
    """Return the name of a picture that can be written."""
    folder = Path(text).parent
    wrong = ""
    if PurePath(text).suffix.lower() not in (".png", ".svg"):
        wrong = "name a file that ends in .png or .svg"
    elif not folder.exists():
        wrong = f"there is no folder {str(folder)!r}; make it first, or name another"
    elif not folder.is_dir():
        wrong = f"{str(folder)!r} is a file, so no picture can be in it; name a folder"
    elif Path(text).is_dir():
        wrong = "that is a folder; name a file in it"
    if wrong:
        raise InputError(f"{text!r}; {wrong}")
    return text


def folder(text: str) -> str:
    """Return the name of a folder that can be written to."""
    if not text.strip():
        raise InputError("the name is empty; name a folder, or . for this one")
    if Path(text).is_file():
        raise InputError(f"{text!r} is a file; name a folder")
    return text


OutFolder: TypeAlias = Annotated[
    str,
    Field(
        Named(folder, "DIR", offers="files"), "Where the files go; created if it does not exist."
    ),
]


PlotFile: TypeAlias = Annotated[
    str | None,
    Field(
        Named(picture, "FILE", offers="files"),
        "Write a picture: PNG or SVG, by the ending of FILE.",
        section="Details",
    ),
]


USUAL_RACE = 7
"""What the stronger player races to unless something else is asked."""


@dataclass(frozen=True, kw_only=True)
class Lengths(Question):
    """How long the races may be that are looked at."""

    games: Annotated[tuple[int, int] | None, GAMES] = None
    race_to: Annotated[
        int | None, RACE_TO, Says(usual=f"{USUAL_RACE}, unless {{games}} is given")
    ] = None

    def check(self) -> None:
        """Refuse two limits."""
        if self.games is not None and self.race_to is not None:
            self.refuse("{games} and {race_to} cannot be combined; leave one out")

    @property
    def lengths(self) -> dict[str, Any]:
        """What limits the races, as `fair_races` takes it."""
        usual = USUAL_RACE if self.games is None and self.race_to is None else self.race_to
        return {"games": self.games, "race_to": usual}


@dataclass(frozen=True, kw_only=True)
class Starters(Question):
    """How strong a new player is."""

    starter: Annotated[
        float | None,
        Field(
            Number(-1e6, 1e6, " is not a number of rating points; give one such as 80"),
            "The rating of a new player.",
            usual="the middle of the scale",
            more="80 on the NPL scale, 500 on Fargo's, 1500 on Elo's.",
            metavar="RATING",
            section="Ratings",
            rare=True,
        ),
    ] = None
    starter_sd: Annotated[
        float | None,
        Field(
            Number(0.0, 1e6, " is not a spread; give 0 or more points, such as 30"),
            "How far off that may be (standard deviation).",
            usual="what doubles the odds",
            metavar="POINTS",
            section="Ratings",
            rare=True,
        ),
    ] = None


def title_in(text: str) -> str:
    """Return the title of a sheet, or refuse one that cannot be printed on a line."""
    # Numpy is not loaded before a title is given.
    from evenbreak.files.tables.names import clean_name, is_name

    title: str = clean_name(text)
    if title and not is_name(title):
        raise InputError(
            f"it has {len(title):,} letters, or some that cannot be printed; give a line"
        )
    return title


Title: TypeAlias = Annotated[
    str, Field(Named(title_in, "TEXT"), "A title for the sheet, such as the league's name.")
]
PaperName: TypeAlias = Annotated[
    str | None,
    Field(PAPER, "The paper of what is printed.", usual="letter where that is usual, else a4"),
]


@dataclass(frozen=True, kw_only=True)
class OnPaper(Question):
    """What is drawn of a tournament to be printed."""

    title: Annotated[
        Title, Says("A title, such as the name of the event.", usual="the name of its file")
    ] = ""
    paper: PaperName = None
