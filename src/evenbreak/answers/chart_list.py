"""The charts that come with the package."""

from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.wording import count_of
from evenbreak.handicaps.charts.chart import CHARTS, chart
from evenbreak.handicaps.charts.level_chart import LEVEL_CHARTS, level_chart
from evenbreak.handicaps.charts.points_chart import POINTS_CHARTS


def chart_list_answer() -> Answer:
    """Return the charts that come with the package, with the races of each.

    >>> [row["chart"] for row in chart_list_answer().to_dict()["charts"]][-1]
    'apa_9ball'
    """
    return Answer(
        "Handicap charts that come with evenbreak",
        [
            f"There are {count_of(len(CHARTS), 'chart')} by rating difference, "
            f"{count_of(len(LEVEL_CHARTS), 'chart')} by skill level and "
            f"{count_of(len(POINTS_CHARTS), 'chart')} of points by skill level. `evenbreak chart "
            "show NAME` prints one; `evenbreak matchups --chart NAME` takes tonight's races from "
            "one, unless it is a chart of points.",
            Table(
                "charts",
                [
                    Column("chart", "name", left=True),
                    Column("what", "full name", left=True),
                    Column("looked_up_by", "looked up by", left=True),
                    Column(("even_race_from", "even_race_to"), "equals\nrace to", _even),
                    Column("longest_games", "games\nat most"),
                    Column("races"),
                ],
                [
                    _row(name, title)
                    for name, title in {**CHARTS, **LEVEL_CHARTS, **POINTS_CHARTS}.items()
                ],
            ),
        ],
    )


def _row(name: str, title: str) -> tuple[Any, ...]:
    if name in POINTS_CHARTS:
        return name, title, "skill level", None, None, None
    if name in CHARTS:
        by, races = "difference", {row[2:] for row in chart(name).rows}
    else:
        table = level_chart(name)
        pairs = [(i, j) for i in table.levels for j in table.levels if i >= j]
        by, races = "skill level", {table.race(*pair) for pair in pairs}
    even = [m for m, n in races if m == n]
    longest = max(m + n - 1 for m, n in races)
    return name, title, by, (min(even), max(even)), longest, len(races)


def _even(ends: tuple[int, int] | None) -> str:
    if ends is None:
        return "points"
    first, last = ends
    return str(first) if first == last else f"{first} to {last}"
