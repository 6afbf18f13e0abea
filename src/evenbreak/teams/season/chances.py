"""Chances of each final place: exact if few matches are left, else simulated.

If the strengths are known, all endings of the remaining matches are enumerated if there are few
enough. Otherwise seasons are drawn in pieces, each with its own random numbers, so the result does
not depend on which worker does them. If the strengths are uncertain, every season has its own draw
of them: the seasons are then independent, and the spread of their outcomes is the whole error.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from math import comb
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import seed_of, whole
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.league.tables.ladder import ranks_of, standings_of
from evenbreak.matches.endings import race_endings
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.teams.season.season import TeamSeason
from evenbreak.workers import in_order

if TYPE_CHECKING:
    import distributed


# How strong the teams are, from the sets they won, and what that says of the matches to come.
#
# A set won by a team is taken like a game won by a player: strengths are fitted like ratings, and
# the chances of the scores to come are averaged over how far they may be off.


PRIOR_SD = 0.5
"""How much teams in a league differ, in log-odds of a set, before there are results."""

_MOST_COVARIANCE = 1e-12  # added to the diagonal, so that its root exists


def scores_of(*, sets: int | None = None, race: int | None = None) -> Ints:
    """Return the possible scores of a match, home first.

    Parameters
    ----------
    sets
        number of sets, all of which are played; or
    race
        the sets that a team needs to win.

    Raises
    ------
    InputError
        unless one of the two is given.

    >>> scores_of(sets=2).tolist(), scores_of(race=2).tolist()
    ([[0, 2], [1, 1], [2, 0]], [[0, 2], [1, 2], [2, 1], [2, 0]])
    """
    if (sets is None) == (race is None):
        raise InputError(
            "give either sets (if all are played) or race (if the first to win that many wins)"
        )
    if sets is not None:
        many = whole(sets, "sets", at_least=1)
        return np.array([(k, many - k) for k in range(many + 1)])
    first = whole(race, "race", at_least=1)
    lost = [(k, first) for k in range(first)]
    return np.array(lost + [(b, a) for a, b in reversed(lost)])


@array_values
@dataclass(frozen=True, eq=False)
class TeamStrengths:
    """Strength of the teams, as far as their matches show it: a normal distribution.

    Parameters
    ----------
    estimate
        log-odds of a set against an average team, shape (teams,).
    root
        a root of the covariance of the estimates, shape (teams, teams).
    """

    estimate: Floats
    root: Floats

    def drawn(self, draws: int, rng: np.random.Generator) -> Floats:
        """Return draws of the strengths, shape (draws, teams)."""
        off = rng.standard_normal((draws, len(self.estimate)))
        return np.asarray(self.estimate + off @ self.root.T)


def team_strengths(
    teams: Sequence[str], played: Ints, *, prior_sd: float = PRIOR_SD
) -> TeamStrengths:
    """Return the strengths of the teams, given the matches played.

    Parameters
    ----------
    played
        home, away, sets won by each, as in `TeamSeason`.
    prior_sd
        standard deviation between teams before there are results, in log-odds of a set.

    >>> found = team_strengths(["Acers", "Bankers"], np.array([[0, 1, 5, 0]]))
    >>> found.estimate.round(2).tolist()
    [0.39, -0.39]
    """
    if not len(played):
        return TeamStrengths(np.zeros(len(teams)), prior_sd * np.eye(len(teams)))
    scale = np.log(2.0)  # so that points are log-odds
    results = Results(tuple(teams), *played.T)
    ratings = fit(results, prior_sd=prior_sd, scale=scale, anchor=0.0)
    covariance = ratings.covariance(teams) + _MOST_COVARIANCE * np.eye(len(teams))
    return TeamStrengths(ratings.rating, np.asarray(np.linalg.cholesky(covariance), dtype=float))


def score_chances(skills: Floats, to_come: Ints, scores: Ints) -> Floats:
    """Return P(each score) for each upcoming match.

    Parameters
    ----------
    skills
        log-odds of a set against an average team, shape (draws, teams).
    to_come
        home, away.
    scores
        from `scores_of`.

    Returns
    -------
    numpy.ndarray
        shape (draws, matches, scores).

    >>> score_chances(np.zeros((1, 2)), np.array([[0, 1]]), scores_of(sets=2)).tolist()
    [[[0.25, 0.5, 0.25]]]
    """
    gaps = skills[:, to_come[:, 0]] - skills[:, to_come[:, 1]]
    p = 1.0 / (1.0 + np.exp(-gaps))
    first = int(scores.max())
    if (scores.sum(axis=1) == first).all():
        # The powers of both chances one after the other: seasons are simulated in hundred thousands
        won, lost = np.ones((2, first + 1, *p.shape))
        np.cumprod(np.broadcast_to(p, won[1:].shape), axis=0, out=won[1:])
        np.cumprod(np.broadcast_to(1.0 / (1.0 + np.exp(gaps)), won[1:].shape), axis=0, out=lost[1:])
        ways = [comb(first, k) for k in range(first + 1)]
        return np.stack([n * won[k] * lost[first - k] for k, n in enumerate(ways)], axis=-1)
    ends = race_endings(first, first, Rack(p), None, 1)
    return np.stack([ends[a < b][a + b] for a, b in scores.tolist()], axis=-1)


MOST_ENDINGS = 200_000
"""Number of endings up to which all are enumerated."""

_PIECE = 5_000


class Watched(NamedTuple):
    """The numbers of top places, and the remaining matches, to report on."""

    places: tuple[int, ...]
    matches: tuple[int, ...]


@array_values
@dataclass(frozen=True, eq=False)
class SeasonChances:
    """Possible endings of a season.

    Parameters
    ----------
    p_place
        P(each team takes each place), shape (teams, places).
    exact
        whether all endings were enumerated; otherwise, seasons were drawn.
    seasons
        the number of seasons drawn, or the number of endings.
    watched
        the places and matches to report on.
    p_if
        for each watched number of top places, P(a team takes one of them | a watched match's
        result), shape (matches, 3, teams): home wins, draw, away wins; NaN if the result is
        impossible.
    p_result
        P(home wins, draw, away wins) for each watched match.
    """

    season: TeamSeason
    p_place: Floats
    exact: bool
    seasons: int
    watched: Watched
    p_if: tuple[Floats, ...]
    p_result: Floats

    def p_first(self, places: int) -> Floats:
        """P(each team takes one of the top places)."""
        return np.asarray(self.p_place[:, :places].sum(axis=1))

    def error(self, p: Floats) -> Floats:
        """Return the standard errors of chances (their spread between seeds); 0 if exact."""
        if self.exact:
            return np.zeros(p.shape)
        return np.sqrt(p * (1.0 - p) / self.seasons)

    @property
    def mean_place(self) -> Floats:
        """The mean final place of each team."""
        return np.asarray(self.p_place @ np.arange(1, len(self.p_place) + 1))


def season_chances(
    season: TeamSeason,
    *,
    places: tuple[int, ...] = (1,),
    matches: tuple[int, ...] = (),
    strengths: TeamStrengths | None = None,
    seasons: int = 100_000,
    seed: int = 1,
    executor: Executor | distributed.Client | None = None,
    jobs: int = 1,
    progress: Callable[[int, int], object] | None = None,
) -> SeasonChances:
    """Return the chances of each final place.

    Parameters
    ----------
    places, matches
        what to report on: for these numbers of top places, the effect of these remaining matches.
    strengths
        the distribution of the teams' strengths: each drawn season has its own draw of them. None:
        use the chances in `season`.
    seasons
        how many seasons are drawn, if the strengths are uncertain or the endings too many.
    seed
        for the random numbers.
    executor, jobs
        what runs the pieces; the result does not depend on it. See `evenbreak.league.simulate`.
    progress
        called with the number of seasons done and the total.

    Raises
    ------
    InputError
        if a number is out of range.

    >>> rules = TeamSeason(
    ...     ["Acers", "Bankers", "Caroms"],
    ...     [[0, 1, 3, 2]],
    ...     [[0, 2], [1, 2]],
    ...     [[3, 2], [2, 3]],
    ...     [[0.5, 0.5], [0.5, 0.5]],
    ... )
    >>> found = season_chances(rules)
    >>> found.exact, found.p_first(1).round(4).tolist()
    (True, [0.5833, 0.0833, 0.3333])
    """
    for many in places:
        if not 1 <= whole(many, "places") <= len(season.teams):
            raise InputError(
                "{places} must be from 1 to {n_teams}, the number of teams; you gave {many}",
                many=many,
                n_teams=len(season.teams),
            )
    for match in matches:
        if not 0 <= whole(match, "matches") < len(season.to_come):
            raise InputError(
                "{matches} has {match}, but only {n_to_come} are still to be played",
                match=match,
                n_to_come=len(season.to_come),
            )
    watched = Watched(tuple(places), tuple(matches))
    if strengths is None and len(season.scores) ** len(season.to_come) <= MOST_ENDINGS:
        return _exact(season, watched)
    pieces = _pieces(whole(seasons, "seasons", at_least=1), seed_of(seed))
    total = _Counts(season, watched)
    shared = season, watched, strengths
    for done, counts in enumerate(
        in_order(_drawn, shared, pieces, executor=executor, jobs=jobs), start=1
    ):
        total.add(*counts)
        if progress is not None:
            progress(min(done * _PIECE, seasons), seasons)
    return total.chances(exact=False, seasons=seasons)


def _pieces(seasons: int, seed: int) -> list[tuple[int, int, int]]:
    sizes = [min(_PIECE, seasons - start) for start in range(0, seasons, _PIECE)]
    return [(seed, number, size) for number, size in enumerate(sizes)]


Counted = tuple[Floats, list[Floats], Floats]
"""Weights of teams and places; of matches, results and teams; of matches and results."""


class _Counts:
    """The quantities summed over endings."""

    def __init__(self, season: TeamSeason, watched: Watched) -> None:
        teams, many = len(season.teams), len(watched.matches)
        self.season, self.watched = season, watched
        self.places = np.zeros((teams, teams))
        self.moved = [np.zeros((many, 3, teams)) for _ in watched.places]
        self.results = np.zeros((many, 3))

    def add(self, places: Floats, moved: list[Floats], results: Floats) -> None:
        self.places += places
        self.results += results
        for own, more in zip(self.moved, moved, strict=True):
            own += more

    def chances(self, *, exact: bool, seasons: int) -> SeasonChances:
        weight = self.places.sum(axis=1).max(initial=0.0)
        with np.errstate(invalid="ignore", divide="ignore"):
            p_if = tuple(own / self.results[:, :, None] for own in self.moved)
        return SeasonChances(
            self.season,
            self.places / weight,
            exact,
            seasons,
            self.watched,
            p_if,
            self.results / weight,
        )


def _counted(season: TeamSeason, watched: Watched, ends: Ints, weights: Floats) -> Counted:
    """Return the sums over all endings."""
    ranks = ranks_of(season.record(ends))
    standings = standings_of(ranks)
    results = np.sign(season.scores[:, 0] - season.scores[:, 1])[ends[list(watched.matches)]]
    of_result = [np.where(results == sign, weights, 0.0) for sign in (1, 0, -1)]
    moved = []
    for places in watched.places:
        shares = standings.share_of(places)
        moved.append(np.stack([one @ shares.T for one in of_result], axis=1))
    sums = np.stack([one.sum(axis=1) for one in of_result], axis=1)
    return standings.places(weights), moved, sums


def _exact(season: TeamSeason, watched: Watched) -> SeasonChances:
    left, kinds = len(season.to_come), len(season.scores)
    endings = kinds**left
    total = _Counts(season, watched)
    at_once = max(1, (1 << 22) // max(1, len(season.teams) ** 2))
    for start in range(0, endings, at_once):
        numbers = np.arange(start, min(endings, start + at_once))
        ends = np.empty((left, len(numbers)), dtype=np.int64)
        rest = numbers
        for match in range(left):
            rest, ends[match] = np.divmod(rest, kinds)
        weights = np.zeros(len(numbers))
        for layer in season.chances:
            each = np.ones(len(numbers))
            for match in range(left):
                each *= layer[match, ends[match]]
            weights += each
        total.add(*_counted(season, watched, ends, weights / len(season.chances)))
    return total.chances(exact=True, seasons=endings)


Shared = tuple[TeamSeason, Watched, TeamStrengths | None]


def _drawn(shared: Shared, piece: tuple[int, int, int]) -> Counted:
    """Return the sums over some drawn seasons: a piece is the seed, its number and its size."""
    season, watched, strengths = shared
    seed, number, size = piece
    rng = np.random.default_rng([seed, number])
    which = (number * _PIECE + np.arange(size)) % len(season.chances)
    skills = None if strengths is None else strengths.drawn(size, rng)
    ends = np.zeros((len(season.to_come), size), dtype=np.int64)
    for match, end in enumerate(ends):
        if skills is None:
            law = season.chances[which, match]
        else:
            law = score_chances(skills, season.to_come[match : match + 1], season.scores)[:, 0]
        draws = rng.random(size)
        for limit in np.cumsum(law, axis=1)[:, :-1].T:
            end += draws > limit
    return _counted(season, watched, ends, np.ones(size))
