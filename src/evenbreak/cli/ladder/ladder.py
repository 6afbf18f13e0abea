"""`evenbreak ladder`: how far off the ratings of a league are in the long run."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import chart_option, scale_option, via_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.systems import chart_for, on_scale, system_option
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import Number, Whole, refuse
from evenbreak.cli.ladder.opponents import opponents_of_options, why_no_long_run

if TYPE_CHECKING:
    from evenbreak.answers.ladder.ladder import LadderFindings, LadderQuestion


LARGEST = 10_000
"""The largest error that can be typed, in points; a ladder says where it ends itself."""

MOST_A_NIGHT = 20

MOST_SD = 4.0
"""Doublings of the odds by which the form of players varies at most."""

MOST_DRIFT = 0.9
"""A rating that moves a point a match cannot follow a skill that does so each time."""

MANY_MOVES = 20
"""With more different moves than this, nights of several matches take long."""

POINTS = Number(0.0, math.inf, "; give points, 0 or more")

EXAMPLES = """\b
Examples:
  evenbreak ladder --chart npl_10
  evenbreak ladder --chart npl_8 --autocorrelated --from -30 --newcomer
  evenbreak ladder --chart npl_10 --step 2 --plot step_2.png
  evenbreak ladder --compare
"""


@click.command("ladder", epilog=EXAMPLES)
@chart_option()
@system_option(None)
@click.option(
    "--step",
    type=Whole(1, 100),
    metavar="K",
    help="Instead of --system: up K for a win, down K for a loss.",
)
@scale_option("the system's", fixed=False)
@click.option(
    "--autocorrelated",
    is_flag=True,
    help="Opponents are rated at the player's skill, with errors like the player's.",
)
@click.option(
    "--equal-skill",
    is_flag=True,
    help="Opponents are as good as the player, with rating errors like the player's.",
)
@click.option(
    "--league",
    metavar="ROSTER.csv",
    help="Opponents are drawn from a league, with rating errors like the player's.",
)
@click.option(
    "--skill",
    type=Whole(-LARGEST, LARGEST),
    metavar="S",
    help="With --league: the player's own skill.  [default: the league's median rating]",
)
@click.option(
    "--day-sd",
    type=POINTS,
    metavar="POINTS",
    help="How much everybody's form varies from night to night (standard deviation).",
)
@click.option(
    "--matches-a-night",
    type=Whole(1, MOST_A_NIGHT),
    metavar="N",
    help="How many matches are played with the form of one night.  [default: 1]",
)
@click.option(
    "--match-sd",
    type=POINTS,
    metavar="POINTS",
    help="How much everybody's form varies from match to match (standard deviation).",
)
@click.option(
    "--drift",
    type=Number(-MOST_DRIFT, MOST_DRIFT, f"; give a number from {-MOST_DRIFT} to {MOST_DRIFT}"),
    metavar="POINTS",
    help="How much the player's skill rises with each match on average: by a whole point, with "
    "this chance.",
)
@click.option(
    "--from",
    "start",
    type=Whole(-LARGEST, LARGEST),
    metavar="ERROR",
    help="How far off the rating is at the start.  [default: one doubling of the odds too low]",
)
@click.option(
    "--within",
    type=Whole(0, LARGEST),
    metavar="POINTS",
    help="How near to the skill a rating counts as settled.  [default: a sixth of a doubling of "
    "the odds]",
)
@click.option("--newcomer", is_flag=True, help="Use the system's longer steps for newcomers.")
@click.option("--compare", is_flag=True, help="Compare systems, charts and step sizes.")
@via_option
@plot_option
@faces()
def command(chart: str | None, *, compare: bool, plot: str | None, **asked: Any) -> Answer:
    """Show how far off a league's ratings are in the long run, and how fair its matches.

    A rating goes up with each match won and down with each match lost, and the chart turns
    the difference of two ratings into a race. ERROR is rating less skill, in points.
    """
    from evenbreak.answers.ladder.ladder import LadderFindings, ladder_answer, ladder_title

    if chart == asked["league"] == "-":
        refuse("- stands for standard input, which only one file can be; name the other")
    if compare:
        from evenbreak.cli.ladder.compare import comparison

        return comparison(chart, asked, plot)
    ladder, opponents, warnings = _ladder(chart, asked)
    found = LadderFindings(ladder, _question(ladder, asked, opponents))
    if plot is not None:
        _draw(found, ladder_title(ladder), plot)
    return ladder_answer(found, warnings)


def _ladder(
    chart_name: str | None, asked: dict[str, Any]
) -> tuple[handicaps.Ladder, str, list[str]]:
    """Return the ladder that is asked for, the word for its opponents, and warnings."""
    from evenbreak.errors import AccuracyError

    if asked["system"] is not None and asked["step"] is not None:
        refuse(f"--step {asked['step']} is a system of its own; leave out --system or --step")
    if asked["matches_a_night"] is not None and not asked["day_sd"]:
        refuse("--matches-a-night is how long a night's form lasts; give --day-sd, or leave it out")
    step = asked["step"]
    system = asked["system"] or handicaps.system_of("npl" if step is None else f"step {step}")
    system = on_scale(system, asked["scale"])
    chart, warnings = chart_for(system, chart_name)
    opponents, name, doubts = opponents_of_options(asked, system.scale)
    _refuse_much(asked, system)
    matches = asked["matches_a_night"] or 1
    try:
        built = handicaps.Ladder(
            system,
            chart,
            opponents=opponents,
            day_sd=asked["day_sd"] or 0.0,
            match_sd=asked["match_sd"] or 0.0,
            matches_a_night=matches,
            drift=asked["drift"] or 0.0,
        )
        say_if_long(built)
        built.law()
    except AccuracyError as error:
        raise AccuracyError(why_no_long_run(error, opponents)) from None
    return built, name, [*warnings, *doubts]


def _refuse_much(asked: dict[str, Any], system: handicaps.System) -> None:
    """Refuse form that varies by more than a ladder of this scale can hold."""
    most = MOST_SD * system.scale.points_per_doubling
    for name in ("day_sd", "match_sd"):
        if (asked[name] or 0.0) > most:
            refuse(
                f"--{name.replace('_', '-')} is {asked[name]:g}; give points from 0 to "
                f"{most:.0f}, which double the odds {MOST_SD:g} times"
            )


def say_if_long(ladder: handicaps.Ladder) -> None:
    """Say beforehand that nights of several matches take long where moves differ much."""
    moves = len(set(handicaps.match_table(ladder.system, ladder.chart).moves.ravel().tolist()))
    if ladder.matches_a_night > 1 and moves > MANY_MOVES:
        say(
            f"The system {ladder.system.name} has {moves} different moves, so nights of three "
            "matches can take 20 seconds to work out, of six a minute, and of more far longer"
        )


def _question(ladder: handicaps.Ladder, asked: dict[str, Any], opponents: str) -> LadderQuestion:
    """Return what is asked of the ladder, or refuse what it cannot answer."""
    from evenbreak.answers.ladder.ladder import LadderQuestion
    from evenbreak.handicaps.ladders.comparison import NEAR

    doubling = round(ladder.system.scale.points_per_doubling)
    start = -doubling if asked["start"] is None else asked["start"]
    within = round(NEAR * doubling) if asked["within"] is None else asked["within"]
    if abs(start) > ladder.widest:
        refuse(
            f"--from is {start}; give an error from {-ladder.widest} to {ladder.widest} points, "
            "where this ladder ends"
        )
    if asked["newcomer"] and not ladder.system.newcomer_steps:
        refuse(
            f"in the system {ladder.system.name} newcomers move like everybody else; leave "
            "--newcomer out, or use --system npl"
        )
    return LadderQuestion(start, within, asked["newcomer"], opponents, asked["via"])


def _draw(found: LadderFindings, title: str, path: str) -> None:
    from evenbreak.plots.ladders import ladder_figure

    within, curve = found.question.within, found.settling
    figure = ladder_figure(
        found.law, natural=found.natural, within=within, curve=curve, title=title
    )
    write_plot(figure, path)
