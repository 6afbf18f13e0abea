"""`evenbreak drill`: where a progressive drill settles, and what a log of one tells."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, Whole, chance, refuse, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    aligned,
    chance_text,
    print_json,
    print_table,
    say,
    to_terminal,
)
from evenbreak.cli.kit.plot import plot_option, write_plot

if TYPE_CHECKING:
    from evenbreak.files.drill_log import DrillLogFile
    from evenbreak.games.drill import Drill
    from evenbreak.practice.drills import DrillStatistics
    from evenbreak.practice.log_analysis import LevelReport, LogAnalysis
    from evenbreak.stats.summary import Distribution

MOST_LEVELS = 100
LEVELS = 9
SEED = 1

COLUMNS = {
    "level": "level",
    "p_success": "success",
    "long_run": "long run",
    "gain": "gain",
    "lift": "lift",
}
"""The columns of a drill, with what a terminal calls them."""

LOG_COLUMNS = {
    "level": "level",
    "attempts": "tried",
    "successes": "made",
    "p_success": "success",
    "p_low": "from",
    "p_high": "to",
    "p_model": None,
    "visited": "so far",
    "expected": None,
    "long_run": "long run",
    "gain": None,
    "lift": "lift",
    "lift_low": None,
    "lift_high": None,
    "p_best": "best",
}
"""The columns of a log, with what a terminal calls those that it shows."""

MUCH = 1e6
"""From here on a terminal shows three digits of a gain."""

WIDTH = 79
"""Of a line of words on a terminal."""

MOST_DRAWS = 20_000_000
"""Attempts that are played by chance for a test, so that a long log takes seconds."""

EXAMPLES = """\b
Examples:
  evenbreak drill --p 0.8
  evenbreak drill --success 0.95,0.8,0.6,0.3 --json
  evenbreak drill --log drill_log.csv --plot drill.png
