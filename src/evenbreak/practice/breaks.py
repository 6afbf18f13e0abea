"""Long-run value of a break format: racks won, stakes, and swings.

There are two states, given by who breaks. Let r_i be P(player 1 wins | i breaks), so r_1 = p1 and
r_2 = 1 - p2, and let a and b be the probabilities that the break passes from 1 to 2 and back. Then

    player 1 breaks the fraction  b / (a + b)  of the racks,
    wins the fraction             W = (b r_1 + a r_2) / (a + b),
    and the effect of the start fades like the powers of the second eigenvalue, 1 - a - b.

In winner breaks a = 1 - p1 and b = 1 - p2; in loser breaks a = p1 and b = p2; in alternate
breaks a = b = 1 (P5.24). Only positive numbers are added and multiplied, so no digits are lost.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import number, one_of, plain
from evenbreak.errors import InputError
from evenbreak.games.breaks import BREAK_FORMATS, BreakFormat, checked_format
from evenbreak.games.rack import Rack
from evenbreak.games.series import Series

_SQUARABLE = 1e100
"""Values beyond this are scaled before they are squared."""


def long_run_share(
    p1: FloatOrArray,
    p2: FloatOrArray,
    breaks: BreakFormat,
    *,
    first_breaker: int = 1,
    via: Way | None = None,
) -> FloatOrArray:
    """Return the fraction of racks that player 1 wins in the long run; elementwise.

    Parameters
    ----------
    p1
        P(player 1 wins the rack | player 1 breaks it).
    p2
        P(player 2 wins the rack | player 2 breaks it). p1 and p2 are broadcast together.
    breaks
        any break format (see `evenbreak.games.breaks`).
    first_breaker
        who breaks the first rack, 1 or 2. It matters only if the break never passes on: with p1 =
        p2 = 1 and winner breaks, for example, the first breaker wins every rack.
    via
        the method: the formula ('kernel', or None), or the stochastic limit of a `Series` by
        'elimination' or 'eigen' (see `evenbreak.chains.limit_of`), for plain numbers.

    Returns
    -------
    float or numpy.ndarray
        a float for plain numbers.

    Raises
    ------
    InputError
        if p1 or p2 is not a probability, their shapes do not broadcast, `breaks` is not a
        break format, `first_breaker` is not 1 or 2, or `via` is unknown.

    Notes
    -----
    Source: P5.24, Table 5.4, Fig. 5.6. With alternate breaks, or with probabilities of 0 or 1,
    the chain may be periodic; the fraction is then an average over the period.

    >>> from evenbreak.games import alternate_breaks, loser_breaks, winner_breaks
    >>> round(long_run_share(0.9, 0.5, winner_breaks), 4)
    0.8333
    >>> long_run_share([0.5, 0.1], [0.1, 0.5], loser_breaks).round(4)
    array([0.8333, 0.1667])
    """
    racks = Breakers.of(p1, p2, breaks)
    if (way := way_of_limit(via)) is not None:
        return _shares_by_limit(
            Series(Rack(p1, p2), breaks=breaks, first_breaker=first_breaker), way
        )[0]
    return plain(racks.won(first_breaker))


def _shares_by_limit(series: Series, via: Way) -> tuple[float, float]:
    """Return the fractions of racks that player 1 wins and loses."""
    from evenbreak.chains.limits import limit_of  # the formulas do without scipy

    broken, rack = limit_of(series, via=via), series.rack
    win, lose = (
        sum(broken.get(breaker, 0.0) * rack.chance(player, breaker) for breaker in (1, 2))
        for player in (1, 2)
    )
    return win, lose


def long_run_sd(
    p1: FloatOrArray, p2: FloatOrArray, breaks: BreakFormat, *, first_breaker: int = 1
) -> FloatOrArray:
    """Return the standard deviation of the racks that player 1 wins, per square root of racks.

    Over a large number N of racks, player 1 wins N W of them on average (see `long_run_share`),
    with a standard deviation of sqrt(N) times this. If equal players gain from the break, it is
    larger for winner breaks than for alternate breaks, because wins come in streaks, and smaller
    for loser breaks.

    Parameters
    ----------
    p1, p2, breaks, first_breaker
        as in `long_run_share`.

    Raises
    ------
    InputError
        as `long_run_share`.

    Notes
    -----
    By the central limit theorem of Markov chains: if h are the relative values of the two
    states, h_1 - h_2 = (r_1 - r_2) / (a + b), the variance per rack is that of the martingale
    of (win - W + change of h). Kemeny & Snell, Finite Markov Chains, section 4.6.

    >>> from evenbreak.games import loser_breaks, winner_breaks
    >>> long_run_sd(0.75, 0.75, winner_breaks), long_run_sd(0.5, 0.5, winner_breaks)
    (0.8660254037844386, 0.5)
    >>> round(long_run_sd(0.75, 0.75, loser_breaks), 4)
    0.2887
    """
    racks = Breakers.of(p1, p2, breaks)
    worth = np.nan_to_num(racks.first_break, posinf=0.0, neginf=0.0)
    unit = np.where(np.abs(worth) > _SQUARABLE, np.abs(worth), 1.0)
    variance = sum(
        broken * win * lose * (1.0 / unit + pull * (worth / unit)) ** 2
        for broken, win, lose, pull in zip(
            racks.broken(first_breaker),
            racks.win,
            racks.lose,
            racks.pulls,
            strict=True,
        )
    )
    return plain(np.sqrt(variance) * unit)


def first_break_worth(p1: FloatOrArray, p2: FloatOrArray, breaks: BreakFormat) -> FloatOrArray:
    """Return the total extra racks that player 1 wins by breaking first instead of second.

    This head start is the same no matter how long the session is; it is infinite if the break never
    changes hands. For alternate breaks, it is the mean over even and odd numbers of racks.

    Parameters
    ----------
    p1, p2, breaks
        as in `long_run_share`.

    Raises
    ------
    InputError
        as `long_run_share`.

    Notes
    -----
    (r_1 - r_2) / (a + b), the sum of (r_1 - r_2) (1 - a - b)^n over the racks n = 0, 1, ...

    >>> from evenbreak.games import winner_breaks
    >>> first_break_worth(0.75, 0.75, winner_breaks)
    1.0
    """
    racks = Breakers.of(p1, p2, breaks)
    return plain(racks.first_break)


class BreakFormatValue(NamedTuple):
    """Long-run value of a break format to player 1, given the stakes of a rack."""

    name: str
    """The format's name in `BREAK_FORMATS`."""
    share: float
    """The fraction of racks that player 1 wins."""
    points: float
    """The points that player 1 wins per rack on average."""
    sd_points: float
    """The standard deviation of player 1's points over N racks, divided by sqrt(N), for large N."""
    fair_ratio: float
    """The points for winning a rack, per point for losing one, that make it even: (1 - W) / W."""
    memory: float
    """The second eigenvalue: the share of the first break's effect left after each rack."""
    first_break: float
    """How many more racks player 1 wins in total by breaking first; see `first_break_worth`."""


