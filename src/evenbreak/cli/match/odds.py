"""The commands about one match, `odds`, `fair` and `live`: who plays, and what is played."""

import math
from dataclasses import replace
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import SAY_WHICH, number_of, refuse
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.questions.match import Fair, Live, Odds, Players
from evenbreak.ratings.scale import Scale, unstated_scale

MOST_SCORES = 10_000
"""The most scores that a match may still come to, so that every answer takes seconds."""
MOST_BY_WAY = 25_000
"""The most scores of a race of games, if its graph is solved in floats: a race 158:158."""


@command_of(Odds, "odds")
def command(asked: Odds) -> Answer:
    """Give the odds of a match."""
    from evenbreak.answers.match.odds import odds_answer

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
    m, n = asked.race or (1, 1)
    return players, Race(
        m, n, rack, breaks=breaks, first_breaker=first, score=start, win_by=asked.win_by or 1
    )


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
    if asked.from_file is not None:
        return _named(asked.ratings, asked.from_file, asked.scale, form)
    a, b = map(number_of, asked.ratings)
    if not math.isfinite(a - b):
        refuse("the ratings are too far apart to calculate with; give smaller numbers")
    scale = asked.scale or unstated_scale([a, b], ["A", "B"], SAY_WHICH)
    return replace(TwoPlayers.rated(a, b, scale), form=form or 0.0)


def _named(
    names: tuple[str, ...], path: str, scale: Scale | None, form: float | None
) -> TwoPlayers:
    """Return two players of a list, with its ratings, scale, errors and form of the day."""
    from evenbreak.answers.league.prior import games_words
    from evenbreak.answers.league.roster_matchups import cannot_be_compared
    from evenbreak.answers.league.sheet import find_players
    from evenbreak.cli.kit.systems import refuse_levels, refuse_other_scale
    from evenbreak.cli.kit.terminal import say
    from evenbreak.files.lists.roster import read_roster
    from evenbreak.ratings.roster import NOT_STATED, Roster

    file = read_roster(path)
    if scale is not None:
        refuse_other_scale(
            file, scale, "--scale", "leave --scale out, or correct the file", stated=True
        )
    elif file.scale is None:
        refuse_levels(file, "say with --scale how many levels double the odds")
    points = file.scale_by(scale, SAY_WHICH)
    roster = file.roster.with_starters(points.centre, points.points_per_doubling, points)
    places = find_players(roster, names, said="--from", where=file.source)
    if len(places) < 2:
        refuse(f"{names[0]!r} and {names[1]!r} are one player; name two")
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
