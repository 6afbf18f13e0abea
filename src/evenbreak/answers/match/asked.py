"""From a question about one match to its answer: `odds`, `fair`, `live` and `compare`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.odds import (
    TwoPlayers,
    fair_answer,
    match_words,
    odds_answer,
    races_for,
)
from evenbreak.errors import InputError
from evenbreak.fields.question import refuse
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.questions.match import Compare, Fair, Live, Odds, Players
from evenbreak.ratings.scale import SCALES, Scale, refuse_contradicted, unstated_scale
from evenbreak.words import Command, Parameter

if TYPE_CHECKING:
    from evenbreak.files.lists.roster import RosterFile
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
    from evenbreak.matches.formats import MatchFormat

    AnyChart: TypeAlias = Chart | LevelChart | PointsChart

MOST_SCORES = 10_000
"""The most scores that a match may still reach, so that every answer takes seconds."""
MOST_BY_WAY = 25_000
"""The most scores in a race of games whose graph is solved in floats: a race to 158:158."""


MOST_COMPARED = {"race": 10_000, "break": 900, "": 2_500}
"""The most scores in a race if the break matters, in other matches if it does, and in other matches
if it doesn't, so that every answer takes seconds."""


def odds(asked: Odds) -> Answer:
    """Return a match's odds."""
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
    return players.noted(odds_answer(players, match, exact=asked.exact, via=asked.via))


def fair(asked: Fair) -> Answer:
    """Return the fairest races."""
    players = players_of(asked, asked.form)
    if asked.via is not None:
        refuse_uncertain(players)
    races = races_for(players, asked)
    return players.noted(fair_answer(players, races, target=asked.target, via=asked.via))


def live(asked: Live) -> Answer:
    """Return the odds of a match in progress."""
    from evenbreak.answers.match.live import live_answer
    from evenbreak.matches.live import live_odds, order_is_free

    if (points := _points(asked)) is not None:
        return points
    players, match = match_of(asked)
    refuse_giants(match)
    if players.form and not order_is_free(match):
        if asked.form is not None:
            refuse("{form} is for races in which the break doesn't matter. Leave it out here.")
        players = replace(players, form=0.0)
    odds = live_odds(match, asked.racks, set_score=asked.set_score, form=players.form)
    answer = live_answer(players, match, odds, comebacks=asked.comebacks)
    return replace(players.noted(answer), drawn=(players, odds))


def match_of(asked: Odds | Live) -> tuple[TwoPlayers, Match]:
    """Return the players and the match described by a question."""
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
    """Return a question's chart; None if it has none."""
    if asked.chart is None:
        return None
    from evenbreak.files.charts import find_chart

    return find_chart(asked.chart)


def _race_of(asked: Odds | Live, players: TwoPlayers) -> tuple[int, int]:
    """Return the race set by a question's chart."""
    chart: Any = _chart_of(asked)
    a, b = (math.floor(rating + 0.5) for rating in players.ratings or (0.0, 0.0))
    race: tuple[int, int] = chart.race(*players.levels) if players.levels else chart.race(a - b)
    return race


def _points(asked: Odds | Live) -> Answer | None:
    """Return the answer for a points chart; None if it isn't one."""
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
    """Return the levels typed."""
    a, b = (int(float(text)) for text in asked.ratings)
    return a, b


def _levels_of(
    file: RosterFile, places: Sequence[int], chart: LevelChart | PointsChart
) -> tuple[int, int]:
    """Return two listed players' levels; reject any level that isn't in the chart."""
    roster = file.roster
    for place in places:
        if roster.level[place] not in chart.levels:
            level = roster.level[place]
            has = "no skill level" if math.isnan(level) else f"skill level {level:g}"
            refuse(
                "{player!r} has {level} in {file}; the levels of {chart} are {levels}",
                player=roster.players[place],
                level=has,
                file=file.source,
                chart=chart.name,
                levels=", ".join(map(str, chart.levels)),
            )
    a, b = (int(roster.level[place]) for place in places)
    return a, b


