"""The one-ball game: whoever makes the ball wins; after a miss the other shoots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass

from evenbreak.checks import complement, exact_probability, number_probabilities, number_probability


@dataclass(frozen=True)
class OneBall:
    """The two-parameter infinite look-ahead one-ball game: four nodes (P5.20, Fig. 5.5).

    Parameters
    ----------
    p1, p2
        P(player 1, 2 makes the ball | that player shoots); a `Fraction` is kept for exact answers,
        and a sympy expression for `evenbreak.chains.symbolic_limit`.

    Raises
    ------
    InputError
        if p1 or p2 is not a probability.

    >>> OneBall(0.4, 0.8).moves("S1")
    {'W': 0.4, 'S2': 0.6}
    """

    p1: float
    p2: float

    def __post_init__(self) -> None:
        for name in ("p1", "p2"):
            object.__setattr__(self, name, exact_probability(getattr(self, name), name))

    @property
    def start(self) -> str:
        """Player 1 shoots first."""
        return "S1"

    def moves(self, state: str) -> Mapping[str, float]:
        """Return the probability of each next state, given `state`; one shot is taken."""
        if state == "S1":
            return {"W": self.p1, "S2": complement(self.p1)}
        if state == "S2":
            return {"L": self.p2, "S1": complement(self.p2)}
        return {}

    def winner(self, state: str) -> int | None:
        """Return who has won in `state`: 1 in W, 2 in L, else None."""
        return {"W": 1, "L": 2}.get(state)


@dataclass(frozen=True)
class OneBallLookAhead:
    """The n-shot look-ahead: n shots, each with its own chance, then a given chance of winning.

    Parameters
    ----------
    shots
        P(the shooter makes shot i | all shots before it were missed), i = 1, 2, ...;
        player 1 takes shots 1, 3, ..., player 2 shots 2, 4, ...
    after
        P(player 1 wins | all shots were missed); 1/2 in the text.

    Raises
    ------
    InputError
        if a value is not a probability, or there is no shot.

    Notes
    -----
    Source: P5.21, Figs. 5.2 and 5.4. State Si: shot i is next; Wi, Li: player 1 has won or
    lost by it; W, L: won or lost afterward.

    >>> OneBallLookAhead([0.4, 0.8]).moves("S2")
    {'L2': 0.8, 'W': 0.09999999999999998, 'L': 0.09999999999999998}
    """

    shots: Sequence[float]
    _: KW_ONLY
    after: float = 0.5

    def __post_init__(self) -> None:
        shots = number_probabilities(self.shots, "shots", "shot")
        object.__setattr__(self, "shots", shots)
        object.__setattr__(self, "after", number_probability(self.after, "after"))

    @property
    def start(self) -> str:
        """Player 1 takes the first shot."""
        return "S1"

    def moves(self, state: str) -> Mapping[str, float]:
        """Return the probability of each next state, given `state`; one shot is taken."""
        if not state.startswith("S"):
            return {}
        shot = int(state[1:])
        made = self.shots[shot - 1]
        end = f"{'W' if shot % 2 else 'L'}{shot}"
        if shot < len(self.shots):
            return {end: made, f"S{shot + 1}": 1.0 - made}
        missed = 1.0 - made
        return {end: made, "W": missed * self.after, "L": missed * (1.0 - self.after)}

    def winner(self, state: str) -> int | None:
        """Return who has won in `state`: 1 in W and Wi, 2 in L and Li, else None."""
        return {"W": 1, "L": 2}.get(state[0])
