"""One rack: the smallest game that two players win or lose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, cast, overload

from evenbreak.checks import one_of, probability, together
from evenbreak.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from typing_extensions import TypeVar

    ChanceT = TypeVar("ChanceT", covariant=True, default=Any)
else:
    from typing import TypeVar

    ChanceT = TypeVar("ChanceT", covariant=True)


@dataclass(frozen=True)
class Rack(Generic[ChanceT]):
    """One rack of 9-ball, 8-ball or any other game, of which one player wins.

    Parameters
    ----------
    p1
        with `p2`: P(player 1 wins the rack | player 1 breaks it); alone: P(player 1
        wins the rack), whoever breaks.
    p2
        P(player 2 wins the rack | player 2 breaks it); None if the break does not matter.

    Either may be an array for the vectorised kernels of `evenbreak.matches`; the graph of a
    game takes numbers only. The probability of losing is 1 - p, formed once.

    Raises
    ------
    InputError
        if p1 or p2 is not a probability, or their shapes do not broadcast.

    Notes
    -----
    Source: problems P5.5 (`Rack(p)`) and P5.24 (`Rack(p1, p2)`).

    >>> Rack(0.75).chance(2, breaker=1)
    0.25
    >>> Rack(0.9, 0.5).chance(1, breaker=2)
    0.5
    """

    p1: ChanceT
    p2: ChanceT | float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "p1", probability(self.p1, "p1"))
        if self.p2 is not None:
            object.__setattr__(self, "p2", probability(self.p2, "p2"))
        _ = self.shape  # an error if there is none

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape to which p1 and p2 broadcast; () for numbers."""
        p1: Any = self.p1
        p2: Any = self.p2
        return together(p1=p1, p2=p2)

    @property
    def break_matters(self) -> bool:
        """Whether the chances depend on who breaks."""
        return self.p2 is not None

    @overload
    def chance(self: Rack[float], player: int, breaker: int = 1) -> float: ...
    @overload
    def chance(self: Rack[Any], player: int, breaker: int = 1) -> NDArray[np.float64]: ...
    def chance(self: Rack[Any], player: int, breaker: int = 1) -> Any:
        """Return P(`player` wins the rack | `breaker` breaks it)."""
        one_of(player, "player", (1, 2))
        one_of(breaker, "breaker", (1, 2))
        if self.p2 is None:
            return self.p1 if player == 1 else 1.0 - self.p1
        own = self.p1 if breaker == 1 else self.p2
        return own if player == breaker else 1.0 - own

    def of_numbers(self) -> Rack[float]:
        """Return the rack itself if it holds numbers, which a graph needs.

        Raises
        ------
        InputError
            if p1 or p2 is an array.

        >>> Rack([0.4, 0.5]).of_numbers()
        Traceback (most recent call last):
        ...
        evenbreak.errors.InputError: p1 is an array; give one number, or loop over them
        """
        for name, value in (("p1", self.p1), ("p2", self.p2)):
            if value is not None and not isinstance(value, float):
                raise InputError(f"{name} is an array; give one number, or loop over them")
        return cast("Rack[float]", self)
