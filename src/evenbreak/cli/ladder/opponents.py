"""Who a player on the ladder meets: --autocorrelated, --equal-skill, --league and --skill."""

from __future__ import annotations

from typing import Any

from evenbreak import files, handicaps
from evenbreak.cli.kit.options import SAY_WHICH
from evenbreak.cli.kit.systems import refuse_other_scale
from evenbreak.cli.kit.values import refuse
from evenbreak.errors import AccuracyError
from evenbreak.ratings.scale import Scale

MOST_APART = 20.0
"""Doublings of the odds that an opponent may be from the player: a game in a million."""


def opponents_of_options(
    asked: dict[str, Any], scale: Scale, remedy: str = SAY_WHICH
) -> tuple[handicaps.Opponents, str, list[str]]:
    """Return the opponents asked for, the word for them, and warnings about their list.

    `remedy` says what to do about a list of another scale.
    """
    given = [name for name in ("autocorrelated", "equal_skill", "league") if asked[name]]
    if len(given) > 1:
        *before, last = (f"--{name.replace('_', '-')}" for name in given)
        refuse(f"{', '.join(before)} and {last} cannot be combined; keep one")
    if asked["skill"] is not None and asked["league"] is None:
        refuse("--skill is the player's own in a league; give --league ROSTER.csv, or leave it out")
    if asked["league"] is not None:
        opponents, warnings = _of_league(
            asked["league"], asked["skill"], scale, remedy, stated=asked["scale"] is not None
        )
        return opponents, "league", warnings
    if asked["autocorrelated"]:
        return handicaps.AUTOCORRELATED, "autocorrelated", []
    if asked["equal_skill"]:
        return handicaps.EQUAL_SKILL, "equal skill", []
    return handicaps.NATURAL, "natural", []


def _of_league(
    path: str, skill: int | None, scale: Scale, remedy: str, *, stated: bool
) -> tuple[handicaps.Opponents, list[str]]:
    """Return opponents drawn from the rated players of a list, or refuse a skill far from them."""
    import numpy as np

    from evenbreak.answers.kit.scales import league_doubts
    from evenbreak.errors import DataError

    file = files.read_roster(path)
    refuse_other_scale(file, scale, "the ladder", remedy, stated=stated)
    ratings = file.roster.rating[~np.isnan(file.roster.rating)]
    if not len(ratings):
        raise DataError([f"{file.source}: no player has a rating; write one for each player"])
    warnings = [*file.warnings, *league_doubts(scale, ratings, remedy)]
    about = round(float(np.median(ratings))) if skill is None else skill
    low, high = float(ratings.min()), float(ratings.max())
    most = MOST_APART * scale.points_per_doubling
    if max(about - low, high - about) > most:
        refuse(
            f"{'the median' if skill is None else '--skill'} is {about}, and the ratings of "
            f"{file.source} are from {low:g} to {high:g}; no opponent may be more than {most:.0f} "
            "points from the player, so give a --skill nearer to all of them"
        )
    return handicaps.opponents_of(ratings, about=about), warnings


def why_no_long_run(error: AccuracyError, opponents: handicaps.Opponents) -> str:
    """Return why a ladder does not settle, and what to do about it on the command line."""
    if "at every difference" in str(error):
        return str(error)
    if opponents.farthest:
        return (
            "the rating does not stay near the skill: the league's players are so far from the "
            "player's skill that the chart's races are nearly always won or lost; give a --skill "
            "nearer to them, or the --scale of their ratings"
        )
    return (
        "the rating does not stay near the skill: the steps are too long for the scale, form "
        "varies too much, or skill drifts faster than the steps can follow; give a smaller "
        "--step, another --system, or less --day-sd, --match-sd or --drift"
    )
