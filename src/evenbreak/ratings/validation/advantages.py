"""Advantages not in the ratings: of the break, of the first column, and of experience."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit, log_expit, logit, logsumexp, ndtr, ndtri, pdtrc

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.estimates import Estimate, logistic_coefficient, two_sided, with_error
from evenbreak.ratings.integrated import normal_nodes
from evenbreak.ratings.results_frame import FORMATS
from evenbreak.ratings.validation.calibration import TOSS_UP
from evenbreak.ratings.validation.walk_forward import Forecasts
from evenbreak.ratings.who_broke import breakers

MOST_ADVANTAGE = 5.0
"""Limit of the search for a break advantage, in log-odds."""


class FirstBreaks(NamedTuple):
    """How often the first breaker won the race, compared with the predicted chances.

    The p-value is two-sided; matches are races whose first breaker is known.
    """

    won: int
    expected: float
    p_value: float
    matches: int


def first_breaks(forecasts: Forecasts) -> FirstBreaks | None:
    """Compare the number of races that the first breaker won with the predicted number."""
    first = forecasts.results.first_break
    if first is None:
        return None
    rows = (first > 0) & (forecasts.race_a > 0)
    if not rows.any():
        return None
    breaks_a = first[rows] == 1
    p, won = forecasts.p_match_integrated[rows], forecasts.won[rows]
    p, won = np.where(breaks_a, p, 1.0 - p), np.where(breaks_a, won, 1.0 - won)
    z = float((won - p).sum()) / math.sqrt(float((p * (1.0 - p)).sum()))
    return FirstBreaks(int(won.sum()), float(p.sum()), two_sided(z), int(rows.sum()))


def break_advantage(forecasts: Forecasts) -> Estimate | None:
    """Return the breaker's advantage in log-odds, if it is known who broke each rack.

    None where no match states its racks, who broke first and who broke next, or where the breaker
    won every rack, or none.

    Under winner breaks, the stronger player breaks more often, and even more often on a good day.
    So the difference in each match is integrated out: it is normal around the rating difference,
    and its variance is that of the ratings plus that of day-to-day form, which is estimated too.
    The standard error is a sandwich estimate with each match as a cluster.
    """
    from scipy.optimize import minimize

    tally = _tally(forecasts)
    rows = tally.sum((1, 2)) > 0
    if not rows.any():
        return None
    won, lost = tally[rows, :, 0].T[:, :, None], tally[rows, :, 1].T[:, :, None]
    points, weights = normal_nodes()
    breaks = np.array([1.0, -1.0])[:, None, None]

    def at(b: float, days: float) -> tuple[Floats, Floats]:
        """Return the log-likelihood of each match and its derivative in b."""
        spread = np.sqrt(forecasts.sd[rows] ** 2 + days**2)
        x = forecasts.difference[rows, None] + spread[:, None] * points + b * breaks
        log = (won * log_expit(x) + lost * log_expit(-x)).sum(0) + np.log(weights)
        whole = logsumexp(log, axis=1)
        slope = (breaks * (won - (won + lost) * expit(x))).sum(0)
        return whole, (np.exp(log - whole[:, None]) * slope).sum(1)

    def loss(x: Floats) -> float:
        return -float(at(x[0], x[1])[0].sum())

    box = [(-MOST_ADVANTAGE, MOST_ADVANTAGE), (0.0, MOST_ADVANTAGE)]
    b, days = map(float, minimize(loss, np.array([0.0, 0.1]), method="L-BFGS-B", bounds=box).x)
    curvature = float((at(b - 1e-4, days)[1] - at(b + 1e-4, days)[1]).sum()) / 2e-4
    if abs(b) > 0.99 * MOST_ADVANTAGE or curvature <= 0.0:
        return None
    return with_error(b, math.sqrt(float((at(b, days)[1] ** 2).sum())) / curvature)


def known_breaks(forecasts: Forecasts) -> int:
    """Return how many racks `break_advantage` uses: those whose breaker is known."""
    return int(_tally(forecasts).sum())


def _tally(forecasts: Forecasts) -> Floats:
    """Return the racks of each match by who broke and who won: 0 for a, 1 for b."""
    results = forecasts.results
    tally = np.zeros((len(forecasts), 2, 2))
    first, form = results.first_break, results.break_format
    if results.racks is None or first is None or form is None:
        return tally
    for row in np.flatnonzero((first > 0) & (form > 0)):
        racks = results.racks[row]
        broke = breakers(racks, FORMATS[form[row]], int(first[row]))
        for breaker, letter in zip(broke, racks, strict=True):
            tally[row, breaker - 1, "ab".index(letter)] += 1.0
    return tally


FEWEST_ON_A_DATE = 3
"""Matches on a date needed to show whether it lists winners first."""

UNLIKELY = 0.001
"""Probability below which luck does not explain the order of the columns."""


class FirstColumn(NamedTuple):
    """How often the player in the first column (a) won the match.

    a was the favorite in `favored` of the `with_favorite` matches that had one. `dates` counts
    dates with at least three matches; on `dates_won` of them a won every match, where
    `dates_expected` were expected. `varies` is the probability that luck alone makes a's share
    differ this much between dates, or events, beyond the predicted chances.
    """

    matches: int
    won: int
    expected: float
    favored: int
    with_favorite: int
    dates: int
    dates_won: int
    dates_expected: float
    varies: float

    @property
    def winners_first(self) -> bool:
        """Whether the file must list winners first, because no home advantage is this large.

        This is so if player a won all of at least five matches, or at least three quarters of ten
        or more with a share at least .2 above the prediction.
        """
        share, predicted = self.won / self.matches, self.expected / self.matches
        large = self.matches >= 10 and share >= 0.75 and share - predicted >= 0.2
        return large or (self.matches >= 5 and self.won == self.matches)

    @property
    def stronger_first(self) -> int:
        """1 if the favorite is clearly more often in the first column, -1 if in the second."""
        half = self.with_favorite / 2.0
        far = ndtri(1.0 - UNLIKELY / 2.0) * math.sqrt(half / 2.0)
        return int(self.favored - half > far) - int(half - self.favored > far)

    @property
    def winners_first_on_some_dates(self) -> bool:
        """Whether there are too many dates when only player a wins for that to be luck."""
        return bool(self.dates_won and pdtrc(self.dates_won - 1, self.dates_expected) < UNLIKELY)


def first_column(forecasts: Forecasts) -> FirstColumn | None:
    """Return how often the player in the first column won; None if no match was decided."""
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

    If the first column is the home player, this is the home advantage; otherwise it shows whether
    the order of the columns means anything.
    """
    ones = np.ones(len(forecasts))
    won, games = forecasts.results.score_a.astype(float), forecasts.games.astype(float)
    predicted = logit(forecasts.p_game_integrated.clip(1e-12, 1.0 - 1e-12))
    # Each match is a cluster: there may be too few dates to see how much they differ.
    each = np.arange(len(forecasts))
    return logistic_coefficient(ones, won, games, each, offset=predicted)


