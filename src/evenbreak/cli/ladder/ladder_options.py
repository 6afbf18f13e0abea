"""What the options of `evenbreak ladder` stand for: a system, a chart, opponents."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak.cli.kit.callbacks import refuse
from evenbreak.cli.kit.output import say
from evenbreak.cli.kit.scale_doubts import scale_doubts

if TYPE_CHECKING:
    from evenbreak.errors import AccuracyError
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.handicaps.ladders.opponents import Opponents
    from evenbreak.handicaps.systems.system import System
    from evenbreak.ratings.scale import Scale

SCALE_OFF = 0.25
"""By what share the scale that a chart fits may be off before it is told."""

MOST_APART = 20.0
"""Doublings of the odds that an opponent may be from the player: a game in a million."""

MANY_MOVES = 20
"""With more moves of different size than this, nights of several matches take long."""


def refuse_conflicts(asked: dict[str, Any]) -> None:
    """Refuse options that exclude each other or need another."""
    models = [
        option
        for option in ("autocorrelated", "equal_skill", "league")
        if asked[option] not in (None, False)
    ]
    if len(models) > 1:
        *before, last = (f"--{option.replace('_', '-')}" for option in models)
        refuse(f"{', '.join(before)} and {last} exclude each other; keep one")
    if asked["system_name"] is not None and asked["step"] is not None:
        refuse(f"--step {asked['step']} is a system of its own; leave --system out, or --step")
    if asked["skill"] is not None and asked["league"] is None:
        refuse("--skill is the player's in a league; give --league ROSTER.csv, or leave it out")
    if asked["matches_a_night"] is not None and not asked["day_sd"]:
        refuse(
            "--matches-a-night says how many matches a day's form lasts; give --day-sd, or leave "
            "it out"
        )


def system_of_options(asked: dict[str, Any]) -> System:
    """Return the system that is asked for, on the scale that is asked for."""
    from dataclasses import replace

    from evenbreak.handicaps.systems.catalogue import system_of
    from evenbreak.ratings.scale import scale_of

    name = asked["system_name"] or ("npl" if asked["step"] is None else f"step {asked['step']}")
    system = system_of(name)
    if asked["scale_name"] is None:
        return system
    scale = scale_of(asked["scale_name"])
    if scale.points_per_doubling < 1.0:
        refuse(
            f"--scale is {asked['scale_name']!r}; ratings are whole points, so give 1 or more to "
            "double the odds"
        )
    if system.scale.name != "npl" and scale != system.scale:
        refuse(f"the rule of the system {system.name} is one of its own scale; leave --scale out")
    return replace(system, scale=scale)


def chart_of_option(name: str | None, system: System) -> Chart:
    """Return the chart of that name or file, and doubt it where it fits another scale."""
    from evenbreak.files.chart import find_chart_file
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.handicaps.charts.chart import Chart

    chart: Chart | LevelChart
    if name is None:
        chart = system.usual_chart()
    else:
        file = find_chart_file(name)
        for warning in file.warnings:
            say(f"Warning: {warning}")
        chart = file.chart
    if not isinstance(chart, Chart):
        refuse(
            f"--chart {name!r} is a chart of skill levels, which no match moves; give one of "
            "rating differences"
        )
    best, own = audit(chart, scale=system.scale).best_fit, system.scale.points_per_doubling
    if best is not None and abs(best.points_per_doubling / own - 1.0) > SCALE_OFF:
        say(
            f"Note: the races of {chart.name} fit a scale on which about "
            f"{best.points_per_doubling:.0f} points double the odds; here {own:.4g} do "
            "(--scale says otherwise)"
        )
    return chart


def say_if_long(system: System, chart: Chart, matches: int) -> None:
    """Tell a person that nights of several matches take long where moves differ much."""
    from evenbreak.handicaps.systems.match_table import match_table

    moves = len(set(match_table(system, chart).moves.ravel().tolist()))
    if matches > 1 and moves > MANY_MOVES:
        say(
            f"Note: the system {system.name} has {moves} different moves; nights of three matches "
            "then can take 20 seconds to work out, of six a minute, and of more far longer"
        )


def opponents_of_options(asked: dict[str, Any], scale: Scale) -> tuple[Opponents, str]:
    """Return the opponents that are asked for, and what they are called."""
    from evenbreak.handicaps.ladders.opponents import AUTOCORRELATED, EQUAL_SKILL, NATURAL

    if asked["autocorrelated"]:
        return AUTOCORRELATED, "autocorrelated"
    if asked["equal_skill"]:
        return EQUAL_SKILL, "equal skill"
    if asked["league"] is not None:
        return _of_league(asked["league"], asked["skill"], scale), "league"
    return NATURAL, "natural"


def _of_league(path: str, skill: int | None, scale: Scale) -> Opponents:
    """Return opponents drawn from the rated players of a list, or refuse a skill far from them."""
    import numpy as np

    from evenbreak.errors import DataError
    from evenbreak.files.roster import read_roster
    from evenbreak.handicaps.ladders.opponents import opponents_of

    file = read_roster(path)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    ratings = file.roster.rating[~np.isnan(file.roster.rating)]
    if not len(ratings):
        raise DataError([f"{file.source}: nobody in it has a rating; write one for each player"])
    for doubt in scale_doubts(scale, ratings, "--scale says what they mean"):
        say(doubt)
    about = round(float(np.median(ratings))) if skill is None else skill
    low, high = float(ratings.min()), float(ratings.max())
    most = MOST_APART * scale.points_per_doubling
    if max(about - low, high - about) > most:
        refuse(
            f"{'the median' if skill is None else '--skill'} is {about}, and the ratings of "
            f"{file.source} are from {low:g} to {high:g}; nobody may be more than {most:.0f} "
            "points from the player, so give a --skill nearer to all of them"
        )
    return opponents_of(ratings, about=about)


_RUNS_AWAY = (
    "the rating does not stay near the skill: the moves are too large for the scale, the form "
    "varies too much, or the skill drifts faster than they follow; give a smaller --step, another "
    "--system, or less of --day-sd, --match-sd or --drift"
)
_TOO_FAR = (
    "the rating does not stay near the skill: the league's players are too far from the player's "
    "skill for the races of the chart, so that he wins or loses nearly always; give a --skill "
    "nearer to them, or the --scale of their ratings"
)


def why_not(error: AccuracyError, opponents: Opponents) -> str:
    """Return why a ladder has no law, and what to do about it on the command line."""
    if "at every difference" in str(error):
        return str(error)
    return _TOO_FAR if opponents.farthest else _RUNS_AWAY
