"""The door for charts: wherever a function takes a chart, a name of the catalogue will do."""

from __future__ import annotations

import re
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import CHARTS, Chart, chart
from evenbreak.handicaps.charts.level_chart import LEVEL_CHARTS, LevelChart, level_chart
from evenbreak.handicaps.charts.points_chart import POINTS_CHARTS, PointsChart, points_chart


def catalogue_name(text: str) -> str:
    """Return what a chart of the catalogue is called, however its name was typed.

    >>> catalogue_name(" NPL-10 ")
    'npl_10'
    """
    return re.sub(r"[-\s]+", "_", text.strip().lower())


def chart_of(chart_or_name: Any) -> Chart:
    """Return a chart by rating difference: a `Chart` as it is, or one of `CHARTS` by its name.

    Raises
    ------
    InputError
        if it is neither; a chart by skill level has no rating differences.

    >>> chart_of("NPL 10").race(12)
    (5, 4)
    >>> chart_of("apa_8ball")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: chart is 'apa_8ball', a chart by skill level; give a chart by
    rating difference: fargo_r6_hot, npl_8, npl_10, npl_12, npl_20, or a Chart of your own
    """
    if isinstance(chart_or_name, Chart):
        return chart_or_name
    name = _name(chart_or_name)
    if name in CHARTS:
        return chart(name)
    raise _refused(
        chart_or_name,
        f"a chart by rating difference: {', '.join(CHARTS)}, or a Chart of your own",
        _kind(chart_or_name),
    )


def level_chart_of(chart_or_name: Any) -> LevelChart:
    """Return a chart by skill level: a `LevelChart` as it is, or one of `LEVEL_CHARTS`.

    Raises
    ------
    InputError
        if it is neither.

    >>> level_chart_of("APA 8ball").race(5, 3)
    (4, 2)
    """
    if isinstance(chart_or_name, LevelChart):
        return chart_or_name
    name = _name(chart_or_name)
    if name in LEVEL_CHARTS:
        return level_chart(name)
    raise _refused(
        chart_or_name,
        f"a chart by skill level: {', '.join(LEVEL_CHARTS)}, or a LevelChart of your own",
        _kind(chart_or_name),
    )


def points_chart_of(chart_or_name: Any) -> PointsChart:
    """Return a chart of points: a `PointsChart` as it is, or one of `POINTS_CHARTS` by name.

    Raises
    ------
    InputError
        if it is neither.

    >>> points_chart_of("APA 9ball").race(5, 3)
    (38, 25)
    """
    if isinstance(chart_or_name, PointsChart):
        return chart_or_name
    name = _name(chart_or_name)
    if name in POINTS_CHARTS:
        return points_chart(name)
    raise _refused(
        chart_or_name,
        f"a chart of points: {', '.join(POINTS_CHARTS)}, or a PointsChart of your own",
        _kind(chart_or_name),
    )


def _name(given: Any) -> str:
    return catalogue_name(given) if isinstance(given, str) else ""


def _kind(given: Any) -> str:
    """Return which other kind of chart it is, if it is one."""
    name = _name(given)
    if isinstance(given, Chart) or name in CHARTS:
        return "a chart by rating difference"
    if isinstance(given, LevelChart) or name in LEVEL_CHARTS:
        return "a chart by skill level"
    return "a chart of points" if isinstance(given, PointsChart) or name in POINTS_CHARTS else ""


def _refused(given: Any, wanted: str, kind: str) -> InputError:
    shown = given.name if isinstance(given, Chart | LevelChart | PointsChart) else given
    return InputError(f"chart is {shown!r}{', ' if kind else ''}{kind}; give {wanted}")
