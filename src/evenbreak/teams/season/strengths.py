"""How strong the teams are, from the sets they won, and what that says of the matches to come.

A set won by a team is taken like a game won by a player: strengths are fitted like ratings, and the
chances of the scores to come are averaged over how far they may be off.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.matches.antidiagonals import race_endings
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


def team_skills(
    teams: Sequence[str],
    played: Ints,
    *,
    draws: int = 200,
    rng: np.random.Generator,
    prior_sd: float = PRIOR_SD,
) -> Floats:
    """Return draws of the teams' strengths, given the matches played.

    Parameters
    ----------
    teams
        the names.
    played
        the matches: home, away, sets won by each, as in `TeamSeason`.
    draws
        how many draws; 0 gives one, the estimates themselves.
    rng
        numpy's random generator.
    prior_sd
        how much teams differ before there are results, in log-odds of a set.

    Returns
    -------
    numpy.ndarray
        log-odds of a set against an average team, shape (draws, teams).

    >>> rng = np.random.default_rng(1)
    >>> found = team_skills(["Acers", "Bankers"], np.array([[0, 1, 5, 0]]), draws=0, rng=rng)
    >>> found.round(2).tolist()
    [[0.39, -0.39]]
    """
    scale = np.log(2.0)  # so that points are log-odds
    centre = np.zeros(len(teams))
    if not len(played):
        spread = prior_sd * rng.standard_normal((draws, len(teams)))
        return spread if draws else centre[None]
    results = Results(tuple(teams), *played.T)
    ratings = fit(results, prior_sd=prior_sd, scale=scale, anchor=0.0)
    if not whole(draws, "draws"):
        return ratings.rating[None]
    covariance = ratings.covariance(teams) + _MOST_COVARIANCE * np.eye(len(teams))
    return rng.multivariate_normal(ratings.rating, covariance, draws, method="cholesky")


def score_chances(
    skills: Floats, to_come: Ints, *, sets: int | None = None, race: int | None = None
) -> Floats:
    """Return P(each score of `scores_of`) for each match to come.

    Parameters
    ----------
    skills
        as `team_skills` returns them.
    to_come
        the matches: home, away.
    sets, race
        as for `scores_of`.

    Returns
    -------
    numpy.ndarray
        shape (draws, matches, scores).

    >>> score_chances(np.zeros((1, 2)), np.array([[0, 1]]), sets=2).round(9).tolist()
    [[[0.25, 0.5, 0.25]]]
    """
    scores = scores_of(sets=sets, race=race)
    gaps = skills[:, to_come[:, 0]] - skills[:, to_come[:, 1]]
    p = 1.0 / (1.0 + np.exp(-gaps))
    found = np.empty((*p.shape, len(scores)))
    if sets is not None:
        from scipy.stats import binom

        for k in range(sets + 1):
            found[:, :, k] = binom.pmf(k, sets, p)
        return found
    first = int(scores.max())
    won, lost = race_endings(first, first, Rack(p), None, 1)
    for k, (a, b) in enumerate(scores.tolist()):
        found[:, :, k] = (won if a > b else lost)[a + b]
    return found