def compare_break_formats(
    rack: Rack,
    *,
    win: float = 1,
    lose: float = 1,
    first_breaker: int = 1,
    via: Way | None = None,
) -> tuple[BreakFormatValue, ...]:
    """Return the value of each break format, with the best for player 1 first.

    Parameters
    ----------
    rack
        with plain numbers.
    win, lose
        the points that player 1 gains for each rack won, and loses for each rack lost.
    first_breaker
        who breaks the first rack; in formats where one player always breaks, that player does.
    via
        the method for the share of racks won, and so for the points, as in `long_run_share`.

    Returns
    -------
    tuple of BreakFormatValue
        one for each of `BREAK_FORMATS`; formats that are worth the same (within 1e-12) keep
        their order.

    Raises
    ------
    InputError
        if `rack` is not a rack or holds arrays, or a stake is not a number, 0 or more,
        or `via` is unknown.

    Notes
    -----
    Source: P5.25, R = W Z_w - (1 - W) Z_l. The text multiplies rounded numbers and prints 0.49
    and -0.08 for winner and loser breaks here; the exact values are 1/2 and -1/14.

    >>> for value in compare_break_formats(Rack(0.9, 0.5), win=1, lose=2):
    ...     print(f"{value.name:10} {value.share:.4f} {value.points:7.4f}")
    player 1   0.9000  0.7000
    winner     0.8333  0.5000
    alternate  0.7000  0.1000
    loser      0.6429 -0.0714
    player 2   0.5000 -0.5000
    """
    if not isinstance(rack, Rack):
        raise InputError("rack must be a Rack(p) or a Rack(p1, p2); you gave {rack!r}", rack=rack)
    rack.of_numbers()
    way = way_of_limit(via)
    wanted = "a number of points, 0 or more"
    prize = number(win, "win", low=0.0, wanted=wanted)
    price = number(lose, "lose", low=0.0, wanted=wanted)
    values = [
        _value(
            name, rack, prize, price, {"player 1": 1, "player 2": 2}.get(name, first_breaker), way
        )
        for name in BREAK_FORMATS
    ]
    return tuple(sorted(values, key=lambda value: -round(value.share, 12)))


