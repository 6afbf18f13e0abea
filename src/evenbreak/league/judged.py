"""Measures of each system from a contest's sums, with errors, and differences between systems.

A measure is a function of sums over all groups of replicas. Its error is a jackknife estimate, from
its variation when each group is left out in turn. For a difference, the same group is left out of
both systems, so everything the two have in common (players, nights and luck) cancels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.special import stdtrit

from evenbreak.arrays import Floats
from evenbreak.league.contest import Contest
from evenbreak.league.world import World

RIGHT = 0.5
"""Error (root mean square, in doublings) at which newcomers' ratings count as right."""

_AROUND = 8
"""Newcomers' errors are smoothed over this fraction of a season's nights on either side."""

_LATE = 4
"""Errors are means over the last part of a league, one over this number of its nights."""


class Estimate(NamedTuple):
    """A measure of each system.

    Parameters
    ----------
    value, error
        each system's value and its standard error; shape (systems,) or (systems, parts). NaN where
        nothing was counted, or there are too few groups for an error.
    change, change_error
        the difference from the first system, and its standard error.
    quantile
        the factor on a standard error for a 90% interval.
    """

    value: Floats
    error: Floats
    change: Floats
    change_error: Floats
    quantile: float

    @property
    def margin(self) -> Floats:
        """Half the width of each value's interval."""
        return np.asarray(self.quantile * self.error)

    @property
    def change_margin(self) -> Floats:
        """Half the width of each difference's interval."""
        return np.asarray(self.quantile * self.change_error)

    @property
    def clear(self) -> Floats:
        """The sign of the difference from the first system; 0 if it is within its error."""
        beyond = np.abs(self.change) > self.change_margin + 1e-12
        return np.where(beyond, np.sign(self.change), 0.0)


@dataclass(frozen=True, eq=False)
class _Total:
    """Sums over groups, and what is needed to interpret them."""

    sums: Mapping[str, Floats]
    world: World
    cycle: int
    calibrated: Floats

    def __getitem__(self, name: str) -> Floats:
        return self.sums[name]


Measure = Callable[[_Total], Floats]
"""A function from sums, with systems and samples as the first axes, to a value for each."""


def _ratio(above: Floats, below: Floats) -> Floats:
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(above / below)


def _squares(of: Floats, slope: Floats) -> Floats:
    """Return the mean square of slope * x - y from the sums n, xx, xy, yy on the last axis."""
    n, xx, xy, yy = np.moveaxis(of[..., :4], -1, 0)
    slope = slope.reshape(slope.shape + (1,) * (n.ndim - slope.ndim))
    return _ratio(slope**2 * xx - 2.0 * slope * xy + yy, n)


def _slope(total: _Total) -> Floats:
    """Return the factor on a point of each system: 1 if its scale is fixed."""
    sums = total["weeks"].sum(axis=-2)
    fitted = _ratio(sums[..., 2], sums[..., 1])
    free = total.calibrated.reshape(-1, *(1,) * (fitted.ndim - 1))
    return np.where(free, np.nan_to_num(fitted), 1.0)


def _errors_by_night(total: _Total) -> Floats:
    """Return the root mean square error after each night, over the cycle that ends that night."""
    squares = _squares(total["weeks"], _slope(total))
    mean = squares.copy()
    for night in range(2, mean.shape[-1]):
        first = max(1, night - total.cycle + 1)
        mean[..., night] = squares[..., first : night + 1].mean(axis=-1)
    return np.sqrt(np.maximum(mean, 0.0))


