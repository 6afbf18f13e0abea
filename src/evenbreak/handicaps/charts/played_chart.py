"""Which catalog chart a league uses, as far as its results show.

If results state a rating or a skill level for each player, the race in every match is compared with
each chart's race. If they state only races, the races that occur are compared with each chart's
list of races.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints
from evenbreak.handicaps.charts.chart import CHARTS, Chart, chart
from evenbreak.handicaps.charts.level_chart import LEVEL_CHARTS, LevelChart, level_chart
from evenbreak.ratings.results import Results
from evenbreak.ratings.validation.starts import level_numbers, levels

Race = tuple[int, int]

FEWEST = 30
"""Matches with unequal races needed to look for a chart."""

RARE = 0.005
"""A race in a smaller share of the matches may be a typo."""

HALF = 0.5
"""Share of cells, and of matches, that a chart must have in common with a league to be named."""

FEWEST_IN_COMMON = 4
"""Unequal races that a chart must have in common with a league, if only races are known."""


class PlayedCell(NamedTuple):
    """A cell in a chart where the league plays a different race.

    Parameters
    ----------
    where
        such as '29 to 36 points apart' or 'level 5 against 3'; '' if only races are known.
    chart, played
        the stronger and the weaker player's games by the chart, and in most matches. If only races
        are known, one of the two is None: the league never plays a race in the chart, or plays one
        that the chart does not have.
    matches
        the number of matches there.
    """

    where: str
    chart: Race | None
    played: Race | None
    matches: int


class PlayedChart(NamedTuple):
    """The chart closest to a league's races.

    Parameters
    ----------
    by
        what was compared: ratings, skill levels, or the races alone.
    matches, agree
        the matches compared, and those whose race is the chart's.
    """

    name: str
    title: str
    by: Literal["rating", "level", "race"]
    matches: int
    agree: int
    cells: int
    changed: tuple[PlayedCell, ...]

    @property
    def same(self) -> bool:
        """Whether the league uses this chart, apart from a few matches."""
        return not self.changed


def played_chart(results: Results) -> PlayedChart | None:
    """Return the closest chart in the catalog; None if none is close.

    >>> season = Results.from_names(["Ann"] * 40, ["Bo"] * 40, [5] * 40, [1] * 40,
    ...     race_a=[5] * 40, race_b=[4] * 40, level_a=["90"] * 40, level_b=["80"] * 40)
    >>> found = played_chart(season)
    >>> found.name, found.agree, found.changed
    ('npl_10', 40, ())
    """
    race_a, race_b = results.races
    season = results.select((race_a > 0) & (race_b > 0))
    race_a, race_b = season.races
    if (race_a != race_b).sum() < FEWEST:
        return None
    level = tuple(level_numbers_of(season))
    stated = ~np.isnan(level[0]) & ~np.isnan(level[1])
    if stated.mean() > HALF:
        compared = _by_level(season.select(stated), *(side[stated] for side in level))
    else:
        compared = _by_race(season)
    near = [played for played in compared if played.agree > HALF * played.matches]
    near = [
        played
        for played in near
        if len(played.changed) <= HALF * played.cells or played.by == "race"
    ]
    return max(near, key=_closeness, default=None)


def _closeness(played: PlayedChart) -> tuple[float, int]:
    return played.agree / played.matches, -len(played.changed)


def level_numbers_of(results: Results) -> Iterator[Floats]:
    """Yield the levels of a and b in each match as numbers; NaN if they aren't numbers."""
    for column in levels(results):
        texts, code = np.unique(column, return_inverse=True)
        yield level_numbers(texts)[code.ravel()]


def last_levels(results: Results) -> Floats:
    """Return each player's level in the last match that states it; NaN if no match does.

    >>> night = Results.from_names(["Ann", "Bo"], ["Bo", "Ann"], [5, 2], [1, 4],
    ...     level_a=["6", "4"], level_b=["3", "6"])
    >>> last_levels(night)
    array([6., 4.])
    """
    dates = results.date
    order = np.arange(len(results)) if dates is None else np.argsort(dates, kind="stable")
    last = np.full(len(results.players), np.nan)
    sides = [results.player_a, results.player_b]
    players = np.column_stack(sides)[order].ravel()
    level = np.column_stack(list(level_numbers_of(results)))[order].ravel()
    stated = ~np.isnan(level)
    last[players[stated]] = level[stated]
    return last


