"""From how seasons end to who is ahead of whom, for many endings at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.teams.season.season import DIFFERENCE, HEAD_TO_HEAD, SCORED, TeamSeason

_FINE = 100.0  # points are compared to a hundredth


def ranks_of(season: TeamSeason, ends: Ints) -> Ints:
    """Return a number for each team and ending that is larger for the team ahead.

    Parameters
    ----------
    season
        the season.
    ends
        the score of each match to come, as a position in `season.scores`, shape (matches, endings).

    Returns
    -------
    numpy.ndarray
        shape (teams, endings); teams that no rule separates have equal numbers.
    """
    teams, endings = len(season.teams), ends.shape[1]
    points = np.repeat(_points_now(season), endings, axis=1)
    gains = np.round(season.points_of_scores * _FINE).astype(np.int64)
    for (home, away), end in zip(season.to_come, ends, strict=True):
        points[home] += gains[end, 0]
        points[away] += gains[end, 1]
    code = points
    for rule in season.rules.ties:
        value = (
            _by_head_to_head(season, ends, code)
            if rule == HEAD_TO_HEAD
            else _sum(season, ends, rule, teams)
        )
        low, high = int(value.min(initial=0)), int(value.max(initial=0))
        code = _dense(code) * (high - low + 1) + (value - low)
    return code


def _points_now(season: TeamSeason) -> Ints:
    return np.round(season.points * _FINE).astype(np.int64)[:, None]


def _dense(code: Ints) -> Ints:
    """Return smaller numbers in the same order, so that products stay within 64 bits."""
    if code.size and int(code.max()) - int(code.min()) < 1 << 30:
        return np.asarray(code - code.min())
    return np.asarray(np.unique(code, return_inverse=True)[1]).reshape(code.shape)


def _gain(rule: str, scores: Ints) -> Ints:
    """Return what a tie-break counts for home and away, for each score."""
    a, b = scores[:, 0], scores[:, 1]
    if rule == DIFFERENCE:
        return np.stack([a - b, b - a], axis=1)
    if rule == SCORED:
        return np.stack([a, b], axis=1)
    return np.stack([a > b, b > a], axis=1).astype(np.int64)


def _sum(season: TeamSeason, ends: Ints, rule: str, teams: int) -> Ints:
    total = np.zeros((teams, ends.shape[1]), dtype=np.int64)
    played = _gain(rule, season.played[:, 2:])
    for (home, away), gain in zip(season.played[:, :2], played, strict=True):
        total[home] += gain[0]
        total[away] += gain[1]
    gains = _gain(rule, season.scores)
    for (home, away), end in zip(season.to_come, ends, strict=True):
        total[home] += gains[end, 0]
        total[away] += gains[end, 1]
    return total


def _by_head_to_head(season: TeamSeason, ends: Ints, code: Ints) -> Ints:
    """Return each team's points in its matches with the teams that it is level with."""
    total = np.zeros(code.shape, dtype=np.int64)
    for home, away, a, b in season.played:
        gain = np.round(np.array(season.rules.points(int(a), int(b))) * _FINE).astype(np.int64)
        level = code[home] == code[away]
        total[home] += level * gain[0]
        total[away] += level * gain[1]
    gains = np.round(season.points_of_scores * _FINE).astype(np.int64)
    for (home, away), end in zip(season.to_come, ends, strict=True):
        level = code[home] == code[away]
        total[home] += level * gains[end, 0]
        total[away] += level * gains[end, 1]
    return total


class Standings(NamedTuple):
    """Where each team stands at the end of each season, shapes (teams, endings).

    Parameters
    ----------
    ahead
        how many teams are ahead of it.
    level
        how many teams no rule separates from it, itself included; lots decide among them.
    """

    ahead: Ints
    level: Ints

    def places(self, weights: Floats) -> Floats:
        """Return the weight with which each team takes each place, shape (teams, places).

        >>> standings_of(np.array([[5], [5], [9]])).places(np.ones(1)).tolist()
        [[0.0, 0.5, 0.5], [0.0, 0.5, 0.5], [1.0, 0.0, 0.0]]
        """
        teams = len(self.ahead)
        found = np.zeros((teams, teams))
        wide = teams + 1
        for team, (ahead, level) in enumerate(zip(self.ahead, self.level, strict=True)):
            both = np.bincount(ahead * wide + level, weights, minlength=teams * wide)
            for at in np.flatnonzero(both):
                first, many = divmod(int(at), wide)
                found[team, first : first + many] += both[at] / many
        return found

    def share_of(self, places: int) -> Floats:
        """Return each team's chance of one of the first places: 0, 1, or by lot.

        >>> standings_of(np.array([[5], [5], [9]])).share_of(2).ravel().tolist()
        [0.5, 0.5, 1.0]
        """
        return np.asarray(np.clip((places - self.ahead) / self.level, 0.0, 1.0))


def standings_of(ranks: Ints) -> Standings:
    """Return who is ahead of whom, from numbers as `ranks_of` returns them."""
    teams, endings = ranks.shape
    order = np.argsort(ranks, axis=0)
    ordered = np.take_along_axis(ranks, order, axis=0)
    new = np.ones((teams, endings), dtype=bool)
    new[1:] = ordered[1:] != ordered[:-1]
    steps = np.arange(teams)[:, None]
    first = np.maximum.accumulate(np.where(new, steps, 0), axis=0)
    last = np.ones((teams, endings), dtype=bool)
    last[:-1] = new[1:]
    end = np.minimum.accumulate(np.where(last, steps, teams)[::-1], axis=0)[::-1]
    ahead, level = np.empty_like(order), np.empty_like(order)
    np.put_along_axis(ahead, order, teams - 1 - end, axis=0)
    np.put_along_axis(level, order, end - first + 1, axis=0)
    return Standings(ahead, level)
