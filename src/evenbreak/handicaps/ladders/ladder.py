"""The ladder: how far a rating strays from the skill that it should tell, match by match.

A player's rating error is his rating less his skill, in points. The chart gives the race at the
difference of two ratings, the race and the two skills give the chances of each final score, the
system's rule moves the rating: a chain on the rating errors, whose stochastic limit says how far
ratings wander however long it is played.

Source: the National Pool League's ladder, between Table 5.6 and P5.27, with the natural and the
autocorrelated model and the further improvements that are named there.
"""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.checks import whole
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.ladders.error_law import Night, Settled, settled
from evenbreak.handicaps.ladders.error_walk import ErrorWalk
from evenbreak.handicaps.ladders.form import deviation_grid, deviations, difference_law
from evenbreak.handicaps.ladders.opponents import NATURAL, Opponents
from evenbreak.handicaps.ladders.pairing import pairing_of
from evenbreak.handicaps.systems.catalogue import system_of
from evenbreak.handicaps.systems.match_table import known_table
from evenbreak.handicaps.systems.system import System
from evenbreak.stats.summary import Distribution

if TYPE_CHECKING:
    from numpy.typing import NDArray

_DOUBLINGS = (2.0, 4.0, 8.0)
_AT_AN_END = 1e-9
_MOST_HELD = 0.1
_MOST_SD = 4.0
_MOST_SPREAD = 20.0


