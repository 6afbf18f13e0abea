"""What is played in each match: races by round and side, from a chart or the fairest of a length.

For every two players, a match's odds say who wins and in how many games. The chances of winning
determine the title odds, and the games determine the time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import betainc, expit

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.checks import column, number
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat, alternate_breaks
from evenbreak.games.race import Race as RaceOfGames
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.race_of_pair import Fairest as Fairest
from evenbreak.handicaps.charts.race_of_pair import Race as Race
from evenbreak.handicaps.charts.race_of_pair import games_needed as games_needed
from evenbreak.matches.endings import race_endings
from evenbreak.matches.form import (
    MOST_NODES,
    center_of_form,
    chance_in_form,
    form_of,
    normal_rule,
    on_days,
)
from evenbreak.matches.parameters import rack_in
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.tournaments.brackets.bracket import Bracket, Match


@own_arrays
@dataclass(frozen=True, eq=False)
class PairOdds:
    """Who wins a match and in how many games, for every two players.

    Parameters
    ----------
    ends
        ends[i, j, k] = P(i beats j, in k games); shape (n, n, games + 1).
    """

    ends: Floats

    @cached_property
    def win(self) -> Floats:
        """P(i beats j)."""
        won: Floats = np.minimum(self.ends.sum(axis=2), 1.0)  # a sum may round to more
        np.fill_diagonal(won, 0.5)
        return won

    @cached_property
    def mean_games(self) -> Floats:
        """The mean number of games when i plays j."""
        both = self.ends + self.ends.transpose(1, 0, 2)
        return np.asarray(both @ np.arange(both.shape[2]))


@dataclass(frozen=True)
class Races:
    """A tournament's races.

    Parameters
    ----------
    race
        on the winners' side, and anywhere not specified otherwise.
    losers
        on the losers' side and in the consolation event; None: as on the winners' side.
    final
        in the final and the second final; None: as on the winners' side.
    by_match
        for single matches, by name.

    >>> races = Races(7, losers=5, final=9)
    >>> races.of(Match("L2.1", "losers", 2, (0, 1))), races.of(Match("F", "final", 1, (0, 1)))
    (5, 9)
    """

    race: Race
    losers: Race | None = None
    final: Race | None = None
    by_match: Mapping[str, Race] = field(default_factory=dict)

    def of(self, match: Match) -> Race:
        """Return a match's race."""
        if match.name in self.by_match:
            return self.by_match[match.name]
        special = None
        if match.side in ("losers", "consolation"):
            special = self.losers
        elif match.side in ("final", "second final"):
            special = self.final
        return self.race if special is None else special


def pair_odds(
    bracket: Bracket,
    ratings: ArrayLike,
    races: Races | Race,
    *,
    scale: Scale | str | float = "fargo",
    break_advantage: float = 0.0,
    breaks: BreakFormat = alternate_breaks,
    form: float = 0.0,
) -> dict[str, PairOdds]:
    """Return each match's odds, given the ratings: what `title_odds` takes as `win`.

    Parameters
    ----------
    ratings
        in the bracket's order.
    scale
        a name, or the points that double the odds.
    break_advantage
        how many points better a game's breaker plays.
    breaks
        matters only with a break advantage; either player may win the lag.
    form
        the standard deviation of a game's log-odds from match to match; see `final_scores`.

    Raises
    ------
    InputError
        if a rating or a race is invalid, or form isn't between 0 and 3.

    >>> from evenbreak.tournaments import double_elimination
    >>> bracket = double_elimination(["Ann", "Bo"])
    >>> laws = pair_odds(bracket, [600, 500], Races(3, final=5))
    >>> laws["W1.1"].win[0, 1].round(4), laws["F"].win[0, 1].round(4)
    (np.float64(0.7901), np.float64(0.8552))
    """
    plan, scale, rated, advantage = _checked(bracket, ratings, races, scale, break_advantage)
    points = rated[:, None] - rated
    made: dict[int | tuple[int, ...], PairOdds] = {}
    laws: dict[str, PairOdds] = {}
    for match in bracket.matches:
        race = plan.of(match)
        if _key(race) not in made:
            needs = games_needed(points, race, scale)
            made[_key(race)] = _in_form(points, needs, scale, advantage, breaks, form_of(form))
        laws[match.name] = made[_key(race)]
    return laws


def from_score(
    law: PairOdds,
    players: tuple[int, int],
    needs: tuple[int, int],
    score: tuple[int, int],
    p: float,
    form: float = 0.0,
) -> PairOdds:
    """Return the odds for a match in play, for its two players.

    p is P(the first player wins a game); `needs` are counted from the start. `form` is as in
    `pair_odds`; the score reveals some of it.

    >>> from evenbreak.tournaments import single_elimination
    >>> start = pair_odds(single_elimination(2), [500, 500], 5)["F"]
    >>> from_score(start, (0, 1), (5, 5), (4, 3), 0.5).win[0, 1]
    np.float64(0.75)
    """
    one, other = players
    rack, weights = Rack(np.array([p])), np.ones(1)
    if form:
        days, weights = on_days(RaceOfGames(*needs, Rack(p), score=score), form)
        rack = rack_in(days)
    won, lost = (
        ends @ weights
        for ends in race_endings(needs[0] - score[0], needs[1] - score[1], rack, None, 1)
    )
    played = sum(score)
    ends = law.ends.copy()
    ends[one, other] = ends[other, one] = 0.0
    ends[one, other, played : played + len(won)] = won
    ends[other, one, played : played + len(lost)] = lost
    return PairOdds(ends)