def refuse_giants(match: Match, most: int = MOST_SCORES) -> None:
    """Reject a match with so many possible scores that it would take minutes."""
    win_by = getattr(match, "win_by", 0)
    left = [
        max(need - has, win_by, 1)
        for need, has in zip((match.m, match.n), match.score, strict=True)
    ]
    scores = left[0] * left[1] if win_by else match.m + match.n
    scores *= getattr(match.rack, "m", 1) * getattr(match.rack, "n", 1)
    if scores > most:
        refuse(
            "{match} still has about {scores:,} possible scores. Give a match with at "
            "most {most:,}.",
            match=match_words(match),
            scores=scores,
            most=most,
        )


def players_of(asked: Players, form: float | None = None) -> TwoPlayers:
    """Return a question's players; its day-to-day form overrides the list's."""
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
    from evenbreak.answers.kit.systems import CHART_OR_SCALE, SAY_WHICH

    a, b = (float(text) + 0.0 for text in asked.ratings)  # -0 is 0
    if not math.isfinite(a - b):
        refuse("the ratings are too far apart for a calculation. Give smaller numbers.")
    scale = asked.scale or _scale_of_chart(chart)
    if scale is None:
        scale = unstated_scale(
            [a, b], ["A", "B"], SAY_WHICH, levels=SAY_WHICH if chart else CHART_OR_SCALE
        )
    if asked.scale is None and chart is not None:
        refuse_contradicted(
            scale, [a, b], ["A", "B"], whose=f"the chart {chart.name}", remedy=SAY_WHICH
        )
    return replace(TwoPlayers.rated(a, b, scale), form=form or 0.0)


def _scale_of_chart(chart: AnyChart | None) -> Scale | None:
    """Return the scale a chart is made for, if its name says so."""
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
    """Return a list with levels, and the names and places of two players on it."""
    from evenbreak.answers.league.by_level import by_level
    from evenbreak.files.lists.roster import read_roster

    file, _ = by_level(read_roster(path), chart, asked.results)
    places = _places(asked, file)
    a, b = (file.roster.players[place] for place in places)
    return file, (a, b), places


def _places(asked: Players, file: RosterFile) -> list[int]:
    """Return the two players' places on the list."""
    from evenbreak.answers.league.sheet import find_players

    places = find_players(
        file.roster, asked.ratings, said=Parameter("from_file"), where=file.source
    )
    if len(places) < 2:
        one, other = asked.ratings
        refuse(
            "{one!r} and {other!r} are the same player. Name two different ones.",
            one=one,
            other=other,
        )
    return places


def _named(asked: Players, path: str, form: float | None) -> TwoPlayers:
    """Return two listed players, with the list's ratings, scale, errors and day-to-day form."""
    from evenbreak.answers.kit.systems import (
        CHART_OR_SCALE,
        LEAVE_OUT,
        SAY_WHICH,
        refuse_levels,
        refuse_other_scale,
    )
    from evenbreak.answers.league.prior import games_words
    from evenbreak.answers.league.roster_matchups import cannot_be_compared
    from evenbreak.files.lists.roster import read_roster
    from evenbreak.ratings.roster import NOT_STATED, Roster

    names, scale = asked.ratings, asked.scale
    file = read_roster(path)
    if scale is not None:
        refuse_other_scale(file, scale, Parameter("scale"), LEAVE_OUT, stated=True)
    elif file.scale is None:
        refuse_levels(file)
    points = file.scale_by(scale, SAY_WHICH, CHART_OR_SCALE)
    roster = file.roster.with_starters(points.center, points.points_per_doubling, points)
    places = _places(asked, file)
    for place in places:
        if math.isnan(file.roster.rating[place]):
            refuse(
                "{player!r} has no rating in {file}. Give two ratings.",
                player=roster.players[place],
                file=file.source,
            )
    a, b = places
    if cannot_be_compared(roster, a, b):
        refuse(
            "no chain of opponents links {one!r} and {other!r}, so their ratings can't be compared",
            one=roster.players[a],
            other=roster.players[b],
        )
    pair = [
        Roster(names, one.rating[places], one.standard_error[places], one.games[places])
        for one in (file.roster, roster)
    ]
    assumed = games_words(*pair) if (pair[0].games == NOT_STATED).any() else ""
    errors = [0.0 if math.isnan(error) else error for error in roster.standard_error.tolist()]
    players = TwoPlayers.rated(
        float(roster.rating[a]),
        float(roster.rating[b]),
        points,
        names=(roster.players[a], roster.players[b]),
        errors=(errors[a], errors[b]),
    )
    return replace(players, form=file.form if form is None else form, assumed=assumed)


