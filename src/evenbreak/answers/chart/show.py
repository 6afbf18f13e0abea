"""All charts and systems, and a chart's races."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, in_files, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.wording import count_of, percent, range_words
from evenbreak.errors import InputError
from evenbreak.files.charts import chart_table, find_chart_file
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import EVERY_CHART, catalog_name, named_chart
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.systems.team_handicap import TeamHandicap, team_handicap
from evenbreak.plugins import Kind, added
from evenbreak.questions.charts import ChartShow, ChartTeam
from evenbreak.ratings.scale import Scale
from evenbreak.words import race


def chart_list_answer(_: object = None) -> Answer:
    """Return the charts, ours and installed packages', with their races.

    >>> [row["chart"] for row in chart_list_answer().to_dict()["charts"]][-1]
    'apa_9ball'
    """
    ours = {name: named_chart(name) for name in EVERY_CHART}
    theirs, warnings = _added("chart", named_chart, lambda name: catalog_name(name) in EVERY_CHART)
    charts = [*ours.values(), *theirs.values()]
    kinds = [sum(isinstance(chart, kind) for chart in charts) for kind in _LOOKED_UP]
    return Answer(
        "Handicap charts",
        [
            f"There are {count_of(kinds[0], 'chart')} by rating difference, "
            f"{count_of(kinds[1], 'chart')} by skill level and "
            f"{count_of(kinds[2], 'chart')} of points by skill level. `evenbreak chart "
            "show NAME` prints a chart; `evenbreak matchups --chart NAME` takes tonight's "
            f"races from it, unless it's a chart of points.",
            Table(
                "charts",
                columns_of("chart_name what looked_up_by even_race longest_games -races"),
                [
                    *((name, EVERY_CHART[name], *_races(chart)) for name, chart in ours.items()),
                    *(
                        (name, f"of the package {package}", *_races(chart))
                        for (name, package), chart in theirs.items()
                    ),
                ],
            ),
        ],
        warnings=warnings,
    )


def system_list_answer(_: object = None) -> Answer:
    """Return the handicap systems, ours and installed packages'.

    >>> system_list_answer().to_dict()["systems"][0]["name"]
    'npl'
    """
    from evenbreak.handicaps.systems.catalog import FAMILIES, is_ours, system_of

    ours = [
        (family.grammar, family.make(*family.samples[0]), "evenbreak")
        for family in FAMILIES.values()
    ]
    theirs, warnings = _added("system", system_of, is_ours)
    every = [*ours, *((name, system, package) for (name, package), system in theirs.items())]
    return Answer(
        "Handicap systems",
        [
            "`evenbreak simulate PLAYERS.csv --compare NAME --compare NAME` plays seasons under "
            "several systems and compares them.",
            Table(
                "systems",
                columns_of("system_name own_chart package -system_rule"),
                [
                    (name, getattr(system.chart, "name", None), package, system.in_words)
                    for name, system, package in every
                ],
            ),
        ],
        warnings=warnings,
    )


def _added(
    kind: Kind, find: Callable[[str], Any], is_ours: Callable[[str], bool]
) -> tuple[dict[tuple[str, str], Any], list[str]]:
    """Return what installed packages add, by name and package, and why any of it is left out."""
    found, warnings = {}, []
    for name, package in added(kind).items():
        if is_ours(name):
            warnings.append(f"{kind} {name!r} in package {package} is hidden by evenbreak's own")
            continue
        try:
            found[name, package] = find(name)
        except InputError as error:
            warnings.append(str(error))
    return found, warnings


_LOOKED_UP = {Chart: "difference", LevelChart: "skill level", PointsChart: "skill level"}


def _races(chart: Any) -> tuple[Any, ...]:
    by = next(words for kind, words in _LOOKED_UP.items() if isinstance(chart, kind))
    if isinstance(chart, PointsChart):
        return by, None, None, None
    if isinstance(chart, Chart):
        races = {tuple(row[2:]) for row in chart.rows}
    else:
        races = {chart.race(i, j) for i in chart.levels for j in chart.levels if i >= j}
    even = [m for m, n in races if m == n]
    return by, (min(even), max(even)), max(m + n - 1 for m, n in races), len(races)


def chart_show_answer(
    chart: Chart | LevelChart | PointsChart, *, warnings: Sequence[str] = ()
) -> Answer:
    """Return a chart's races; the CSV is a chart file.

    >>> from evenbreak.handicaps import chart
    >>> print(chart_show_answer(chart("npl_8")).sentences[0])
    Equal players race to 4. At a difference of 49 points or more, the race is 6:2: the stronger
    player needs 6 games and the weaker player 2.
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
    """Return a chart's rows as in a file, and as in JSON under `rows`."""
    columns, rows = chart_table(chart)
    return Table("rows", in_files(columns), rows)


