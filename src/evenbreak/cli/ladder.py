"""`evenbreak ladder`: how wrong the ratings of a league are in the long run."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.options import Whole, number, refuse, wants_json
from evenbreak.cli.output import aligned, paragraphs, print_json, print_table, say, to_terminal
from evenbreak.cli.plot import plot_option, write_plot

if TYPE_CHECKING:
    from evenbreak.cli.ladder_answer import LadderAnswer

__all__ = ["ladder"]

LARGEST = 10_000
"""The largest error that can be typed, in points; a ladder says where it ends itself."""

MOST_A_NIGHT = 20

MOST_DRIFT = 0.9
"""A rating that moves a point a match cannot follow a skill that does so each time."""

_RUNS_AWAY = (
    "the rating does not stay near the skill: the moves are too large for the scale, the form "
    "varies too much, or the skill drifts faster than they follow; give a smaller --step, another "
    "--system, or less of --day-sd, --match-sd or --drift"
)

SHARES = (0.5, 0.75, 0.9, 0.95, 0.99)
"""The parts of the ratings whose largest error a terminal shows."""

EXAMPLES = """\b
Examples:
  evenbreak ladder --chart npl_10
  evenbreak ladder --chart npl_8 --autocorrelated --from -30 --newcomer
  evenbreak ladder --chart npl_10 --step 2 --plot step_2.png
  evenbreak ladder --compare