def refuse_uncertain(players: TwoPlayers) -> None:
    """Reject --via if chances are averaged over rating errors, because these aren't a limit."""
    if players.form:
        refuse(
            "{via} is for one chain, but with {form} the answer is an average over many chains. "
            "Leave out {via} or {form}."
        )
    if players.error:
        refuse(
            "{via} is for one chain, but with {from_file} the answer is an average over "
            "how far the ratings may be off. Give the two ratings as numbers."
        )


class FormatsCompared(NamedTuple):
    """Formats side by side, as shown in a picture."""

    players: TwoPlayers
    formats: list[MatchFormat]
    line: dict[str, Any]
    pairs: dict[tuple[int, int], Any]


def compare(asked: Compare) -> Answer:
    """Return match formats side by side."""
    from evenbreak import matches
    from evenbreak.answers.match.formats import Compared, compare_answer

    players = players_of(asked, 0.0)
    read = _formats(asked.formats, players)
    line = _line(players, asked.hold)
    compared = []
    for played in read:
        match = played.match(
            players.rack, breaks=players.break_format, first_breaker=players.first_breaker
        )
        compared.append(
            Compared(played, matches.match_odds(match), matches.even_probability(played, **line))
        )
    pairs = {
        (i, j): matches.crossings(read[i], read[j], **line)
        for i, j in combinations(range(len(read)), 2)
    }
    answer = compare_answer(players, compared, pairs, hold=asked.hold)
    return replace(players.noted(answer), drawn=FormatsCompared(players, read, line, pairs))


def _formats(texts: Sequence[str], players: TwoPlayers) -> list[MatchFormat]:
    """Return the formats, or reject those that can't be compared here."""
    from evenbreak.matches.formats import match_format

    read = [match_format(text) for text in texts]
    for played in read:
        kinds = [played]
        while kinds[-1].set_ is not None:
            kinds.append(kinds[-1].set_)
        if kinds[-1].breaks is not None and not players.rack.break_matters:
            refuse(
                "{format!r} says who breaks, which matters only with {p1} and {p2}. Leave it out.",
                format=str(played),
            )
        for kind in kinds:
            race = len(kinds) == 1 and not kind.ahead and kind.win_by == 1
            if race and not players.rack.break_matters:
                continue
            most = MOST_COMPARED["race" if race else "break" if players.rack.break_matters else ""]
            scores = kind.scores // (kind.set_.scores if kind.set_ else 1)
            if scores > most:
                refuse(
                    "one part of {format!r} has about {scores:,} possible scores, but at most "
                    "{most:,} can be compared here. Use {odds} for such a match.",
                    format=str(played),
                    scores=scores,
                    most=most,
                    odds=Command("odds"),
                )
    return read


def _line(players: TwoPlayers, hold: str | None) -> dict[str, Any]:
    """Return the pairs of players for which formats are compared, as options for `crossings`."""
    p1, p2 = players.rack.p1, players.rack.p2
    if p2 is None:
        if hold is not None:
            refuse("{hold} needs {p1} and {p2}. Give them, or leave it out.")
        return {}
    line: dict[str, Any] = {"breaks": players.break_format, "first_breaker": players.first_breaker}
    if hold != "break":
        return line | {"p2": p2}
    if not (0.0 < p1 < 1.0 and 0.0 < p2 < 1.0):
        refuse("{hold} break needs {p1} and {p2} above 0 and below 1. Use {hold} p2.")
    return line | {"break_odds": p1 / (1.0 - p1) * p2 / (1.0 - p2)}
