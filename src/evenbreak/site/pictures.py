"""The site's pictures: the values for a small SVG in its template, a few hundred bytes each."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date, timedelta
from typing import NamedTuple

import numpy as np

from evenbreak.handicaps.charts.gap import Gap
from evenbreak.site.league import PublishedLeague

WIDTH, HEIGHT, LEFT, TOP, BELOW = 420.0, 190.0, 44.0, 10.0, 26.0
_BANDS = ((0.0, 0.25), (0.25, 0.5), (0.5, 0.75), (0.75, 1.0))


class Axis(NamedTuple):
    """The range of values in a picture, and the values labeled next to it."""

    low: float
    high: float
    ticks: tuple[float, ...]

    @classmethod
    def around(cls, low: float, high: float) -> Axis:
        """Return an axis with a few round values that includes everything between two values."""
        span = max(high - low, 1e-9)
        unit = 10.0 ** math.floor(math.log10(span / 3.0))
        step = next(unit * k for k in (1, 2, 5, 10, 20) if span / (unit * k) <= 4.0)
        first, last = math.floor(low / step), math.ceil(high / step)
        last = max(last, first + 1)
        ticks = tuple(k * step for k in range(first, last + 1))
        return cls(ticks[0], ticks[-1], ticks)

    def y(self, value: float) -> float:
        """Return a value's distance from the top."""
        share = (value - self.low) / (self.high - self.low)
        return round(TOP + (1.0 - share) * (HEIGHT - TOP - BELOW), 1)


@dataclass(frozen=True)
class Chart:
    """A picture: its label for screen readers, and its parts in the drawing's units."""

    label: str
    ticks: Sequence[tuple[float, str]]
    below: Sequence[tuple[float, str, str]] = ()
    line: str = ""
    band: str = ""
    bars: Sequence[tuple[float, float, float, float]] = ()
    dots: Sequence[tuple[float, float, float, float]] = ()
    even: float | None = None
    width: float = WIDTH
    height: float = HEIGHT


def short_day(day: str, *, year: bool = False) -> str:
    """Return a date as people write it.

    >>> short_day("2025-11-24"), short_day("2025-11-24", year=True), short_day("")
    ('Nov 24', 'Nov 24, 2025', '')
    """
    if not day:
        return ""
    when = date.fromisoformat(day)
    months = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"]
    return f"{months[when.month - 1]} {when.day}" + (f", {when.year}" if year else "")


def history(league: PublishedLeague, player: str) -> Chart | None:
    """Return a picture of a player's rating over the season; None with fewer than two dates."""
    seat = league.results.players.index(player)
    known = [(day, then) for day, then in league.history if not then.idle[seat]]
    if len(known) < 2:
        return None
    rating = [float(then.rating[seat]) for _, then in known]
    error = [float(then.standard_error[seat]) for _, then in known]
    axis = Axis.around(
        min(r - e for r, e in zip(rating, error, strict=True)),
        max(r + e for r, e in zip(rating, error, strict=True)),
    )
    first, last = (date.fromisoformat(known[k][0]).toordinal() for k in (0, -1))
    x = [_x((date.fromisoformat(day).toordinal() - first) / (last - first)) for day, _ in known]
    upper = [(at, axis.y(r + e)) for at, r, e in zip(x, rating, error, strict=True)]
    lower = [(at, axis.y(r - e)) for at, r, e in zip(x, rating, error, strict=True)]
    middle = [(at, axis.y(r)) for at, r in zip(x, rating, strict=True)]
    return Chart(
        f"The rating went from {rating[0]:.0f} on {short_day(known[0][0])} to "
        f"{rating[-1]:.0f} on {short_day(known[-1][0])}",
        _ticks(axis),
        below=[(LEFT, short_day(known[0][0]), "start"), (x[-1], short_day(known[-1][0]), "end")],
        line=_points(middle),
        band=_points([*upper, *lower[::-1]]),
        dots=[(*middle[-1], 0.0, 0.0)],
    )


def season(league: PublishedLeague) -> list[tuple[str, Chart, str]]:
    """Return a season's pictures, each with its title and what it shows in a sentence."""
    made = [_by_week(league), _spread(league), _evenness(league)]
    return [one for one in made if one is not None]


