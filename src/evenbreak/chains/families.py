"""The limits of a family of games at once: one game, arrays of chances.

The game is made once for a batch of chances, from `Numbers` that stand for all of them, and
traversed once. If the chances in the batch lead to different graphs (a chance of 0 or 1, or a game
that branches on a chance), the batch is split and each part is traversed again. The limits are then
calculated over arrays (see `family_elimination`).

In a large family, only the first part is traversed: its operations are repeated for every batch
whose comparisons give the same answers (see `family_numbers`).

As a check, the game is made again from plain floats for three members of each part and one of each
batch, and must have the same arcs. A part that fails this, or whose game needs plain floats, is
calculated member by member.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csc_array

from evenbreak.arrays import Floats, Ints, Places, own_arrays
from evenbreak.chains.arcs import arcs_of
from evenbreak.chains.explore import chain_of
from evenbreak.chains.family_elimination import family_limits
from evenbreak.chains.family_numbers import Disagreement, Numbers, Program, Record
from evenbreak.chains.limits import stochastic_limit
from evenbreak.chains.matrices import ROUNDING, SUM_TOLERANCE
from evenbreak.chains.structure import Structure, structure_of
from evenbreak.checks import probability, together
from evenbreak.errors import ChainError, InputError
from evenbreak.game import Game, moves_of

_BATCH = 8192
"""Batch size in members: an array of them fits into the cache."""
_FIRST = 1024
"""Members worked out first if there is more than one batch; their operations are then repeated."""
_FEW = 3
"""Members up to which each is calculated alone; in a larger part, this many are checked."""
_SAME = 1e-14
"""Relative tolerance between an arc and that of the game made from plain floats."""


@own_arrays
@dataclass(frozen=True, eq=False)
class FamilyLimit:
    """Stochastic limits of a family of games; `limit[state]` is an array over the family.

    Parameters
    ----------
    states
        the n states that any member of the family can reach.
    probability
        the shape of the family, then n: the limit of each state, given the start of the game; 0
        for a state that this member cannot reach.
    period
        the shape of the family: the period of each limit, see `Limit`. Above 1 the limit is a
        long-run average only.
    """

    states: Sequence[Hashable]
    probability: Floats
    period: Ints

    def __getitem__(self, state: Hashable) -> Floats:
        try:
            place = self.states.index(state)
        except ValueError:
            first = ", ".join(map(repr, self.states[:5]))
            raise ChainError(
                f"state {state!r} isn't in any game in the family, whose first states are {first}"
            ) from None
        return np.asarray(self.probability[..., place])

    def __repr__(self) -> str:
        count, n = self.period.size, len(self.states)
        return f"<FamilyLimit of {count} game{'s' * (count != 1)} over {n} state{'s' * (n != 1)}>"


def limits_over(game_of: Callable[..., Game], /, **chances: ArrayLike) -> FamilyLimit:
    """Return the stochastic limits of a game for arrays of its chances.

    Each limit is conditional on the start of its game, and as accurate as that of
    `stochastic_limit`, even if a chance is 0 or 1.

    Parameters
    ----------
    game_of
        a callable that makes the game: a class such as `OneBall`, or any function that takes the
        chances by name and returns a game, such as `lambda p1, p2: Ahead(5, 3, Rack(p1, p2),
        breaks=...)`.
    **chances
        the chances, as numbers or arrays; they are broadcast together.

    Raises
    ------
    AccuracyError
        if a limit cannot be guaranteed, as for `stochastic_limit`.
    ChainError, GameError
        if the moves of a game are not probabilities that sum to 1.
    InputError
        if no chance is given, one is not a probability, an array is empty, or the shapes do not
        broadcast; or `game_of` cannot be called.

    Notes
    -----
    The function and the game should do arithmetic with the chances and compare them; numpy's
    functions of single numbers work as well. The result is right for any game, but one that needs
    plain floats (`math.exp(p)`, `round(p, 2)`, a chance in the name of a state) is calculated
    member by member, in a loop over `stochastic_limit`; so is a game whose graph differs from
    member to member. A limit that underflow may have affected is recalculated alone.

    >>> from evenbreak.games import OneBall
    >>> limit = limits_over(OneBall, p1=[[0.25], [0.5], [1.0]], p2=[0.0, 0.5])
    >>> limit["W"].round(4)
    array([[1.    , 0.4   ],
           [1.    , 0.6667],
           [1.    , 1.    ]])
    >>> limit
    <FamilyLimit of 6 games over 4 states>
    """
    if not callable(game_of):
        raise InputError(f"game_of must be a class of games or a function; you gave {game_of!r}")
    if not chances:
        raise InputError(
            "no probabilities were given. Give arrays of them by name, such as p1=[0.4, 0.6]."
        )
    checked = {name: probability(value, name) for name, value in chances.items()}
    shape = together(**checked)
    count = math.prod(shape)
    if not count:
        empty = next(name for name, value in checked.items() if not np.size(value))
        raise InputError(f"{empty} must not be empty. Give at least one chance.")
    flat = {
        name: value if isinstance(value, float) else np.broadcast_to(value, shape).ravel()
        for name, value in checked.items()
    }
    return _Family(game_of, flat, count).limits(shape)


class _Found:
    """The limits that are known so far."""

    def __init__(self, count: int) -> None:
        self._listed: list[list[Any]] = []
        self._row: dict[Any, int] = {}
        self._limits = np.zeros((0, count))
        self._periods: dict[int, list[Any]] = {}

    def add(
        self, members: Any, states: list[Any], limits: Iterable[tuple[int, Any]], period: int
    ) -> None:
        """Add the limits of some members, by position in the list of their states."""
        if not any(states is listed for listed in self._listed):
            self._listed.append(states)
            for state in states:
                self._row.setdefault(state, len(self._row))
            before = self._limits
            if len(self._row) > len(before):
                self._limits = np.zeros((len(self._row), before.shape[1]))
                self._limits[: len(before)] = before
        for place, values in limits:
            self._limits[self._row[states[place]], members] = values
        self._periods.setdefault(period, []).append(members)

    def together(self, shape: tuple[int, ...]) -> FamilyLimit:
        """Return all limits, with the states of the largest graph first."""
        order: dict[Any, int] = {}
        for states in sorted(self._listed, key=len, reverse=True):
            for state in states:
                order.setdefault(state, self._row[state])
        rows = list(order.values())
        limits = self._limits if rows == sorted(rows) else self._limits[rows]
        # Nobody else has these arrays, so they need no copy.
        limits.flags.writeable = False
        by_state = np.moveaxis(limits.reshape(len(rows), *shape), 0, -1)
        return FamilyLimit(tuple(order), by_state, self._period(shape))

    def _period(self, shape: tuple[int, ...]) -> Ints:
        period = np.array(next(iter(self._periods)))
        if len(self._periods) > 1:
            period = np.empty(self._limits.shape[1], dtype=np.int64)
            for of_some, parts in self._periods.items():
                for members in parts:
                    period[members] = of_some
            period = period.reshape(shape)
        period.flags.writeable = False
        return np.broadcast_to(period, shape)


class _Again(NamedTuple):
    """The operations for one part, to be repeated for members that give the same answers."""

    states: list[Any]
    sources: list[int]
    targets: list[int]
    period: int
    places: list[int]
    """Positions of the limits that `limits` returns."""
    limits: Program
    chances: Program


class _Family:
    """A game with arrays of chances of shape (k,), or floats."""

    def __init__(
        self, game_of: Callable[..., Game], chances: dict[str, Floats | float], count: int
    ) -> None:
        self._game_of, self._chances, self._count = game_of, chances, count
        self._structures: dict[Any, Structure] = {}
        self._found = _Found(count)
        self._programs: list[_Again] = []

    def limits(self, shape: tuple[int, ...]) -> FamilyLimit:
        """Return the limits of all members, those with the same graph calculated together."""
        done, step = 0, _BATCH if self._count <= _BATCH else _FIRST
        waiting: list[Places] = []
        while waiting or done < self._count:
            if not waiting:
                batch = slice(done, min(done + step, self._count))
                if not self._again(batch):
                    waiting.append(np.arange(batch.start, batch.stop))
                done, step = (
                    batch.stop,
                    min((program.limits.size for program in self._programs), default=_BATCH),
                )
                continue
            members, true = waiting.pop(), None
            if len(members) > _FEW:
                try:
                    members = self._together(members)
                except Disagreement as answer:
                    true = answer.true
                except Exception:
                    true = None
            if true is None:
                for member in members.tolist():
                    self._alone(member)
            else:
                waiting += [members[true], members[~true]]
        return self._found.together(shape)

    def _again(self, batch: slice) -> bool:
        """Repeat the operations for another batch; return whether they are valid for it."""
        values = [value[batch] for value in self._chances.values() if not isinstance(value, float)]
        middle = (batch.start + batch.stop) // 2
        at = [value[middle - batch.start, None] for value in values]
        for program in self._programs:
            with suppress(Exception), np.errstate(divide="raise", invalid="raise"):
                limits = program.limits.run(values)
                if limits is not None:
                    chances = [float(np.ravel(p)[0]) for p in program.chances.run(at) or ()]
                    self._check(middle, program.states, program.sources, program.targets, chances)
                    limits_at = zip(program.places, limits, strict=True)
                    self._found.add(batch, program.states, limits_at, program.period)
                    return True
        return False

    def _game(self, member: int) -> Game:
        return self._game_of(
            **{
                name: value if isinstance(value, float) else float(value[member])
                for name, value in self._chances.items()
            }
        )

    def _alone(self, member: int) -> None:
        limit = stochastic_limit(chain_of(self._game(member)))
        states = list(limit.states)
        self._found.add(member, states, enumerate(limit.probability), limit.period)

    def _together(self, members: Places) -> Places:
        """Work out the limits of members with the same graph; return those that remain doubtful."""
        record = Record()
        first, last = int(members[0]), int(members[-1])
        part: Any = slice(first, last + 1) if last - first < len(members) else members
        # Where a float would raise ZeroDivisionError, arrays must not go on either.
        with np.errstate(divide="raise", invalid="raise"):
            game = self._game_of(
                **{
                    name: value if isinstance(value, float) else Numbers(value[part], record)
                    for name, value in self._chances.items()
                }
            )
            states, sources, targets, numbers = moves_of(game, game.start)
        for k in (0, len(members) // 2, len(members) - 1):
            at = [_at(p, k) for p in numbers]
            self._check(int(members[k]), states, sources, targets, at)
        moves = sources, targets
        sources, targets, completed = _completed(len(states), sources, targets, numbers)
        structure = self._structure(len(states), sources, targets)
        period = math.lcm(*structure.periods[structure.closed].tolist())
        limits, doubtful = family_limits(structure, sources, targets, completed, len(members))
        plain = ((k, x.values if isinstance(x, Numbers) else x) for k, x in limits.items())
        self._found.add(part, states, plain, period)
        if doubtful is not None:
            return members[doubtful]
        if self._count > _BATCH and len(self._programs) < _FEW:
            program = _Again(
                states,
                *moves,
                period,
                list(limits),
                Program(record, limits.values()),
                Program(record, numbers, answers=False),
            )
            self._programs.append(program)
        return members[:0]

    def _check(
        self,
        member: int,
        states: list[Any],
        sources: list[int],
        targets: list[int],
        chances: list[float],
    ) -> None:
        """Raise an error if arcs differ from those of the game made from plain floats."""
        game = self._game(member)
        *graph, exact = moves_of(game, game.start)
        same = graph == [states, sources, targets] and all(
            math.isclose(p, float(q), rel_tol=_SAME) for p, q in zip(chances, exact, strict=True)
        )
        if not same:
            raise Disagreement(None)

    def _structure(self, size: int, sources: list[int], targets: list[int]) -> Structure:
        key = size, tuple(sources), tuple(targets)
        if key not in self._structures:
            j, i = np.array(sources, dtype=np.intp), np.array(targets, dtype=np.intp)
            matrix: csc_array = csc_array((np.ones(len(j)), (i, j)), shape=(size, size))
            self._structures[key] = structure_of(arcs_of(matrix), matrix.diagonal() > 0.0)
        return self._structures[key]


def _at(chance: Any, place: int) -> float:
    return float(chance.values[place] if isinstance(chance, Numbers) else chance)


def _completed(
    size: int, sources: list[int], targets: list[int], chances: list[Any]
) -> tuple[list[int], list[int], list[Any]]:
    """Return the arcs with sums of 1, as `chain_of` completes the arcs of one chain.

    A self-loop becomes the remainder of the other arcs, which must be zero for all members or for
    none. Without a self-loop, arcs that miss 1 by more than a rounding error are scaled.
    """
    others: list[Any] = [0.0] * size
    loops: list[Any] = [None] * size
    for j, i, chance in zip(sources, targets, chances, strict=True):
        if i == j:
            loops[j] = chance
        else:
            others[j] = others[j] + chance
    scales: list[Any] = [None] * size
    for j in set(sources):
        total = others[j] + (0.0 if loops[j] is None else loops[j])
        if not 1.0 - SUM_TOLERANCE <= total <= 1.0 + SUM_TOLERANCE:
            raise Disagreement(None)
        if loops[j] is not None:
            left = 1.0 - others[j]
            loops[j] = left if left > 0.0 else None
        elif not all(yes is True for yes in (total >= 1.0 - ROUNDING, total <= 1.0 + ROUNDING)):
            scales[j] = np.where(abs(total - 1.0) <= ROUNDING, 1.0, total)
    kept_sources, kept_targets, completed = [], [], []
    for j, i, chance in zip(sources, targets, chances, strict=True):
        completion = loops[j] if i == j else chance if scales[j] is None else chance / scales[j]
        if completion is not None:
            kept_sources.append(j)
            kept_targets.append(i)
            completed.append(completion)
    return kept_sources, kept_targets, completed
