"""`evenbreak ladder --compare`: systems, charts and sizes of the step side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import refuse
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    aligned,
    csv_text,
    heading_lines,
    paragraphs,
    print_json,
    to_terminal,
)
from evenbreak.cli.kit.plot import write_plot
from evenbreak.cli.ladder.ladder_options import (
    chart_of_option,
    opponents_of_options,
    refuse_conflicts,
    why_not,
)

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.ladders.comparison import SystemRow
    from evenbreak.handicaps.ladders.opponents import Opponents
    from evenbreak.league.reestimate import Reestimated

COMPARE_COLUMNS = (
    *("system", "chart", "sd", "sd_doublings", "settling_mean", "settling_p90"),
    *("p_favourite_mean", "favourite_over_60", "games_mean", "inflation", "on_front"),
    *("sd_se", "settling_mean_se"),
)

HEADINGS = (
    *("system", "chart", "sd,\npoints", "% of a\ndoubling", "settles\nin"),
    *("9 of 10\nin", "favourite\nwins %", "60 %\nor up", "games"),
)

OTHERS = ("margin 2", "elo 4", "elo 16", "fixed 9")
"""The other systems; those without a printed chart are played by a chart of their own."""

STEPS = (1, 2, 3, 4, 5, 6, 8, 10)
"""The sizes of the step of which the best are looked for."""

ALLOWED = ("autocorrelated", "equal_skill", "league", "skill")
"""The options that --compare goes with, besides --chart, --plot and --json."""

NEWCOMERS = "npl new"
"""What the row is called of a player who moves by the league's newcomer steps."""


REFITTED_PLAYERS, REFITTED_LEAGUES, REFITTED_SEED = 40, 8, 1
"""The leagues of players of equal skill in which ratings are fitted anew each week."""


def compare_ladders(
    chart_name: str | None, asked: dict[str, Any], *, plot: str | None, as_json: bool
) -> None:
    """Print systems and steps side by side: as JSON, CSV or, on a terminal, two tables."""
    from evenbreak.errors import AccuracyError
    from evenbreak.handicaps.systems.catalogue import system_of

    refuse_conflicts(asked)
    if chart_name == asked["league"] == "-":
        refuse("- stands for standard input, which only one file can be; name the other")
    options = {"system_name": "system", "scale_name": "scale", "start": "from"}
    for name, value in asked.items():
        if name not in ALLOWED and value not in (None, False):
            option = options.get(name, name.replace("_", "-"))
            refuse(f"--compare goes through systems by itself; leave --{option} out")
    npl = system_of("npl")
    chart = chart_of_option(chart_name, npl)
    opponents, name = opponents_of_options(asked, npl.scale)
    try:
        systems = _systems(chart, opponents)
        steps = _steps(chart, opponents)
    except AccuracyError as error:
        raise AccuracyError(why_not(error, opponents)) from None
    refitted = _refitted(chart) if name == "equal skill" else None
    listed: list[tuple[Any, ...]] = [(*row, None, None, None) for row in systems]
    if refitted is not None:
        listed.append((*refitted.row, None, refitted.sd_error, refitted.settling_error))
    listed += [(*row, best, None, None) for row, best in steps]
    if as_json:
        told = [dict(zip(COMPARE_COLUMNS, row, strict=True)) for row in listed]
        print_json({"opponents": name, "systems": told, "schema_version": SCHEMA_VERSION})
    elif to_terminal():
        _print(chart, systems, steps, name, refitted)
    else:
        rows = [[int(cell) if isinstance(cell, bool) else cell for cell in row] for row in listed]
        click.echo(csv_text(COMPARE_COLUMNS, rows), nl=False)
    if plot is not None:
        _draw(chart, systems, steps, plot)


def _systems(chart: Chart, opponents: Opponents) -> list[SystemRow]:
    """Return the National Pool League by all of its charts and by `chart`, and other systems."""
    from evenbreak.handicaps.charts.chart import chart as printed
    from evenbreak.handicaps.ladders.comparison import compare_systems
    from evenbreak.handicaps.systems.catalogue import system_of

    npl = system_of("npl")
    charts = [printed(name) for name in npl.charts]
    if chart not in charts:
        charts.append(chart)
    others = [(name, chart if system_of(name).charts else None) for name in OTHERS]
    rows = compare_systems([*(("npl", each) for each in charts), *others], opponents=opponents)
    place = charts.index(chart)
    return [*rows[: place + 1], _newcomer(rows[place], chart, opponents), *rows[place + 1 :]]


def _newcomer(row: SystemRow, chart: Chart, opponents: Opponents) -> SystemRow:
    """Return the league's row on this chart if the player moves by its newcomer steps at first."""
    from evenbreak.handicaps.ladders.comparison import NEAR
    from evenbreak.handicaps.ladders.ladder import Ladder
    from evenbreak.handicaps.ladders.settling import settling

    ladder = Ladder("npl", chart, opponents=opponents)
    points = ladder.system.scale.points_per_doubling
    sooner = settling(ladder, -round(points), round(NEAR * points), newcomer=True)
    nine = int(sooner.matches.quantile(0.9))
    return row._replace(system=NEWCOMERS, settling_mean=sooner.mean, settling_p90=nine)


def _refitted(chart: Chart) -> Reestimated:
    """Return how wrong ratings stay that are fitted anew each week, in leagues simulated."""
    from evenbreak.league.reestimate import reestimate

    return reestimate(
        [0.0] * REFITTED_PLAYERS,
        chart,
        scale="npl",
        newcomer_weeks=100,
        leagues=REFITTED_LEAGUES,
        seed=REFITTED_SEED,
    )


