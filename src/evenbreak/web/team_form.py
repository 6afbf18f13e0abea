"""The form that starts a team night: its fields, and the resulting plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import chain
from typing import Any

import numpy as np

from evenbreak.answers.kit.scales import league_doubts
from evenbreak.answers.kit.wording import some_of
from evenbreak.answers.league.prior import starters_words
from evenbreak.answers.team.strengths import level_words, lists_by_level
from evenbreak.errors import DataError
from evenbreak.fields.question import declaration
from evenbreak.files.league.league_file import LeagueFile
from evenbreak.files.league.values import MOST_SETS
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.files.lists.teams import TeamList, form_of_lists, read_team
from evenbreak.files.tables.names import clean_name, is_name
from evenbreak.handicaps.charts.chart_of import EVERY_CHART
from evenbreak.handicaps.charts.level_chart import (
    LEVEL_CHARTS,
    POINTS_CHARTS,
    level_chart,
    points_chart,
)
from evenbreak.handicaps.charts.level_skills import FARGO, LevelSkills
from evenbreak.questions.of_league import key_of, text_of
from evenbreak.questions.teams import ORDERS, Lineup, OnTables, usual_sets
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale, scale_of, unstated_scale
from evenbreak.teams.evening.events import LevelsTonight, NightPlan, TeamSheet
from evenbreak.web.forms import (
    CHOOSE_IT,
    FAIR,
    RACES,
    Form,
    fields_named,
    list_of,
    read_upload,
    scale_in,
    value_of,
    warnings_of,
)
from evenbreak.web.guard import RefusalError
from evenbreak.web.league import League
from evenbreak.words import Sentence, say

FIELDS = fields_named(
    Lineup, "sets", "order", "count", "doubles", "cap", "at_most", "times", "sure"
)
"""What the form asks in the same way as `evenbreak lineup`."""

TIMES = fields_named(OnTables, "discipline", "tables")
"""What it asks for to predict when the night ends."""


def plan_of(
    form: Form, league: League, rules: LeagueFile | None = None
) -> tuple[NightPlan, list[str]]:
    """Return the plan that a form asks for, and what is doubtful about its lists.

    Players without a rating get the league's, if it knows them. As in `evenbreak lineup`, the worth
    of skill levels is estimated from the results that the league's file names.
    """
    names = [clean_name(form.text(f"team_{side}", longest=60)) for side in "ab"]
    if not all(names):
        raise RefusalError("A team has no name. Name both teams.")
    for name in names:
        if not is_name(name):
            raise RefusalError("The name {value!r} can't be printed. Type it again.", value=name)
    lists = []
    for side, name in zip("ab", names, strict=True):
        content = list_of(form, f"players_{side}", f"file_{side}")
        if not content.strip():
            raise RefusalError("Enter at least one player.")
        lists.append(_read(content, name))
    races = form.one_of("races", (*RACES, *EVERY_CHART))
    results = text_of(rules, key_of(Lineup, "results")) if rules else None
    lists, by_level, levels, rests_on = _by_level(races, lists, results)
    if by_level:
        scale = FARGO
    else:
        scale = _scale(form, lists, league)
        lists = [_with_league(one, scale, league) for one in lists]
    asked = {one.name: value_of(one, form) for one in FIELDS if one.name != "order"}
    sheets = [_sheet(name, one, scale, asked) for name, one in zip(names, lists, strict=True)]
    fewest = min(len(sheet.players) for sheet in sheets) * asked["times"]
    race: Any = declaration(Lineup, "race").kind
    plan = NightPlan(
        (sheets[0], sheets[1]),
        asked["sets"] or usual_sets(fewest, asked["cap"]),
        race=0 if races in EVERY_CHART else form.whole("race", race.low, race.high),
        handicapped=races == FAIR,
        chart=races if races in EVERY_CHART else "",
        order=form.text("pattern", longest=MOST_SETS) or form.one_of("order", tuple(ORDERS)),
        count=asked["count"],
        doubles=asked["doubles"],
        cap=asked["cap"],
        at_most=asked["at_most"],
        times=asked["times"],
        scale=scale.text,
        match_form=form_of_lists(one.file.form for one in lists),
        by_level=by_level,
        levels=None if levels is None else LevelsTonight.of(levels),
        **{one.name: value_of(one, form) for one in TIMES},
    )
    warnings = [
        line for name, one in zip(names, lists, strict=True) for line in warnings_of(one.file, name)
    ]
    both = [name for name in sheets[0].players if name in sheets[1].players]
    if both:
        warnings.append(
            say("both teams list {names}; are they different people?", names=some_of(both))
        )
    for one in lists:
        filled = one.file.roster.with_starters(scale.center, scale.points_per_doubling, scale)
        warnings += filter(None, [starters_words(one.file.roster, filled)])
    rated = np.concatenate([one.file.roster.rating for one in lists])
    doubts = [] if by_level else league_doubts(scale, rated, say("is it the right scale?"))
    return plan, [*dict.fromkeys(warnings), *doubts, *filter(None, [rests_on])]


def _by_level(
    races: str, lists: list[TeamList], results: str | None
) -> tuple[list[TeamList], bool, LevelSkills | None, Sentence | None]:
    """Return the lists with a chart's levels, whether and how chances come from levels, and why."""
    if races not in LEVEL_CHARTS and races not in POINTS_CHARTS:
        return lists, False, None, None
    chart = level_chart(races) if races in LEVEL_CHARTS else points_chart(races)
    files, levels = lists_by_level([one.file for one in lists], chart, results)
    for file in files:
        without = np.isnan(file.roster.level)
        if without.any():
            raise RefusalError(
                "{name} has no skill level, and the chart needs one for every player.",
                name=file.roster.players[int(without.argmax())],
            )
    found = [TeamList(file, file.roster.level) for file in files]
    by_level = levels is not None or races in POINTS_CHARTS
    return found, by_level, levels, level_words(chart, levels)


