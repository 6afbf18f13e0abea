"""The fairest chart within limits, compared with other charts."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from itertools import groupby
from typing import Any, NamedTuple

from evenbreak.answers.chart.show import chart_rows
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.systems import chart_by_difference
from evenbreak.answers.kit.wording import count_of, percent, range_words
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.design import races_to_try
from evenbreak.handicaps.charts.fair import RaceLimits
from evenbreak.handicaps.charts.measure import ChartMeasure, last_difference, measure_chart
from evenbreak.handicaps.charts.race_grid import games_quantiles, mean_games_grid, win_grid
from evenbreak.questions.charts import ChartDesign
from evenbreak.ratings.scale import Scale
from evenbreak.words import Parameter, Sentence, race, say

MOST_LISTED = 10
"""The most ranges with different races that are shown for one chart."""

MOST_SHORTER = 4
"""The most charts with shorter matches that are listed."""

SPREAD = 2
"""How much the longest matches in a printed chart's races differ, in games."""


@dataclass(frozen=True)
class DesignTask:
    """What a chart design must meet; the fields are as in `evenbreak.handicaps.design`.

    Without `up_to`, the last difference that counts is the smallest `last_difference` of the charts
    compared with (`beside`).
    """

    scale: Scale
    limits: RaceLimits
    target: float = 0.5
    tilt: float = 0.5
    up_to: int | None = None
    rows: int | None = None
    beside: tuple[Chart, ...] = ()

    def design(self) -> tuple[Chart, int]:
        """Return the chart that meets the requirements, and the last difference that counts."""
        up_to = self.up_to
        if up_to is None and self.beside:
            up_to = min(last_difference(chart, self.scale) for chart in self.beside)
        races = races_to_try(self.scale, self.limits, SPREAD, up_to)
        made = races.fairest(target=self.target, tilt=self.tilt, rows=self.rows)
        return made, int(races.points[-1])

    def heading(self, up_to: int) -> str:
        """Return the requirements, in two lines."""
        low, high = self.limits.games
        words = [f"Races that can last {low} to {high} games at most"]
        if self.limits.games_p90 is not None:
            words.append(f"9 out of 10 ending within {self.limits.games_p90} games")
        if self.rows is not None:
            words.append(f"in at most {count_of(self.rows, 'row')}")
        if high - low > SPREAD:
            words.append(f"with maximums at most {SPREAD} games apart")
        goal = "the smallest unfairness on average"
        if self.target != 0.5:
            goal += f", with a target of {percent(self.target)}"
        if self.tilt != 0.5:
            goal += f", with tilt {self.tilt:g}"
        return (
            f"{', '.join(words)}; {self.scale.points_per_doubling:.4g} points double the odds of "
            f"winning a game\nAim: {goal}, for differences from 0 to {up_to}"
        )


def chart_design_answer(task: DesignTask, design: tuple[Chart, int]) -> Answer:
    """Return a designed chart next to other charts; the CSV is a chart file.

    >>> from evenbreak.ratings import SCALES
    >>> task = DesignTask(SCALES["npl"], RaceLimits((7, 9), 5, 2), up_to=59)
    >>> print(chart_design_answer(task, task.design()).sentences[0])
    At differences up to 59, the stronger player's chance is within 7.2 percentage points of 50%,
    and is off by 2.9 on average. A match takes 6.6 games on average; 9 out of 10 end within 9.
    """
    made, up_to = design
    ours, *theirs = (
        measure_chart(chart, task.scale, up_to=up_to, target=task.target)
        for chart in (made, *task.beside)
    )
    differing = [list(_differing(made, other, up_to)) for other in task.beside]
    parts: list[Part] = [_in_words(ours, task.target)]
    for chart, one, spans in zip(task.beside, theirs, differing, strict=True):
        parts.append(_compared(chart, one, spans, task.target))
    parts.append(_rows(task, made, up_to))
    prices = _prices(task, made, up_to)
    if prices is not None:
        parts.append(prices)
    for chart, spans in zip(task.beside, differing, strict=True):
        if spans:
            parts.append(_other_races(chart, spans))
    return Answer(
        task.heading(up_to),
        parts,
        data={
            "points_per_doubling": task.scale.points_per_doubling,
            **asdict(ours),
            "beside": [
                {
                    "chart": chart.name,
                    **asdict(one),
                    "other_races": [span.to_dict() for span in spans],
                }
                for chart, one, spans in zip(task.beside, theirs, differing, strict=True)
            ],
        },
        csv=replace(chart_rows(made), name=""),  # `_rows` has them too
    )


def _in_words(found: ChartMeasure, target: float) -> str:
    return (
        f"At differences up to {found.up_to}, the stronger player's chance is within "
        f"{100 * found.worst_unfairness:.1f} percentage points of {percent(target)}, and is "
        f"off by {100 * found.mean_unfairness:.1f} on average. A match takes "
        f"{found.mean_games:.1f} games on average; 9 out of 10 end within {found.games_p90}."
    )


class _Span(NamedTuple):
    """A range of differences for which two charts have different races."""

    first: int
    last: int
    design: tuple[int, int]
    beside: tuple[int, int]

    def to_dict(self) -> dict[str, Any]:
        return {
            "difference_from": self.first,
            "difference_to": self.last,
            "design": race(self.design),
            "beside": race(self.beside),
        }