def _value(
    name: str, rack: Rack, win: float, lose: float, first: int, via: Way | None
) -> BreakFormatValue:
    p1, p2 = rack.p1, rack.chance(2, breaker=2)
    breaks = BREAK_FORMATS[name]
    racks = Breakers.of(p1, p2, breaks)
    share, loss = float(racks.won(first)), float(racks.lost(first))
    if via is not None:
        series = Series(Rack(p1, p2), breaks=breaks, first_breaker=first)
        share, loss = _shares_by_limit(series, via)
    return BreakFormatValue(
        name=name,
        share=share,
        points=share * win - loss * lose,
        sd_points=(win + lose) * long_run_sd(p1, p2, breaks, first_breaker=first),
        fair_ratio=loss / share if share > 0.0 else math.inf,
        memory=float(1.0 - racks.changes),
        first_break=float(racks.first_break),
    )


class Breakers(NamedTuple):
    """The two states of endless play (who breaks), for arrays of probabilities.

    >>> from evenbreak.games import winner_breaks
    >>> breakers = Breakers.of(0.75, 0.5, winner_breaks)
    >>> [float(fraction) for fraction in breakers.broken(1)]
    [0.6666666666666666, 0.3333333333333333]
    """

    win: tuple[Any, Any]  # by breaker: player 1 wins the rack
    lose: tuple[Any, Any]
    passes: tuple[Any, Any]  # by breaker: the break passes to the other player
    # By breaker: player 1's chance to break next after winning, minus that after losing.
    pulls: tuple[int, int]

    @classmethod
    def of(cls, p1: Any, p2: Any, breaks: BreakFormat) -> Breakers:
        """Return the states for two probabilities and a break format, after checking them."""
        rack = Rack(p1, p2)
        checked_format(breaks)
        if p2 is None:
            raise InputError("p2 is missing. Give P(player 2 wins a rack that player 2 breaks).")
        keeps_1, keeps_2 = np.broadcast_arrays(rack.chance(1, 1), rack.chance(2, 2))
        win, lose = (keeps_1, rack.chance(1, 2)), (rack.chance(2, 1), keeps_2)
        passes = (
            win[0] * (breaks(1, 1) == 2) + lose[0] * (breaks(1, 2) == 2),
            win[1] * (breaks(2, 1) == 1) + lose[1] * (breaks(2, 2) == 1),
        )
        pulls = (
            (breaks(1, 1) == 1) - (breaks(1, 2) == 1),
            (breaks(2, 1) == 1) - (breaks(2, 2) == 1),
        )
        return cls(win, lose, passes, pulls)

    @property
    def changes(self) -> Any:
        """P(the break passes from 1 to 2) plus P(it passes back)."""
        return self.passes[0] + self.passes[1]

    def broken(self, first_breaker: int) -> tuple[Any, Any]:
        """Return the fractions of the racks that player 1 and player 2 break."""
        one_of(first_breaker, "first_breaker", (1, 2))
        stays = self.changes == 0.0
        per_change = np.where(stays, 1.0, self.changes)
        return (
            np.where(stays, float(first_breaker == 1), self.passes[1] / per_change),
            np.where(stays, float(first_breaker == 2), self.passes[0] / per_change),
        )

    def won(self, first_breaker: int) -> Any:
        """Return the fraction of the racks that player 1 wins."""
        first, second = self.broken(first_breaker)
        return first * self.win[0] + second * self.win[1]

    def lost(self, first_breaker: int) -> Any:
        """Return the fraction of the racks that player 1 loses, accurate even if tiny."""
        first, second = self.broken(first_breaker)
        return first * self.lose[0] + second * self.lose[1]

    @property
    def first_break(self) -> Any:
        """(r_1 - r_2) / (a + b): infinite if the break never changes hands."""
        edge, changes = self.win[0] - self.win[1], self.changes
        stays = changes == 0.0
        endless = np.where(edge == 0.0, 0.0, np.copysign(math.inf, edge))
        return np.where(stays, endless, edge / np.where(stays, 1.0, changes))
