"""What a handicap system is: its initial numbers, its races, and the numbers it publishes.

A system has three methods, and states what its numbers mean. The league simulation, the list after
a night and the sandbagging checks use nothing else.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Any, ClassVar, Literal, cast

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.systems.history import Entries, History
from evenbreak.ratings.scale import Scale
from evenbreak.words import Parameter


class System(ABC):
    """Handicap system; a custom one is a subclass with `initial`, `update`, and a chart or `race`.

    Attributes
    ----------
    in_words
        its rule in words, including assumptions.
    publishes
        'ratings' or 'levels': what `initial` and `update` return, and `race` reads.
    scale
        the scale of its ratings; None if it is not fixed (levels, averages).
    chart
        the chart that sets its races; None if no chart does.
    asks
        what it needs to know about a match besides its winner: 'games', 'race', 'innings'.
    winner_never_falls
        whether no one's published number falls on a night without a lost match, all else equal.
    vectorised
        whether its methods take all replicas at once; if False, a simulation calls `update` for one
        league at a time.
    """

    name: str
    in_words: str = ""
    publishes: Literal["ratings", "levels"] = "ratings"
    scale: Scale | None = None
    asks: tuple[str, ...] = ()
    winner_never_falls: bool = False
    vectorised: ClassVar[bool] = True

    @abstractmethod
    def initial(self, entries: Entries) -> Floats:
        """Return the published ratings (or levels) before the first night, shaped as `entries`."""

    @abstractmethod
    def update(self, history: History) -> Floats:
        """Return the published ratings after the last night, shaped like `history.ratings`."""

    @property
    def chart(self) -> Chart | LevelChart | None:
        """The chart that sets the races, if any."""
        return None

    def race(self, a: Any, b: Any) -> tuple[Ints, Ints]:
        """Return (m, n): the games needed by players with published ratings a and b, elementwise.

        A system without a chart must override this method. A chart of rating differences is read at
        ratings rounded to whole points, with halves rounded up.
        """
        chart = self.chart
        if chart is None:
            raise InputError(
                "the system {name} has neither a chart nor a race method. Give it one of them.",
                name=self.name,
            )
        a, b = (np.floor(np.asarray(x, dtype=float) + 0.5) for x in (a, b))
        return chart.races(a, b) if isinstance(chart, LevelChart) else chart.races(a - b)

    def strength(self, numbers: Any) -> Floats:
        """Convert published numbers to the Fargo scale; only differences matter.

        Raises
        ------
        InputError
            if the conversion is unknown.

        >>> from evenbreak.handicaps import system_of
        >>> system_of("npl").strength([60.0, 90.0]).round().tolist()
        [200.0, 300.0]
        >>> system_of("tap-like").strength([3, 4]).round().tolist()
        [94.0, 177.0]
        """
        from evenbreak.handicaps.charts.level_skills import level_skills

        if self.publishes == "levels" and isinstance(self.chart, LevelChart):
            return level_skills(self.chart).strength(numbers)
        if self.scale is None:
            raise InputError(
                "the system {name} has no scale, so its numbers don't show how strong anyone "
                "is. Give a system with a scale or levels.",
                name=self.name,
            )
        return np.asarray(numbers, dtype=float) * (100.0 / self.scale.points_per_doubling)

    def on_chart(self, chart: Any) -> System:
        """Return the same system with races from another chart.

        Raises
        ------
        InputError
            if its races come from no chart, or from one of another kind.
        """
        if chart == self.chart and chart is not None:
            return self
        kind, own = type(self.chart), getattr(self, "__dataclass_fields__", {})
        if self.chart is None or not isinstance(chart, kind) or "own_chart" not in own:
            raise InputError(
                "the system {name} can't be played with the chart {chart}. Leave out "
                "{chart_option}.",
                name=self.name,
                chart=chart.name,
                chart_option=Parameter("chart"),
            )
        return cast("System", replace(cast("Any", self), own_chart=chart))


def updated(system: System, history: History) -> Floats:
    """Return what a system publishes after a night, replica by replica or all at once.

    Raises
    ------
    InputError
        if the system returns another shape, or something that is not a finite number.

    >>> from evenbreak.handicaps import system_of
    >>> from evenbreak.handicaps.systems.history import Matches
    >>> night = Matches.of_night(1, [0], [1], [5], [3], [5], [4], [92.0], [80.0])
    >>> begun = np.array([92.0, 80.0])
    >>> updated(system_of("npl"), History(Entries.of(begun), begun, begun, 1, night))
    array([93., 79.])
    """
    if history.ratings.ndim > 1 and not system.vectorised:
        columns = (system.update(history.one(place)) for place in range(history.ratings.shape[1]))
        ratings = np.stack([np.asarray(column, dtype=float) for column in columns], axis=1)
    else:
        ratings = np.asarray(system.update(history), dtype=float)
    return checked_ratings(system, ratings, history.ratings.shape, "update")


def checked_ratings(system: System, ratings: Any, shape: tuple[int, ...], method: str) -> Floats:
    """Return a system method's result; raise an error for a wrong shape or a missing number."""
    values = np.asarray(ratings, dtype=float)
    if values.shape != shape:
        raise InputError(
            "in the system {name}, {method} returned an array of shape {got}. It must return "
            "one number for each player, in shape {shape}.",
            method=method,
            name=system.name,
            got=values.shape,
            shape=shape,
        )
    wrong = ~np.isfinite(values)
    if wrong.any():
        raise InputError(
            "in the system {name}, {method} returned {value} for player {player}. It must "
            "return finite numbers.",
            method=method,
            name=system.name,
            value=float(values[wrong].flat[0]),
            player=int(np.argwhere(wrong)[0][0]) + 1,
        )
    return values


def checked_races(system: System, a: Any, b: Any) -> tuple[Ints, Ints]:
    """Return a system's races for pairs of ratings; raise an error for a race below 1 game."""
    races = system.race(a, b)
    if not isinstance(races, tuple) or len(races) != 2:
        raise InputError(
            "in the system {name}, race returned {races!r}. It must return two arrays (m, n), "
            "the games that each player needs.",
            name=system.name,
            races=races,
        )
    shape = np.broadcast_shapes(np.shape(a), np.shape(b))
    for needs in map(np.asarray, races):
        if needs.shape != shape or not (needs >= 1).all() or (needs != np.floor(needs)).any():
            raise InputError(
                "in the system {name}, race returned {needs!r}. It must return a whole number "
                "of games, 1 or more, for each pair of ratings.",
                name=system.name,
                needs=needs,
            )
    m, n = (np.asarray(needs).astype(np.int64) for needs in races)
    return m, n
