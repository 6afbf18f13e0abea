"""`evenbreak ladder`: how wrong the ratings of a league are in the long run."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import Whole, number, refuse, wants_json
from evenbreak.cli.kit.output import aligned, paragraphs, print_json, print_table, say, to_terminal
from evenbreak.cli.kit.plot import plot_option, write_plot

if TYPE_CHECKING:
    from evenbreak.cli.ladder.ladder_answer import LadderAnswer
    from evenbreak.handicaps.systems.system import System

LARGEST = 10_000
"""The largest error that can be typed, in points; a ladder says where it ends itself."""

MOST_A_NIGHT = 20

MOST_SD = 4.0
"""Doublings of the odds by which the form of players varies at most."""

MOST_DRIFT = 0.9
"""A rating that moves a point a match cannot follow a skill that does so each time."""

SHARES = (0.5, 0.75, 0.9, 0.95, 0.99)
"""The parts of the ratings whose largest error a terminal shows."""

EXAMPLES = """\b
Examples:
  evenbreak ladder --chart npl_10
  evenbreak ladder --chart npl_8 --autocorrelated --from -30 --newcomer
  evenbreak ladder --chart npl_10 --step 2 --plot step_2.png
  evenbreak ladder --compare
"""


def _points(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return points, 0 or more; by the scale it is said later how many are too many."""
    if value is None:
        return None
    return number(value, 0.0, math.inf, "; give points, 0 or more", ctx=ctx, param=param)


def _drift(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None
    wanted = f"; give a number from {-MOST_DRIFT:g} to {MOST_DRIFT:g}"
    return number(value, -MOST_DRIFT, MOST_DRIFT, wanted, ctx=ctx, param=param)


@click.command("ladder", epilog=EXAMPLES)
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
    callback=_points,
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
    callback=_points,
    help="How much it varies from match to match.",
)
@click.option(
    "--drift",
    metavar="POINTS",
    callback=_drift,
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
def command(
    chart_name: str | None, *, compare: bool, plot: str | None, as_json: bool, **asked: Any
) -> None:
    """Tell how wrong the ratings of a league are in the long run.

    A rating goes up with each match won and down with each match lost, and the chart turns
    the difference of two ratings into a race. ERROR is the rating less the skill, in points.
    """
    if compare:
        from evenbreak.cli.ladder.ladder_compare import compare_ladders

        compare_ladders(chart_name, asked, plot=plot, as_json=as_json)
        return
    found = _answer(chart_name, asked)
    if as_json:
        from evenbreak.cli.ladder.ladder_answer import as_json as answer

        print_json(answer(found))
    else:
        _print(found)
    if plot is not None:
        _draw(found, plot)
    for reason in found.not_told:
        say(f"Note: a part of the answer is left out: {reason}")


def _answer(chart_name: str | None, asked: dict[str, Any]) -> LadderAnswer:
    """Return the answer to the options, or refuse those that exclude each other."""
    from evenbreak.cli.ladder.ladder_answer import LadderAnswer, Question
    from evenbreak.cli.ladder.ladder_options import (
        chart_of_option,
        opponents_of_options,
        refuse_conflicts,
        say_if_long,
        system_of_options,
        why_not,
    )
    from evenbreak.errors import AccuracyError
    from evenbreak.handicaps.ladders.ladder import Ladder

    refuse_conflicts(asked)
    if chart_name == asked["league"] == "-":
        refuse("- stands for standard input, which only one file can be; name the other")
    system = system_of_options(asked)
    chart = chart_of_option(chart_name, system)
    opponents, name = opponents_of_options(asked, system.scale)
    _refuse_much(asked, system)
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
    except AccuracyError as error:
        raise AccuracyError(why_not(error, opponents)) from None
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


def _refuse_much(asked: dict[str, Any], system: System) -> None:
    """Refuse a form that varies by more than a ladder of this scale can hold."""
    most = MOST_SD * system.scale.points_per_doubling
    for name in ("day_sd", "match_sd"):
        if (asked[name] or 0.0) > most:
            refuse(
                f"--{name.replace('_', '-')} is {asked[name]:g}; give points from 0 to "
                f"{most:.0f}, by which the odds double {MOST_SD:g} times"
            )


def _print(found: LadderAnswer) -> None:
    """Print the law as CSV into a pipe, and the answer in words on a terminal."""
    from evenbreak.cli.ladder.ladder_answer import COLUMNS, rows
    from evenbreak.cli.ladder.ladder_words import heading, ladder_sentences

    if not to_terminal():
        print_table(COLUMNS, rows(found), headings=(), heading="", text=lambda _, value: str(value))
        return
    told = [heading(found), *ladder_sentences(found)]
    click.echo("\n\n".join(map(paragraphs, told)))
    listed = [[f"{100 * share:g} %", str(found.off.quantile(share))] for share in SHARES]
    click.echo("\n" + aligned([["of the ratings", "off by up to"], *listed]), nl=False)


def _draw(found: LadderAnswer, path: str) -> None:
    from itertools import accumulate

    from evenbreak.cli.ladder.ladder_words import title
    from evenbreak.plots.ladders import SettlingCurve, ladder_figure

    asked = found.question
    curve = None
    if found.settling is not None:
        settled = [*accumulate(found.settling.chances)]
        curve = SettlingCurve(asked.start, asked.within, settled)
    figure = ladder_figure(
        found.law, natural=found.natural, within=asked.within, curve=curve, title=title(found)
    )
    write_plot(figure, path)
