"""Races round by round that make a tournament fairest, for about as many games."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import combinations
from typing import NamedTuple, TypeAlias

from numpy.typing import ArrayLike

from evenbreak.checks import column, whole
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.brackets.bracket import Bracket, Match
from evenbreak.tournaments.odds.fairness import Fairness, fairness_of
from evenbreak.tournaments.odds.races import Fairest, PairOdds, Races, pair_odds

RoundOf: TypeAlias = tuple[str, int]
"""A round: its side of the bracket and its number there."""

_PAIRS = 8  # pairs of changes that are tried at a time


class FairestRounds(NamedTuple):
    """The fairest races by round that were found.

    Parameters
    ----------
    games
        the games that the stronger player needs in each round.
    found
        how fair they are.
    """

    games: Mapping[RoundOf, int]
    found: Fairness


def round_of(match: Match) -> RoundOf:
    """Return the round of a match; a second final has the race of the final."""
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
) -> FairestRounds:
    """Return races by round that make a tournament fairer, found by changing one or two at a time.

    Parameters
    ----------
    bracket, ratings, scale
        as in `tournament_fairness`.
    games
        where to begin: the games that the stronger player needs in each round.
    lengths
        the shortest and the longest race of each round.
    games_mean
        the fewest and the most games of the whole tournament, on average.
    tries
        how many tournaments are tried at most.

    Raises
    ------
    InputError
        if a round has no race to begin with.

    >>> from evenbreak.tournaments import single_elimination
    >>> bracket = single_elimination(4)
    >>> begin = {("winners", 1): 5, ("final", 1): 7}
    >>> asked = {"lengths": dict.fromkeys(begin, (3, 9)), "games_mean": (20.0, 30.0)}
    >>> best = fairest_rounds(bracket, [620, 560, 500, 440], begin, **asked)
    >>> best.games, round(best.found.spread, 3)
    ({('winners', 1): 6, ('final', 1): 6}, 0.049)
    """
    search = _Search(bracket, ratings, scale, whole(tries, "tries", at_least=1), games_mean)
    missing = {round_of(match) for match in bracket.matches} - set(games) & set(lengths)
    if missing:
        raise InputError("games has no race for {missing}", missing=min(missing))
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
    """Return the best of the tournaments that one or two steps lead to, or the one at hand."""
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
    """The tournaments that have been tried."""

    def __init__(
        self,
        bracket: Bracket,
        ratings: ArrayLike,
        scale: Scale | str | float,
        tries: int,
        games_mean: tuple[float, float],
    ) -> None:
        self.bracket, self.scale, self.tries = bracket, scale, tries
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
            found = pair_odds(self.bracket, self.ratings, Fairest(games), scale=self.scale)
            self.laws[games] = found[first]
        return self.laws[games]
