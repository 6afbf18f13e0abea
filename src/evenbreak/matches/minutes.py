"""How long a match takes in minutes, and when the matches on a table or of an evening end.

The minutes of a match are a mixture of lognormals over its number of games. For several matches,
times are put on a grid with steps h so that the mean is preserved: probability between two points
is divided between them in proportion. With L(x) the mean of a time cut off at x, the point x
receives

    (2 L(x) - L(x - h) - L(x + h)) / h.

The probability at the points up to x has then ended half a step after x. Sums are convolutions,
done by the fast Fourier transform.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft
from scipy.special import ndtr, ndtri

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import kind_of, number, plain
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.matches.quantiles import TIE

_LEAST = 1e-9  # stands for no time at all and for no spread, whose logarithms do not exist
_HALVINGS = 40


@own_arrays
@dataclass(frozen=True, eq=False)
class MatchMinutes:
    """The distribution of a match's minutes.

    Parameters
    ----------
    probability
        P(the match takes the number of games that belongs to `means`), shape `(*parameters, k)`.
    means
        the mean minutes of a match with this number of games, shape (k,).
    log_sd
        the standard deviation of the logarithm of the minutes around them.
    """

    probability: Floats
    means: Floats
    log_sd: float

    def __repr__(self) -> str:
        law = f"mean {self.mean:.1f}" if np.ndim(self.mean) == 0 else f"{len(self.mean):,} matches"
        return f"<MatchMinutes: {law}>"

    @property
    def mean(self) -> Any:
        """The mean in minutes."""
        return plain(self.probability @ self.means)

    @property
    def sd(self) -> Any:
        """The standard deviation in minutes."""
        square = self.probability @ (self.means**2 * math.exp(self.log_sd**2))
        return plain(np.sqrt(np.maximum(square - self.mean**2, 0.0)))

    def cdf(self, minutes: ArrayLike) -> Any:
        """Return P(the match takes at most this many minutes)."""
        ended = ended_by(np.asarray(minutes, dtype=float)[..., np.newaxis], self.means, self.log_sd)
        return plain((self.probability * ended).sum(axis=-1))

    def quantile(self, q: float) -> Any:
        """Return the minutes within which the match ends with probability q, 0 < q < 1."""
        q = number(q, "q", low=0.0, high=1.0)
        possible = self.means[self.probability.reshape(-1, self.means.size).any(axis=0)]
        # The quantile lies between those of the shortest and of the longest length.
        above = ndtri(q) * self.log_sd - self.log_sd**2 / 2.0
        least, most = (max(_LEAST, end(possible)) * math.exp(above) for end in (np.min, np.max))
        shape = self.probability.shape[:-1]

        def reached(minutes: Floats) -> Any:
            return self.cdf(minutes) >= q * (1.0 - TIE)

        return plain(between(np.full(shape, least), np.full(shape, most), reached))


def match_minutes(games: ArrayLike, probability: ArrayLike, pace: Pace) -> MatchMinutes:
    """Return the distribution of a match's minutes if the pace of the evening is not known.

    Parameters
    ----------
    games
        lengths of the match, shape (k,).
    probability
        of each length, shape `(*parameters, k)`.

    >>> from evenbreak.matches import PACES, race_odds
    >>> race = race_odds(7, 5, 0.55)
    >>> minutes = match_minutes(race.games, race.probability, PACES["9-ball"])
    >>> round(minutes.mean, 1), round(minutes.quantile(0.9), 1)
    (54.8, 79.4)
    """
    kind_of(pace, "pace", Pace)
    chances = np.asarray(probability, dtype=float)
    return MatchMinutes(chances, np.atleast_1d(pace.mean_minutes(games)), pace.log_sd)


def ended_by(minutes: ArrayLike, mean: ArrayLike, log_sd: float) -> Floats:
    """Return P(a lognormal time with this mean is over by the given time)."""
    z = np.log(np.maximum(minutes, _LEAST / 2.0)) - np.log(np.maximum(mean, _LEAST))
    spread = max(log_sd, _LEAST)
    ended: Floats = ndtr((z + spread**2 / 2.0) / spread)
    return ended


def mean_up_to(minutes: ArrayLike, mean: ArrayLike, log_sd: float) -> Floats:
    """Return the mean of a lognormal time with this mean, cut off at these minutes."""
    tilted = np.asarray(mean) * ended_by(minutes, np.asarray(mean) * math.exp(log_sd**2), log_sd)
    cut: Floats = tilted + np.asarray(minutes) * (1.0 - ended_by(minutes, mean, log_sd))
    return cut


def between(low: Any, high: Any, reached: Callable[[Any], Any]) -> Any:
    """Return, by bisection, where a condition that holds from some point on starts to hold."""
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        holds = reached(middle)
        low, high = np.where(holds, low, middle), np.where(holds, middle, high)
    return high


_STEPS_PER_SD = 500
_MOST_STEPS = 2**18
_TAIL = 5.0  # standard deviations of a logarithm beyond which a time is not followed


class End(NamedTuple):
    """Distribution of a finish time: P(by minutes[k]) = ended[k], with its mean and sd."""

    minutes: Floats
    ended: Floats
    mean: float
    sd: float


def one_after_another(lengths: Sequence[Floats], pace: Pace, turnover: Turnover) -> End:
    """Return when the matches on one table end, with turnovers in between, at the usual pace.

    Lengths are P(the match takes k games), k = 0, 1, ..., for each match.

    >>> once = one_after_another([np.array([0.0, 0.0, 1.0])] * 3, Pace(4, 6, 0, 0), Turnover(5))
    >>> once.mean
    58.0
    """
    chances, means = _by_games(lengths, pace)
    mean, square = chances @ means, chances @ means**2 * math.exp(pace.match_sd**2)
    pauses = len(lengths) - 1
    pause_variance = turnover.mean**2 * math.expm1(turnover.log_sd**2)
    total = float(mean.sum()) + pauses * turnover.mean
    variance = float((square - mean**2).sum()) + pauses * pause_variance
    sd = math.sqrt(max(variance, 0.0))
    longest = means.max() * math.exp(_TAIL * pace.match_sd)
    if pauses:
        longest = max(longest, turnover.mean * math.exp(_TAIL * turnover.log_sd))
    step, points = _grid(total + 10.0 * sd + longest, sd)
    size = fft.next_fast_len(points, real=True)

    def transformed(mean: float, log_sd: float) -> NDArray[np.complex128]:
        spectrum: NDArray[np.complex128] = fft.rfft(_on_grid(step, points, mean, log_sd), size)
        return spectrum

    matches = chances @ np.array([transformed(mean, pace.match_sd) for mean in means])
    spectrum = matches.prod(axis=0) * transformed(turnover.mean, turnover.log_sd) ** pauses
    chance = np.maximum(fft.irfft(spectrum, size), 0.0)
    minutes: Floats = step * np.arange(0.5, size)
    return End(minutes, np.cumsum(chance) / chance.sum(), total, sd)


def all_at_once(lengths: Sequence[Floats], pace: Pace) -> End:
    """Return when the last of several matches that all start together ends.

    >>> all_at_once([np.array([0.0, 0.5, 0.5])] * 2, Pace(0, 8, 0, 0)).mean.__round__(1)
    14.0
    """
    chances, means = _by_games(lengths, pace)
    usual = Pace(pace.overhead, pace.per_game, pace.match_sd, 0.0)
    each = [match_minutes(np.arange(len(length)), length, usual) for length in lengths]
    longest = means.max() * math.exp((_TAIL + 1.0) * pace.match_sd)
    step, points = _grid(longest, max(match.sd for match in each))
    law = np.array([_on_grid(step, points, mean, pace.match_sd) for mean in means])
    ended = np.minimum(chances @ law.cumsum(axis=1), 1.0).prod(axis=0)
    minutes: Floats = step * np.arange(0.0, points)
    chance = np.diff(ended, prepend=0.0)
    mean = float(minutes @ chance)
    sd = math.sqrt(float((minutes - mean) ** 2 @ chance))
    half_on: Floats = minutes + step / 2.0
    return End(half_on, ended, mean, sd)


def _by_games(lengths: Sequence[Floats], pace: Pace) -> tuple[Floats, Floats]:
    """Return P(match i takes games j), shape (matches, k), and the mean minutes of games j."""
    longest = max(map(len, lengths))
    padded = np.array([np.pad(length, (0, longest - len(length))) for length in lengths])
    games = np.flatnonzero(padded.any(axis=0))
    return padded[:, games], pace.mean_minutes(games)


def _grid(longest: float, sd: float) -> tuple[float, int]:
    """Return the step and the number of points of a grid that reaches this far."""
    step = max(sd / _STEPS_PER_SD, longest / _MOST_STEPS, 1e-9)
    return step, int(longest / step) + 3


def _on_grid(step: float, points: int, mean: float, log_sd: float) -> Floats:
    """Return the probability at each grid point of a lognormal time with this mean."""
    cut = mean_up_to(step * np.arange(-1, points + 1), mean, log_sd)
    cut[:2] = -step, 0.0  # nothing is cut off below 0
    chance: Floats = np.maximum(2.0 * cut[1:-1] - cut[:-2] - cut[2:], 0.0) / step
    return chance