def _by_difference(chart: Chart) -> list[Part]:
    first, last = chart.rows[0], chart.rows[-1]
    text = f"Equal players race to {first.stronger_needs}."
    if len(chart.rows) > 1:
        text += (
            f" At a difference of {last.difference_from} points or more, the race is "
            f"{race(last[2:])}: the stronger player needs {last.stronger_needs} games and the "
            f"weaker player {last.weaker_needs}."
        )
    columns = columns_of("difference race")
    rows = [(range_words(*row[:2]), row[2:]) for row in chart.rows]
    return [text, Table("", columns, rows)]


def _of_points(chart: PointsChart) -> list[Part]:
    columns = columns_of("level points_needed")
    rows = list(zip(chart.levels, chart.points, strict=True))
    return [
        "Each player plays to the points for their own level, whoever the opponent is.",
        Table("", columns, rows),
    ]


def _by_level(chart: LevelChart) -> list[Part]:
    columns = [*columns_of("level"), *(column_of("against", level=level) for level in chart.levels)]
    rows = [(own, *(chart.race(own, other) for other in chart.levels)) for own in chart.levels]
    return [
        "In each race, the first number is how many games the row's level needs, and the second "
        "is how many the column's level needs.",
        Table("", columns, rows),
    ]


def team_handicap_answer(
    averages: tuple[float, float], found: TeamHandicap, *, match_ups: int, scale: Scale
) -> Answer:
    """Return the handicap for a round between two teams with these average ratings.

    >>> from evenbreak.handicaps import team_handicap
    >>> from evenbreak.ratings import SCALES
    >>> fargo = SCALES["fargo"]
    >>> asked = {"match_ups": 3, "scale": fargo}
    >>> print(team_handicap_answer((417, 447), team_handicap(417, 447), **asked).sentences[0])
    Team 1 gets 4 points a round.
    """
    first, second = averages
    return Answer(
        f"Team 1 averages {first:g} and team 2 averages {second:g}, {scale_words(scale)}",
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
            "Every game is treated as one between two players with their teams' average "
            "ratings. In 17-point scoring, a game's winner averages 13.19 points and its loser "
            "3.81. CSI publishes an example but not these numbers; they are the ones that "
            "reproduce it."
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
        f"{text} That difference is rounded down and then multiplied by {found.games}, the "
        f"number of games in a match-up. It would take {found.even_points:.2f} points to make "
        f"the round even, so rounding costs the weaker team {percent(found.given_away)} of them."
    )


def show(asked: ChartShow) -> Answer:
    """Return a chart's races."""
    file = find_chart_file(asked.chart)
    return chart_show_answer(file.chart, warnings=file.warnings)


def team(asked: ChartTeam) -> Answer:
    """Return the points given to the weaker of two teams."""
    handicap = team_handicap(
        asked.average_1,
        asked.average_2,
        match_ups=asked.match_ups,
        games=asked.single_games,
        points_won=asked.won,
        points_lost=asked.lost,
        scale=asked.scale,
    )
    return team_handicap_answer(
        (asked.average_1, asked.average_2), handicap, match_ups=asked.match_ups, scale=asked.scale
    )
