"""How fair the races of a whole tournament are: title odds beside an equal share.

A chart that is fair match by match need not be fair over a tournament: small edges add up
from round to round, and long rounds for those on the losers' side weigh on some players
more than on others. In a tournament without favourites each of n players has 1/n.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import column
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.odds.races import PairOdds, Race, Races, pair_odds
from evenbreak.tournaments.odds.title import TitleOdds, title_odds

_MOST_CHOICES = 200


@own_arrays
@dataclass(frozen=True, eq=False)
class Fairness:
    """Title odds under a handicap.

    Parameters
    ----------
    races
        what is played.
    odds
        the title odds.
    edge
        for each player, how many times an equal share their title odds are, less 1: 0 is
        fair, 1 is twice the share.
    upper_half
        P(the title goes to the upper half by rating), of which a fair share is 1/2; a
        player in the middle counts half.
    games_mean
        the expected number of games of the whole tournament.
    """

    races: Races
    odds: TitleOdds
    edge: Floats
    upper_half: float
    games_mean: float

    @property
    def spread(self) -> float:
        """The root mean square of the edges: 0 is fair to everybody."""
        return unfairness(self.odds.title)


def upper_half(ratings: Floats, title: Floats) -> float:
    """Return P(the title goes to the upper half by rating); a player in the middle counts half.

    >>> upper_half(np.array([600.0, 500.0, 400.0]), np.array([0.5, 0.3, 0.2]))
    0.65
    """
    order = np.argsort(-ratings, kind="stable")
    half = len(order) // 2
    middle = 0.5 * title[order[half]] if len(order) % 2 else 0.0
    return float(title[order[:half]].sum() + middle)


def unfairness(title: Floats) -> float:
    """Return how far title odds are from equal: the root mean square, in equal shares.

    >>> unfairness(np.array([0.75, 0.25]))
    0.5
    """
    return float(np.sqrt(np.mean((len(title) * title - 1.0) ** 2)))


def tournament_fairness(
    bracket: Bracket,
    ratings: ArrayLike,
    races: Races | Race,
    *,
    scale: Scale | str | float = "fargo",
    break_advantage: float = 0.0,
) -> Fairness:
    """Return how fair the races of a tournament are to its players.

    Parameters
    ----------
    bracket
        the tournament, with the players on their lines.
    ratings, races, scale, break_advantage
        as in `pair_odds`.

    >>> from evenbreak.tournaments import double_elimination
    >>> found = tournament_fairness(double_elimination(4), [620, 560, 500, 440], Races(7))
    >>> found.edge.round(2), round(found.upper_half, 3)
    (array([ 2.54, -0.56, -0.98, -1.  ]), 0.996)
    """
    plan = races if isinstance(races, Races) else Races(races)
    rated = column(ratings, "ratings", len(bracket.players), "players")
    laws = pair_odds(bracket, rated, plan, scale=scale, break_advantage=break_advantage)
    return fairness_of(bracket, rated, plan, laws)


def fairness_of(
    bracket: Bracket, ratings: Floats, races: Races, laws: Mapping[str, PairOdds]
) -> Fairness:
    """Return how fair races are, given the odds of each match that they make."""
    odds = title_odds(bracket, laws)
    edge = len(ratings) * odds.title - 1.0
    return Fairness(races, odds, edge, upper_half(ratings, odds.title), _games(odds, laws))


def fairest_races(
    bracket: Bracket,
    ratings: ArrayLike,
    winners: Sequence[Race],
    losers: Sequence[Race] | None = None,
    final: Sequence[Race] | None = None,
    *,
    scale: Scale | str | float = "fargo",
    break_advantage: float = 0.0,
    most_games: float | None = None,
) -> list[Fairness]:
    """Return all combinations of races by side, the fairest tournament first.

    Parameters
    ----------
    bracket, ratings, scale, break_advantage
        as in `tournament_fairness`.
    winners, losers, final
        the races to choose from on each side; None: as on the winners' side.
    most_games
        leave out tournaments with more expected games than this.

    Raises
    ------
    InputError
        if there are no combinations, or more than 200.

    >>> from evenbreak.tournaments import Fairest, single_elimination
    >>> lengths = [Fairest(5), Fairest(7), Fairest(9)]
    >>> best = fairest_races(single_elimination(4), [620, 560, 500, 440], lengths)[0]
    >>> best.races.race, round(best.spread, 3)
    (Fairest(race_to=9), 0.045)
    """
    same: list[Race | None] = [None]
    chosen = product(winners, losers or same, final or same)
    combinations = [Races(race, other, last) for race, other, last in chosen]
    if not 1 <= len(combinations) <= _MOST_CHOICES:
        raise InputError(
            "there are {n_combinations} combinations of races; give lists that make 1 to "
            "{most_choices}",
            n_combinations=len(combinations),
            most_choices=_MOST_CHOICES,
        )
    found = [
        tournament_fairness(bracket, ratings, races, scale=scale, break_advantage=break_advantage)
        for races in combinations
    ]
    kept = [one for one in found if most_games is None or one.games_mean <= most_games]
    return sorted(kept, key=lambda one: one.spread)


def _games(odds: TitleOdds, laws: Mapping[str, PairOdds]) -> float:
    return float(
        sum(
            meeting.probability @ laws[name].mean_games[meeting.first, meeting.second]
            for name, meeting in odds.meetings.items()
        )
    )
