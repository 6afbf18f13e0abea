"""`evenbreak sandbag power`: how soon the watch flags a sandbagger."""

from __future__ import annotations

from typing import Any

import click

from evenbreak import handicaps, league
from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import chart_option, seed_option
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.systems import system_option
from evenbreak.cli.kit.values import SHARE, Whole, refuse
from evenbreak.cli.sandbag.options import between, watch_options, watched_ladder

Kind = tuple[float, int | None]

KINDS: tuple[Kind, ...] = (
    (0.0, None),
    (0.25, 60),
    (0.25, None),
    (0.5, 30),
    (0.5, 60),
    (0.5, 120),
    (0.5, None),
    (0.9, 60),
    (0.9, None),
)
"""Who is simulated: the share of the matches that they dump, and how many points below their
skill they play those, where 30 points double the odds; None: they lose them on purpose."""

EXAMPLES = """\b
Examples:
  evenbreak sandbag power
  evenbreak sandbag power --honest established --matches 60
  evenbreak sandbag power --marked 0.5 --share 0.6 --points 60
"""


@click.command("power", epilog=EXAMPLES)
@chart_option()
@system_option()
@click.option(
    "--share",
    metavar="S",
    type=SHARE,
    help="The share of the matches that are dumped.  [default: several]",
)
@click.option(
    "--points",
    type=Whole(1, 500),
    metavar="D",
    help="With --share: how far below their skill they play in the dumped matches.  [default: they "
    "lose them all, with the scores of honest defeats]",
)
@click.option(
    "--matches",
    type=Whole(1, 500),
    default=80,
    metavar="N",
    help="How many matches each player plays.",
)
@click.option(
    "--marked",
    metavar="P",
    type=between(0.01, 1.0),
    help="The share of the matches that count for little and may be dumped; S is then a share of "
    "these.  [default: any match may be]",
)
@watch_options
@click.option(
    "--replicas",
    type=Whole(2, 100_000),
    default=250,
    metavar="R",
    help="How many players of each kind are simulated.",
)
@seed_option("Seed of the simulation.")
@faces()
def command(
    chart: str | None,
    system: handicaps.System,
    *,
    share: float | None,
    points: int | None,
    matches: int,
    day_sd: float,
    **asked: Any,
) -> Answer:
    """Show how soon the watch flags a sandbagger.

    Players who dump different shares of their matches are simulated and watched. At the start
    their ratings are as far off as ratings are in the long run.
    """
    from evenbreak.answers.sandbag_power import sandbag_power_answer

    if points is not None and share is None:
        refuse("--points goes with --share; give both")
    ladder, warnings = watched_ladder(system, chart, day_sd)
    size = system.scale.points_per_doubling / 30.0
    kinds: list[Kind] = [(part, None if low is None else round(low * size)) for part, low in KINDS]
    if share is not None:
        kinds = [(0.0, None), *([(share, points)] if share else [])]
    found = []
    with Progress("kinds of players simulated") as progress:
        for count, (part, depth) in enumerate(kinds, 1):
            found.append(
                league.watch_power(ladder, share=part, points=depth, matches=matches, **asked)
            )
            progress(count, len(kinds))
    return sandbag_power_answer(found, ladder.chart.name, warnings=warnings, **asked)
