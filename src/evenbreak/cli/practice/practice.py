"""`evenbreak practice`: what practice scores tell, of one score more or of a change."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import chance, number, refuse, wants_json
from evenbreak.cli.kit.output import say
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.practice.practice_words import (
    NEW_WORDS,
    SUMMARY_WORDS,
    VERSUS_WORDS,
    luck_sentence,
    many,
    print_answer,
)
from evenbreak.errors import DataError

if TYPE_CHECKING:
    from evenbreak.files.scores import ScoresFile
    from evenbreak.stats.compare import Comparison
    from evenbreak.stats.confidence import MeanInterval
    from evenbreak.stats.trend import Trend

DAYS_A_WEEK = 7.0
DRIFTS = 0.05
"""The chance of a slope so steep below which scores are said to drift."""

EXAMPLES = """\b
Examples:
  evenbreak practice scores.csv
  evenbreak practice scores.csv --new 53 --confidence 0.8
  evenbreak practice before.csv --versus after.csv --plot scores.png
"""


def _score(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None

    from evenbreak.stats.confidence import LARGEST

    wanted = " is not a score; give a number, such as 53"
    return number(value, -LARGEST, LARGEST, wanted, ctx=ctx, param=param)


def _confidence(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    share = chance(ctx, param, value)
    if share in (0.0, 1.0):
        message = f"{value!r}; give a number between 0 and 1, such as 0.95"
        raise click.BadParameter(message, ctx=ctx, param=param)
    return share


@click.command("practice", epilog=EXAMPLES)
@click.argument("scores", metavar="SCORES.csv")
@click.option("--new", metavar="SCORE", callback=_score, help="Was this one score more luck?")
@click.option("--versus", metavar="OTHER.csv", help="Have the scores changed since SCORES.csv?")
@click.option(
    "--confidence",
    metavar="C",
    callback=_confidence,
    default="0.95",
    show_default=True,
    help="How sure the intervals are to cover the true value.",
)
@plot_option
@wants_json
def command(
    scores: str,
    new: float | None,
    versus: str | None,
    confidence: float,
    plot: str | None,
    as_json: bool,
) -> None:
    """Tell what the scores of a drill say: how good you are, and whether practice helped.

    SCORES.csv has a column score and, if you like, a column date; - is stdin.
    """
    if new is not None and versus is not None:
        refuse("--new and --versus exclude each other; leave one out")
    if scores == versus == "-":
        refuse("both lists cannot be on stdin; name a file for one of them")
    file = _read(scores)
    if versus is not None:
        _versus(file, _read(versus), confidence, plot, as_json)
    elif new is not None:
        _new(file, new, confidence, plot, as_json)
    else:
        _summary(file, confidence, plot, as_json)


def _read(path: str) -> ScoresFile:
    from evenbreak.files.scores import read_scores

    file = read_scores(path)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    return file


def _interval(file: ScoresFile, confidence: float, method: Any = "t") -> MeanInterval | None:
    """Return the interval of the true mean; None where the scores have no spread."""
    from evenbreak.stats.confidence import mean_interval, sd_of

    if len(file.scores) < 2 or sd_of(file.scores) == 0.0:
        return None
    return mean_interval(file.scores, confidence, method=method)


def _trend(file: ScoresFile, confidence: float) -> Trend | None:
    """Return the trend in points a week; None without dates enough to see one."""
    from evenbreak.stats.confidence import sd_of
    from evenbreak.stats.trend import trend

    if file.dates is None or len(file.scores) < 3 or sd_of(file.scores) == 0.0:
        return None
    days = (file.dates - file.dates.min()).astype(float)
    return trend(days / DAYS_A_WEEK, file.scores, confidence) if days.any() else None


def _summary(file: ScoresFile, confidence: float, plot: str | None, as_json: bool) -> None:
    own, normal = _interval(file, confidence), _interval(file, confidence, "normal")
    line = _trend(file, confidence)
    answer = {
        "n": len(file.scores),
        "mean": float(file.scores.mean()),
        "sd": own and own.sd,
        "confidence": confidence,
        "low": own and own.low,
        "high": own and own.high,
        "low_normal": normal and normal.low,
        "high_normal": normal and normal.high,
        "slope_per_week": line and line.slope,
        "slope_low": line and line.low,
        "slope_high": line and line.high,
        "p_slope": line and line.p_value,
    }
    told = []
    if own is None:
        told.append(
            "one score, or equal ones, show no spread: how far the true mean is off is not known"
        )
    if line is None and own is not None and file.dates is not None:
        told.append("a change with time shows with three scores or more, not all of one date")
    if line is not None and line.p_value < DRIFTS:
        told.append(
            "the scores seem to drift with time, but the interval takes the true mean for steady"
        )
    heading = f"{many(len(file.scores))} in {file.source}{_days(file)}"
    print_answer(answer, SUMMARY_WORDS, heading, told, as_json=as_json)
    if plot is not None:
        from evenbreak.plots.practice_scores import plot_scores

        write_plot(plot_scores(file, own), plot)


def _new(file: ScoresFile, new: float, confidence: float, plot: str | None, as_json: bool) -> None:
    from evenbreak.stats.confidence import was_it_luck

    own = _interval(file, confidence)
    if own is None:
        raise DataError(
            [f"{file.source}: holds no two scores that differ; --new needs them, add some"]
        )
    luck = was_it_luck(file.scores, new, confidence=confidence)
    answer = {
        "score": new,
        "n": luck.n,
        "mean": luck.mean,
        "sd": own.sd,
        "confidence": confidence,
        "units": luck.t.units,
        "p_as_far": luck.t.as_far,
        "p_as_high": luck.t.as_high,
        "p_as_low": luck.t.as_low,
        "p_as_high_by_rank": luck.as_high_by_rank,
        "p_as_low_by_rank": luck.as_low_by_rank,
        "units_normal": luck.normal.units,
        "p_as_far_normal": luck.normal.as_far,
        "units_cautious": luck.cautious.units,
        "p_as_far_cautious": luck.cautious.as_far,
    }
    side = "low" if new < luck.mean else "high"
    other = "high" if side == "low" else "low"
    words = {key: name for key, name in NEW_WORDS.items() if f"_as_{other}" not in key}
    print_answer(answer, words, luck_sentence(luck), [], as_json=as_json)
    if plot is not None:
        from evenbreak.plots.practice_scores import plot_scores

        write_plot(plot_scores(file, own, new=new), plot)


def _versus(
    before: ScoresFile, after: ScoresFile, confidence: float, plot: str | None, as_json: bool
) -> None:
    from evenbreak.stats.compare import compare

    short = [
        f"{file.source}: holds {many(len(file.scores))}; a comparison needs two or more, add some"
        + ("; for a single new one there is --new" if file is after else "")
        for file in (before, after)
        if len(file.scores) < 2
    ]
    if short:
        raise DataError(short)
    found = compare(before.scores, after.scores, confidence=confidence)
    print_answer(_comparison(found), VERSUS_WORDS, found.sentence, found.warnings, as_json=as_json)
    if plot is not None:
        from evenbreak.plots.practice_scores import plot_two_lists

        intervals = _interval(before, confidence), _interval(after, confidence)
        write_plot(
            plot_two_lists(before.scores, after.scores, ("before", "after"), intervals), plot
        )


def _comparison(found: Comparison) -> dict[str, Any]:
    tests = ("welch", "student", "anova", "variances", "mann_whitney", "chi_squared")
    p_values = {name: test and test.p_value for name in tests for test in [getattr(found, name)]}
    return {
        **{f"{name}_before": value for name, value in found.before._asdict().items()},
        **{f"{name}_after": value for name, value in found.after._asdict().items()},
        "confidence": found.confidence,
        "difference": found.difference,
        "low": found.low,
        "high": found.high,
        **{f"p_{name}": value for name, value in p_values.items()},
        "g": found.effect.g,
        "g_low": found.effect.low,
        "g_high": found.effect.high,
        "p_after_higher": found.effect.p_after_higher,
    }


def _days(file: ScoresFile) -> str:
    if file.dates is None:
        return ""
    return f", {file.dates.min()} to {file.dates.max()}"
