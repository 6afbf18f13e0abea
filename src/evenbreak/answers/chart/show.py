"""The charts that come with the package."""

from collections.abc import Sequence
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, in_files, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.wording import count_of, percent, race, range_words
from evenbreak.files.charts import chart_table
from evenbreak.handicaps.charts.chart import CHARTS, Chart, chart
from evenbreak.handicaps.charts.level_chart import (
    LEVEL_CHARTS,
    POINTS_CHARTS,
    LevelChart,
    PointsChart,
    level_chart,
)
from evenbreak.handicaps.systems.team_handicap import TeamHandicap
from evenbreak.ratings.scale import Scale


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
                columns_of("chart_name what looked_up_by even_race longest_games -races"),
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
    return Table("rows", in_files(columns), rows)


def _by_difference(chart: Chart) -> list[Part]:
    first, last = chart.rows[0], chart.rows[-1]
    text = f"Equal players race to {first.stronger_needs}."
    if len(chart.rows) > 1:
        text += (
            f" From a difference of {last.difference_from} points on, the race is "
            f"{race(last[2:])}: the stronger player needs {last.stronger_needs} games, the "
            f"weaker {last.weaker_needs}."
        )
    columns = columns_of("difference race")
    rows = [(range_words(*row[:2]), row[2:]) for row in chart.rows]
    return [text, Table("", columns, rows)]


def _of_points(chart: PointsChart) -> list[Part]:
    columns = columns_of("level points_needed")
    rows = list(zip(chart.levels, chart.points, strict=True))
    return [
        "Each player plays to the points of their own level, whoever the opponent is.",
        Table("", columns, rows),
    ]


def _by_level(chart: LevelChart) -> list[Part]:
    columns = [*columns_of("level"), *(column_of("against", level=level) for level in chart.levels)]
    rows = [(own, *(chart.race(own, other) for other in chart.levels)) for own in chart.levels]
    return [
        "In each race the first number is what the level of that row needs, the second what the "
        "level of that column needs.",
        Table("", columns, rows),
    ]


def team_handicap_answer(
    averages: tuple[float, float], found: TeamHandicap, *, match_ups: int, scale: Scale
) -> Answer:
    """Return the handicap of a round between two teams of these average ratings.

    >>> from evenbreak.handicaps import team_handicap
    >>> from evenbreak.ratings import SCALES
    >>> fargo = SCALES["fargo"]
    >>> asked = {"match_ups": 3, "scale": fargo}
    >>> print(team_handicap_answer((417, 447), team_handicap(417, 447), **asked).sentences[0])
    Team 1 gets 4 points a round.
    """
    first, second = averages
    return Answer(
        f"Team 1 rated {first:g} on average, team 2 {second:g}, {scale_words(scale)}",
        [
            _in_words(found),
            _how(found, match_ups),
            Quantities(
                quantities_of(
                    {
                        "average_1": first,
                        "average_2": second,
                        "p_game_1": found.p_game_1,
                        "scored_1": found.scored_1,
                        "scored_2": found.scored_2,
                        "points_a_round": found.points,
                        "to_team": found.to_team,
                        "even_points": found.even_points,
                        "-given_away": found.given_away,
                    }
                )
            ),
        ],
        details=[
            "Every game is taken to be between two players of their teams' average ratings. The "
            "17-point scores of a game average 13.19 for the winner and 3.81 for the loser: CSI "
            "publishes an example, not these numbers, and they are the ones that reproduce it."
        ],
    )


def _in_words(found: TeamHandicap) -> str:
    if found.to_team is None:
        return "Neither team gets points."
    return f"Team {found.to_team} gets {count_of(found.points, 'point')} a round."


def _how(found: TeamHandicap, match_ups: int) -> str:
    gap = abs(found.scored_1 - found.scored_2)
    each = f"{found.scored_1:.2f} and {found.scored_2:.2f} points"
    pairs = count_of(match_ups, "match-up")
    text = f"Over one game in each of {pairs}, the teams should score {each}, {gap:.2f} apart."
    if not found.given_away:
        return text
    return (
        f"{text} That is rounded down and then multiplied by the games of a match-up, "
        f"{found.games}. {found.even_points:.2f} points would make the round even, so the rounding "
        f"keeps {percent(found.given_away)} of them from the weaker team."
    )
