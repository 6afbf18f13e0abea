"""`evenbreak validate`: whether a league can trust its ratings."""

from __future__ import annotations

from typing import Any

import click

from evenbreak import answers, files, handicaps, ratings
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import results_options, scale_option, seed_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.league.rate_options import (
    begin_from,
    beginning_option,
    half_life_option,
    half_life_to_choose,
    prior_in_log_odds,
    prior_option,
)
from evenbreak.ratings.scale import Scale

EXAMPLES = """\b
Examples:
  evenbreak validate season.csv
  evenbreak validate season.csv --plot calibration.png
  evenbreak validate season.csv --prior 20 --half-life 365
"""


@click.command("validate", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv...", nargs=-1, required=True)
@prior_option
@half_life_option
@beginning_option
@scale_option()
@seed_option("The seed of the intervals and simulated seasons.")
@results_options
@plot_option
@faces()
def command(
    results: tuple[str, ...],
    prior: float | str | None,
    half_life: float | str | None,
    begin: str | None,
    scale: Scale,
    seed: int,
    reading: dict[str, Any],
    plot: str | None,
) -> Answer:
    """Find out whether the ratings of a league can be trusted.

    RESULTS.csv is a file as for `rate`, with dates; - reads standard input; several are read
    as one. Each date is
    predicted from the results of earlier dates alone, and then compared with what happened.
    """
    from evenbreak.cli.kit.progress import Progress
    from evenbreak.errors import DataError, InputError

    prior_sd = prior_in_log_odds(prior, scale) if isinstance(prior, float) else None
    file = files.read_seasons(results, **reading)
    try:
        with Progress("steps") as progress:
            found = ratings.validate(
                file.results,
                prior_sd=prior_sd,
                half_life=half_life_to_choose(half_life),
                beginning=None if begin is None else begin_from(begin, file, scale),
                seed=seed,
                progress=progress,
            )
    except InputError as error:  # the options have been checked, so it is the data
        raise DataError([f"{file.source}: {error}"]) from None
    if plot is not None:
        from evenbreak.plots.league import draw_calibration

        write_plot(draw_calibration(found), plot)
    return answers.validate_answer(
        file, found, scale, seed=seed, chart=handicaps.league_chart(file.results)
    )
