"""From a question about ratings in the long run to its answer."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from evenbreak import files, handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.patience import takes_long
from evenbreak.answers.kit.systems import (
    SAY_WHICH,
    chart_for,
    level_system,
    on_scale,
    refuse_other_scale,
    refuse_too_varying,
)
from evenbreak.errors import DataError
from evenbreak.fields.question import worded
from evenbreak.questions.ladders import LadderErrors
from evenbreak.ratings.scale import Scale
from evenbreak.words import say

if TYPE_CHECKING:
    from evenbreak.answers.ladder.ladder import LadderQuestion


MANY_MOVES = 20
"""With more different moves than this, nights with several matches take long to calculate."""

MANY_POINTS = 500.0
"""On a scale with more points per doubling of the odds, the chain is large."""

MOST_APART = 20.0
"""How far an opponent may be from the player, in doublings of the odds: a game in a million."""

SAY_OTHERWISE = worded("{compare} is for NPL ratings. Leave it out and give {scale} for others.")


def ladder(asked: LadderErrors) -> Answer:
    """Return how far off ratings are in the long run."""
    from evenbreak.answers.ladder.ladder import LadderFindings, ladder_answer

    if asked.compare:
        return _comparison(asked)
    levels = level_system(asked.system, asked.chart if asked.step is None else None)
    if levels is not None:
        return _of_levels(asked, levels)
    meant, opponents, warnings = _ladder(asked)
    findings = LadderFindings(meant, _question(meant, asked, opponents))
    return replace(ladder_answer(findings, warnings), drawn=findings)


def _ladder(asked: LadderErrors) -> tuple[handicaps.Ladder, str, list[str]]:
    """Return the requested ladder, the term for its opponents, and warnings."""
    step = asked.step
    system = handicaps.steps_of(asked.system or ("npl" if step is None else f"step {step}"))
    system = on_scale(system, asked.scale)
    if system.scale.points_per_doubling > MANY_POINTS:
        takes_long(
            say(
                "A scale on which {points:,.0f} points double the odds has so many ratings that "
                "this can take minutes and gigabytes of memory",
                points=system.scale.points_per_doubling,
            )
        )
    chart, warnings = chart_for(system, asked.chart)
    opponents, name, doubts = _opponents(asked, system.scale)
    refuse_too_varying(asked, system, "day_sd", "match_sd")
    ladder = handicaps.Ladder(
        system,
        chart,
        opponents=opponents,
        day_sd=asked.day_sd,
        match_sd=asked.match_sd,
        matches_a_night=asked.matches_a_night or 1,
        drift=asked.drift,
    )
    say_if_long(ladder)
    ladder.law()
    return ladder, name, [*warnings, *doubts]


def _of_levels(asked: LadderErrors, system: handicaps.MarkovSystem) -> Answer:
    """Return a skill-level system's long run, against equals or the players on a list."""
    import numpy as np

    from evenbreak.answers.ladder.levels import level_ladder_answer
    from evenbreak.answers.league.by_level import by_level, with_level
    from evenbreak.answers.league.roster_matchups import check_roster
    from evenbreak.handicaps.systems.history import Entries
    from evenbreak.ratings.scale import SCALES

    for name in asked.given:
        if name not in ("system", "chart", "league", "equal_skill"):
            asked.refuse("{" + name + "} is for ratings in points. Leave it out with skill levels.")
    weights, warnings = None, []
    if asked.league is not None:
        chart: Any = system.chart
        file, _ = by_level(files.read_roster(asked.league), chart)
        levels = file.roster.level
        all_known = with_level(file, float(chart.levels[0])).roster  # who has none does not count
        check_roster(file, all_known, chart, SCALES["fargo"])
        warnings = list(file.warnings)
        places = chart.places(levels[~np.isnan(levels)])
        weights = np.bincount(places, minlength=len(chart.levels)).tolist()
    newcomer = int(system.initial(Entries.of(level=[np.nan]))[0])
    return level_ladder_answer(system, weights, newcomer, warnings)


