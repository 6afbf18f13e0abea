"""The commands about one match, `odds`, `fair` and `live`: who plays, and what is played."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import SAY_WHICH, number_of, refuse
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.questions.match import Fair, Live, Odds, Players
from evenbreak.ratings.scale import SCALES, Scale, refuse_contradicted, unstated_scale

if TYPE_CHECKING:
    from evenbreak.files.lists.roster import RosterFile
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart

    AnyChart: TypeAlias = Chart | LevelChart | PointsChart

MOST_SCORES = 10_000
"""The most scores that a match may still come to, so that every answer takes seconds."""
MOST_BY_WAY = 25_000
"""The most scores of a race of games, if its graph is solved in floats: a race 158:158."""


@command_of(Odds, "odds")
def command(asked: Odds) -> Answer:
    """Give the odds of a match."""
    from evenbreak.answers.match.odds import odds_answer

    if (points := _points(asked)) is not None:
        return points
    players, match = match_of(asked)
    if asked.via is not None:
        refuse_uncertain(players)
    is_plain = getattr(match, "win_by", 0) == 1 and match.rack is players.rack
    if asked.exact or not is_plain:
        refuse_giants(match)
    elif asked.via is not None:
        refuse_giants(match, MOST_BY_WAY)
    return odds_answer(players, match, exact=asked.exact, via=asked.via)


@command_of(Fair, "fair")
def fair(asked: Fair) -> Answer:
    """Find the fairest races."""
    from evenbreak.answers.match.odds import fair_answer, races_for

    players = players_of(asked, asked.form)
    if asked.via is not None:
        refuse_uncertain(players)
    return fair_answer(players, races_for(players, asked), target=asked.target, via=asked.via)


@command_of(Live, "live")
def live(asked: Live) -> Answer:
    """Follow a match under way."""
    from evenbreak.answers.match.live import live_answer
    from evenbreak.matches.live import live_odds, order_is_free

    if (points := _points(asked)) is not None:
        return points
    players, match = match_of(asked)
    refuse_giants(match)
    if players.form and not order_is_free(match):
        if asked.form is not None:
            asked.refuse(
                "{form} is for races of games in which the break does not matter; leave it out here"
            )
        players = replace(players, form=0.0)
    odds = live_odds(match, asked.racks, set_score=asked.set_score, form=players.form)
    answer = live_answer(players, match, odds, comebacks=asked.comebacks)
    if asked.plot is not None:
        from evenbreak.plots.matches import course_figure

        write_plot(course_figure(odds, title=answer.heading, names=players.names), asked.plot)
    return answer


def match_of(asked: Odds | Live) -> tuple[TwoPlayers, Match]:
    """Return the players and the match that a question describes."""
    players = players_of(asked, asked.form)
    rack: Any = players.rack
    breaks, first = players.break_format, players.first_breaker
    start = asked.score or (0, 0)
    if asked.set_ is not None:  # the break format carries on across sets: only the set needs it
        rack = Race(*asked.set_, rack, breaks=breaks, first_breaker=first)
        breaks = None
    if asked.ahead is not None:
        from evenbreak.games.ahead import Ahead

        return players, Ahead(*asked.ahead, rack, breaks=breaks, first_breaker=first, score=start)
    m, n = asked.race or _race_of(asked, players)
    return players, Race(
        m, n, rack, breaks=breaks, first_breaker=first, score=start, win_by=asked.win_by or 1
    )


def _chart_of(asked: Players) -> AnyChart | None:
    """Return the chart of a question, None where there is none."""
    if asked.chart is None:
        return None
    from evenbreak.files.charts import find_chart

    return find_chart(asked.chart)


def _race_of(asked: Odds | Live, players: TwoPlayers) -> tuple[int, int]:
    """Return the race that the chart of a question sets."""
    chart: Any = _chart_of(asked)
    a, b = (math.floor(rating + 0.5) for rating in players.ratings or (0.0, 0.0))
    race: tuple[int, int] = chart.race(*players.levels) if players.levels else chart.race(a - b)
    return race


def _points(asked: Odds | Live) -> Answer | None:
    """Return the answer by a chart of points; None where the chart is none."""
    if asked.chart is None:
        return None
    from evenbreak.answers.match.points import points_answer
    from evenbreak.handicaps.charts.level_chart import PointsChart

    chart = _chart_of(asked)
    if not isinstance(chart, PointsChart):
        return None
    names = ("A", "B")
    if asked.from_file is None:
        levels = _levels(asked)
    else:
        file, names, places = _listed(asked, asked.from_file, chart)
        levels = _levels_of(file, places, chart)
    return points_answer(chart, levels, names, asked.score or (0, 0))


def _levels(asked: Players) -> tuple[int, int]:
    """Return the levels that are typed."""
    a, b = (int(number_of(text)) for text in asked.ratings)
    return a, b


def _levels_of(
    file: RosterFile, places: Sequence[int], chart: LevelChart | PointsChart
) -> tuple[int, int]:
    """Return the levels of two players of a list, or refuse what is no level of the chart."""
    roster = file.roster
    for place in places:
        if roster.level[place] not in chart.levels:
            level = roster.level[place]
            has = "no skill level" if math.isnan(level) else f"skill level {level:g}"
            refuse(
                f"{roster.players[place]!r} has {has} in {file.source}; the levels of "
                f"{chart.name} are {', '.join(map(str, chart.levels))}"
            )
    a, b = (int(roster.level[place]) for place in places)
    return a, b


def refuse_giants(match: Match, most: int = MOST_SCORES) -> None:
    """Refuse a match that can still come to so many scores that it would take minutes."""
    from evenbreak.answers.match.odds import match_words

    win_by = getattr(match, "win_by", 0)
    left = [
        max(need - has, win_by, 1)
        for need, has in zip((match.m, match.n), match.score, strict=True)
    ]
    scores = left[0] * left[1] if win_by else match.m + match.n
    scores *= getattr(match.rack, "m", 1) * getattr(match.rack, "n", 1)
    if scores > most:
        refuse(
            f"{match_words(match)} can still come to about {scores:,} scores; ask for a match "
            f"with at most {most:,}"
        )


def players_of(asked: Players, form: float | None = None) -> TwoPlayers:
    """Return the players that a question describes.

    Parameters
    ----------
    asked
        the question.
    form
        the form of the day that it states; None: that of the list.
    """
    if asked.p1 is not None and asked.p2 is not None:
        first = asked.first_break or ("b" if asked.breaks == "b" else "a")
        rack: Rack[float] = Rack(asked.p1, asked.p2)
        return TwoPlayers(rack, asked.breaks, 1 if first == "a" else 2, form=form or 0.0)
    if asked.p is not None:
        return TwoPlayers(Rack(asked.p), form=form or 0.0)
    chart = _chart_of(asked)
    if chart is not None:
        from evenbreak.handicaps.charts.level_chart import LevelChart

        if isinstance(chart, LevelChart):
            return _by_level(asked, chart, form)
    if asked.from_file is not None:
        return _named(asked, asked.from_file, form)
    a, b = map(number_of, asked.ratings)
    if not math.isfinite(a - b):
        refuse("the ratings are too far apart to calculate with; give smaller numbers")
    scale = asked.scale or _scale_of_chart(chart) or unstated_scale([a, b], ["A", "B"], SAY_WHICH)
    if asked.scale is None and chart is not None:
        refuse_contradicted(
            scale, [a, b], ["A", "B"], whose=f"the chart {chart.name}", remedy=SAY_WHICH
        )
    return replace(TwoPlayers.rated(a, b, scale), form=form or 0.0)


def _scale_of_chart(chart: AnyChart | None) -> Scale | None:
    """Return the scale that a chart is made for, if its name says it."""
    return None if chart is None else SCALES.get(chart.name.partition("_")[0])


def _by_level(asked: Players, chart: LevelChart, form: float | None) -> TwoPlayers:
    """Return two players by their skill levels: typed, or on a list, perhaps with ratings."""
    from evenbreak.answers.league.by_level import SCALE_OF_LEVELS, by_level, skills_of

    if asked.from_file is None:
        levels, skills = _levels(asked), skills_of(chart, asked.results)
        return replace(TwoPlayers.of_levels(levels, skills), form=form or 0.0)
    file, names, places = _listed(asked, asked.from_file, chart)
    levels = _levels_of(file, places, chart)
    if not file.levels:
        return replace(_named(asked, asked.from_file, form), levels=levels)
    if asked.scale is not None:
        raise InputError(SCALE_OF_LEVELS)
    _, read = by_level(file, chart, asked.results)
    players = TwoPlayers.of_levels(levels, read or skills_of(chart, None), names)
    return replace(players, form=file.form if form is None else form)


def _listed(
    asked: Players, path: str, chart: LevelChart | PointsChart
) -> tuple[RosterFile, tuple[str, str], list[int]]:
    """Return a list with levels, and the names and the places of two players on it."""
    from evenbreak.answers.league.by_level import by_level
    from evenbreak.files.lists.roster import read_roster

    file, _ = by_level(read_roster(path), chart, asked.results)
    places = _places(asked, file)
    a, b = (file.roster.players[place] for place in places)
    return file, (a, b), places


def _places(asked: Players, file: RosterFile) -> list[int]:
    """Return the places of the two players on a list."""
    from evenbreak.answers.league.sheet import find_players

    places = find_players(file.roster, asked.ratings, said="--from", where=file.source)
    if len(places) < 2:
        refuse(f"{asked.ratings[0]!r} and {asked.ratings[1]!r} are one player; name two")
    return places


def _named(asked: Players, path: str, form: float | None) -> TwoPlayers:
    """Return two players of a list, with its ratings, scale, errors and form of the day."""
    from evenbreak.answers.league.prior import games_words
    from evenbreak.answers.league.roster_matchups import cannot_be_compared
    from evenbreak.cli.kit.systems import refuse_levels, refuse_other_scale
    from evenbreak.cli.kit.terminal import say
    from evenbreak.files.lists.roster import read_roster
    from evenbreak.ratings.roster import NOT_STATED, Roster

    names, scale = asked.ratings, asked.scale
    file = read_roster(path)
    if scale is not None:
        refuse_other_scale(
            file, scale, "--scale", "leave --scale out, or correct the file", stated=True
        )
    elif file.scale is None:
        refuse_levels(file)
    points = file.scale_by(scale, SAY_WHICH)
    roster = file.roster.with_starters(points.centre, points.points_per_doubling, points)
    places = _places(asked, file)
    for place in places:
        if math.isnan(file.roster.rating[place]):
            refuse(f"{roster.players[place]!r} has no rating in {file.source}; give two ratings")
    a, b = places
    if cannot_be_compared(roster, a, b):
        refuse(
            f"no chain of opponents links {roster.players[a]!r} and {roster.players[b]!r}, so "
            "their ratings cannot be compared"
        )
    pair = [
        Roster(names, one.rating[places], one.standard_error[places], one.games[places])
        for one in (file.roster, roster)
    ]
    if (pair[0].games == NOT_STATED).any() and (said := games_words(*pair)):
        say(said)
    errors = [0.0 if math.isnan(error) else error for error in roster.standard_error.tolist()]
    players = TwoPlayers.rated(
        float(roster.rating[a]),
        float(roster.rating[b]),
        points,
        names=(roster.players[a], roster.players[b]),
        errors=(errors[a], errors[b]),
    )
    return replace(players, form=file.form if form is None else form)


def refuse_uncertain(players: TwoPlayers) -> None:
    """Refuse --via where chances are averaged over the errors of ratings: they are no limit."""
    if players.form:
        refuse(
            "--via is for one chain, but with --form the answer is an average over many; leave one "
            "out"
        )
    if players.error:
        refuse(
            "--via is for one chain, but with --from the answer is an average over how far the "
            "ratings may be off; give the two ratings as numbers"
        )
