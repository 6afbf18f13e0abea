"""Audit a chart: how fair its races are, and which scale and tilt it was made for.

A race m:n is even at exactly one game probability. If s points double the odds, that is a rating
difference of s·e points, where e = log2(p / (1 - p)) at W(p; m, n) = 1/2. The cut between two
neighboring races of a chart lies between the differences at which they are even: with tilt t at
s·((1 - t)·e_k + t·e_(k-1)). So tilt 0 makes each race even at the start of its band, tilt 1/2 makes
it even in the middle (the races on either side of a cut are about equally unfair, one to each
player), and tilt 1 at the end. The cuts are linear in s and s·t, and least squares gives both.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart, ChartDraft, ChartRow
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.handicaps.charts.race_grid import even_doublings
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale, scale_of

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class ChartFit:
    """A scale, with the tilt that fits a chart best.

    Parameters
    ----------
    points_per_doubling
        the rating points that double the odds of a game.
    tilt
        where in its band a race is even: 0 at the start, 1/2 in the middle, 1 at the end.
        With tilt 0 the stronger player is never the underdog, with tilt 1 the weaker never is.
    misfit
        root mean square distance of the chart's cuts from those of the scale and tilt, in points;
        rounding to whole points alone gives 0.29.
    """

    points_per_doubling: float
    tilt: float
    misfit: float


@dataclass(frozen=True)
class AuditRow:
    """One row of a chart: its race, and the chances across its band of differences.

    Parameters
    ----------
    difference_from, difference_to, stronger_needs, weaker_needs
        the row; `difference_to` is None if it has no end.
    p_win_low, p_win_middle, p_win_high
        P(the stronger player wins the race | the ratings are right) at the row's first difference,
        in its middle, and at its last; None if the row is open-ended.
    even_difference
        the difference in points at which the race is even.
    even_place
        where in its band that is: 0 at the start of the band (half a point before its first whole
        point), 1 at its end; below 0 or above 1 outside the band. None for a row that starts at 0
        or is open-ended.
    unfairness
        the larger `|P - 1/2|` of the two ends of the band.
    monotone
        whether the race is harder for the stronger player than the races of all earlier rows.
    """

    difference_from: int
    difference_to: int | None
    stronger_needs: int
    weaker_needs: int
    p_win_low: float
    p_win_middle: float | None
    p_win_high: float | None
    even_difference: float
    even_place: float | None
    unfairness: float
    monotone: bool


@dataclass(frozen=True)
class ChartAudit:
    """How fair a chart is, row by row, and which scale and tilt fit it.

    Parameters
    ----------
    scale
        the scale of the ratings, used to calculate the chances.
    fit
        that scale with the tilt that fits the chart best on it; None for a chart of one row.
    best_fit
        the scale and the tilt that together fit the chart best; None if its cuts do not determine
        them.
    gaps, overlaps
        differences (first, last) that are in no row, and in more than one row; last is None for an
        open end.
    """

    name: str
    scale: Scale
    fit: ChartFit | None
    best_fit: ChartFit | None
    rows: tuple[AuditRow, ...]
    gaps: tuple[tuple[int, int | None], ...]
    overlaps: tuple[tuple[int, int | None], ...]

    @property
    def worst(self) -> AuditRow:
        """The most unfair row; the first one if several are equally unfair."""
        return max(self.rows, key=lambda row: row.unfairness)

    @property
    def p_win(self) -> Floats:
        """P(the stronger player wins) at each difference from 1 up, as far as rows have an end."""
        chances = [np.empty(0)]
        for row in self.rows:
            if row.difference_to is not None:
                points = np.arange(max(row.difference_from, 1), row.difference_to + 1)
                p = self.scale.win_probability(points)
                needs = row.stronger_needs, row.weaker_needs
                chances.append(np.asarray(race_win_probability(p, *needs)))
        return np.concatenate(chances)


def audit(chart: Chart | ChartDraft | str, *, scale: Any = None) -> ChartAudit:
    """Return the fairness of a chart of rating differences, and the scale and tilt that fit it.

    Parameters
    ----------
    scale
        'npl', 'fargo', 'elo', a `Scale` or the points that double the odds; None: the scale that
        fits the chart best.

    Raises
    ------
    InputError
        if there is no such chart, it has no rows, a row ends before it starts, or no scale is
        given and the chart does not determine one (it has fewer than three rows, or its races
        do not get harder).

    Notes
    -----
    Source: Table 5.6 and the two equations before it; P5.5 for where a race is even.

    >>> report = audit("npl_10")
    >>> round(report.best_fit.points_per_doubling, 1), round(report.best_fit.tilt, 2)
    (30.1, 0.49)
    >>> row = audit("fargo_r6_hot", scale="fargo").rows[3]
    >>> row.stronger_needs, row.weaker_needs, round(row.even_difference, 2)
    (7, 4, 86.09)
    """
    chart = chart if isinstance(chart, ChartDraft) else chart_of(chart)
    rows = _in_order(chart)
    even = even_doublings([row.stronger_needs for row in rows], [row.weaker_needs for row in rows])
    cuts = np.array([row.difference_from - 0.5 for row in rows[1:]])
    best = _best_fit(even, cuts)
    if scale is None and best is None:
        raise InputError(
            "{scale} is missing, and chart {chart!r} doesn't imply one. Give npl, fargo, elo, "
            "or the points that double the odds.",
            chart=chart.name,
        )
    used = _fitted(best) if best and scale is None else scale_of(scale)
    return ChartAudit(
        chart.name,
        used,
        best if scale is None else _fit_on(used.points_per_doubling, even, cuts),
        best,
        tuple(_audited(rows, even, used)),
        *_gaps_and_overlaps(rows),
    )


def _in_order(chart: Chart | ChartDraft) -> list[ChartRow]:
    rows = sorted(chart.rows, key=lambda row: row.difference_from)
    if not rows:
        raise InputError(
            "chart {chart!r} has no rows. Give a row for each range of differences.",
            chart=chart.name,
        )
    for row in rows:
        if row.difference_to is not None and row.difference_to < row.difference_from:
            raise InputError(
                "a row goes from {difference_from} to {difference_to}. Make its end no lower "
                "than its start.",
                difference_from=row.difference_from,
                difference_to=row.difference_to,
            )
    return rows


def _best_fit(even: Floats, cuts: Floats) -> ChartFit | None:
    """Return the scale and tilt whose cuts are closest, by least squares."""
    columns = np.column_stack([even[1:], -np.diff(even)])
    (points, tilted), _, rank, _ = np.linalg.lstsq(columns, cuts)
    if rank < 2 or not points > 0.0:
        return None
    return ChartFit(
        float(points),
        float(tilted / points),
        float(np.sqrt(np.mean((columns @ (points, tilted) - cuts) ** 2))),
    )


def _fitted(fit: ChartFit) -> Scale:
    """Return the scale from a fit."""
    return Scale(f"{fit.points_per_doubling:.4g} points", fit.points_per_doubling)


def _fit_on(points: float, even: Floats, cuts: Floats) -> ChartFit | None:
    """Return a scale with the tilt whose cuts are closest."""
    step = points * np.diff(even)
    if not step.any():
        return None
    above = points * even[1:] - cuts
    tilt = float(step @ above / (step @ step))
    return ChartFit(points, tilt, float(np.sqrt(np.mean((above - tilt * step) ** 2))))


def _audited(rows: Sequence[ChartRow], even: Floats, scale: Scale) -> Iterator[AuditRow]:
    first = np.array([row.difference_from for row in rows], dtype=float)
    last = np.array([row.difference_to for row in rows], dtype=float)  # None becomes NaN
    ends = np.isfinite(last)
    differences = np.array([first, (first + last) / 2.0, last])
    games = np.array([row[2:] for row in rows])
    p = scale.win_probability(np.where(ends, differences, first))
    wins = race_win_probability(p, games[:, 0], games[:, 1])
    unfairness = np.abs(wins - 0.5).max(axis=0)
    points = even * scale.points_per_doubling
    highest = np.maximum.accumulate(even)
    for k, row in enumerate(rows):
        low, middle, high = wins[:, k].tolist()
        inside = row.difference_from > 0 and bool(ends[k])
        yield AuditRow(
            *row,
            p_win_low=low,
            p_win_middle=middle if ends[k] else None,
            p_win_high=high if ends[k] else None,
            even_difference=float(points[k]),
            even_place=float((points[k] - first[k] + 0.5) / (last[k] - first[k] + 1.0))
            if inside
            else None,
            unfairness=float(unfairness[k]),
            monotone=k == 0 or bool(even[k] > highest[k - 1]),
        )


Spans = tuple[tuple[int, int | None], ...]


def _gaps_and_overlaps(rows: Sequence[ChartRow]) -> tuple[Spans, Spans]:
    gaps: list[tuple[int, int | None]] = []
    overlaps: list[tuple[int, int | None]] = []
    free: int | None = 0  # the first difference above all rows so far; None: one is open-ended
    for first, last, _, _ in rows:
        if free is not None and first > free:
            gaps.append((free, first - 1))
        elif free is None or first < free:
            before = None if free is None else free - 1
            ends = [end for end in (last, before) if end is not None]
            overlaps.append((first, min(ends, default=None)))
        if free is not None:
            free = None if last is None else max(free, last + 1)
    if free is not None:
        gaps.append((free, None))
    return tuple(gaps), tuple(overlaps)


# The chance of every player against every other.


def win_matrix(
    ratings: Ratings, players: Sequence[str] | None = None, *, race: tuple[int, int] = (1, 1)
) -> pd.DataFrame:
    """Return every player's chance against every other player.

    Each chance is averaged over the error of the rating difference, in which any shared uncertainty
    cancels.

    Parameters
    ----------
    players
        default: all rated players.
    race
        the games that the row's player and the column's player need; (1, 1) is a single game.

    Returns
    -------
    pandas.DataFrame
        P(the row's player wins); NaN on the diagonal, and for players whom no chain of opponents
        connects.

    Raises
    ------
    InputError
        if a player is not rated or named twice, or the race is not two whole numbers above 0.

    >>> from evenbreak.ratings import Results, fit
    >>> ratings = fit(Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [14, 10], [10, 10]))
    >>> win_matrix(ratings).round(3)
    player    Ann     Bo     Cy
    player
    Ann       NaN  0.566  0.557
    Bo      0.434    NaN  0.493
    Cy      0.443  0.507    NaN
    """
    import pandas as pd

    if not isinstance(ratings, Ratings):
        raise InputError(
            "{ratings} must be the ratings that fit(results) returns; you gave {value!r:.60}",
            value=ratings,
        )
    named = list(ratings.players if players is None else players)
    if len(set(named)) < len(named):
        raise InputError("players has a name twice. Give each name once.")
    try:
        m, n = (whole(games, "race", at_least=1) for games in race)
    except (TypeError, ValueError):
        raise InputError(
            "{race} must be two whole numbers such as (7, 5); you gave {value!r}", value=race
        ) from None
    covariance = ratings.covariance(named)
    position = {name: place for place, name in enumerate(ratings.players)}
    places = [position[name] for name in named]
    rating, component = ratings.rating[places], ratings.component[places]
    variance = np.diag(covariance)
    spread = variance[:, None] + variance - 2.0 * covariance
    linked = component[:, None] == component
    np.fill_diagonal(linked, val=False)
    chance = np.full(linked.shape, np.nan)
    error = np.sqrt(np.maximum(spread, 0.0))
    gap = Gap(rating[:, None] - rating, error, ratings.scale)
    chance[linked] = gap[linked].win(m, n)
    names = pd.Index(named, name="player")
    return pd.DataFrame(chance, index=names, columns=names)
