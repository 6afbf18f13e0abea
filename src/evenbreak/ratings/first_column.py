"""Whether the first column means something: an advantage, or only how the file was written."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit, logit, ndtr, ndtri, pdtrc

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.calibration import TOSS_UP, Estimate, logistic_coefficient
from evenbreak.ratings.walk_forward import Forecasts

FEWEST_ON_A_DATE = 3
"""Matches from which a date shows whether it lists winners first."""

UNLIKELY = 0.001
"""A chance below which luck does not explain the order of the columns."""


class FirstColumn(NamedTuple):
    """How often the player in the first column won the match.

    Parameters
    ----------
    matches, won
        decided matches, and those that player a won.
    expected
        the sum of the predicted chances of player a.
    favoured, with_favourite
        matches in which player a was the favourite, and those in which one of the two was.
    dates, dates_won
        dates of three matches or more, and those on which player a won every match.
    dates_expected
        on how many dates that was to be expected.
    varies
        the chance that luck alone makes the share of player a differ so much between dates, or
        between events, where it is the same on all of them but for the predicted chances.
    """

    matches: int
    won: int
    expected: float
    favoured: int
    with_favourite: int
    dates: int
    dates_won: int
    dates_expected: float
    varies: float

    @property
    def winners_first(self) -> bool:
        """Whether the file must list winners first: no home advantage is as large.

        Player a won every one of five matches or more, or three quarters of at least ten and a
        fifth of them more than predicted.
        """
        share, predicted = self.won / self.matches, self.expected / self.matches
        large = self.matches >= 10 and share >= 0.75 and share - predicted >= 0.2
        return large or (self.matches >= 5 and self.won == self.matches)

    @property
    def stronger_first(self) -> int:
        """1 where the favourite is clearly more often in the first column, -1 in the second."""
        half = self.with_favourite / 2.0
        far = ndtri(1.0 - UNLIKELY / 2.0) * math.sqrt(half / 2.0)
        return int(self.favoured - half > far) - int(half - self.favoured > far)

    @property
    def winners_first_on_some_dates(self) -> bool:
        """Whether too many dates have nobody but player a winning for that to be luck."""
        return bool(self.dates_won and pdtrc(self.dates_won - 1, self.dates_expected) < UNLIKELY)


def first_column(forecasts: Forecasts) -> FirstColumn | None:
    """Return how often the player in the first column won; None where no match was decided."""
    rows = forecasts.race_a > 0
    if not rows.any():
        return None
    p, won, date = forecasts.p_match_integrated[rows], forecasts.won[rows], forecasts.date_of[rows]
    many = np.bincount(date)
    judged = many >= FEWEST_ON_A_DATE
    by_luck = np.exp(np.bincount(date, np.log(p.clip(1e-12))))
    groups = [date]
    event = forecasts.results.event
    if event is not None:
        groups.append(np.unique(event[rows].astype(str), return_inverse=True)[1])
    return FirstColumn(
        int(rows.sum()),
        int(won.sum()),
        float(p.sum()),
        int((p - 0.5 > TOSS_UP).sum()),
        int((np.abs(p - 0.5) > TOSS_UP).sum()),
        int(judged.sum()),
        int((judged & (np.bincount(date, won) == many)).sum()),
        float(by_luck[judged].sum()),
        min(_varies(p, won, group) for group in groups),
    )


def side_advantage(forecasts: Forecasts) -> Estimate | None:
    """Return the advantage in log-odds of the player in the first column, if any.

    Where the first column is the home player that is the home advantage; elsewhere it
    shows whether the order of the columns has a meaning.
    """
    ones = np.ones(len(forecasts))
    won, games = forecasts.results.score_a.astype(float), forecasts.games.astype(float)
    predicted = logit(forecasts.p_game_integrated.clip(1e-12, 1.0 - 1e-12))
    # Each match is a cluster: there may be too few dates to see how much they differ.
    each = np.arange(len(forecasts))
    return logistic_coefficient(ones, won, games, each, offset=predicted)


def _varies(p: Floats, won: Floats, group: Ints) -> float:
    """Return the chance that groups differ so much by luck, given one advantage in all of them.

    The squared sums of won - p over each group are compared with their mean and variance.
    """
    before = logit(p.clip(1e-12, 1.0 - 1e-12))
    each = np.arange(len(p))
    shift = logistic_coefficient(np.ones(len(p)), won, np.ones(len(p)), each, offset=before)
    if shift is None:
        return 1.0
    p = expit(before + shift.value)
    variance = p * (1.0 - p)
    v = np.bincount(group, variance)
    fourth = np.bincount(group, variance * (1.0 - 6.0 * variance))
    excess = float((np.bincount(group, won - p) ** 2 - v).sum())
    spread = float((fourth + 2.0 * v**2).sum())
    return 1.0 if spread <= 0.0 else float(ndtr(-excess / math.sqrt(spread)))