def chances_given(
    bracket: Bracket,
    ratings: ArrayLike,
    races: Races | Race,
    *,
    scale: Scale | str | float = "fargo",
    break_advantage: float = 0.0,
    breaks: BreakFormat = alternate_breaks,
    form: float = 0.0,
) -> Callable[[Floats], dict[str, Floats]]:
    """Return a function from players' skills to each match's chances, for `over_ratings`.

    The races depend on the ratings, as printed on the chart; the skills determine who wins them.

    Parameters
    ----------
    bracket, ratings, races, scale, break_advantage, breaks, form
        as in `pair_odds`; with a break advantage there is no form.

    >>> from evenbreak.tournaments import single_elimination
    >>> chances = chances_given(single_elimination(2), [600, 500], 3)
    >>> chances(np.array([500.0, 500.0]))["F"]
    array([[0.5, 0.5],
           [0.5, 0.5]])
    """
    plan, scale, rated, advantage = _checked(bracket, ratings, races, scale, break_advantage)
    points = rated[:, None] - rated
    race_of = {match.name: plan.of(match) for match in bracket.matches}
    needs = {_key(race): games_needed(points, race, scale) for race in race_of.values()}

    def chances(skills: Floats) -> dict[str, Floats]:
        gaps = skills[:, None] - skills
        if advantage:
            tables = {k: _ends(gaps, n, scale, advantage, breaks).win for k, n in needs.items()}
        else:
            log_odds = np.asarray(scale.log_odds(gaps))
            tables = {k: _won(log_odds, *n, form) for k, n in needs.items()}
        return {name: tables[_key(race)] for name, race in race_of.items()}

    return chances


def _won(log_odds: Floats, m: Ints, n: Ints, form: float) -> Floats:
    """Return P(i beats j) in races of m to n games, given the log-odds of a game."""
    if form == 0.0:
        return np.asarray(betainc(m, n, expit(log_odds)), dtype=float)
    won = np.zeros(log_odds.shape)
    for needs in set(zip(m.ravel().tolist(), n.ravel().tolist(), strict=True)):
        alike = (m == needs[0]) & (n == needs[1])
        won[alike] = race_chance(log_odds[alike], needs, form)
    return won


def race_chance(
    log_odds: Floats, needs: tuple[int, int], form: float, score: tuple[int, int] = (0, 0)
) -> Floats:
    """Return P(player 1 wins a race from its score on), given the log-odds of a game.

    >>> race_chance(np.array([0.0, 1.0]), (5, 5), 0.0, (4, 4)).round(4)
    array([0.5   , 0.7311])
    """
    if form == 0.0:
        m, n = needs[0] - score[0], needs[1] - score[1]
        return np.asarray(betainc(m, n, expit(log_odds)), dtype=float)
    return chance_in_form(needs, form, score)(log_odds)


def _checked(
    bracket: Bracket,
    ratings: ArrayLike,
    races: Races | Race,
    scale: Scale | str | float,
    break_advantage: float,
) -> tuple[Races, Scale, Floats, float]:
    rated = column(ratings, "ratings", len(bracket.players), "players")
    if not np.isfinite(rated).all():
        raise InputError("ratings must be finite numbers; one of them isn't")
    plan = races if isinstance(races, Races) else Races(races)
    unknown = set(plan.by_match) - set(bracket.by_name)
    if unknown:
        raise InputError(
            "by_match has match {unknown!r}, which the bracket doesn't have", unknown=min(unknown)
        )
    return plan, scale_of(scale), rated, number(break_advantage, "break_advantage")


def _key(race: Race) -> int | tuple[int, ...]:
    return race if isinstance(race, int) else (id(race),)


def _in_form(
    points: Floats,
    needs: tuple[Ints, Ints],
    scale: Scale,
    advantage: float,
    breaks: BreakFormat,
    form: float,
) -> PairOdds:
    """Return the odds averaged over day-to-day form, which leaves a game's chance unchanged."""
    if form == 0.0:
        return _ends(points, needs, scale, advantage, breaks)
    center = np.asarray(scale.points(center_of_form(scale.log_odds(points), 0.0, form)))
    nodes, weights = normal_rule(form, int(np.max(needs[0] + needs[1])), MOST_NODES)
    # Of a pair only the first player's chances are looked at; the other has what is left.
    days = (center + scale.points(form * node) for node in nodes)
    parts = (_ends(day, needs, scale, advantage, breaks).ends for day in days)
    return PairOdds(sum(w * part for w, part in zip(weights, parts, strict=True)))


def _ends(
    points: Floats,
    needs: tuple[Ints, Ints],
    scale: Scale,
    advantage: float,
    breaks: BreakFormat,
) -> PairOdds:
    need_1, need_2 = needs
    count = len(points)
    ends = np.zeros((count, count, int((need_1 + need_2).max())))
    pairs = np.triu(np.ones((count, count), dtype=bool), k=1)
    for m, n in set(zip(need_1[pairs].tolist(), need_2[pairs].tolist(), strict=True)):
        i, j = np.nonzero(pairs & (need_1 == m) & (need_2 == n))
        for first, share in ((1, 0.5), (2, 0.5)) if advantage else ((1, 1.0),):
            won, lost = race_endings(m, n, _rack(points[i, j], scale, advantage), breaks, first)
            ends[i, j, : m + n] += share * won.T
            ends[j, i, : m + n] += share * lost.T
    return PairOdds(ends)


def _rack(points: Floats, scale: Scale, advantage: float) -> Rack:
    if not advantage:
        return Rack(scale.win_probability(points))
    one = scale.win_probability(points + advantage)
    return Rack(one, scale.win_probability(advantage - points))
