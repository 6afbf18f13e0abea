"""`evenbreak chart design`: the fairest chart for a scale, and what fairness costs in length."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from itertools import groupby
from textwrap import fill
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.chart.design_wish import RULES, Wish, limit_options, options_named, wish_of
from evenbreak.cli.chart.show import span_text
from evenbreak.cli.kit.callbacks import chance, refuse, wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, aligned, csv_text, print_json, to_terminal
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.progress import Progress

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.measure import ChartMeasure
    from evenbreak.handicaps.charts.pareto import ParetoChart

MEASURES = ("mean_unfairness", "worst_unfairness", "mean_games", "games_p90")
MEASURE_HEADINGS = ("unfair, mean", "worst", "games, mean", "9 of 10 within")

_WIDTH = 80
"""Of a terminal, in characters."""

_MOST_LISTED = 10
"""Spans of other races than those of a chart beside that a person is shown."""

OTHER_RACES = ("difference_from", "difference_to", "design", "beside")

EXAMPLES = """\b
Examples:
  evenbreak chart design --games 7..9 --least 5:2 --beside npl_10
  evenbreak chart design --games 5..15 --scale fargo --tilt 0 > ours.csv
  evenbreak chart design --games 17..41 --rows 10
  evenbreak chart design --games 5..19 --least 2:2 --pareto --beside npl_10
