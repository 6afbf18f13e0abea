"""Who plays: two ratings, two names on a list, a chance in a game, or one for each breaker."""

import math
from dataclasses import replace

from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.cli.kit.values import SAY_WHICH, number_of, refuse
from evenbreak.games.rack import Rack
from evenbreak.questions.match import Players
from evenbreak.ratings.scale import Scale, unstated_scale


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
