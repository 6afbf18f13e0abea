"""Races from the league's chart, for results that state levels or ratings but no races."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.charts import find_chart
from evenbreak.files.tables.problems import warning
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import PointsChart
from evenbreak.handicaps.charts.played_chart import level_numbers_of
from evenbreak.ratings.results import Results
from evenbreak.words import race, say, say_count


def races_by_chart(
    results: Results,
    chart: str | Path,
    lines: NDArray[np.int64],
    source: str,
    *,
    points: bool = False,
) -> tuple[Results, list[str]]:
    """Return results with the races that a chart sets for the levels or ratings stated in them.

    A race stays unknown if both players reached their target or neither did, if it's a points
    chart, or if no levels are stated. With `points`, scores under a points chart are points, and
    the chart sets the points to win.
    """
    of_league = find_chart(chart)
    race_a, race_b = (needed.copy() for needed in results.races)
    score_a, score_b = results.score_a, results.score_b
    unset = results.counted & (race_a == 0) & (race_b == 0) & (score_a + score_b > 0)
    if not unset.any():
        return results, []
    if isinstance(of_league, PointsChart) and not points:
        text = say(
            "{chart} is a points chart, so it doesn't set races in games here, and scores are "
            "read as games",
            chart=of_league.name,
        )
        return results, [warning(source, None, text)]
    if results.level_a is None or results.level_b is None:
        text = say(
            "{chart} sets no races here, because the columns {level_a} and {level_b} are missing",
            chart=of_league.name,
            level_a="level_a",
            level_b="level_b",
        )
        return results, [warning(source, None, text)]
    stated = tuple(level_numbers_of(results))
    missing = np.isnan(stated[0]) | np.isnan(stated[1])
    if isinstance(of_league, Chart):
        known = ~missing
        a, b = (np.floor(level[known] + 0.5) for level in stated)
        needs: Any = of_league.races(a - b)
    else:
        known = np.isin(stated[0], of_league.levels) & np.isin(stated[1], of_league.levels)
        a, b = (level[known] for level in stated)
        if isinstance(of_league, PointsChart):
            needs = [np.interp(level, of_league.levels, of_league.points) for level in (a, b)]
        else:
            needs = of_league.races(a, b)
    m, n = np.zeros_like(race_a), np.zeros_like(race_b)
    m[known], n[known] = needs
    ends = ((score_a == m) & (score_b < n)) | ((score_b == n) & (score_a < m))
    filled = unset & known & ends
    race_a[filled], race_b[filled] = m[filled], n[filled]
    told: list[str] = []
    if filled.any():
        text = say_count(
            "{n} match gets its race from {chart}, based on the levels given",
            "{n:,} matches get their races from {chart}, based on the levels given",
            int(filled.sum()),
            chart=of_league.name,
        )
        told.append(warning(source, None, text))
    if (unknown := unset & ~known).any():
        text = say_count(
            "{n} match has neither a race nor levels from {chart}; it counts game by game, with "
            "no winner unless one is given",
            "{n:,} matches, starting with this one, have neither a race nor levels from "
            "{chart}; they count game by game, with no winner unless one is given",
            int(unknown.sum()),
            chart=of_league.name,
        )
        told.append(warning(source, lines[unknown.argmax()] if len(lines) else None, text))
    if (unfit := unset & known & ~ends).any():
        row = int(unfit.argmax())
        text = say_count(
            "the score {a}-{b} doesn't complete the {race} race for the levels given. Check it.",
            "the score {a}-{b} doesn't complete the {race} race for the levels given (and "
            "{more:,} more like this). Check them.",
            int(unfit.sum()),
            a=int(score_a[row]),
            b=int(score_b[row]),
            race=race((int(m[row]), int(n[row]))),
            more=int(unfit.sum()) - 1,
        )
        told.append(warning(source, lines[row] if len(lines) else None, text))
    return replace(results, race_a=race_a, race_b=race_b), told