@dataclass(frozen=True)
class Ladder(ErrorWalk):
    """A player's rating error under a handicap system, as a chain and its long-run law.

    It is a game without an end: a state is the rating error in whole points, from -widest to
    widest, and it begins at 0. An error that a match would take beyond the end stays.

    Parameters
    ----------
    system
        whose rule moves the ratings: a `System` or the name of one. A `Chart` stands for the
        National Pool League's rule on that chart.
    chart
        by which the races are given; None: the system's own.
    opponents
        whom the player meets, all of them the same however he is rated.
    day_sd
        standard deviation, in points, of a player's deviation from his skill on a night: his
        own for all matches of the night, normal, rounded to whole points. Every player has it.
    match_sd
        the same of the deviation that is new in each match.
    matches_a_night
        how many matches a player has on a night, each against another opponent; ratings move
        after each. It matters only with a `day_sd`.
    drift
        points by which the player's skill rises with each match, on average, from -1 to 1:
        after a match it rises by one point with this chance. His opponents' skills are steady.
    widest
        errors are cut at -widest and widest points. None: 2, 4 or 8 doublings of the odds, so
        wide that each end has a chance below 1e-9 with a match a night against these opponents,
        or, where all are given at the player's own skill or rating, those who are rated rightly.

    Raises
    ------
    InputError
        if a parameter is not such a one.
    AccuracyError
        if no width is given and none is wide enough: the rating cannot keep up with the skill,
        the opponents are too far from it, or the chart has one race for all differences.

    Notes
    -----
    With matches_a_night above 1 and a day_sd the error alone is no chain, since matches of a
    night have something in common. `kernel` is then what holds on the average of the matches
    of all nights, and its law is exact for that average; how fast a rating settles follows
    from it to good approximation only. Such nights take a fraction of a second for moves of
    few points; for moves as different as Elo's on a line of 960 errors, nights of three matches
    can take 20 seconds, of six a minute, and of more far longer: if opponents err as he does.

    Source: the natural and the autocorrelated distributions of Fig. 5.9 and after it. The
    limit of a +-1 ladder is that of the powers of M, since an error stays at the two ends now
    and then. But it does so once in ages: over any season that is played, the error is odd
    after an odd number of matches and even after an even one, as on a ladder without ends,
    whose period is 2. The law is then the average of the two.

    >>> from evenbreak.handicaps import AUTOCORRELATED, EQUAL_SKILL, chart
    >>> regular = chart("npl_10")
    >>> round(Ladder(regular).law().sd, 3)
    4.634
    >>> round(Ladder(regular, opponents=AUTOCORRELATED).law().sd, 3)
    4.654
    >>> round(Ladder(regular, opponents=EQUAL_SKILL).law().sd, 3)
    4.417
    """

    system: System
    chart: Chart
    opponents: Opponents = NATURAL
    day_sd: float = 0.0
    match_sd: float = 0.0
    matches_a_night: int = 1
    drift: float = 0.0
    widest: int = 0

    def __init__(
        self,
        system: System | str | Chart,
        chart: Chart | None = None,
        *,
        opponents: Opponents = NATURAL,
        day_sd: float = 0.0,
        match_sd: float = 0.0,
        matches_a_night: int = 1,
        drift: float = 0.0,
        widest: int | None = None,
    ) -> None:
        by, chart = _system_and_chart(system, chart)
        if not isinstance(opponents, Opponents):
            raise InputError(f"opponents is {opponents!r}; give Opponents, such as NATURAL")
        doubling = by.scale.points_per_doubling
        if doubling < 1.0:
            raise InputError(
                f"points_per_doubling is {doubling:g} on the scale of the system; ratings are "
                "whole points, so give a scale of 1 or more"
            )
        if opponents.farthest > _MOST_SPREAD * doubling:
            raise InputError(
                f"spread of the opponents goes to {opponents.farthest} points; give "
                f"{_MOST_SPREAD * doubling:.0f} or less"
            )
        values = {
            "system": by,
            "chart": chart,
            "opponents": opponents,
            "day_sd": _number(day_sd, "day_sd", 0.0, _MOST_SD * doubling),
            "match_sd": _number(match_sd, "match_sd", 0.0, _MOST_SD * doubling),
            "matches_a_night": whole(matches_a_night, "matches_a_night", at_least=1),
            "drift": _number(drift, "drift", -1.0, 1.0),
        }
        values["widest"] = (
            _usual_width(
                by,
                chart,
                opponents if opponents.farthest else NATURAL,
                values["day_sd"],
                values["match_sd"],
                values["drift"],
            )
            if widest is None
            else whole(widest, "widest", at_least=1)
        )
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def steps(self) -> NDArray[np.int64]:
        """The moves that a match can bring, in points, from the lowest to the highest."""
        return self._settled.steps

    @property
    def kernel(self) -> NDArray[np.float64]:
        """P(move | error before the match); shape (errors, steps), before the ends hold it."""
        return self._settled.kernel

    @property
    def wins(self) -> NDArray[np.float64]:
        """P(the player wins the match | error before it); shape (errors,)."""
        return self._settled.wins

    @property
    def opponent_law(self) -> Distribution:
        """The law of the opponents' rating error, on the average of the matches of a night."""
        return self._distribution(self._settled.opponents)

    @property
    def changes(self) -> tuple[float, ...]:
        """For each round until nothing changed, by how much a chance of the law did at most."""
        return self._settled.changes

    def law(self) -> Distribution:
        """Return the law of the player's rating error in the long run: the stochastic limit.

        The player's skill does not change but for the drift. Where all moves are multiples of
        a number g of points, no match takes an error from one remainder by g to another. A
        skill knows nothing of g, so each remainder is equally likely at the beginning; the law
        is the average over the g limits.

        Raises
        ------
        AccuracyError
            if the self-consistent law of the opponents does not settle, or if more than a tenth
            of the ratings are at the ends of the line: it is then the width that holds them.
        """
        law = self._settled.law
        held = _at_the_ends(law)
        if held > _MOST_HELD:
            raise AccuracyError(
                f"the rating error is at the ends of the line of {self.widest} points with a "
                f"chance of {held:.2g}: the moves do not keep up with what drives it away, or the "
                f"line is too short; give {_remedy(self)}"
            )
        return self._distribution(law)

    @cached_property
    def _settled(self) -> Settled:
        shared = self.matches_a_night > 1 and self.day_sd > 0.0
        doubling = self.system.scale.points_per_doubling
        days, weights = deviation_grid(deviations(self.day_sd if shared else 0.0), doubling)
        blur = difference_law(self.match_sd, 0.0 if shared else self.day_sd)
        pairing = pairing_of(self.system, self.chart, self.widest, self.opponents, blur, days)
        matches = self.matches_a_night if shared else 1
        night = Night(pairing, weights, matches)
        return settled(night, self._given_error(), self.drift, conserving=self.system.conserving)

    def _given_error(self) -> NDArray[np.float64] | None:
        """Return the law of the opponents' error on the line, its ends holding what is beyond."""
        given = self.opponents.error
        if given is None:
            return None
        values = np.array(given.values, dtype=np.int64)
        places = np.clip(values, -self.widest, self.widest) + self.widest
        weights = np.array(given.probability, dtype=float)
        return np.bincount(places, weights, 2 * self.widest + 1).astype(float)

    def _distribution(self, chances: NDArray[np.float64]) -> Distribution:
        return Distribution(tuple(self.errors.tolist()), tuple(chances.tolist()))


