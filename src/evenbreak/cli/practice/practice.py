"""`evenbreak practice`: whether you are getting better, it was luck, or something helped."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import count_of
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import dates_option, drill_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import Number, refuse
from evenbreak.errors import DataError
from evenbreak.stats.confidence import LARGEST

if TYPE_CHECKING:
    from evenbreak.files.practice import ScoresFile


SCORE = Number(-LARGEST, LARGEST, " is not a score; give a number, such as 53")
CONFIDENCE = Number(
    1e-9, 1.0 - 1e-9, " is not a confidence level; give a number between 0 and 1, such as 0.95"
)

EXAMPLES = """\b
Examples:
  evenbreak practice scores.csv
  evenbreak practice scores.csv --new 53 --confidence 0.8
  evenbreak practice before.csv --versus after.csv --plot scores.png
"""


@click.command("practice", epilog=EXAMPLES)
@click.argument("scores", metavar="SCORES.csv")
@click.option("--new", metavar="SCORE", type=SCORE, help="Was this one score luck?")
@click.option("--versus", metavar="OTHER.csv", help="Have the scores changed since SCORES.csv?")
@click.option(
    "--confidence",
    metavar="C",
    type=CONFIDENCE,
    default=0.95,
    help="The confidence of the intervals.",
)
@drill_option
@dates_option
@plot_option
@faces()
def command(
    scores: str,
    new: float | None,
    versus: str | None,
    confidence: float,
    drill: str | None,
    dates: Literal["mdy", "dmy"] | None,
    plot: str | None,
) -> Answer:
    """Find out from the scores of a drill whether you are getting better.

    With --new: was one more score luck? With --versus: did something help? SCORES.csv has
    a column score and, if known, the columns date and drill; - reads standard input.
    """
    from evenbreak.files.practice import read_scores

    if new is not None and versus is not None:
        refuse("--new and --versus cannot be combined; leave one out")
    if scores == versus == "-":
        refuse("only one list can come from standard input; name a file for the other")
    file = read_scores(scores, drill=drill, dates=dates)
    if versus is not None:
        return _versus(file, read_scores(versus, drill=drill, dates=dates), confidence, plot)
    return _one_list(file, new, confidence, plot)


def _one_list(file: ScoresFile, new: float | None, confidence: float, plot: str | None) -> Answer:
    from evenbreak.answers.practice.practice import (
        getting_better_answer,
        interval_of,
        new_score_answer,
        trend_line_of,
    )

    own = interval_of(file, confidence)
    if new is not None and own is None:
        raise DataError([f"{file.source}: --new needs at least two different scores; add some"])
    if plot is not None:
        from evenbreak.plots.practice import draw_scores

        line = trend_line_of(file, confidence) if new is None else None
        write_plot(draw_scores(file, own, line, new=new), plot)
    if new is not None:
        return new_score_answer(file, new, confidence=confidence)
    return getting_better_answer(file, confidence=confidence)


def _versus(before: ScoresFile, after: ScoresFile, confidence: float, plot: str | None) -> Answer:
    from evenbreak.answers.practice.practice import before_and_after_answer
    from evenbreak.stats.compare import compare

    short = [
        f"{file.source}: has {count_of(len(file.scores), 'score')}; a comparison needs two or more"
        + (", but --new takes a single new one" if file is after else "")
        for file in (before, after)
        if len(file.scores) < 2
    ]
    if short:
        raise DataError(short)
    found = compare(before.scores, after.scores, confidence=confidence)
    if plot is not None:
        from evenbreak.answers.practice.practice import interval_of
        from evenbreak.plots.practice import draw_two_lists

        intervals = interval_of(before, confidence), interval_of(after, confidence)
        write_plot(
            draw_two_lists(before.scores, after.scores, ("before", "after"), intervals), plot
        )
    return before_and_after_answer(before, after, found)
