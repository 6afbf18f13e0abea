"""The ladder: a rating goes up a point with each match won and down a point with each lost.

A player's rating error i is his rating less his skill, in points. The chart gives the race at
the error, the race gives the chance W[i] to win the match, and the error moves to i + 1 or to
i - 1: a chain whose stochastic limit says how far ratings wander however long it is played.

Two models of the opponents, whose ratings all equal the player's skill:

- natural: their skill is what their rating says, so each game is even and
  W[i] = W(1/2; m[i], n[i]);
- autocorrelated: their skill is off by j points with the chance v[j] that the player himself is,
  so W[i] = sum over j of v[j] W(p(-j); m[i], n[i]), and v is the limit that these W[i] give.

Source: the National Pool League's ladder, between Table 5.6 and P5.27.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.checks import number_probabilities, whole
from evenbreak.errors import AccuracyError, InputError
from evenbreak.game import ArcArrays
from evenbreak.handicaps.chart import Chart
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.stats.summary import Distribution

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["LadderLaw", "RatingLadder", "autocorrelated_ladder", "natural_ladder"]

_SETTLED = 1e-14
_ROUNDS = 1000


@dataclass(frozen=True)
class RatingLadder:
    """A rating error that moves up a point with a match won and down a point with one lost.

    It is a game without an end: a state is the rating error, from -widest to widest points,
    and it begins at 0. At the two ends an error that would go further stays where it is.

    Parameters
    ----------
    wins
        P(the player wins the match | his rating error is i), for i = -widest ... widest: an
        odd number of chances, three or more.

    Raises
    ------
    InputError
        if a value is not a probability, or their number is even or less than three.

    >>> ladder = RatingLadder([0.75, 0.5, 0.25])
    >>> ladder.moves(0), ladder.moves(1)
    ({1: 0.5, -1: 0.5}, {1: 0.25, 0: 0.75})
    >>> [round(chance, 3) for chance in ladder.law().probability]
    [0.286, 0.429, 0.286]
    """

    wins: Sequence[float]

    def __post_init__(self) -> None:
        wins = number_probabilities(self.wins, "wins", "win chance")
        if len(wins) < 3 or len(wins) % 2 == 0:
            raise InputError(
                f"wins has {len(wins)} chances; give one for each error from -widest to widest, "
                "an odd number, three or more"
            )
        object.__setattr__(self, "wins", wins)

    @property
    def widest(self) -> int:
        """The largest rating error, in points."""
        return len(self.wins) // 2

    @property
    def start(self) -> int:
        """No error."""
        return 0

    def moves(self, state: int) -> Mapping[int, float]:
        """Return the probability of each next error, given the error `state`."""
        win = self.wins[state + self.widest]
        up, down = min(state + 1, self.widest), max(state - 1, -self.widest)
        return {up: win, down: 1.0 - win}

    def winner(self, state: int) -> None:  # noqa: ARG002
        """Return None: a ladder has no end."""
        return

    def arcs(self) -> ArcArrays | None:
        """Return the arcs in the order of the errors; None where not every error is reached."""
        win = np.array(self.wins)
        # Beyond a certain win or loss there may be no way back to the start or out from it.
        if not ((win > 0.0) & (win < 1.0)).all():
            return None
        place = np.arange(len(win))
        lower, higher = np.maximum(place - 1, 0), np.minimum(place + 1, len(win) - 1)
        return ArcArrays(
            range(-self.widest, self.widest + 1),
            place.repeat(2),
            np.column_stack([lower, higher]).ravel(),
            np.column_stack([1.0 - win, win]).ravel(),
        )

    def law(self) -> Distribution:
        """Return the stochastic limit of the rating error, begun at 0."""
        limit = stochastic_limit(chain_of(self))
        errors = tuple(range(-self.widest, self.widest + 1))
        return Distribution(errors, tuple(float(limit.get(error, 0.0)) for error in errors))


@dataclass(frozen=True)
class LadderLaw:
    """How far a rating wanders from the skill that it should tell.

    Parameters
    ----------
    ladder
        the ladder, with the chance to win at each rating error.
    distribution
        its stochastic limit: the law of the rating error in points.
    changes
        for each round of the iteration the largest change of a probability; empty where
        there was nothing to iterate.
    """

    ladder: RatingLadder
    distribution: Distribution
    changes: tuple[float, ...] = ()


def natural_ladder(chart: Chart, *, widest: int = 60) -> LadderLaw:
    """Return the law of a player's rating error against opponents who are rated rightly.

    Each probability is conditional on nothing but the model: the player's skill does not
    change, each game is even, and the race is what the chart says at the rating error.

    Parameters
    ----------
    chart
        the races by rating difference.
    widest
        errors are cut at -widest and widest points.

    Raises
    ------
    InputError
        if chart is none, or widest is not a whole number above 0.

    Notes
    -----
    Source: the natural distributions of Fig. 5.9. The errors that the chart calls even give
    the law its flat top; beyond them it falls off.

    The limit is that of the powers of M, since an error stays at the two ends now and then.
    But it does so once in ages: over any season that is played, the error is odd after an
    odd number of matches and even after an even one, as on a ladder without ends, whose
    period is 2. The law is then the average of the two.

    >>> from evenbreak.handicaps import chart
    >>> round(natural_ladder(chart("npl_8")).distribution.sd, 3)
    4.963
    """
    wins = _win_table(chart, whole(widest, "widest", at_least=1), np.array([0.5]))
    return _solved(wins[:, 0])


def autocorrelated_ladder(
    chart: Chart, *, widest: int = 60, scale: Scale = SCALES["npl"]
) -> LadderLaw:
    """Return the law of a player's rating error against opponents who err as he does.

    Each opponent is rated at the player's skill and is in truth off by an error with the
    same law as the player's own, worked out anew until it no longer changes.

    Parameters
    ----------
    chart
        the races by rating difference.
    widest
        errors are cut at -widest and widest points.
    scale
        what a difference of skill means for a game.

    Raises
    ------
    InputError
        if chart is none, or widest is not a whole number above 0.
    AccuracyError
        if the law does not settle.

    Notes
    -----
    Source: the autocorrelated model after Fig. 5.9.

    The law is the symmetric one. Among symmetric laws each round brings the change down
    to a hundredth or so. But where opponents are a little better on average than they are
    rated, the player falls below his own skill by a little more: without the symmetry,
    rounding errors grow until the law swings to and fro between two skewed ones.

    >>> from evenbreak.handicaps import chart
    >>> found = autocorrelated_ladder(chart("npl_8"))
    >>> round(found.distribution.sd, 3), len(found.changes) < 10
    (4.978, True)
    """
    size = whole(widest, "widest", at_least=1)
    errors = np.arange(-size, size + 1)
    table = _win_table(chart, size, scale.win_probability(-errors))
    law = _solved(table[:, size])
    changes: list[float] = []
    for _ in range(_ROUNDS):
        opponents = np.asarray(law.distribution.probability, dtype=float)
        law = _solved(table @ opponents)
        player = np.asarray(law.distribution.probability, dtype=float)
        changes.append(float(np.abs(player - opponents).max()))
        if changes[-1] <= _SETTLED:
            return LadderLaw(law.ladder, law.distribution, tuple(changes))
    raise AccuracyError(
        f"the law still changes by {changes[-1]:.3g} after {_ROUNDS} rounds; "
        "natural_ladder answers for opponents who are rated rightly"
    )


def _win_table(chart: Chart, widest: int, games: NDArray[Any]) -> NDArray[np.float64]:
    """Return P(the player wins | his error, an opponent of game chance games[j]); (errors, j)."""
    if not isinstance(chart, Chart):
        raise InputError(f"chart is {chart!r}; give a Chart, such as chart('npl_10')")
    needs = [chart.race(error) for error in range(-widest, widest + 1)]
    m, n = np.array(needs).T[:, :, None]
    table: NDArray[np.float64] = race_win_probability(games, m, n)
    return table


def _solved(wins: NDArray[np.float64]) -> LadderLaw:
    """Return the law of a ladder that is the same when turned upside down."""
    # Rounding would tilt it: see the notes of autocorrelated_ladder.
    even = (wins + (1.0 - wins[::-1])) / 2.0
    ladder = RatingLadder(even.tolist())
    return LadderLaw(ladder, ladder.law())