def say_if_long(ladder: handicaps.Ladder) -> None:
    """Announce that nights with several matches take long if moves vary a lot."""
    moves = len(set(handicaps.match_table(ladder.system, ladder.chart).moves.ravel().tolist()))
    if ladder.matches_a_night > 1 and moves > MANY_MOVES:
        takes_long(
            say(
                "The system {name} has {moves} different moves, so nights of three matches can "
                "take 20 seconds to work out, nights of six can take a minute, and longer "
                "nights far more",
                name=ladder.system.name,
                moves=moves,
            )
        )


def _question(ladder: handicaps.Ladder, asked: LadderErrors, opponents: str) -> LadderQuestion:
    """Return the requested ladder settings, or reject what can't be answered."""
    from evenbreak.answers.ladder.ladder import LadderQuestion
    from evenbreak.handicaps.ladders.comparison import NEAR

    doubling = round(ladder.system.scale.points_per_doubling)
    start = -doubling if asked.start_error is None else asked.start_error
    within = round(NEAR * doubling) if asked.within is None else asked.within
    if abs(start) > ladder.widest:
        asked.refuse(
            "{start_error} must be from -{widest} to {widest} points, the largest errors "
            "possible on this ladder; you gave {start}",
            start=start,
            widest=ladder.widest,
        )
    if asked.newcomer and not ladder.system.newcomer_steps:
        asked.refuse(
            "in the system {name} newcomers move like everyone else. Leave {newcomer} "
            "out, or use {system} npl.",
            name=ladder.system.name,
        )
    return LadderQuestion(start, within, asked.newcomer, opponents, asked.via)


# Systems, charts and step sizes side by side.


def _comparison(asked: LadderErrors) -> Answer:
    """Return systems and steps side by side."""
    from evenbreak.answers.ladder.comparison import compare_ladders, ladder_comparison_answer

    npl = handicaps.steps_of("npl")
    chart, warnings = chart_for(npl, asked.chart)
    opponents, name, doubts = _opponents(asked, npl.scale, SAY_OTHERWISE)
    comparison = compare_ladders(chart, opponents, name)
    answer = ladder_comparison_answer(comparison, [*warnings, *doubts])
    return replace(answer, drawn=comparison)


# Who a player on the ladder meets.


def _opponents(
    asked: LadderErrors, scale: Scale, remedy: str = SAY_WHICH
) -> tuple[handicaps.Opponents, str, list[str]]:
    """Return the requested opponents, the term for them, and warnings about their list.

    `remedy` says what to do about a list on another scale.
    """
    if asked.league is not None:
        opponents, warnings = _of_league(asked, asked.league, scale, remedy)
        return opponents, "league", warnings
    if asked.autocorrelated:
        return handicaps.AUTOCORRELATED, "autocorrelated", []
    if asked.equal_skill:
        return handicaps.EQUAL_SKILL, "equal skill", []
    return handicaps.NATURAL, "natural", []


def _of_league(
    asked: LadderErrors, path: str, scale: Scale, remedy: str
) -> tuple[handicaps.Opponents, list[str]]:
    """Return opponents drawn from a list's rated players; reject a skill that is far from them."""
    import numpy as np

    from evenbreak.answers.kit.scales import league_doubts

    file = files.read_roster(path)
    refuse_other_scale(file, scale, "the ladder", remedy, stated=asked.scale is not None)
    ratings = file.roster.rating[~np.isnan(file.roster.rating)]
    if not len(ratings):
        raise DataError([f"{file.source}: no player has a rating. Write one for each player."])
    warnings = [*file.warnings, *league_doubts(scale, ratings, remedy)]
    about = round(float(np.median(ratings))) if asked.skill is None else asked.skill
    low, high = float(ratings.min()), float(ratings.max())
    most = MOST_APART * scale.points_per_doubling
    if max(about - low, high - about) > most:
        values: dict[str, Any] = {"about": about, "low": low, "high": high, "most": most}
        asked.refuse(
            ("the median" if asked.skill is None else "{skill}")
            + " is {about}, and the ratings in {source} run from {low:g} to {high:g}; no "
            "opponent may be more than {most:.0f} points away from the player, so give a "
            "{skill} closer to all of them",
            source=file.source,
            **values,
        )
    return handicaps.opponents_of(ratings, about=about), warnings
