"""Fairness of a whole tournament's races: title odds compared with an equal share.

A chart that is fair match by match isn't necessarily fair over a tournament: small edges add up
from round to round, and the losers' side's many rounds affect some players more than others. In a
tournament without favorites, each of n players has a chance of 1/n.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import column, whole
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.brackets.bracket import Bracket, Match
from evenbreak.tournaments.odds.races import Fairest, PairOdds, Race, Races, pair_odds
from evenbreak.tournaments.odds.title import TitleOdds, title_odds

_MOST_CHOICES = 200


@own_arrays
@dataclass(frozen=True, eq=False)
class Fairness:
    """Title odds under a handicap.

    Parameters
    ----------
    edge
        each player's title odds in equal shares, minus 1: 0 is fair, 1 is twice the share.
    upper_half
        P(the title goes to the upper half by rating), whose fair value is 1/2; a player in the
        middle counts half.
    games_mean
        the expected number of games in the whole tournament.
    """

    races: Races
    odds: TitleOdds
    edge: Floats
    upper_half: float
    games_mean: float

    @property
    def spread(self) -> float:
        """The root mean square of the edges: 0 is fair to everyone."""
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
    form: float = 0.0,
) -> Fairness:
    """Return how fair a tournament's races are to its players.

    Parameters
    ----------
    bracket
        the bracket, with the players on their lines.

    >>> from evenbreak.tournaments import double_elimination
    >>> found = tournament_fairness(double_elimination(4), [620, 560, 500, 440], Races(7))
    >>> found.edge.round(2), round(found.upper_half, 3)
    (array([ 2.54, -0.56, -0.98, -1.  ]), 0.996)
    """
    plan = races if isinstance(races, Races) else Races(races)
    rated = column(ratings, "ratings", len(bracket.players), "players")
    laws = pair_odds(bracket, rated, plan, scale=scale, break_advantage=break_advantage, form=form)
    return fairness_of(bracket, rated, plan, laws)


def fairness_of(
    bracket: Bracket, ratings: Floats, races: Races, laws: Mapping[str, PairOdds]
) -> Fairness:
    """Return how fair races are, given each match's odds under them."""
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
    form: float = 0.0,
    most_games: float | None = None,
) -> list[Fairness]:
    """Return all combinations of races by side, fairest tournament first.

    Parameters
    ----------
    bracket, ratings, scale, break_advantage, form
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
            "the lists of races make {n_combinations} combinations. Give lists that make 1 to "
            "{most_choices}.",
            n_combinations=len(combinations),
            most_choices=_MOST_CHOICES,
        )
    found = [
        tournament_fairness(
            bracket, ratings, races, scale=scale, break_advantage=break_advantage, form=form
        )
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


# Races round by round that make a tournament fairest, for about as many games.


RoundOf: TypeAlias = tuple[str, int]
"""A round: its side of the bracket and its number on that side."""

_PAIRS = 8  # pairs of changes that are tried at a time


class FairestRounds(NamedTuple):
    """The fairest races by round that were found, as the stronger player's games."""

    games: Mapping[RoundOf, int]
    found: Fairness


def round_of(match: Match) -> RoundOf:
    """Return a match's round; a second final has the same race as the final."""
    return ("final", 1) if match.side in ("final", "second final") else (match.side, match.round)