"""


@click.command("design", epilog=EXAMPLES)
@limit_options
@click.option(
    "--scale",
    metavar="npl|fargo|elo|POINTS",
    default="npl",
    show_default=True,
    help="What the ratings mean: POINTS of difference double the odds.",
)
@click.option(
    "--target",
    metavar="P",
    callback=chance,
    default="0.5",
    show_default=True,
    help="The chance that the stronger player should have.",
)
@click.option(
    "--tilt",
    metavar="T",
    callback=chance,
    default="0.5",
    show_default=True,
    help="Where in its band a race is on target: 0 begin (the stronger is never the underdog), "
    "1 end.",
)
@click.option(
    "--rule",
    type=click.Choice(list(RULES)),
    default="mean",
    show_default=True,
    help="What is made least: the mean unfairness over all whole-point differences or the "
    "largest; or take the nearest race at each difference by itself.",
)
@click.option(
    "--up-to",
    type=click.IntRange(1, 10**6),
    metavar="D",
    help="The last difference that counts.  [default: where the last race of each chart beside, "
    "or the hardest race allowed, is even]",
)
@click.option(
    "--beside",
    metavar="NAME_OR_FILE",
    multiple=True,
    help="A chart to compare with; may be given more than once.",
)
@click.option(
    "--pareto", is_flag=True, help="List what fairness costs in length, in place of one chart."
)
@plot_option
@wants_json
def command(pareto: bool, plot: str | None, as_json: bool, **wishes: Any) -> None:
    """Design the fairest chart for a scale, within limits on its races.

    Unfairness is how far the stronger player's chance W is from the target. Into a pipe or a
    file goes the chart as a CSV file that the other commands read.
    """
    with options_named(in_minutes=wishes["minutes"] is not None):
        (_print_pareto if pareto else _print_design)(wish_of(**wishes), plot, as_json)


def _print_design(wish: Wish, plot: str | None, as_json: bool) -> None:
    from evenbreak.handicaps.charts.candidates import Candidates
    from evenbreak.handicaps.charts.measure import last_difference, measure_chart

    up_to = wish.up_to
    if up_to is None and wish.beside:
        up_to = min(last_difference(chart, wish.play) for chart in wish.beside)
    candidates = Candidates(wish.play, wish.limits, up_to)
    up_to = int(candidates.points[-1])
    if wish.rule == "nearest":
        made = candidates.nearest("design")
    else:
        made = candidates.fairest(
            target=wish.target,
            tilt=wish.tilt,
            criterion=wish.rule,
            mean_games=wish.mean_games,
            rows=wish.rows,
        )
    charts = [made, *wish.beside]
    told = [measure_chart(one, wish.play, up_to=up_to, target=wish.target) for one in charts]
    if plot is not None:
        _draw(wish, made, plot)
    if as_json:
        print_json(_as_json(wish, charts, told))
        return
    if to_terminal():
        click.echo(f"{_heading(wish, up_to)}\n\n{_rows_text(wish, made, up_to)}")
    else:
        from evenbreak.files.chart import chart_table

        click.echo(csv_text(*chart_table(made)), nl=False)
    names = [chart.name for chart in charts]
    rows = [[name, *_measure_text(one)] for name, one in zip(names, told, strict=True)]
    click.echo(aligned([["chart", *MEASURE_HEADINGS], *rows]), nl=False, err=not to_terminal())
    for line in _comparison(made, wish.beside, up_to):
        click.echo(line, err=not to_terminal())


def _draw(wish: Wish, made: Chart, plot: str) -> None:
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.plots.charts import chart_figure

    if not wish.play.is_plain:
        refuse("--plot draws plain races; leave it out, or --win-by and --breaks")
    reports = [audit(one, scale=wish.play.scale) for one in (made, *wish.beside[:1])]
    write_plot(chart_figure(*reports), plot)


def _heading(wish: Wish, up_to: int) -> str:
    low, high = wish.limits.games
    play = wish.play
    said = [f"Races of {low} to {high} games at most"]
    if play.win_by > 1:
        said.append(f"won by {play.win_by}")
    if play.break_points:
        said.append(f"the break worth {play.break_points:g} points")
    if wish.limits.games_p90 is not None:
        said.append(f"9 of 10 within {wish.limits.games_p90} games")
    if wish.rows is not None:
        said.append("1 row" if wish.rows == 1 else f"{wish.rows} rows at most")
    goal = RULES[wish.rule]
    if (wish.target, wish.tilt) != (0.5, 0.5):
        goal += f" (target {wish.target:g}, tilt {wish.tilt:g})"
    what = f"{', '.join(said)}; {play.points:.4g} points double the odds."
    return f"{fill(what, _WIDTH)}\n{goal[0].upper()}{goal[1:]}, differences 0 to {up_to}."


def _rows_text(wish: Wish, made: Chart, up_to: int) -> str:
    """Return the chart with what its races come to, as a terminal shows it."""
    lines = [["difference", "race", "W low", "W high", "games, mean", "9 of 10 within"]]
    for row in made.rows:
        last = up_to if row.difference_to is None else row.difference_to
        m, n = row.stronger_needs, row.weaker_needs
        ends = [row.difference_from, last]
        low, high = wish.play.win([m], [n], ends)[0]
        mean = wish.play.mean_games([m], [n], ends)[0].mean()
        p90 = wish.play.games_quantile(m, n, ends, 0.9).max()
        lines.append(
            [
                span_text(row.difference_from, row.difference_to),
                f"{m}:{n}",
                f"{low:.3f}",
                f"{high:.3f}",
                f"{mean:.2f}",
                str(p90),
            ]
        )
    return aligned(lines)


def _measure_text(told: ChartMeasure) -> list[str]:
    return [
        f"{told.mean_unfairness:.4f}",
        f"{told.worst_unfairness:.4f}",
        f"{told.mean_games:.2f}",
        str(told.games_p90),
    ]


def _differing(made: Chart, other: Chart, up_to: int) -> Iterator[tuple[int, int, str, str]]:
    """Yield the spans of differences (first, last) with other races, and both races."""
    points = range(up_to + 1)
    both = ((d, "{}:{}".format(*made.race(d)), "{}:{}".format(*other.race(d))) for d in points)
    for (ours, theirs), run in groupby(both, key=lambda one: one[1:]):
        if ours != theirs:
            where = [one[0] for one in run]
            yield where[0], where[-1], ours, theirs


def _comparison(made: Chart, beside: Sequence[Chart], up_to: int) -> Iterator[str]:
    for other in beside:
        differing = list(_differing(made, other, up_to))
        count = sum(last - first + 1 for first, last, _, _ in differing)
        if not count:
            yield f"\nThe same races as {other.name} at all differences from 0 to {up_to}."
            continue
        rows = [
            [span_text(first, last), ours, theirs]
            for first, last, ours, theirs in differing[:_MOST_LISTED]
        ]
        yield f"\nOther races than {other.name} at {count} of {up_to + 1} differences:"
        yield aligned([["difference", "design", other.name], *rows]).rstrip("\n")
        if len(differing) > _MOST_LISTED:
            yield f"  and {len(differing) - _MOST_LISTED} more; --json lists them all"


def _as_json(wish: Wish, charts: Sequence[Chart], told: Sequence[ChartMeasure]) -> dict[str, Any]:
    made = charts[0]
    return {
        "points_per_doubling": wish.play.points,
        "rows": [row._asdict() for row in made.rows],
        **asdict(told[0]),
        "beside": [
            {
                "chart": other.name,
                **asdict(one),
                "other_races": [
                    dict(zip(OTHER_RACES, where, strict=True))
                    for where in _differing(made, other, one.up_to)
                ],
            }
            for other, one in zip(charts[1:], told[1:], strict=True)
        ],
        "schema_version": SCHEMA_VERSION,
    }


def _print_pareto(wish: Wish, plot: str | None, as_json: bool) -> None:
    from evenbreak.handicaps.charts.pareto import pareto

    if wish.rule == "nearest" or wish.mean_games is not None or wish.tilt != 0.5:
        refuse(
            "--pareto goes through all lengths; leave --mean-games, --tilt and --rule nearest out"
        )
    with Progress("charts designed") as progress:
        charts = pareto(
            wish.play,
            wish.limits,
            beside=wish.beside,
            criterion=wish.rule,
            target=wish.target,
            up_to=wish.up_to,
            rows=wish.rows,
            watch=progress,
        )
    if plot is not None:
        from evenbreak.plots.pareto_front import pareto_figure

        write_plot(pareto_figure(charts, criterion=wish.rule), plot)
    up_to = charts[0].measure.up_to
    columns = ("chart", *MEASURES, "races", "beaten_by")
    rows = [_pareto_row(one) for one in charts]
    if as_json:
        listed = [dict(zip(columns, row, strict=True)) for row in rows]
        print_json({"up_to": up_to, "charts": listed, "schema_version": SCHEMA_VERSION})
        return
    if not to_terminal():
        click.echo(csv_text(columns, rows), nl=False)
        return
    lines = [
        [one.chart.name, *_measure_text(one.measure), str(len(one.chart.rows)), one.beaten_by or ""]
        for one in charts
    ]
    headings = ["chart", "unfair", "worst", "games", "9 of 10 in", "races", "beaten by"]
    if not wish.beside:  # of designed charts none here is beaten
        headings, lines = headings[:-1], [line[:-1] for line in lines]
    click.echo(f"{_heading(wish, up_to)}\n\n{aligned([headings, *lines])}", nl=False)


def _pareto_row(one: ParetoChart) -> list[Any]:
    told = one.measure
    return [
        one.chart.name,
        *(getattr(told, name) for name in MEASURES),
        len(one.chart.rows),
        one.beaten_by,
    ]