def _by_week(league: PublishedLeague) -> tuple[str, Chart, str] | None:
    days = [date.fromisoformat(day) for row in league.rows if (day := league.day_of(row))]
    if not days:
        return None
    monday = min(days) - timedelta(days=min(days).weekday())
    weeks = Counter((day - monday).days // 7 for day in days)
    many = max(weeks) + 1
    axis = Axis.around(0.0, float(max(weeks.values())))
    wide = (WIDTH - LEFT - 8.0) / many
    bars = [
        (round(LEFT + k * wide + wide * 0.12, 1), axis.y(n), round(wide * 0.76, 1))
        for k, n in sorted(weeks.items())
    ]
    most = max(weeks, key=lambda k: (weeks[k], -k))
    label = "Matches in each week of the season"
    words = (
        f"The busiest week started on {short_day(str(monday + timedelta(weeks=most)))}, with "
        f"{weeks[most]:,} matches. The average week with play had {len(days) / len(weeks):.1f}."
    )
    chart = Chart(
        label,
        _ticks(axis),
        below=_ends(str(min(days)), str(max(days))),
        bars=[(x, y, w, round(axis.y(0.0) - y, 1)) for x, y, w in bars],
    )
    return "Matches by week", chart, words


def _spread(league: PublishedLeague) -> tuple[str, Chart, str] | None:
    placed = [one for one in league.rated if not one.provisional]
    if len(placed) < 3:
        return None
    axis = Axis.around(
        min(one.rating - one.error for one in placed), max(one.rating + one.error for one in placed)
    )
    x = [_x((k + 0.5) / len(placed)) for k in range(len(placed))]
    dots = [
        (at, axis.y(one.rating), axis.y(one.rating - one.error), axis.y(one.rating + one.error))
        for at, one in zip(x, placed, strict=True)
    ]
    half = [one.rating for one in placed]
    low, high = np.quantile(half, [0.25, 0.75]).tolist()
    words = (
        f"Ratings run from {placed[0].rating:.0f} down to {placed[-1].rating:.0f}; the middle half "
        f"of the {len(placed)} players are between {low:.0f} and {high:.0f}. The bars show "
        "how far off each rating may be."
    )
    label = "Every ranked player's rating, with the highest on the left"
    below = [(x[0], "1st", "middle"), (x[-1], f"{len(placed)}", "end")]
    return "How far apart the players are", Chart(label, _ticks(axis), below, dots=dots), words


def _evenness(league: PublishedLeague) -> tuple[str, Chart, str] | None:
    """Return how often the stronger player won the races that were played."""
    results, ratings = league.results, league.ratings
    race_a, race_b = results.races
    rows = [row for row in league.rows if league.winner[row] and race_a[row] and race_b[row]]
    if len(rows) < 40:
        return None
    apart = ratings.rating[results.player_a[rows]] - ratings.rating[results.player_b[rows]]
    won = np.where(apart >= 0, league.winner[rows] == 1, league.winner[rows] == 2)
    gap = Gap(np.abs(apart), 0.0, ratings.scale, ratings.match_form)
    m, n = (
        np.where(apart >= 0, one, two)
        for one, two in ((race_a[rows], race_b[rows]), (race_b[rows], race_a[rows]))
    )
    expected = gap.win(m, n)
    axis = Axis(0.0, 1.0, (0.0, 0.25, 0.5, 0.75, 1.0))
    order = np.argsort(np.abs(apart), kind="stable")
    groups = [part for part in np.array_split(order, len(_BANDS)) if len(part)]
    dots, below = [], []
    for k, part in enumerate(groups):
        share = float(won[part].mean())
        error = math.sqrt(max(share * (1.0 - share), 0.05) / len(part))
        at = _x((k + 0.5) / len(groups))
        ends = (axis.y(max(0.0, share - error)), axis.y(min(1.0, share + error)))
        dots.append((at, axis.y(share), *ends))
        size = np.abs(apart[part])
        below.append((at, f"{size.min():.0f}–{size.max():.0f}", "middle"))
    words = (
        f"The stronger player won {100 * won.mean():.0f}% of {len(rows):,} matches; from "
        f"today's ratings, you'd expect {100 * float(np.mean(expected)):.0f}%. A dot on the "
        "dashed line means even races. Below each dot is the rating difference between the two "
        "players. The bars show how far luck alone can move a dot."
    )
    chart = Chart(
        "How often the stronger player won, by the difference in ratings",
        [(axis.y(share), f"{100 * share:.0f}%") for share in axis.ticks],
        below,
        dots=dots,
        even=axis.y(0.5),
    )
    return "How even the matches were", chart, words


def _x(share: float) -> float:
    return round(LEFT + share * (WIDTH - LEFT - 8.0), 1)


def _ends(first: str, last: str) -> list[tuple[float, str, str]]:
    return [(LEFT, short_day(first), "start"), (WIDTH - 8.0, short_day(last), "end")]


def _ticks(axis: Axis) -> list[tuple[float, str]]:
    return [(axis.y(value), f"{value:g}") for value in axis.ticks]


def _points(points: Sequence[tuple[float, float]]) -> str:
    return " ".join(f"{x:g},{y:g}" for x, y in points)
