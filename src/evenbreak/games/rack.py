"""One rack: the smallest game that two players win or lose."""

from __future__ import annotations

from copy import copy
from dataclasses import KW_ONLY, dataclass, field, fields
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Generic, cast, overload

from evenbreak.checks import ManyAsOne, complement, one_of, probability, together
from evenbreak.errors import InputError

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    from evenbreak.arrays import Floats

    ChanceT = TypeVar("ChanceT", covariant=True, default=Any)
else:
    from typing import TypeVar

    ChanceT = TypeVar("ChanceT", covariant=True)

_ROUNDING = 1e-12
"""Tolerance for p + q, which should be 1: the remaining rounding if the two were computed."""


@dataclass(frozen=True)
class Rack(Generic[ChanceT]):
    """One rack of 9-ball, 8-ball or any other game that one of the players wins.

    Parameters
    ----------
    p1
        with `p2`: P(player 1 wins the rack | player 1 breaks it); alone: P(player 1 wins the rack),
        regardless of who breaks.
    p2
        P(player 2 wins the rack | player 2 breaks it); None if the break does not matter.

    q1, q2
        P(the player of p1, p2 loses that rack), if it is known to more digits than 1 - p has; None:
        1 - p, computed in decimal if p has at most 15 decimals (.1 for .9).

    A `Fraction` is kept in `given` for exact answers.

    All may be arrays for the vectorized kernels in `evenbreak.matches`; the graph of a game takes
    only numbers.

    Raises
    ------
    InputError
        if a value is not a probability, p and q do not add up to 1, or the shapes do not
        broadcast.

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
    _: KW_ONLY
    q1: Any = field(default=None, repr=False)
    q2: Any = field(default=None, repr=False)
    given: tuple[Any, Any] = field(init=False, repr=False, compare=False)

    def __repr__(self) -> str:
        return game_repr(self)

    def __post_init__(self) -> None:
        exact = (p if isinstance(p, Fraction) else None for p in (self.p1, self.p2))
        object.__setattr__(self, "given", tuple(exact))
        self._check("1")
        if self.p2 is not None:
            self._check("2")
        elif self.q2 is not None:
            raise InputError("q2 is given without p2. Give both, or neither.")
        _ = self.shape  # raises if p1 and p2 do not broadcast

    def _check(self, player: str) -> None:
        """Check a player's p and q, and compute q if it is not given."""
        p = probability(getattr(self, "p" + player), "p" + player)
        q = getattr(self, "q" + player)
        if q is None:
            q = complement(p)
        else:
            q = probability(q, "q" + player)
            together(**{"p" + player: p, "q" + player: q})
            off = abs(p + q - 1.0)
            many = not isinstance(off, float | ManyAsOne)
            if (off.max(initial=0.0) if many else off) > _ROUNDING:
                raise InputError(
                    "p{player} and q{player} don't add up to 1. Correct one of them.", player=player
                )
        for name, chance in (("p", p), ("q", q)):
            own = copy(chance)  # so that a later change to the caller's array changes nothing here
            if not isinstance(own, float | ManyAsOne):
                own.flags.writeable = False
            object.__setattr__(self, name + player, own)

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
    def chance(self: Rack[Any], player: int, breaker: int = 1) -> Floats: ...
    def chance(self: Rack[Any], player: int, breaker: int = 1) -> Any:
        """Return P(`player` wins the rack | `breaker` breaks it)."""
        one_of(player, "player", (1, 2))
        one_of(breaker, "breaker", (1, 2))
        if self.p2 is None:
            return self.p1 if player == 1 else self.q1
        own = (self.p1, self.q1) if breaker == 1 else (self.p2, self.q2)
        return own[player != breaker]

    @property
    def in_fractions(self) -> bool:
        """Whether any chance was given as a `Fraction`, which floats may not represent."""
        return any(isinstance(chance, Fraction) for chance in self.given)

    def move(self, player: int, breaker: int = 1) -> Any:
        """Return P(`player` wins the rack | `breaker` breaks it), for a game's moves.

        It is a `Fraction` if the chance was given as one.

        >>> from fractions import Fraction
        >>> Rack(Fraction(1, 3)).move(2)
        Fraction(2, 3)
        """
        exact = self.given[0 if self.p2 is None else breaker - 1]
        if not isinstance(exact, Fraction):
            return self.chance(player, breaker)
        own = 1 if self.p2 is None else breaker
        return exact if player == own else 1 - exact

    def of_numbers(self) -> Rack[float]:
        """Return the rack itself if it holds numbers, as a graph requires.

        Raises
        ------
        InputError
            if p1 or p2 is an array.

        >>> Rack([0.4, 0.5]).of_numbers()
        Traceback (most recent call last):
        ...
        evenbreak.errors.InputError: p1 must be one number. For an array, loop over it.
        """
        for name, value in (("p1", self.p1), ("p2", self.p2)):
            if value is not None and not isinstance(value, float | ManyAsOne):
                raise InputError(
                    "{name} must be one number. For an array, loop over it.", name=name
                )
        return cast("Rack[float]", self)


def game_repr(game: Any) -> str:
    """Return the `repr` of a game: break formats by name, arrays by size.

    >>> from evenbreak.games import Race, winner_breaks
    >>> Race(9, 5, Rack(0.6, 0.5), breaks=winner_breaks)
    Race(m=9, n=5, rack=Rack(p1=0.6, p2=0.5), breaks=winner_breaks, first_breaker=1, ...)
    """

    def shown(value: Any) -> str:
        if shape := getattr(value, "shape", ()):
            return f"<{' x '.join(map(str, shape))} values>"
        return str(getattr(value, "__name__", repr(value)))

    parts = (f"{f.name}={shown(getattr(game, f.name))}" for f in fields(game) if f.repr)
    return f"{type(game).__name__}({', '.join(parts)})"
