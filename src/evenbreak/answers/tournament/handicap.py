"""How fair a whole tournament's handicap is, and races that would make it fairer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Quantity, Table
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.tournament.tournament import Tournament
from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.odds.fairness import (
    Fairness,
    RoundOf,
    fairest_races,
    fairest_rounds,
    round_of,
    tournament_fairness,
    unfairness,
    upper_half,
)
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.races import Fairest, Race, Races
from evenbreak.tournaments.odds.title import PlaceOdds

_EVEN = 0.03  # a half of the field that is favored by less than this is not
_REACH = 2  # how many games longer or shorter a race may be
_OTHERWISE = (3, 5, 7, 9, 11)  # games of the races that are tried in place of a chart
_GAMES = (0.85, 1.02)  # the games of the fairer tournaments, as shares of today's
_GAMES_BY_ROUND = (0.95, 1.05)
_WORTH_IT = 0.95  # of the unfairness of the races by side
_SHOWN = 5


def favors_words(ratings: Floats, odds: PlaceOdds) -> str:
    """Return who a handicapped tournament's races favor.

    >>> import numpy as np
    >>> from evenbreak.tournaments import single_elimination, title_odds
    >>> odds = title_odds(single_elimination(2), [[0.5, 0.6], [0.4, 0.5]])
    >>> favors_words(np.array([600.0, 500.0]), odds)
    'The races favor the stronger half of the field: it wins the title 60% of the time, and
     50% would be fair.'
    """
    upper = upper_half(ratings, odds.title)
    if abs(upper - 0.5) < _EVEN:
        verdict = "are fair to both halves of the field: the stronger half"
    else:
        stronger = upper > 0.5
        verdict = f"favor the {'stronger' if stronger else 'weaker'} half of the field: it"
        upper = upper if stronger else 1.0 - upper
    often = percent(upper)
    return f"The races {verdict} wins the title {often} of the time, and 50% would be fair."


def favors(ratings: Floats, odds: PlaceOdds) -> list[Quantity]:
    """Return the same in numbers."""
    return quantities_of(
        {
            "-p_title_stronger_half": upper_half(ratings, odds.title),
            "-unfairness": unfairness(odds.title),
        }
    )


def fairer_races(tournament: Tournament) -> list[Part]:
    """Return today's races, and the fairest races by side and by round.

    They take about as many games on average; ratings are treated as exact. Raises InputError if
    races aren't handicapped, something is still to be drawn, or the bracket is too large.
    """
    bracket, races = tournament.bracket, tournament.races
    if isinstance(races.race, int):
        raise InputError("even races have no handicap to make fairer. Use handicapped races.")
    if tournament.to_draw or exact_plan(bracket) is None:
        raise InputError(
            "to find fairer races, the bracket must be drawn and small enough for exact odds"
        )
    asked: Any = {"scale": tournament.scale, "form": tournament.file.form}
    today = tournament_fairness(bracket, tournament.ratings, races, **asked)
    sides = {match.side for match in bracket.matches}
    found = fairest_races(
        bracket,
        tournament.ratings,
        _lengths(races.race),
        _lengths(races.losers or races.race) if sides & {"losers", "consolation"} else None,
        _lengths(races.final or races.race) if "final" in sides else None,
        most_games=_GAMES[1] * today.games_mean,
        **asked,
    )
    found = [one for one in found if one.games_mean >= _GAMES[0] * today.games_mean]
    columns = columns_of(
        "races_text losers_race final_race p_title_stronger_half unfairness games_mean"
    )
    rows = [_row(today), *map(_row, found[:_SHOWN])]
    table = Table("fairer_races", columns, rows, title="Today's races, and the fairest by side")
    by_round = _by_round(tournament, today, found)
    return [
        table,
        *by_round,
        "Unfairness is 0 if everyone has the same title odds, and 1 if the odds are typically "
        "off by as much as an equal share (root mean square). The table shows the stronger "
        "player's race; the weaker player gets the fairest race.",
    ]


def _by_round(tournament: Tournament, today: Fairness, by_side: Sequence[Fairness]) -> list[Part]:
    """Return races by round, if they are fairer than races by side."""
    bracket = tournament.bracket
    if bracket.groups or not by_side:
        return []
    fewest, most = (part * today.games_mean for part in _GAMES_BY_ROUND)
    near = [one for one in by_side if fewest <= one.games_mean <= most]
    begin = near[0] if near else min(by_side, key=lambda one: abs(one.games_mean - fewest))
    middle = today if isinstance(today.races.race, Fairest) else begin
    best = fairest_rounds(
        bracket,
        tournament.ratings,
        _by_rounds(bracket, begin.races),
        lengths={
            one: (max(1, games - _REACH), games + _REACH)
            for one, games in _by_rounds(bracket, middle.races).items()
        },
        games_mean=(fewest, most),
        scale=tournament.scale,
        form=tournament.file.form,
    )
    if not fewest <= best.found.games_mean <= most:
        return []
    if best.found.spread > _WORTH_IT * by_side[0].spread:
        return ["Races that differ from round to round would hardly be fairer than races by side."]
    now = {round_of(match): tournament.races.of(match) for match in reversed(bracket.matches)}
    rows = [
        [side, number, f"to {best.games[side, number]}", _words(now[side, number])]
        for side, number in dict.fromkeys(map(round_of, bracket.matches))
    ]
    columns = columns_of("side round race_text race_today")
    quantities = quantities_of(
        {"unfairness_by_round": best.found.spread, "games_mean_by_round": best.found.games_mean}
    )
    said = (
        "Choosing the length of the races round by round brings unfairness down from "
        f"{today.spread:.2f} to {best.found.spread:.2f}, with {best.found.games_mean:.0f} games "
        "on average."
    )
    table = Table("races_by_round", columns, rows, title="The fairest races by round")
    return [said, Quantities(quantities), table]


def _by_rounds(bracket: Bracket, races: Races) -> dict[RoundOf, int]:
    """Return the stronger player's games in each round."""
    found: dict[RoundOf, int] = {}
    for match in bracket.matches:
        race: Any = races.of(match)
        found.setdefault(round_of(match), race.race_to)
    return found


def _lengths(race: Race) -> Sequence[Race]:
    if isinstance(race, Fairest):
        first = max(1, race.race_to - _REACH)
        return [Fairest(games) for games in range(first, race.race_to + _REACH + 1)]
    return [Fairest(games) for games in _OTHERWISE]


def _row(found: Fairness) -> list[Any]:
    races = found.races
    shown = [_words(race) for race in (races.race, races.losers, races.final)]
    return [*shown, found.upper_half, found.spread, found.games_mean]


def _words(race: Race | None) -> str | None:
    match race:
        case None:
            return None
        case Fairest(race_to=games):
            return f"to {games}"
        case int():
            return f"to {race}"
    return race.name
