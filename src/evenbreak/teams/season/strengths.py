"""How strong the teams are, from the sets they won, and what that says of the matches to come.

A set won by a team is taken like a game won by a player: strengths are fitted like ratings, and the
chances of the scores to come are averaged over how far they may be off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb

import numpy as np

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.matches.endings import race_endings
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results

PRIOR_SD = 0.5
"""How much teams of a league differ, in log-odds of a set, before there are results."""

_MOST_COVARIANCE = 1e-12  # added to the diagonal, so that its root exists


def scores_of(*, sets: int | None = None, race: int | None = None) -> Ints:
    """Return the scores that a match can have, home first.

    Parameters
    ----------
    sets
        how many sets are played, all of them; or
    race
        how many a team needs to win.

    Raises
    ------
    InputError
        unless one of the two is given.

    >>> scores_of(sets=2).tolist(), scores_of(race=2).tolist()
    ([[0, 2], [1, 1], [2, 0]], [[0, 2], [1, 2], [2, 1], [2, 0]])
    """
    if (sets is None) == (race is None):
        raise InputError("give one of sets (all are played) and race (the first to win so many)")
    if sets is not None:
        many = whole(sets, "sets", at_least=1)
        return np.array([(k, many - k) for k in range(many + 1)])
    first = whole(race, "race", at_least=1)
    lost = [(k, first) for k in range(first)]
    return np.array(lost + [(b, a) for a, b in reversed(lost)])


@array_values
@dataclass(frozen=True, eq=False)
class TeamStrengths:
    """How strong the teams are, as far as their matches show: a normal distribution.

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
    """Return how strong the teams are, given the matches played.

    Parameters
    ----------
    teams
        the names.
    played
        the matches: home, away, sets won by each, as in `TeamSeason`.
    prior_sd
        how much teams differ before there are results, in log-odds of a set.

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
    """Return P(each score) for each match to come.

    Parameters
    ----------
    skills
        log-odds of a set against an average team, shape (draws, teams).
    to_come
        the matches: home, away.
    scores
        as `scores_of` returns them.

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
