"""`evenbreak sandbag power`: how soon the watch sees a sandbagger."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import Whole, refuse, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    paragraphs,
    print_json,
    print_table,
    to_terminal,
)
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.sandbag.options import (
    between,
    found_chart,
    found_system,
    wants_alpha,
    wants_chart,
    wants_day_sd,
    wants_honest,
    wants_system,
    watched_ladder,
)

if TYPE_CHECKING:
    from evenbreak.league.watch_power import WatchPower

KINDS: tuple[tuple[float, int | None], ...] = (
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
"""Who is simulated: the share of the matches that he dumps, and how many points below his skill
he plays them, where 30 double the odds."""

EXAMPLES = """\b
Examples:
  evenbreak sandbag power
  evenbreak sandbag power --honest established --matches 60
  evenbreak sandbag power --marked 0.5 --share 0.6 --points 60
"""


@click.command("power", epilog=EXAMPLES)
@wants_chart
@wants_system
@click.option(
    "--share",
    metavar="S",
    callback=between(0.0, 1.0),
    help="The share of the matches that he dumps.  [default: several]",
)
@click.option(
    "--points",
    type=Whole(1, 500),
    metavar="D",
    help="With --share: by how much below his skill he plays those.  [default: he loses them all, "
    "with scores of honest defeats]",
)
@click.option(
    "--matches",
    type=Whole(1, 500),
    default=80,
    show_default=True,
    metavar="N",
    help="How many matches he plays.",
)
@click.option(
    "--marked",
    metavar="P",
    callback=between(0.01, 1.0),
    help="The part of the matches known as those that may be dumped; S is of them.  [default: "
    "any may be]",
)
@wants_alpha
@wants_honest
@wants_day_sd
@click.option(
    "--replicas",
    type=Whole(2, 100_000),
    default=250,
    show_default=True,
    metavar="R",
    help="How many players of each kind are simulated.",
)
@click.option(
    "--seed", type=Whole(0, 2**32 - 1), default=1, show_default=True, help="Seed of the simulation."
)
@wants_json
def command(
    chart_name: str | None,
    system_name: str,
    *,
    share: float | None,
    points: int | None,
    matches: int,
    day_sd: float,
    as_json: bool,
    **asked: Any,
) -> None:
    """Tell how soon the watch sees a sandbagger.

    Players who sandbag more or less are simulated, each rated at first as rightly as the
    ladder rates, and watched.
    """
    from evenbreak.league.watch_power import watch_power

    if points is not None and share is None:
        refuse("--points is of the matches that he dumps; give their --share")
    chart = None if chart_name is None else found_chart(chart_name)
    ladder = watched_ladder(found_system(system_name), chart, day_sd)
    size = ladder.system.scale.points_per_doubling / 30.0
    several = [(part, None if low is None else round(low * size)) for part, low in KINDS]
    honest: tuple[float, int | None] = (0.0, None)
    kinds = several if share is None else [honest, *([(share, points)] if share else [])]
    found = []
    with Progress("kinds of players simulated") as progress:
        for count, (part, depth) in enumerate(kinds, 1):
            found.append(watch_power(ladder, share=part, points=depth, matches=matches, **asked))
            progress(count, len(kinds))
    _print(found, ladder.chart.name, matches, asked, as_json=as_json)


def _print(
    found: list[WatchPower], chart: str, matches: int, asked: dict[str, Any], *, as_json: bool
) -> None:
    within = sorted({max(1, round(matches * part / 4)) for part in (1, 2, 3, 4)})
    if as_json:
        kinds = [
            {
                **one._asdict(),
                "flagged": one.flagged.tolist(),
                "se": one.se.tolist(),
                "rating_error": one.rating_error.tolist(),
            }
            for one in found
        ]
        print_json({"chart": chart, **asked, "kinds": kinds, "schema_version": SCHEMA_VERSION})
        return
    if not to_terminal():
        columns = ["share", "points", "matches", "flagged", "se", "rating_error", "p_win"]
        rows: list[list[Any]] = [
            [one.share, one.points, *_at(one, n), one.p_win] for one in found for n in within
        ]
        print_table(columns, rows, headings=(), heading="", text=lambda _, value: str(value))
        return
    known = ""
    if asked["marked"] is not None:
        known = f" of the {asked['marked']:.0%} of the matches that are marked"
    print_table(
        ["share", "points", *map(str, within), "se", "error", "p_win"],
        [
            [
                "honest" if not one.share else f"{one.share:.0%}",
                "" if not one.share else "loses" if one.points is None else f"-{one.points}",
                *(float(one.flagged[n - 1]) for n in within),
                float(one.se.max()),
                float(one.rating_error[-1]),
                one.p_win,
            ]
            for one in found
        ],
        headings=[
            "dumps",
            "plays",
            *(f"flagged\nin {n}" for n in within),
            "se at\nmost",
            "rating\nerror",
            "wins in\nearnest",
        ],
        heading=paragraphs(
            f"{chart}, alarm at e = {1.0 / asked['alpha']:,.0f}, honest: {asked['honest']}; "
            f"{asked['replicas']:,} simulated players who dump a share{known}"
        ),
        text=lambda name, value: (
            value
            if isinstance(value, str)
            else f"{value:.1f}"
            if name == "error"
            else f"{value:.3f}"
        ),
        left=2,
    )


def _at(one: WatchPower, n: int) -> list[Any]:
    place = n - 1
    return [n, float(one.flagged[place]), float(one.se[place]), float(one.rating_error[place])]