def fairest_rounds(
    bracket: Bracket,
    ratings: ArrayLike,
    games: Mapping[RoundOf, int],
    *,
    lengths: Mapping[RoundOf, tuple[int, int]],
    games_mean: tuple[float, float],
    tries: int = 300,
    scale: Scale | str | float = "fargo",
    form: float = 0.0,
) -> FairestRounds:
    """Return races by round that make a tournament fairer, changing one or two at a time.

    `games` is the starting point: the stronger player's games; each round's number stays within its
    `lengths`, and the tournament's mean within `games_mean`. At most `tries` tournaments are tried.
    Raises InputError if a round has no race to start with.
    """
    search = _Search(bracket, ratings, scale, whole(tries, "tries", at_least=1), games_mean, form)
    missing = {round_of(match) for match in bracket.matches} - set(games) & set(lengths)
    if missing:
        raise InputError("{games} has no race for {missing}", missing=min(missing))
    rounds = sorted({round_of(match) for match in bracket.matches})
    best = {one: games[one] for one in games if one in rounds}
    while not search.over:
        steps = [
            (one, by)
            for one in rounds
            for by in (-1, 1)
            if lengths[one][0] <= best[one] + by <= lengths[one][1]
        ]
        better = _better(search, best, steps)
        if better == best:
            break
        best = better
    found = search.fairness(best)
    return FairestRounds(best, found)


Step: TypeAlias = tuple[RoundOf, int]


def _better(search: _Search, best: dict[RoundOf, int], steps: list[Step]) -> dict[RoundOf, int]:
    """Return the best tournament that is one or two steps away, or the current one."""
    here = search.fairness(best)
    tried = {step: search.fairness(_after(best, [step])) for step in steps}

    def sum_of(pair: tuple[Step, Step]) -> tuple[float, float]:
        ends = [tried[step] for step in pair]
        return (
            sum(one.spread for one in ends) - here.spread,
            sum(one.games_mean for one in ends) - here.games_mean,
        )

    pairs = [pair for pair in combinations(steps, 2) if pair[0][0] != pair[1][0]]
    allowed = [pair for pair in pairs if search.allows(sum_of(pair)[1])]
    promising = sorted(allowed, key=lambda pair: sum_of(pair)[0])[:_PAIRS]
    ways = [[step] for step in steps] + [list(pair) for pair in promising]
    reached = [best, *(_after(best, way) for way in ways)]
    fit = [one for one in reached if search.allows(search.fairness(one).games_mean)] or [best]
    return min(fit, key=lambda one: search.fairness(one).spread)


def _after(games: Mapping[RoundOf, int], steps: Iterable[Step]) -> dict[RoundOf, int]:
    changed = dict(games)
    for one, by in steps:
        changed[one] += by
    return changed


class _Search:
    """The tournaments tried so far."""

    def __init__(
        self,
        bracket: Bracket,
        ratings: ArrayLike,
        scale: Scale | str | float,
        tries: int,
        games_mean: tuple[float, float],
        form: float,
    ) -> None:
        self.bracket, self.scale, self.tries, self.form = bracket, scale, tries, form
        self.ratings = column(ratings, "ratings", len(bracket.players), "players")
        self.games_mean = games_mean
        self.laws: dict[int, PairOdds] = {}
        self.tried: dict[tuple[int, ...], Fairness] = {}

    @property
    def over(self) -> bool:
        """Whether enough have been tried."""
        return len(self.tried) >= self.tries

    def allows(self, games_mean: float) -> bool:
        """Return whether a tournament has neither too few nor too many games."""
        return self.games_mean[0] <= games_mean <= self.games_mean[1]

    def fairness(self, games: Mapping[RoundOf, int]) -> Fairness:
        """Return how fair races by round are."""
        key = tuple(games[one] for one in sorted(games))
        if key not in self.tried:
            race = {match.name: games[round_of(match)] for match in self.bracket.matches}
            laws = {name: self._law(number) for name, number in race.items()}
            plan = Races(
                Fairest(key[0]), by_match={name: Fairest(number) for name, number in race.items()}
            )
            self.tried[key] = fairness_of(self.bracket, self.ratings, plan, laws)
        return self.tried[key]

    def _law(self, games: int) -> PairOdds:
        if games not in self.laws:
            first = self.bracket.matches[0].name
            found = pair_odds(
                self.bracket, self.ratings, Fairest(games), scale=self.scale, form=self.form
            )
            self.laws[games] = found[first]
        return self.laws[games]