def _system_and_chart(system: Any, chart: Any) -> tuple[System, Chart]:
    if isinstance(system, Chart):
        if chart is not None:
            raise InputError(f"chart is {chart!r}; a Chart was given as the system already")
        return system_of("npl"), system
    if chart is not None and not isinstance(chart, Chart):
        raise InputError(f"chart is {chart!r}; give a Chart, such as chart('npl_10')")
    by = system_of(system)
    return by, by.usual_chart() if chart is None else chart


def _number(value: Any, name: str, low: float, high: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not low <= number <= high:
        raise InputError(f"{name} is {value!r}; give a number from {low:g} to {high:g}")
    return number


def _at_the_ends(law: NDArray[np.float64]) -> float:
    """Return P(the error is at either end, or so near that moves of several points leave gaps)."""
    near = max(1, len(law) // 40)
    return float(law[:near].sum() + law[-near:].sum())


def _remedy(ladder: Ladder) -> str:
    wider = f"a widest above {ladder.widest}"
    return (
        f"opponents nearer the player's skill, or {wider}" if ladder.opponents.farthest else wider
    )


def _same_everywhere(system: System, chart: Chart) -> bool:
    """Return whether a match is the same whatever the two ratings are."""
    table = known_table(system, chart)
    return all(bool((each == each[0]).all()) for each in (table.needs, table.moves))


@lru_cache(maxsize=64)
def _usual_width(
    system: System,
    chart: Chart,
    opponents: Opponents,
    day_sd: float,
    match_sd: float,
    drift: float,
) -> int:
    """Return so wide a line that next to nothing is at its ends."""
    if _same_everywhere(system, chart):
        raise AccuracyError(
            f"chart {chart.name} has the same race at every difference, so nothing brings a wrong "
            "rating back; give a chart whose races differ"
        )
    for doublings in _DOUBLINGS:
        widest = round(doublings * system.scale.points_per_doubling)
        ladder = Ladder(
            system,
            chart,
            opponents=opponents,
            day_sd=day_sd,
            match_sd=match_sd,
            drift=drift,
            widest=widest,
        )
        # Opponents far off may have no law on a short line, and one on a longer.
        with contextlib.suppress(AccuracyError):
            if _at_the_ends(np.array(ladder.law().probability)) <= _AT_AN_END:
                return widest
    if opponents.farthest:
        raise AccuracyError(
            f"the rating error goes beyond {widest} points, or its law does not settle: the "
            "opponents are too far from the player's skill for the races; give opponents nearer it"
        )
    raise AccuracyError(
        f"the rating error goes beyond {widest} points: the moves are too large for the scale, "
        "the form varies too much, or the skill drifts away from the rating; give widest yourself"
    )