def _read(content: bytes, name: str) -> TeamList:
    """Read a team's players; problems in the list name the team."""
    try:
        return read_upload(content, read_team)
    except DataError as error:
        raise DataError(
            [say("{name}: {problem}", name=name, problem=problem) for problem in error.problems]
        ) from None


def _with_league(read: TeamList, scale: Scale, league: League) -> TeamList:
    """Return a team, taking missing ratings from the league."""
    if league.sheet is None or not league.sheet.ratings.scale.same_points(scale):
        return read
    roster = read.file.roster
    rating, error = roster.rating.copy(), roster.standard_error.copy()
    for k, name in enumerate(roster.players):
        if np.isnan(rating[k]) and (known := league.known(name)):
            _, rating[k], error[k], _ = known
    form = read.file.form or league.sheet.ratings.match_form
    filled = Roster(roster.players, rating, error)
    return replace(read, file=replace(read.file, roster=filled, form=form))


def _scale(form: Form, lists: list[TeamList], league: League) -> Scale:
    """Return the ratings' scale, as stated by the form, the lists or the league."""
    if points := form.above_0("doubling"):
        return scale_of(points)
    if any(one.file.levels for one in lists):
        raise RefusalError(
            "The lists have skill levels instead of ratings. Choose a skill-level chart, or "
            "open More and enter how many levels double the odds."
        )
    stated = [one.file.scale for one in lists if one.file.scale is not None]
    if any(not stated[0].same_points(other) for other in stated[1:]):
        raise RefusalError("The two lists are on different scales. Put all ratings on one scale.")
    if stated:
        for one in lists:
            refuse_to_read(one.file, stated[0], say("the other team's list"), CHOOSE_IT)
        return stated[0]
    unrated = all(np.isnan(one.file.roster.rating).all() for one in lists)
    if unrated and league.sheet is not None:
        return league.sheet.ratings.scale
    rated = [(one.file.roster.rating.tolist(), one.file.roster.players) for one in lists]
    ratings, players = (list(chain.from_iterable(each)) for each in zip(*rated, strict=True))
    return scale_in(form) or unstated_scale(ratings, players, CHOOSE_IT)


def _sheet(name: str, read: TeamList, scale: Scale, asked: Mapping[str, Any]) -> TeamSheet:
    """Return a team in which new players get an average rating with a large uncertainty."""
    if read.without_weight and (asked["cap"] or asked["at_most"]):
        raise RefusalError(
            "{name} has no skill level, and a cap needs one for every player.",
            name=read.without_weight,
        )
    roster = read.file.roster.with_starters(scale.center, scale.points_per_doubling, scale)
    errors = np.zeros(len(roster)) if asked["sure"] else np.nan_to_num(roster.standard_error)
    weights = np.nan_to_num(read.weights)
    return TeamSheet(
        name,
        roster.players,
        tuple(roster.rating.tolist()),
        tuple(errors.tolist()),
        tuple(weights.tolist()),
    )