"""


def _between(low: float, high: float) -> Callable[..., float | None]:
    """Return the callback of an option that is a number from low to high."""

    def read(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
        if value is None:
            return None
        wanted = f"; give a number from {low:g} to {high:g}"
        return number(value, low, high, wanted, ctx=ctx, param=param)

    return read


@click.command(epilog=EXAMPLES)
@click.option(
    "--chart",
    "chart_name",
    metavar="NAME_OR_FILE",
    help="The chart that says the races.  [default: the system's own]",
)
@click.option(
    "--system",
    "system_name",
    metavar="NAME",
    help="How ratings move: npl, step UP [DOWN], margin [MOST], elo [K] or fixed [GAMES].  "
    "[default: npl]",
)
@click.option(
    "--step", type=Whole(1, 100), metavar="K", help="Instead: up K with a win, down K with a loss."
)
@click.option(
    "--scale",
    "scale_name",
    metavar="npl|fargo|elo|POINTS",
    help="What the ratings mean.  [default: the system's]",
)
@click.option(
    "--autocorrelated",
    is_flag=True,
    help="Opponents rated at the player's skill, their skill off as his rating is.",
)
@click.option(
    "--equal-skill",
    is_flag=True,
    help="Opponents as good as the player, their ratings off as his is.",
)
@click.option(
    "--league", metavar="ROSTER.csv", help="Opponents drawn from a league, their ratings off too."
)
@click.option(
    "--skill",
    type=Whole(-LARGEST, LARGEST),
    metavar="S",
    help="With --league: the player's own.  [default: the league's median rating]",
)
@click.option(
    "--day-sd",
    metavar="POINTS",
    callback=_between(0.0, LARGEST),
    help="How much the form of all players varies from night to night.",
)
@click.option(
    "--matches-a-night",
    type=Whole(1, MOST_A_NIGHT),
    metavar="N",
    help="How many matches have the same day's form.  [default: 1]",
)
@click.option(
    "--match-sd",
    metavar="POINTS",
    callback=_between(0.0, LARGEST),
    help="How much it varies from match to match.",
)
@click.option(
    "--drift",
    metavar="POINTS",
    callback=_between(-MOST_DRIFT, MOST_DRIFT),
    help="By how much the player's skill rises with each match.",
)
@click.option(
    "--from",
    "start",
    type=Whole(-LARGEST, LARGEST),
    metavar="ERROR",
    help="How wrong a rating begins whose settling is told.  [default: what doubles the odds, too "
    "low]",
)
@click.option(
    "--within",
    type=Whole(0, LARGEST),
    metavar="POINTS",
    help="Settled is an error of so many points or less.  [default: a sixth of what doubles the "
    "odds]",
)
@click.option("--newcomer", is_flag=True, help="Let him move by the system's newcomer steps.")
@click.option("--compare", is_flag=True, help="Compare systems, and sizes of the step.")
@plot_option
@wants_json
def ladder(
    chart_name: str | None, *, compare: bool, plot: str | None, as_json: bool, **asked: Any
) -> None:
    """Tell how wrong the ratings of a league are in the long run.

    A rating goes up with each match won and down with each match lost, and the chart turns
    the difference of two ratings into a race. ERROR is the rating less the skill, in points.
    """
    if compare:
        from evenbreak.cli.ladder_compare import compare_ladders

        compare_ladders(chart_name, asked, plot=plot, as_json=as_json)
        return
    found = _answer(chart_name, asked)
    if as_json:
        from evenbreak.cli.ladder_answer import as_json as answer

        print_json(answer(found))
    else:
        _print(found)
    if plot is not None:
        _draw(found, plot)
    for reason in found.not_told:
        say(f"Note: a part of the answer is left out: {reason}")


def _answer(chart_name: str | None, asked: dict[str, Any]) -> LadderAnswer:
    """Return the answer to the options, or refuse those that exclude each other."""
    from evenbreak.cli.ladder_answer import LadderAnswer, Question
    from evenbreak.cli.ladder_options import (
        chart_of_option,
        opponents_of_options,
        refuse_conflicts,
        say_if_long,
        system_of_options,
    )
    from evenbreak.errors import AccuracyError
    from evenbreak.handicaps.ladder import Ladder

    refuse_conflicts(asked)
    if chart_name == asked["league"] == "-":
        refuse("- stands for standard input, which only one file can be; name the other")
    system = system_of_options(asked)
    chart = chart_of_option(chart_name, system)
    opponents, name = opponents_of_options(asked)
    say_if_long(system, chart, asked["matches_a_night"] or 1)
    try:
        built = Ladder(
            system,
            chart,
            opponents=opponents,
            day_sd=asked["day_sd"] or 0.0,
            match_sd=asked["match_sd"] or 0.0,
            matches_a_night=asked["matches_a_night"] or 1,
            drift=asked["drift"] or 0.0,
        )
    except AccuracyError:
        raise AccuracyError(_RUNS_AWAY) from None
    doubling = round(system.scale.points_per_doubling)
    start, within = asked["start"], asked["within"]
    if start is None:
        start = -doubling
    if within is None:
        within = round(doubling / 6)
    if abs(start) > built.widest:
        refuse(
            f"--from is {start}; the ladder goes from {-built.widest} to {built.widest} points, "
            "give an error on it"
        )
    if asked["newcomer"] and not system.newcomer_steps:
        refuse(
            f"in the system {system.name} newcomers move like all others; leave --newcomer out, "
            "or take --system npl"
        )
    return LadderAnswer(built, Question(start, within, asked["newcomer"], name))


def _print(found: LadderAnswer) -> None:
    """Print the law as CSV into a pipe, and the answer in words on a terminal."""
    from evenbreak.cli.ladder_answer import COLUMNS, rows
    from evenbreak.cli.ladder_words import heading, ladder_sentences

    if not to_terminal():
        print_table(COLUMNS, rows(found), headings=(), heading="", text=lambda _, value: str(value))
        return
    told = [heading(found), *ladder_sentences(found)]
    click.echo("\n\n".join(map(paragraphs, told)))
    listed = [[f"{100 * share:g} %", str(found.off.quantile(share))] for share in SHARES]
    click.echo("\n" + aligned([["of the ratings", "off by up to"], *listed]), nl=False)


def _draw(found: LadderAnswer, path: str) -> None:
    from itertools import accumulate

    from evenbreak.cli.ladder_words import title
    from evenbreak.reports.ladder_plots import SettlingCurve, ladder_figure

    asked = found.question
    curve = None
    if found.settling is not None:
        settled = [*accumulate(found.settling.chances)]
        curve = SettlingCurve(asked.start, asked.within, settled)
    figure = ladder_figure(
        found.law, natural=found.natural, within=asked.within, curve=curve, title=title(found)
    )
    write_plot(figure, path)