def _by_level(season: Results, level_a: Floats, level_b: Floats) -> Iterator[PlayedChart]:
    ahead = level_a >= level_b
    races = np.where(ahead, season.races, season.races[::-1])
    high, low = np.maximum(level_a, level_b), np.minimum(level_a, level_b)
    whole = np.rint(high).astype(np.int64), np.rint(low).astype(np.int64)
    for name, title in CHARTS.items():
        by_rating = chart(name)
        starts = np.array([row.difference_from for row in by_rating.rows])
        place = np.searchsorted(starts, whole[0] - whole[1], side="right") - 1
        texts = [_points_apart(by_rating, k) for k in range(len(starts))]
        yield _compared(
            name, title, "rating", races, by_rating.races(whole[0] - whole[1]), place, texts
        )
    for name, title in LEVEL_CHARTS.items():
        by_level = level_chart(name)
        if not np.isin([high, low], by_level.levels).all():
            continue
        many = int(max(by_level.levels)) + 1
        pairs, place = np.unique(whole[0] * many + whole[1], return_inverse=True)
        texts = [f"level {pair // many} against {pair % many}" for pair in pairs.tolist()]
        said = by_level.races(*whole)
        yield _compared(name, title, "level", races, said, place.ravel(), texts)


def _points_apart(by_rating: Chart, place: int) -> str:
    row = by_rating.rows[place]
    last = "or more" if row.difference_to is None else f"to {row.difference_to}"
    return f"{row.difference_from} {last} points apart"


def _compared(
    name: str,
    title: str,
    by: Literal["rating", "level"],
    races: Ints,
    said: tuple[Ints, Ints],
    place: NDArray[np.intp],
    texts: list[str],
) -> PlayedChart:
    """Return how a chart compares, given each match's race, its race by the chart, and its cell."""
    # An equal difference has no stronger player, so either may be called a.
    same = (races == said).all(0) | ((races[::-1] == said).all(0) & (said[0] == said[1]))
    changed, cells = [], 0
    for cell in np.unique(place).tolist():
        rows = place == cell
        cells += 1
        played, often = np.unique(races[:, rows], axis=1, return_counts=True)
        most = int(often.argmax())
        needs = played[0, most].item(), played[1, most].item()
        by_chart = said[0][rows][0].item(), said[1][rows][0].item()
        if needs != by_chart and often[most] > HALF * rows.sum():
            changed.append(PlayedCell(texts[cell], by_chart, needs, int(rows.sum())))
    return PlayedChart(name, title, by, len(same), int(same.sum()), cells, tuple(changed))


def _by_race(season: Results) -> Iterator[PlayedChart]:
    """Yield the charts that have enough of the races played."""
    pairs = np.column_stack([np.maximum(*season.races), np.minimum(*season.races)])
    races, often = np.unique(pairs, axis=0, return_counts=True)
    played = {(m, n): many for (m, n), many in zip(races.tolist(), often.tolist(), strict=True)}
    usual = {race for race, many in played.items() if many >= max(2, RARE * len(season))}
    for name, title in {**CHARTS, **LEVEL_CHARTS}.items():
        of_chart = set(_races_of(chart(name) if name in CHARTS else level_chart(name)))
        common = usual & of_chart
        if sum(m != n for m, n in common) < FEWEST_IN_COMMON or len(common) < HALF * len(of_chart):
            continue
        changed = [PlayedCell("", race, None, 0) for race in sorted(of_chart - set(played))]
        changed += [PlayedCell("", None, race, played[race]) for race in sorted(usual - of_chart)]
        agree = sum(many for race, many in played.items() if race in of_chart)
        yield PlayedChart(name, title, "race", len(season), agree, len(of_chart), tuple(changed))


def _races_of(of_chart: Chart | LevelChart) -> Iterator[Race]:
    if isinstance(of_chart, Chart):
        yield from ((row.stronger_needs, row.weaker_needs) for row in of_chart.rows)
        return
    for high, row in enumerate(of_chart.needs):
        yield from ((needs, of_chart.needs[low][high]) for low, needs in enumerate(row[: high + 1]))
