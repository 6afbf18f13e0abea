"""Look up charts by name: every function that takes a chart also takes a catalog name."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeVar, cast

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import CHARTS, Chart, chart
from evenbreak.handicaps.charts.level_chart import (
    LEVEL_CHARTS,
    POINTS_CHARTS,
    LevelChart,
    PointsChart,
    level_chart,
    points_chart,
)
from evenbreak.ratings.scale import SCALES, Scale

EVERY_CHART = {**CHARTS, **LEVEL_CHARTS, **POINTS_CHARTS}
"""Titles of all built-in charts, by name."""

AnyChart = TypeVar("AnyChart", Chart, LevelChart, PointsChart)


def scale_of_chart(chart: Chart | LevelChart | PointsChart | None) -> Scale | None:
    """Return the scale that goes with a chart; None if there is no chart or its scale is unknown.

    Skill levels have points on the Fargo scale; the name of a chart of differences tells its scale.

    >>> [scale_of_chart(one).name for one in (chart("npl_10"), level_chart("apa_8ball"))]
    ['npl', 'fargo']
    """
    if isinstance(chart, LevelChart | PointsChart):
        return SCALES["fargo"]
    return None if chart is None else SCALES.get(chart.name.partition("_")[0])


def chart_names() -> list[str]:
    """Return the names of all charts, built-in and from installed packages."""
    from evenbreak.plugins import added

    return [*{**EVERY_CHART, **added("chart")}]


def catalog_name(text: str) -> str:
    """Return the catalog name of a chart, in any spelling.

    >>> catalog_name(" NPL-10 "), catalog_name("APA 8-Ball")
    ('npl_10', 'apa_8ball')
    """
    return re.sub(r"(?<=\d)_ball$", "ball", re.sub(r"[-\s]+", "_", text.strip().lower()))


def named_chart(name: str) -> Chart | LevelChart | PointsChart | None:
    """Return a chart from the catalog or an installed package; None if no chart has this name.

    Raises
    ------
    InputError
        if a package has a chart of this name that breaks a rule (`broken_chart_laws`).

    >>> named_chart("APA 9-ball").points[-1], named_chart("nobody's")
    (75, None)
    """
    key = catalog_name(name)
    for kind in _KINDS.values():
        if key in kind.names:
            return cast("Chart | LevelChart | PointsChart", kind.read(key))
    from evenbreak.handicaps.charts.laws import lawful_chart
    from evenbreak.plugins import plugin

    return cast("Chart | LevelChart | PointsChart | None", plugin("chart", name, lawful_chart))


def chart_of(chart_or_name: Any) -> Chart:
    """Return a chart by rating difference: a `Chart` unchanged, or one of `CHARTS` by name.

    Raises
    ------
    InputError
        if it is neither; a chart by skill level has no rating differences.

    >>> chart_of("NPL 10").race(12)
    (5, 4)
    >>> chart_of("apa_8ball")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: chart must be a chart by rating difference: fargo_r6_hot, npl_8,
        npl_10, npl_12, npl_20, or a Chart of your own; you gave 'apa_8ball', a chart by skill level
    """
    return _found(chart_or_name, Chart)


def level_chart_of(chart_or_name: Any) -> LevelChart:
    """Return a chart by skill level: a `LevelChart` unchanged, or one of `LEVEL_CHARTS` by name.

    Raises
    ------
    InputError
        if it is neither.

    >>> level_chart_of("APA 8ball").race(5, 3)
    (4, 2)
    """
    return _found(chart_or_name, LevelChart)


def points_chart_of(chart_or_name: Any) -> PointsChart:
    """Return a chart of points: a `PointsChart` unchanged, or one of `POINTS_CHARTS` by name.

    Raises
    ------
    InputError
        if it is neither.

    >>> points_chart_of("APA 9ball").race(5, 3)
    (38, 25)
    """
    return _found(chart_or_name, PointsChart)


class _Kind(NamedTuple):
    """A kind of chart: its name in words, its catalog names, and the function that reads one."""

    words: str
    names: Mapping[str, str]
    read: Callable[[str], Any]


_KINDS: dict[type, _Kind] = {
    Chart: _Kind("a chart by rating difference", CHARTS, chart),
    LevelChart: _Kind("a chart by skill level", LEVEL_CHARTS, level_chart),
    PointsChart: _Kind("a chart of points", POINTS_CHARTS, points_chart),
}


def _found(wanted: Any, cls: type[AnyChart]) -> AnyChart:
    """Return a chart of one kind, unchanged or by its name, or raise an error."""
    if isinstance(wanted, cls):
        return wanted
    kind, named = _KINDS[cls], wanted
    if isinstance(wanted, str) and isinstance(named := named_chart(wanted), cls):
        return named
    others = (
        f", {other_kind.words}"
        for other_class, other_kind in _KINDS.items()
        if isinstance(named, other_class)
    )
    shown = wanted.name if isinstance(wanted, Chart | LevelChart | PointsChart) else wanted
    raise InputError(
        "chart must be {words}: {names}, or a {name} of your own; you gave {shown!r}{others}",
        shown=shown,
        others="".join(others),
        words=kind.words,
        names=", ".join(kind.names),
        name=cls.__name__,
    )
