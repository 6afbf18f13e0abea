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
CHANCE = Number(0.0, 1.0, " isn't a probability. Give a number from 0 to 1", metavar="P")
SHARE = Number(metavar="SHARE")
RACE = TwoWhole(
    wanted=f"isn't a race. Give 1 to {LONGEST} games, such as 7, or each player's, such as 7:5",
    metavar="N|M:N",
    one=True,
)
"""The games that each player needs: 7:5, 7-5 or 7/5; 7 alone means 7:7."""
SCORE = TwoWhole(
    low=0,
    wanted=f"isn't a score. Give two numbers from 0 to {LONGEST}, such as 3-0",
    metavar="I:J",
)
SPAN = TwoWhole(
    r"\.\.",
    wanted=f"isn't a range of games. Give the fewest and the most, 1 to {LONGEST}, such as 7..13",
    metavar="LO..HI",
    rising=True,
)
_SCALE = Field(
    SCALE,
    "The scale of the ratings: POINTS double the odds of winning a game.",
    usual="inferred from the ratings",
    more="If the list has a `scale` column, that scale is used; otherwise see [how the scale is "
    "inferred](../files.md#the-scale-of-a-list).",
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
    more="In an m:n race, the longest possible match has m + n − 1 games.",
)
RACE_TO = Field(Whole(1, LONGEST), "Races in which the stronger player needs N games.")
EntrantsFile: TypeAlias = Annotated[
    str | None,
    Field(
        File("FILE"),
        "The entrants: one name per line, or a CSV file with player and rating.",
        more="[Entrants missing from the list](../files.md#entrants) are new players.",
    ),
]
Target: TypeAlias = Annotated[float, Field(CHANCE, "A's target chance of winning.")]
ChartName: TypeAlias = Annotated[str | None, Field(CHART, "The race chart.")]
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
EvenRace: TypeAlias = Annotated[int | None, Field(_RACE, "Play even races to N games.")]
HandicappedRace: TypeAlias = Annotated[
    int | None,
    Field(
        _RACE,
        "Handicapped races: the stronger player races to N; the weaker gets the fairest race.",
    ),
]
ChartOfRaces: TypeAlias = Annotated[
    ChartName, Says("Use the races in this chart of rating differences.")
]
Sure: TypeAlias = Annotated[
    bool, Field(Flag(), "Treat the ratings as exact, even if they have standard errors.")
]
Jobs: TypeAlias = Annotated[
    int,
    Field(
        Whole(1, MOST_JOBS),
        "Number of parallel processes; it doesn't change the answer.",
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
        asked.refuse("{dask} and {jobs} can't be used together; the cluster has its own workers")
    if asked.dask is not None and not asked.dask.strip():
        asked.refuse(
            "{dask} must not be empty. Give the scheduler's address, such as tcp://10.0.0.5:8786."
        )


FormOfDay: TypeAlias = Annotated[
    float | None,
    Field(
        Number(0.0, 3.0, " isn't a number from 0 to 3, such as 0.35", metavar="SD"),
        "Day-to-day form: how much the log-odds of a game vary from match to match.",
        usual="the value in the ratings list, otherwise 0",
        section="Details",
        more="This is a standard deviation; `evenbreak rate` finds its value. See [day-to-day "
        "form](../../explanation/ratings.md#day-to-day-form).",
    ),
]
ByWay: TypeAlias = Annotated[
    Way | None,
    Field(
        Choice(tuple(WAYS)),
        "How the answer is calculated: with a formula, or from the game's graph and matrix.",
        section="Details",
        rare=True,
        more="The methods are the fast formula (kernel), elimination of states, and "
        "eigenvectors; their answers are compared. See [the same answer by another "
        "method](../../how-to/your-own-chain.md#the-same-answer-by-another-method).",
    ),
]


def picture(text: str) -> str:
    """Return the name of a picture that can be written."""
    folder = Path(text).parent
    wrong = ""
    if PurePath(text).suffix.lower() not in (".png", ".svg"):
        wrong = "name a file that ends in .png or .svg"
    elif not folder.exists():
        wrong = f"folder {str(folder)!r} doesn't exist. Create it or choose another"
    elif not folder.is_dir():
        wrong = f"{str(folder)!r} is a file, so no picture can be in it. Choose another folder"
    elif Path(text).is_dir():
        wrong = "that's a folder. Name a file in it"
    if wrong:
        raise InputError(f"{text!r}; {wrong}")
    return text


def folder(text: str) -> str:
    """Return the name of a folder that can be written to."""
    if not text.strip():
        raise InputError("the name is empty. Name a folder, or use . for this one.")
    if Path(text).is_file():
        raise InputError(f"{text!r} is a file. Name a folder.")
    return text


OutFolder: TypeAlias = Annotated[
    str,
    Field(
        Named(folder, "DIR", offers="files"), "Folder for the files; created if it doesn't exist."
    ),
]


PlotFile: TypeAlias = Annotated[
    str | None,
    Field(
        Named(picture, "FILE", offers="files"),
        "Write a chart to FILE (.png or .svg).",
        section="Details",
    ),
]


USUAL_RACE = 7
"""What the stronger player races to unless something else is asked."""


@dataclass(frozen=True, kw_only=True)
class Lengths(Question):
    """The lengths of the races to compare."""

    games: Annotated[tuple[int, int] | None, GAMES] = None
    race_to: Annotated[int | None, RACE_TO, Says(usual=f"{USUAL_RACE} without {{games}}")] = None

    def check(self) -> None:
        """Refuse two limits."""
        if self.games is not None and self.race_to is not None:
            self.refuse("{games} and {race_to} can't be used together. Leave one out.")

    @property
    def lengths(self) -> dict[str, Any]:
        """What limits the races, as `fair_races` takes it."""
        usual = USUAL_RACE if self.games is None and self.race_to is None else self.race_to
        return {"games": self.games, "race_to": usual}


@dataclass(frozen=True, kw_only=True)
class Starters(Question):
    """The rating that new players get."""

    starter: Annotated[
        float | None,
        Field(
            Number(-1e6, 1e6, " isn't a rating. Give a number of points, such as 80"),
            "The rating that a new player gets.",
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
            Number(0.0, 1e6, " isn't a spread. Give 0 or more points, such as 30"),
            "Uncertainty of that rating (standard deviation).",
            usual="one doubling of the odds",
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
            f"a title must be one line of letters that can be printed; this one has {len(title):,}"
        )
    return title


Title: TypeAlias = Annotated[
    str, Field(Named(title_in, "TEXT"), "A title for the sheet, such as the league's name.")
]
PaperName: TypeAlias = Annotated[
    str | None,
    Field(PAPER, "Paper size.", usual="letter where that is standard, otherwise a4"),
]


@dataclass(frozen=True, kw_only=True)
class OnPaper(Question):
    """What to print of a tournament."""

    title: Annotated[
        Title, Says("A title, such as the event's name.", usual="the name of its file")
    ] = ""
    paper: PaperName = None
