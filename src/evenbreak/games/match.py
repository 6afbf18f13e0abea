"""Common base of all matches: the score, the rule that ends them, and who breaks next.

A match can itself be the rack of a longer match: a race whose rack is a race is a match of
sets, and so on to any depth.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Any, Generic, TypeAlias

from evenbreak.checks import one_of, whole
from evenbreak.errors import GameError, InputError
from evenbreak.game import Game
from evenbreak.games.breaks import BreakFormat, checked_format
from evenbreak.games.rack import ChanceT, Rack, game_repr

Score: TypeAlias = tuple[int, int]


@dataclass(frozen=True)
class Match(ABC, Generic[ChanceT]):
    """Base class of `Race` and `Ahead`: a score a:b that grows rack by rack until one player wins.

    Parameters
    ----------
    m, n
        the games (or sets) that player 1 and player 2 need.
    rack
        what is played for one point of the score: a `Rack`, another match (a set), or a custom
        game, which player 1 or player 2 wins and which itself determines who starts.
    breaks
        who breaks next (see `evenbreak.games.breaks`); needed if the break matters. In a
        match of sets it decides who breaks first in the next set, given who broke first in
        the last one and who won it; with None, the set's own format carries over from set to set.
    first_breaker
        who breaks the first rack to be played, 1 or 2.
    score
        the score to start from: games on the wire, or a match in progress.

    Notes
    -----
    A state is (a, b) if the break does not matter, (a, b, breaker) if it does, and (a, b,
    state of the set) in a match of sets, with the set's first breaker before the set's state
    if the match has its own break format; a custom game's state replaces the set's. Scores that
    differ only in racks that no longer matter are one state, so even a match without a longest
    length has a finite graph.
    """

    m: int
    n: int
    rack: Rack[ChanceT] | Match[ChanceT] | Game
    _: KW_ONLY
    breaks: BreakFormat | None = None
    first_breaker: int = 1
    score: Score = (0, 0)

    def __repr__(self) -> str:
        return game_repr(self)

    def __post_init__(self) -> None:
        object.__setattr__(self, "m", whole(self.m, "m", at_least=1))
        object.__setattr__(self, "n", whole(self.n, "n", at_least=1))
        if not isinstance(self.rack, (Rack, Match)):
            self._check_own_game(self.rack)
        if isinstance(self.rack, Match) and self.rack.decided(*self.rack.score) is not None:
            raise InputError(
                "rack is a set that is already over at its starting score. Give a set that can "
                "still be played."
            )
        if isinstance(self.rack, Rack) and self.rack.break_matters and self.breaks is None:
            raise InputError(
                "breaks is missing: with Rack(p1, p2), the break matters. Give a break format, "
                "such as breaks=winner_breaks."
            )
        if self.breaks is not None:
            checked_format(self.breaks)
        first = one_of(self.first_breaker, "first_breaker", (1, 2))
        object.__setattr__(self, "first_breaker", first)
        try:
            a, b = self.score
        except (TypeError, ValueError):
            raise InputError(
                "score is {score!r}. Give the games that each player has won, such as (2, 1).",
                score=self.score,
            ) from None
        self._check_score(whole(a, "score of player 1"), whole(b, "score of player 2"))

    def _check_own_game(self, game: Game) -> None:
        if not isinstance(game, Game) or isinstance(game, type):
            raise InputError(
                "rack must be a Rack(p), a Rack(p1, p2), a match, or a game with start, "
                "moves and winner; you gave {game!r}",
                game=game,
            )
        if self.breaks is not None or self.first_breaker != 1:
            raise InputError(
                "breaks and first_breaker can't be used when the rack is a game of your own, "
                "which already sets who starts. Leave them out, or give Rack(p1, p2) with each "
                "player's chance in games they start."
            )
        if game.winner(game.start) is not None:
            raise InputError(
                "rack is a game that is over before it starts. Give one that can be played."
            )

    def _check_score(self, a: int, b: int) -> None:
        object.__setattr__(self, "score", (a, b))
        before = self._played_from(a, b)
        last_winner = self.decided(a, b)
        if last_winner is not None:
            only = (a - 1, b) if last_winner == 1 else (a, b - 1)
            before = [x for x in before if x == only and (x == (0, 0) or self._played_from(*x))]
        if not before and (a, b) != (0, 0):
            raise InputError(
                "{score} is {a}-{b}, which can't be reached: {name} {m}:{n} is over before that",
                a=a,
                b=b,
                name=type(self).__name__,
                m=self.m,
                n=self.n,
            )

    def _played_from(self, a: int, b: int) -> list[Score]:
        """Return the scores one rack before a:b at which the match continues."""
        return [
            (x, y)
            for x, y in ((a - 1, b), (a, b - 1))
            if min(x, y) >= 0 and self.decided(x, y) is None
        ]

    @abstractmethod
    def decided(self, a: int, b: int) -> int | None:
        """Return who has won at the score a:b: 1, 2, or None while the match continues."""

    @abstractmethod
    def fold(self, a: int, b: int) -> Score:
        """Return the lowest score from which the rest of the match is the same as from a:b."""

    @property
    def break_matters(self) -> bool:
        """Whether the chances depend on who breaks."""
        return isinstance(self.rack, (Rack, Match)) and self.rack.break_matters

    @property
    def innermost_rack(self) -> Rack[ChanceT] | Game:
        """The rack, or custom game, at the bottom of a match of sets, or of sets of sets."""
        return self.rack.innermost_rack if isinstance(self.rack, Match) else self.rack

    @property
    def start(self) -> Any:
        """The state before the first rack."""
        if isinstance(rack := self.innermost_rack, Rack):
            rack.of_numbers()
        return self.open(self.first_breaker)

    def open(self, breaker: int) -> Any:
        """Return the state before the first rack, given that `breaker` breaks it."""
        return self._state(self.score, breaker)

    def moves(self, state: Any) -> Mapping[Any, float]:
        """Return the probability of each next state, given `state`; one rack is played."""
        a, b, *rest = state
        if self.decided(a, b) is not None:
            return {}
        if isinstance(self.rack, Rack):
            return self._after_rack(a, b, rest[0] if rest else 1, self.rack)
        return self._after_rack_of_set(a, b, rest, self.rack)

    def winner(self, state: Any) -> int | None:
        """Return who has won in `state`: 1, 2, or None while the match continues."""
        return self.decided(state[0], state[1])

    def label(self, state: Any) -> str:
        """Return the score in `state`, with the breaker or the score of the set below it."""
        a, b, *rest = state
        lines = [f"{a}:{b}"]
        if self.winner(state) is None:  # who would break next is not part of a result
            if not isinstance(self.rack, Rack):
                lines += [f"{opener} broke first" for opener in rest[:-1]]
                lines.append(str(getattr(self.rack, "label", str)(rest[-1])))
            elif rest:
                lines.append(f"{rest[0]} breaks")
        return "\n".join(lines)

    def next_breaker(self, state: Any) -> int:
        """Return who breaks the rack after this match: the last entry of its final state."""
        return int(state[2]) if self.break_matters else 1

    def _after_rack(self, a: int, b: int, breaker: int, rack: Rack) -> dict[Any, float]:
        return {
            self._state(
                (a + 1, b) if winner == 1 else (a, b + 1),
                self.breaks(breaker, winner) if self.breaks else breaker,
            ): chance
            for winner in (1, 2)
            if (chance := rack.move(winner, breaker)) > 0.0
        }

    def _after_rack_of_set(
        self, a: int, b: int, rest: list[Any], rack: Match | Game
    ) -> dict[Any, float]:
        *opener, inner = rest
        result: dict[Any, float] = {}
        for after, chance in rack.moves(inner).items():
            winner = rack.winner(after)
            if winner is None:
                target: Any = (a, b, *opener, after)
            elif winner not in (1, 2):
                raise GameError(
                    "the rack's winner is {winner!r} in {after!r}. Give a game that "
                    "player 1 or player 2 wins.",
                    winner=winner,
                    after=after,
                )
            else:
                score = (a + 1, b) if winner == 1 else (a, b + 1)
                carried = rack.next_breaker(after) if isinstance(rack, Match) else 1
                target = self._state(
                    score, self.breaks(opener[0], winner) if opener and self.breaks else carried
                )
            result[target] = result.get(target, 0) + chance
        return result

    def _state(self, score: Score, breaker: int) -> Any:
        folded = self.fold(*score)
        if isinstance(self.rack, Rack) or self.decided(*folded) is not None:
            return (*folded, breaker) if self.break_matters else folded
        opener = (breaker,) if self.breaks and self.break_matters else ()
        inner = self.rack.open(breaker) if isinstance(self.rack, Match) else self.rack.start
        return (*folded, *opener, inner)