def _varies(p: Floats, won: Floats, group: Ints) -> float:
    """Return the probability that groups differ this much by luck, given one common advantage.

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


LIMITS = (0, 1, 21, 51, 201)
"""The fewest games in each group; the first group is players without a game."""

FEWEST = 30
"""Matches needed to judge a group."""


class ByExperience(NamedTuple):
    """Matches in which the less experienced player had played about this many games before.

    `most` is None for the last group. `predicted` and `seen` are the less experienced player's
    shares of games; `stronger` is their strength over their rating, compared with the opponent, in
    log-odds; `spread` is the mean squared error of scores, relative to its value for independent
    games.
    """

    fewest: int
    most: int | None
    matches: int
    games: int
    predicted: float
    seen: float
    stronger: Estimate
    spread: float


def by_experience(forecasts: Forecasts) -> list[ByExperience]:
    """Return how players did against more experienced ones, by their own number of games.

    The first date is left out, because no one has played before it. Dates, or matches where that
    gives the larger standard error, are clusters.
    """
    less_a = forecasts.known_a < forecasts.known_b
    fewer = np.minimum(forecasts.known_a, forecasts.known_b)
    judged = (forecasts.known_a != forecasts.known_b) & (forecasts.date_of > 0)
    p = np.where(less_a, forecasts.p_game_integrated, 1.0 - forecasts.p_game_integrated)
    p = p.clip(1e-12, 1.0 - 1e-12)
    games = forecasts.games.astype(float)
    won = np.where(less_a, forecasts.results.score_a, forecasts.results.score_b).astype(float)
    bands = []
    for fewest, above in zip(LIMITS, (*LIMITS[1:], None), strict=True):
        rows = judged & (fewer >= fewest) & (fewer < (np.inf if above is None else above))
        if rows.sum() < FEWEST:
            continue
        _, cluster = np.unique(forecasts.date_of[rows], return_inverse=True)
        offset, ones = logit(p[rows]), np.ones(int(rows.sum()))
        # From a few dates alone hardly any spread could be estimated.
        either = [
            logistic_coefficient(ones, won[rows], games[rows], together, offset=offset)
            for together in (cluster, np.arange(len(cluster)))
        ]
        estimates = [estimate for estimate in either if estimate is not None]
        if not estimates:
            continue
        stronger = max(estimates, key=lambda estimate: estimate.high - estimate.low)
        n, chance = games[rows], p[rows]
        spread = ((won[rows] - chance * n) ** 2).sum() / (chance * (1.0 - chance) * n).sum()
        bands.append(
            ByExperience(
                fewest,
                None if above is None else above - 1,
                len(n),
                int(n.sum()),
                float((chance * n).sum() / n.sum()),
                float(won[rows].sum() / n.sum()),
                stronger,
                float(spread),
            )
        )
    return bands
