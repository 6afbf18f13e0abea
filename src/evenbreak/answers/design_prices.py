"""What each wish for a chart costs: the same design without it, and with shorter matches."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.parts import Column, Table
from evenbreak.answers.kit.wording import count_of, decimals
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.measure import measure_chart

if TYPE_CHECKING:
    from evenbreak.answers.chart_design import DesignTask

MOST_SHORTER = 4
"""The most charts with shorter matches that are listed."""


def design_prices(task: DesignTask, made: Chart, up_to: int) -> Table | None:
    """Return the designed chart beside those without each wish; None if they are all the same.

    Unfairness is measured from the target, whatever the rule and the tilt of the design.
    """
    rows = [("this chart", made)]
    for what, other in _others(replace(task, up_to=up_to)):
        if all(other.rows != chart.rows for _, chart in rows):
            rows.append((what, other))
    if len(rows) == 1:
        return None
    columns = [
        Column("design", "chart", left=True),
        Column("mean_unfairness", "unfair, on\naverage", decimals(3)),
        Column("worst_unfairness", "at worst", decimals(3)),
        Column("mean_games", "games, on\naverage", decimals(1)),
        Column("games_p90", "9 of 10\nwithin"),
        Column("rows", "rows"),
    ]
    return Table(
        "prices",
        columns,
        [_measured(task, what, chart, up_to) for what, chart in rows],
        "What each wish costs. 'Unfair' is how far the stronger player's chance is from the "
        "target:",
    )


def _others(task: DesignTask) -> Iterator[tuple[str, Chart]]:
    low, high = task.limits.games
    if task.rule == "nearest":
        return
    if task.rows is not None:
        yield "any number of rows", replace(task, rows=None).design()[0]
    if task.spread is not None and high - low > task.spread:
        yield f"races of all lengths, {low} to {high}", replace(task, spread=None).design()[0]
    for most in _shorter(task):
        with suppress(InputError):  # no even race, or no chart, is that short
            limits = replace(task.limits, games=(low, most))
            made, _ = replace(task, limits=limits).design()
            yield f"matches of at most {count_of(most, 'game')}", made


def _shorter(task: DesignTask) -> list[int]:
    """Return shorter and shorter limits on the games of a match, evenly spaced."""
    low, high = task.limits.games
    limits = [] if task.spread is None else list(range(high - 2, low + task.spread - 1, -2))
    step = -(-len(limits) // MOST_SHORTER) or 1
    return limits[step - 1 :: step]


def _measured(task: DesignTask, what: str, chart: Chart, up_to: int) -> tuple[Any, ...]:
    found = asdict(measure_chart(chart, task.rules, up_to=up_to, target=task.target))
    names = ("mean_unfairness", "worst_unfairness", "mean_games", "games_p90")
    return what, *(found[name] for name in names), len(chart.rows)