def _differing(made: Chart, other: Chart, up_to: int) -> Iterator[_Span]:
    ours_at, theirs_at = (
        zip(*(needs.tolist() for needs in chart.races(range(up_to + 1))), strict=True)
        for chart in (made, other)
    )
    both = zip(range(up_to + 1), ours_at, theirs_at, strict=True)
    for (ours, theirs), run in groupby(both, key=lambda one: one[1:]):
        if ours != theirs:
            where = [d for d, _, _ in run]
            yield _Span(where[0], where[-1], ours, theirs)


def _compared(chart: Chart, found: ChartMeasure, spans: Sequence[_Span], target: float) -> str:
    count = sum(span.last - span.first + 1 for span in spans)
    races = f"different races at {count} of the" if count else "the same races at all"
    return (
        f"For comparison, {chart.name} stays within {100 * found.worst_unfairness:.1f} percentage "
        f"points of {percent(target)}, and is off by {100 * found.mean_unfairness:.1f} on "
        f"average. A match takes {found.mean_games:.1f} games on average; 9 out of 10 end within "
        f"{found.games_p90}. The two charts have {races} {found.up_to + 1} differences."
    )


def _rows(task: DesignTask, made: Chart, up_to: int) -> Table:
    """Return the chart with the chances and lengths of its races."""
    rows = []
    for row in made.rows:
        last = up_to if row.difference_to is None else row.difference_to
        m, n = row.stronger_needs, row.weaker_needs
        ends = [row.difference_from, last]
        low, high = win_grid(task.scale, [m], [n], ends)[0]
        mean = mean_games_grid(task.scale, [m], [n], ends)[0].mean()
        p90 = games_quantiles(task.scale, m, n, ends, 0.9).max()
        rows.append((row[:2], (m, n), low, high, mean, p90))
    columns = columns_of("span needs p_win_at_start p_win_at_end mean_games games_p90")
    return Table("rows", columns, rows)


def _other_races(chart: Chart, spans: Sequence[_Span]) -> Table:
    shown = spans[:MOST_LISTED]
    first = f", the first {MOST_LISTED} of {len(spans)} ranges" if len(shown) < len(spans) else ""
    columns = columns_of("difference design beside", chart=chart.name)
    rows = [(range_words(span.first, span.last), span.design, span.beside) for span in shown]
    return Table("", columns, rows, f"Where the races differ from those in {chart.name}{first}:")


def _prices(task: DesignTask, made: Chart, up_to: int) -> Table | None:
    """Return the designed chart next to the charts without each wish; None if all are the same.

    Unfairness is measured from the target, whatever the tilt of the design.
    """
    rows = [("this chart", made)]
    for what, other in _without_wishes(replace(task, up_to=up_to)):
        if all(other.rows != chart.rows for _, chart in rows):
            rows.append((what, other))
    if len(rows) == 1:
        return None
    names = ("mean_unfairness", "worst_unfairness", "mean_games", "games_p90")
    columns = columns_of("design_name mean_unfairness worst_unfairness mean_games games_p90 rows")
    measured = [
        (what, chart, measure_chart(chart, task.scale, up_to=up_to, target=task.target))
        for what, chart in rows
    ]
    return Table(
        "prices",
        columns,
        [
            (what, *(getattr(measure, name) for name in names), len(chart.rows))
            for what, chart, measure in measured
        ],
        "The cost of each limit. 'Unfair' is how far the stronger player's chance is from the "
        "target:",
    )


def _without_wishes(task: DesignTask) -> Iterator[tuple[str, Chart]]:
    """Yield the charts with any number of rows, and with shorter and shorter matches."""
    if task.rows is not None:
        yield "any number of rows", replace(task, rows=None).design()[0]
    low, high = task.limits.games
    limits = list(range(high - 2, low + SPREAD - 1, -2))
    step = -(-len(limits) // MOST_SHORTER) or 1
    for most in limits[step - 1 :: step]:
        with suppress(InputError):  # no even race, or no chart, is that short
            shorter = replace(task.limits, games=(low, most))
            chart, _ = replace(task, limits=shorter).design()
            yield f"matches of at most {count_of(most, 'game')}", chart


_FIELDS = {"rows": "most_rows", "weaker_least": "least", "stronger_least": "least"}
"""The question's names for a design's parameters."""


def design(asked: ChartDesign) -> Answer:
    """Return the fairest chart."""
    charts = tuple(chart_by_difference(name, "beside") for name in asked.beside)
    try:
        task = DesignTask(
            asked.scale,
            RaceLimits(asked.games, *asked.least, asked.games_p90),
            target=asked.target,
            tilt=asked.tilt,
            up_to=asked.up_to,
            rows=asked.most_rows,
            beside=charts,
        )
        return chart_design_answer(task, task.design())
    except InputError as error:
        raise InputError(_of_the_question(error.sentence)) from error


def _of_the_question(sentence: Sentence) -> Sentence:
    """Return what is wrong with a design, using the question's parameter names."""
    values = {name: Parameter(field) for name, field in _FIELDS.items()}
    for name, value in sentence.values.items():
        is_one = isinstance(value, Parameter)
        values[name] = Parameter(_FIELDS.get(value, value)) if is_one else value
    return say(sentence.template, **values)