"""


def _chances(
    ctx: click.Context, param: click.Parameter, value: str | None
) -> tuple[float, ...] | None:
    """Return the chances of a list such as 0.9,0.8,0.5."""
    if value is None:
        return None
    parts = [part.strip() for part in value.split(",")]
    numbers = tuple(float(part) if NUMBER.fullmatch(part) else math.nan for part in parts)
    if len(numbers) > MOST_LEVELS or not all(0.0 <= number <= 1.0 for number in numbers):
        raise click.BadParameter(
            f"{value!r}; give up to {MOST_LEVELS} numbers from 0 to 1 with commas between them, "
            "such as 0.9,0.8,0.5",
            ctx=ctx,
            param=param,
        )
    return numbers


@click.command("drill", epilog=EXAMPLES)
@click.option(
    "--p", metavar="P", callback=chance, help="The chance of a shot: level i takes i - 1 of them."
)
@click.option(
    "--success",
    metavar="P,P,...",
    callback=_chances,
    help="Instead: the chance of success at each level.",
)
@click.option("--log", metavar="LOG.csv", help="Instead: a log of attempts; - is stdin.")
@click.option(
    "--levels",
    type=Whole(1, MOST_LEVELS),
    metavar="N",
    help="How many levels.  [default: 9 with --p, the highest of the log with --log]",
)
@click.option(
    "--seed",
    type=click.IntRange(0),
    metavar="N",
    help=f"Where the chance of the tests of a log begins.  [default: {SEED}]",
)
@wants_json
@plot_option
def command(
    p: float | None,
    success: tuple[float, ...] | None,
    log: str | None,
    levels: int | None,
    seed: int | None,
    as_json: bool,
    plot: str | None,
) -> None:
    """Find where a progressive drill settles, and what to practise.

    A success leads one level up, a miss one level down. Which drill: --p, --success or
    --log. The columns of LOG.csv are level and success, and session or date if there are
    several sessions.
    """
    if sum(which is not None for which in (p, success, log)) != 1:
        refuse("give one of --p, --success and --log")
    if success is not None and levels is not None:
        refuse("--success says how many levels there are; leave --levels out")
    if log is None and seed is not None:
        refuse("--seed is for the tests of --log; leave it out")
    if log is not None:
        _print_log(log, levels, SEED if seed is None else seed, as_json=as_json, plot=plot)
        return
    from evenbreak.games.drill import Drill

    if p is None:
        game, heading = Drill(success or ()), "a drill with the chances given"
    else:
        game = Drill.progressive(p, LEVELS if levels is None else levels)
        heading = f"level i takes i - 1 good shots, each made with {p:g}"
    _print_drill(game, heading, as_json=as_json, plot=plot)


def _print_drill(game: Drill, heading: str, *, as_json: bool, plot: str | None) -> None:
    from evenbreak.practice.drills import drill_statistics

    statistics = drill_statistics(game)
    if plot is not None:
        from evenbreak.plots.drills import drill_figure

        write_plot(drill_figure(statistics), plot)
    rows = _rows(statistics)
    law = statistics.distribution
    if as_json:
        print_json(
            {
                "levels": [dict(zip(COLUMNS, row, strict=True)) for row in rows],
                **_quantities(law),
                "practise_next": statistics.practise_next,
                "period": statistics.period,
                "schema_version": SCHEMA_VERSION,
            }
        )
        return
    if statistics.period > 1:
        click.echo(
            "Note: odd and even attempts differ for ever; the long run is the average of both",
            err=True,
        )
    print_table(list(COLUMNS), rows, headings=list(COLUMNS.values()), heading=heading, text=_text)
    if to_terminal():
        from evenbreak.answers.drill_words import drill_advice

        words = [["mean level", f"{law.mean:.3f}"], *_spread(law)]
        _say(aligned(words), drill_advice(statistics))


def _rows(statistics: DrillStatistics) -> list[tuple[Any, ...]]:
    success, law = statistics.drill.success, statistics.distribution.probability
    pairs = zip(success, law, statistics.gain, statistics.lift, strict=True)
    return [
        (level, p, float(share), _finite(gain), lift)
        for level, (p, share, gain, lift) in enumerate(pairs, 1)
    ]


def _print_log(
    path: str, levels: int | None, seed: int, *, as_json: bool, plot: str | None
) -> None:
    import numpy as np

    from evenbreak.files.drill_log import read_drill_log
    from evenbreak.practice.log_analysis import analyse_log

    file = read_drill_log(path, levels=levels)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    replicas = min(1999, max(199, MOST_DRAWS // len(file.log)))
    analysis = analyse_log(file.log, rng=np.random.default_rng(seed), replicas=replicas)
    if plot is not None:
        from evenbreak.plots.drills import log_figure

        write_plot(log_figure(analysis), plot)
    rows = [_log_row(report) for report in analysis.levels]
    if as_json:
        print_json(_log_answer(file, analysis, rows, seed))
        return
    if not to_terminal():
        print_table(list(LOG_COLUMNS), rows, headings=(), heading="", text=_text)
        return
    shown = [name for name, heading in LOG_COLUMNS.items() if heading]
    print_table(
        shown,
        [
            [value for name, value in zip(LOG_COLUMNS, row, strict=True) if name in shown]
            for row in rows
        ],
        headings=[LOG_COLUMNS[name] or "" for name in shown],
        heading=_log_heading(file) + (_levels_taken(file) if levels is None else ""),
        text=_text,
    )
    from evenbreak.answers.drill_words import log_advice

    law = analysis.implied
    interval = f"({analysis.mean_low:.2f} to {analysis.mean_high:.2f})"
    words = [
        ["mean level so far", f"{analysis.visited.mean:.2f}", ""],
        ["mean level in the long run", f"{law.mean:.2f}", interval],
        *([*row, ""] for row in _spread(law)),
    ]
    _say(_aligned_left(words), *log_advice(analysis))


def _log_row(report: LevelReport) -> tuple[Any, ...]:
    return (
        *(report.level, report.attempts, report.successes),
        *(report.p, report.p_low, report.p_high, report.p_model),
        *(report.visited, report.expected, report.implied, _finite(report.gain)),
        *(report.lift, report.lift_low, report.lift_high, report.p_best),
    )


def _log_answer(
    file: DrillLogFile, analysis: LogAnalysis, rows: list[tuple[Any, ...]], seed: int
) -> dict[str, Any]:
    """Return what --json prints of a log."""
    best, off = analysis.practise_next, analysis.furthest_off_model
    tests = {name: getattr(analysis, name) for name in ("difference", "memory", "model_test")}
    return {
        "levels": [dict(zip(LOG_COLUMNS, row, strict=True)) for row in rows],
        **_quantities(analysis.implied),
        "mean_low": analysis.mean_low,
        "mean_high": analysis.mean_high,
        "mean_so_far": analysis.visited.mean,
        "practise_next": best and best.level,
        **{name: test and test._asdict() for name, test in tests.items()},
        "model": analysis.model and analysis.model._asdict(),
        "furthest_off_model": off and off.level,
        "attempts": len(file.log),
        "sessions": file.log.sessions,
        "against_the_rule": len(file.log.jumps),
        "replicas": analysis.replicas,
        "seed": seed,
        "schema_version": SCHEMA_VERSION,
    }


def _log_heading(file: DrillLogFile) -> str:
    attempts, sessions = len(file.log), file.log.sessions
    return (
        f"{file.source}: {attempts:,} attempt{'s' * (attempts > 1)} in {sessions:,} "
        f"session{'s' * (sessions > 1)}"
    )


def _levels_taken(file: DrillLogFile) -> str:
    levels = len(file.log.attempts)
    return (
        f"\ntaken as a drill of {levels} level{'s' * (levels > 1)}, the most in the log; "
        "--levels says otherwise"
    )


def _quantities(law: Distribution) -> dict[str, Any]:
    return {"mean": law.mean, "median": law.median, "mode": law.mode, "sd": law.sd}


def _spread(law: Distribution) -> list[list[str]]:
    return [
        ["median", str(law.median)],
        ["mode", str(law.mode)],
        ["standard deviation", f"{law.sd:.3f}"],
    ]


def _say(table: str, *paragraphs: str) -> None:
    """Print the statistics and then the paragraphs."""
    import textwrap

    from evenbreak.answers.drill_words import SPACE

    click.echo(f"\n{table}")
    text = "\n\n".join(textwrap.fill(paragraph, WIDTH) for paragraph in paragraphs)
    click.echo(text.replace(SPACE, " "))


def _aligned_left(words: list[list[str]]) -> str:
    """Return rows of a name, a number and what stands behind it."""
    numbers = aligned([row[:2] for row in words]).splitlines()
    return "".join(
        f"{line} {row[2]}".rstrip() + "\n" for line, row in zip(numbers, words, strict=True)
    )


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _text(column: str, value: Any) -> str:
    if column in ("level", "attempts", "successes"):
        return str(value)
    if column in ("gain", "lift"):
        return f"{value:.3f}" if value < MUCH else f"{value:.3g}"
    return chance_text(value)