def _steps(chart: Chart, opponents: Opponents) -> list[tuple[SystemRow, bool]]:
    """Return what each step is worth by this chart, and whether no other one is better."""
    from evenbreak.handicaps.ladders.comparison import compare_systems, on_front

    rows = compare_systems([(f"step {step}", chart) for step in STEPS], opponents=opponents)
    front = on_front([(row.sd, row.settling_mean) for row in rows])
    return list(zip(rows, front, strict=True))


def _print(
    chart: Chart,
    systems: list[SystemRow],
    steps: list[tuple[SystemRow, bool]],
    opponents: str,
    refitted: Reestimated | None,
) -> None:
    from evenbreak.cli.ladder.ladder_answer import OPPONENTS

    click.echo(
        paragraphs(
            f"Systems side by side. {OPPONENTS[opponents]}\n"
            "sd: of the rating error in the long run; a doubling: the points that double the odds. "
            "Settled is who comes from one doubling too low to within a sixth of one; the mean "
            "number of matches, and in how many 9 of 10 settle. The favourite of a match is whom "
            "the errors favour: how much he wins, and how often that is 60 % or more."
        )
    )
    click.echo("\n" + paragraphs(_what_helps(chart, systems, steps)))
    head = heading_lines(HEADINGS)
    shown = [*systems, *([] if refitted is None else [refitted.row])]
    click.echo("\n" + aligned([*head, *map(_cells, shown)], left=2))
    if refitted is not None:
        click.echo(
            paragraphs(
                f"{refitted.row.system}: all ratings are fitted anew each week to all results, as "
                f"Fargo's are; {REFITTED_LEAGUES} leagues of {REFITTED_PLAYERS} players simulated "
                f"over a year, so that its sd is off by about {refitted.sd_error:.2f} points and "
                f"its settling by {refitted.settling_error:.1f} matches."
            )
        )
    inflating = [f"{row.system} by {row.inflation:+.2f}" for row in systems if row.inflation]
    click.echo(
        f"Ratings inflate, in points a match: {', '.join(inflating)}."
        if inflating
        else "No ratings inflate: what one player gains, the other loses."
    )
    click.echo(f"\nSizes of the step on chart {chart.name}:\n")
    click.echo(aligned([*head, *(_cells(row) for row, _ in steps)], left=2))
    beaten = [row.system for row, on_front in steps if not on_front]
    click.echo(
        paragraphs(
            "A longer step settles sooner and stays less exact; which is best depends on how many "
            "newcomers there are. " + _not_worth_it(beaten)
        )
    )


def _what_helps(chart: Chart, systems: list[SystemRow], steps: list[tuple[SystemRow, bool]]) -> str:
    """Return which change would help most, against the league's own rule on this chart."""
    own = next(row for row in systems if (row.system, row.chart) == ("npl", chart.name))
    new = next(row for row in systems if row.system == NEWCOMERS)
    others = [row for row in (*systems, *(row for row, _ in steps)) if row is not new]
    exact = min(others, key=lambda row: row.sd_doublings)
    fastest = min(others, key=lambda row: row.settling_mean)
    no_slower = [row for row in others if row.settling_mean <= own.settling_mean]
    best = min(no_slower, key=lambda row: row.sd_doublings)
    sure = (
        "of those that are no slower, it is the most accurate itself"
        if best.sd_doublings >= own.sd_doublings
        else f"of those that are no slower, {_called(best)} is the most accurate"
    )
    return (
        f"Least off: {_called(exact)} ({100.0 * exact.sd_doublings:.1f} % of a doubling). "
        f"Fastest: {_called(fastest)} ({fastest.settling_mean:.1f} matches). Against "
        f"{_called(own)} ({100.0 * own.sd_doublings:.1f} %, {own.settling_mean:.1f} matches): "
        f"{sure}; and longer steps for newcomers alone ({new.system}) bring them in after "
        f"{new.settling_mean:.1f} matches and leave the others as accurate as they are."
    )


def _called(row: SystemRow) -> str:
    return f"{row.system} on {row.chart}"


def _not_worth_it(steps: list[str]) -> str:
    """Return which steps are beaten by another one.

    >>> _not_worth_it(["step 6"])
    'Step 6 is never worth it: another step is both more exact and faster.'
    """
    if not steps:
        return "Each of these is worth it: none is both more exact and faster than another."
    verb = "is" if len(steps) == 1 else "are"
    named = _listed(steps).capitalize()
    return f"{named} {verb} never worth it: another step is both more exact and faster."


def _listed(words: list[str]) -> str:
    *before, last = words
    return f"{', '.join(before)} and {last}" if before else last


def _cells(row: SystemRow) -> list[str]:
    return [
        *(row.system, row.chart, f"{row.sd:.2f}", f"{100.0 * row.sd_doublings:.1f}"),
        *(f"{row.settling_mean:.1f}", str(row.settling_p90), f"{100.0 * row.favourite:.1f}"),
        *(f"{100.0 * row.clear_favourite:.0f} %", f"{row.games:.1f}"),
    ]


def _draw(
    chart: Chart, systems: list[SystemRow], steps: list[tuple[SystemRow, bool]], path: str
) -> None:
    from evenbreak.plots.ladders import SystemPoint, systems_figure

    points = [
        *(
            SystemPoint(row.system, 100.0 * row.sd_doublings, row.settling_mean, best)
            for row, best in steps
        ),
        *(
            SystemPoint(_name(row), 100.0 * row.sd_doublings, row.settling_mean, None)
            for row in systems
            # The league itself on this chart is the step of 1.
            if (row.system, row.chart) != ("npl", chart.name)
        ),
    ]
    write_plot(systems_figure(points, chart=chart.name), path)


def _name(row: SystemRow) -> str:
    if row.system == NEWCOMERS:
        return "newcomers"
    return row.chart if row.system == "npl" else row.system
