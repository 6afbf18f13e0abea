"""How long a match takes, in racks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from evenbreak.checks import number_probability
from evenbreak.errors import AccuracyError
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import ChanceT
from evenbreak.matches.endings import endings_of, is_bounded
from evenbreak.matches.outcomes import outcomes_of
from evenbreak.matches.parameters import at_score, broadcast, in_shape
from evenbreak.matches.quantiles import TIE

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    MeanT = TypeVar("MeanT", covariant=True, default=Any)
else:
    from typing import TypeVar

    MeanT = TypeVar("MeanT", covariant=True)

Floats: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MatchLength(Generic[ChanceT, MeanT]):
    """The distribution of the length of a match in racks, from its start score on.

    Parameters
    ----------
    games
        lengths in racks, ascending, shape (k,).
    probability
        P(the match takes exactly games[i] racks), shape `(*parameters, k)`.
    mean, sd
        mean and standard deviation in racks, exact even where `games` leaves out a tail;
        None (NaN in arrays) if the match may never end.
    p_never_ends
        P(the match goes on for ever).
    tail_mass
        P(the match ends, but after more than games[-1] racks); 0 if there is a longest
        length.
    bounded
        whether there is a longest length.
    """

    games: NDArray[np.int64]
    probability: Floats
    mean: MeanT
    sd: MeanT
    p_never_ends: ChanceT
    tail_mass: ChanceT
    bounded: bool

    @property
    def span(self) -> int:
        """The longest length in `games`."""
        return int(self.games[-1])

    @overload
    def quantile(self: MatchLength[float, Any], q: float) -> int | None: ...
    @overload
    def quantile(self: MatchLength[Any, Any], q: float) -> Floats: ...
    def quantile(self: MatchLength[Any, Any], q: float) -> Any:
        """Return the smallest k with P(length <= k) >= q; ties within rounding count.

        Parameters
        ----------
        q
            the level, 0 to 1.

        Returns
        -------
        int, None or numpy.ndarray
            None (NaN in arrays) if the probability of ending never reaches q.

        Raises
        ------
        InputError
            if q is not a probability.
        AccuracyError
            if the quantile lies in the tail that is left out.

        >>> from evenbreak.games import Race, Rack
        >>> match_length(Race(2, 2, Rack(0.5))).quantile(0.5)
        2
        """
        q = number_probability(q, "q")
        chances = self.probability
        if q <= 0.5:
            reached = (np.cumsum(chances, axis=-1) >= q * (1.0 - TIE)) & (chances > 0.0)
        else:
            # The upper levels are read off the tail, a small sum of small terms.
            beyond = np.asarray(self.tail_mass + self.p_never_ends)[..., np.newaxis]
            tail = np.cumsum(np.concatenate([beyond, chances[..., :0:-1]], axis=-1), axis=-1)
            reached = tail[..., ::-1] <= (1.0 - q) * (1.0 + TIE)
        found = reached.any(axis=-1)
        ends = np.asarray(1.0 - self.p_never_ends)
        if not self.bounded and ((ends >= q) & (q < 1.0) & ~found).any():
            raise AccuracyError(
                f"the {q:g} quantile lies beyond {self.span} racks, where the distribution is cut "
                "off; give a smaller tail, or use match_odds for the .5 and .9 quantiles"
            )
        at = self.games[reached.argmax(axis=-1)]
        if chances.ndim == 1:
            return int(at) if found else None
        return at if found.all() else np.where(found, at, np.nan)


@overload
def match_length(
    match: Match[float], score: Score | None = None, *, tail: float = 1e-12
) -> MatchLength[float, float | None]: ...
@overload
def match_length(
    match: Match[Any], score: Score | None = None, *, tail: float = 1e-12
) -> MatchLength[Floats, Floats]: ...
def match_length(
    match: Match, score: Score | None = None, *, tail: float = 1e-12
) -> MatchLength[Any, Any]:
    """Return the distribution of the number of racks that `match` still takes.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets; p1 and p2 may be arrays.
    score
        the score now (see `win_probability`); None: the match's own start score.
    tail
        how much probability may be left out of the distribution if there is no longest
        length. It is cut off after 100,000 racks in any case (fewer for large arrays);
        `tail_mass` is what was left out.

    Raises
    ------
    InputError
        if the score cannot be reached or `tail` is not a probability.

    Notes
    -----
    Source: problems P5.5, P5.24, P5.27. If there is no longest length, mean and standard
    deviation come from the absorbing chain of the score, not from the cut distribution.

    >>> from evenbreak.games import Ahead, Race, Rack
    >>> length = match_length(Race(2, 2, Rack(0.5)))
    >>> length.games.tolist(), length.probability.tolist(), length.mean, length.sd
    ([2, 3], [0.5, 0.5], 2.5, 0.5)
    >>> length = match_length(Ahead(2, 2, Rack(0.5)))
    >>> round(length.mean, 9), length.span, length.tail_mass < 1e-12
    (4.0, 80, True)
    """
    match, shape = broadcast(at_score(match, score))
    tail = number_probability(tail, "tail")
    bounded = is_bounded(match)
    # A race of racks has too many scores for a chain, and no tail.
    outcomes = None if bounded else outcomes_of(match)
    never = 0.0 if outcomes is None else outcomes.never
    endings = endings_of(match, never, tail)
    chances = np.moveaxis(endings.win_1 + endings.win_2, 0, -1)
    games = np.arange(chances.shape[-1])
    if outcomes is None:
        mean = (games * chances).sum(axis=-1)
        sd = np.sqrt(((games - mean[..., np.newaxis]) ** 2 * chances).sum(axis=-1))
        left = 0.0
    else:
        _, mean, sd = outcomes.length
        left = np.maximum(1.0 - chances.sum(axis=-1) - never, 0.0)
    possible = chances.reshape(-1, games.size).any(axis=0)
    first = int(possible.argmax())
    return MatchLength(
        games=games[first:],
        probability=chances[..., first:],
        mean=_unless_endless(mean, never, shape),
        sd=_unless_endless(sd, never, shape),
        p_never_ends=in_shape(never, shape),
        tail_mass=in_shape(left, shape),
        bounded=bounded,
    )


def _unless_endless(value: Any, never: Any, shape: tuple[int, ...]) -> Any:
    if not shape:
        return None if never > 0.0 else float(value)
    return in_shape(np.where(np.asarray(never) > 0.0, np.nan, value), shape)
