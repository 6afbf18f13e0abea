"""A chart: who needs how many games."""

from collections.abc import Sequence

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Part, Table
from evenbreak.answers.wording import race, range_words
from evenbreak.files.charts import chart_table
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.charts.points_chart import PointsChart


def chart_show_answer(
    chart: Chart | LevelChart | PointsChart, *, warnings: Sequence[str] = ()
) -> Answer:
    """Return the races of a chart; as CSV it is a chart file.

    >>> from evenbreak.handicaps import chart
    >>> print(chart_show_answer(chart("npl_8")).sentences[0])
    Equal players race to 4. From a difference of 49 points on, the race is 6:2: the stronger player
    needs 6 games, the weaker 2.
    """
    return Answer(
        f"Chart {chart.name}",
        _parts(chart),
        warnings=warnings,
        data={"chart": chart.name},
        csv=chart_rows(chart),
    )


def _parts(chart: Chart | LevelChart | PointsChart) -> list[Part]:
    if isinstance(chart, PointsChart):
        return _of_points(chart)
    return _by_difference(chart) if isinstance(chart, Chart) else _by_level(chart)


def chart_rows(chart: Chart | LevelChart | PointsChart) -> Table:
    """Return the rows of a chart as a file holds them, and as JSON does under `rows`."""
    columns, rows = chart_table(chart)
    return Table("rows", [Column(name) for name in columns], rows)


def _by_difference(chart: Chart) -> list[Part]:
    first, last = chart.rows[0], chart.rows[-1]
    text = f"Equal players race to {first.stronger_needs}."
    if len(chart.rows) > 1:
        text += (
            f" From a difference of {last.difference_from} points on, the race is "
            f"{race(last[2:])}: the stronger player needs {last.stronger_needs} games, the "
            f"weaker {last.weaker_needs}."
        )
    columns = [
        Column("difference", "difference", left=True),
        Column("race", "race", race),
    ]
    rows = [(range_words(*row[:2]), row[2:]) for row in chart.rows]
    return [text, Table("", columns, rows)]


def _of_points(chart: PointsChart) -> list[Part]:
    columns = [Column("level", "level", left=True), Column("points", "points to win")]
    rows = list(zip(chart.levels, chart.points, strict=True))
    return [
        "Each player plays to the points of their own level, whoever the opponent is.",
        Table("", columns, rows),
    ]


def _by_level(chart: LevelChart) -> list[Part]:
    columns = [
        Column("level", "level", left=True),
        *(Column(f"against {level}", f"v {level}", race) for level in chart.levels),
    ]
    rows = [(own, *(chart.race(own, other) for other in chart.levels)) for own in chart.levels]
    return [
        "In each race the first number is what the level of that row needs, the second what the "
        "level of that column needs.",
        Table("", columns, rows),
    ]