def _late_error(total: _Total) -> Floats:
    nights = total["weeks"].shape[-2] - 1
    last = max(1, nights // _LATE)
    last = min(nights, -(-last // total.cycle) * total.cycle)  # whole cycles only
    late = total["weeks"][..., -last:, :].sum(axis=-2)
    return np.sqrt(np.maximum(_squares(late, _slope(total)), 0.0))


def _newcomer_errors(total: _Total) -> Floats:
    squares = _squares(total["newcomers"], _slope(total))
    return np.sqrt(np.maximum(squares[..., : total.world.weeks + 1], 0.0))


def _nights_until_right(total: _Total) -> Floats:
    """Return the number of nights until newcomers are right, interpolated linearly."""
    errors = _smooth_newcomer_errors(total)
    there = errors <= np.log(RIGHT)
    first = there.argmax(axis=-1)
    after = np.take_along_axis(errors, first[..., None], -1)[..., 0]
    before = np.take_along_axis(errors, np.maximum(first - 1, 0)[..., None], -1)[..., 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        back = np.where(first > 0, (np.log(RIGHT) - after) / (before - after), 0.0)
    return np.where(there.any(axis=-1), first + 1 - back, np.nan)


def _smooth_newcomer_errors(total: _Total) -> Floats:
    """Return the log of newcomers' errors after each night from 1, by a local linear fit.

    The first of many noisy values below a limit comes too early: its intervals held in 77 of 100
    runs, and those of a parabola in 80, where the errors hardly fall any more. The value is
    infinite after nights that no newcomer has reached.
    """
    counted = total["newcomers"][..., 1 : total.world.weeks + 1, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log(_newcomer_errors(total)[..., 1:])
    known = np.isfinite(logs)
    weight, logs = np.where(known, counted, 0.0), np.where(known, logs, 0.0)
    nights = np.arange(logs.shape[-1])
    apart = np.subtract.outer(nights, nights)
    near = np.abs(apart) <= max(1, total.world.weeks // _AROUND)
    s0, s1, s2 = (weight @ (near * apart**k) for k in range(3))
    t0, t1 = ((weight * logs) @ (near * apart**k) for k in range(2))
    spread = s0 * s2 - s1**2
    line = np.where(spread > 0.0, _ratio(s2 * t0 - s1 * t1, spread), _ratio(t0, s0))
    return np.where(weight > 0.0, line, np.inf)


def _pays(total: _Total) -> Floats:
    won = _ratio(total["dumped"][..., 1], total["dumped"][..., 0])
    return np.asarray(won[..., 1] - won[..., 0])


def _drift(total: _Total) -> Floats:
    offset = _ratio(total["weeks"][..., 4], total["weeks"][..., 5])
    moved = (offset[..., -1] - offset[..., 0]) / total.world.seasons
    # Numbers of no fixed scale have no level either that could rise against the skills.
    free = total.calibrated.reshape(-1, *(1,) * (moved.ndim - 1))
    return np.where(free, np.nan, moved)


def _titles(total: _Total) -> Floats:
    titles = total["titles"]
    return _ratio(titles * titles.shape[-1], titles.sum(axis=-1, keepdims=True))


def _of_matches(place: int) -> Measure:
    return lambda total: _ratio(total["matches"][..., place], total["matches"][..., 0])


def _better(total: _Total) -> Floats:
    matches = total["matches"]
    return _ratio(matches[..., 2] - matches[..., 4] * 0.5, matches[..., 0] - matches[..., 4])


def _of_deciles(place: int) -> Measure:
    return lambda total: _ratio(total["deciles"][..., place], total["deciles"][..., 0])


def _moves(total: _Total) -> Floats:
    """Return how often a player's number changes in a season."""
    players, weeks = total["weeks"][..., 1:, 0].sum(axis=-1), total.world.weeks
    return _ratio(total["nights"][..., 2] * weeks, players)


MEASURES: Mapping[str, Measure] = {
    "p_even": _of_matches(1),
    "p_right": _of_matches(5),
    "p_doubling_wins": _of_matches(6),
    "p_better_wins": _better,
    "rating_error": _late_error,
    "nights_until_right": _nights_until_right,
    "sandbagging_pays": _pays,
    "drift": _drift,
    "mean_games": _of_matches(3),
    "games_a_night": lambda total: _ratio(total["nights"][..., 1], total["nights"][..., 0]),
    "changes_a_season": _moves,
    "titles_strongest": lambda total: _titles(total)[..., -_fifth(total) :].mean(axis=-1),
    "titles_weakest": lambda total: _titles(total)[..., : _fifth(total)].mean(axis=-1),
}
"""Measures with one number per system: shares, doublings of the odds, nights, games.

`p_even`: matches in which neither player's chance is above 60%, given the true skills. `p_right`:
matches whose race makes up for the skill difference to within a quarter doubling; unlike `p_even`
it does not depend on how long races are. `p_doubling_wins`: the chance of a player who is a
doubling better than the race expects. `p_better_wins`: the chance of the better player.
`rating_error`: the root mean square difference between published number and skill over the last
quarter of the nights, in whole cycles, after removing the part common to all players.
`sandbagging_pays`: the share of matches that count that sandbaggers win, minus that of others.
`drift`: how much all numbers rise relative to the skills in a season. `titles_strongest`,
`titles_weakest`: titles of the strongest and the weakest fifth, as a multiple of an equal share.
"""

PARTS: Mapping[str, Measure] = {
    "p_win": _of_deciles(1),
    "p_even": _of_deciles(2),
    "titles": _titles,
    "error": _errors_by_night,
    "newcomer_error": _newcomer_errors,
    "player": lambda total: _ratio(total["players"][..., 1], total["players"][..., 0]),
}
"""Measures with a value for each decile, night or player."""


def _fifth(total: _Total) -> int:
    return max(1, int(total["titles"].shape[-1]) // 5)


def estimate(
    contest: Contest,
    measure: Measure,
    world: World,
    *,
    cycle: int = 1,
    calibrated: Floats | None = None,
    confidence: float = 0.9,
) -> Estimate:
    """Return a measure of each system in a contest, with errors.

    Parameters
    ----------
    measure
        one of `MEASURES` or `PARTS`.
    cycle
        the least common multiple of the systems' cycles.
    calibrated
        which systems publish numbers without a fixed scale: the value of a point is then fitted to
        the skills. None: no system does.
    confidence
        the confidence level of the intervals from `Estimate.quantile`.
    """
    names = [name for name in vars(contest) if name != "replicas"]
    systems, groups = contest.matches.shape[:2]
    free = np.zeros(systems, dtype=bool) if calibrated is None else np.asarray(calibrated)
    whole = {name: getattr(contest, name).sum(axis=1) for name in names}
    value = measure(_Total(whole, world, cycle, free))
    if groups < 2:
        missing = np.full_like(value, np.nan)
        return Estimate(value, missing, value - value[:1], missing, np.nan)
    left_out = {name: whole[name][:, None] - getattr(contest, name) for name in names}
    samples = measure(_Total(left_out, world, cycle, free))

    def error(of: Floats) -> Floats:
        off = of - of.mean(axis=1, keepdims=True)
        return np.asarray(np.sqrt((groups - 1.0) / groups * (off**2).sum(axis=1)))

    quantile = float(stdtrit(groups - 1, 0.5 + confidence / 2.0))
    change = value - value[:1]
    return Estimate(value, error(samples), change, error(samples - samples[:1]), quantile)
