"""The distribution of the length of a match."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import number_probability
from evenbreak.errors import AccuracyError
from evenbreak.games.rack import ChanceT
from evenbreak.matches.quantiles import TIE

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    MeanT = TypeVar("MeanT", covariant=True, default=Any)
else:
    from typing import TypeVar

    MeanT = TypeVar("MeanT", covariant=True)


@array_values
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

    games: Ints
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
        >>> from evenbreak.matches import match_length
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
