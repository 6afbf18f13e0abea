"""Many numbers that pass through a game as if they were one.

`Numbers` adds, multiplies and divides entry by entry. It answers a comparison with one True or
False, as a float does, if all entries agree; otherwise it raises `Disagreement` with the entries
for which the answer is True, so that the caller can ask again for these and for the others. So code
that branches on a value remains correct. Functions that need a single number (`float`, `round`,
`hash`, `str`) raise `Disagreement` without such a list: only one entry at a time can answer.

The operations on the numbers are kept in a `Record`. Since only these answers can change the code's
path, the same operations are valid for any other numbers that give the same answers: a `Program`
repeats them for these, in memory that stays in the cache, and asks again.
"""

from __future__ import annotations

import operator
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from evenbreak.arrays import Bools, Floats
from evenbreak.checks import ManyAsOne

_LEAST, _MOST = np.minimum.reduce, np.maximum.reduce
_EXTREMES: dict[Any, Any] = {
    np.less: (operator.lt, _MOST, _LEAST),
    np.less_equal: (operator.le, _MOST, _LEAST),
    np.greater: (operator.gt, _LEAST, _MOST),
    np.greater_equal: (operator.ge, _LEAST, _MOST),
}
"""The entry that answers true for all in a comparison with a constant, and the one for false."""


class Disagreement(Exception):  # noqa: N818  it is an answer, not a failure
    """The entries of `Numbers` give different answers.

    `true` is where the answer is True; None if there is no answer for many at once.
    """

    def __init__(self, true: Bools | None) -> None:
        super().__init__("the numbers do not agree")
        self.true = true


class _Step(NamedTuple):
    """One operation: a function, the places of its arguments or constants, and its dtype."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    dtype: np.dtype[Any]


class _Place(int):
    """The place of a number in a record, distinguished from a constant."""


class Record:
    """The operations on some numbers, and the answers that they give."""

    def __init__(self) -> None:
        self.steps: list[_Step | None] = []
        self.asked: dict[int, dict[Any, bool]] = defaultdict(dict)
        self._places: dict[Any, _Place] = {}

    def place(self, step: _Step | None = None) -> _Place:
        """Return the place of the number made in this step; None stands for a given number."""
        key = step and (step.function, *((type(x), x) for x in step.arguments))
        if key in self._places:
            return self._places[key]
        self.steps.append(step)
        place = _Place(len(self.steps) - 1)
        if key:
            self._places[key] = place
        return place


class Numbers(NDArrayOperatorsMixin, ManyAsOne):
    """Several numbers, or several truth values, that go through arithmetic as one.

    The operations on them are kept in `record`, which is shared by all numbers that are combined.
    """

    __slots__ = ("place", "record", "values")
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self, values: Any, record: Record | None = None, step: _Step | None = None
    ) -> None:
        self.values = values
        self.record = Record() if record is None else record
        self.place = self.record.place(step)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the values."""
        return np.shape(self.values)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Apply a numpy function entry by entry."""
        if method != "__call__" or options or ufunc.nout != 1:
            raise Disagreement(None)
        if ufunc is np.add:  # sums begin with 0
            for start, addend in (inputs, inputs[::-1]):
                if isinstance(start, (int, float)) and start == 0:
                    return addend
        if ufunc in _EXTREMES and inputs[0] is self and isinstance(inputs[1], (int, float)):
            compare, *extremes = _EXTREMES[ufunc]
            true, false = (extreme(self.values).item() for extreme in extremes)
            answer = bool(compare(true, inputs[1]))
            if true == true and answer == compare(false, inputs[1]):  # no NaN
                self.record.asked[self.place][extremes[not answer], compare, inputs[1]] = answer
                return answer
        return self._made(ufunc, inputs)

    def __array_function__(self, function: Any, _types: Any, args: Any, options: Any) -> Numbers:
        """Return `numpy.where`, the one other function that works entry by entry."""
        if function is not np.where or options:
            raise Disagreement(None)
        return self._made(function, args)

    def _made(self, function: Callable[..., Any], inputs: Sequence[Any]) -> Numbers:
        values = function(*map(_plain, inputs))
        arguments = (x.place if isinstance(x, Numbers) else x for x in inputs)
        return Numbers(values, self.record, _Step(function, tuple(arguments), values.dtype))

    def __bool__(self) -> bool:
        true = self.values != 0
        answer = bool(true.all())
        if not answer and true.any():
            raise Disagreement(true)
        self.record.asked[self.place][np.all if answer else np.any, operator.eq, answer] = True
        return answer

    def _one(self, *_: Any) -> NoReturn:
        raise Disagreement(None)

    __float__ = __int__ = __index__ = __complex__ = __round__ = __trunc__ = _one
    __floor__ = __ceil__ = __str__ = __repr__ = __format__ = __array__ = _one


def _plain(value: Any) -> Any:
    """Return the values that numpy calculates with: entries, or one number for all of them."""
    if isinstance(value, Numbers):
        return value.values
    if np.ndim(value):
        raise Disagreement(None)
    return value


_MEMORY = 2_500_000
"""Bytes of cache that the numbers in progress should fit into."""
_SHORTEST, _LONGEST = 4096, 32_000
"""Numbers at a time: more means fewer calls, as long as they fit in the cache."""


class Program:
    """A record's operations, to be repeated with other numbers, at most `size` at a time.

    `outputs` are some of the record's numbers, or floats; `answers` is whether the answers must be
    the same.
    """

    def __init__(self, record: Record, outputs: Iterable[Any], *, answers: bool = True) -> None:
        self._registers, self._given, self._acts = list[Any](), list[Any](), list[Any]()
        self._outputs = [x.place if isinstance(x, Numbers) else x for x in outputs]
        self._tests = record.asked if answers else {}
        needed = {place for place in (*self._outputs, *self._tests) if isinstance(place, _Place)}
        self._plan(record, needed)
        memory = [k for k, x in enumerate(self._registers) if isinstance(x, np.dtype)]
        self.size = min(_LONGEST, max(_SHORTEST, _MEMORY // (8 * len(memory) + 1)))
        for k in memory:
            # At another place in its page than the one before.
            room, shift = np.empty(self.size + 4096, self._registers[k]), 64 * (k % 64)
            self._registers[k] = room[shift : shift + self.size]

    def _plan(self, record: Record, needed: set[Any]) -> None:
        """Give each number that is needed a register, and reuse it after its last use."""
        last: dict[int, int] = {}
        for place in range(len(record.steps) - 1, -1, -1):
            step = record.steps[place]
            if step is not None and place in needed:
                for x in step.arguments:
                    if isinstance(x, _Place):
                        needed.add(x)
                        last.setdefault(x, place)
        kept = {place for place in self._outputs if isinstance(place, _Place)}
        free: dict[Any, list[int]] = defaultdict(list)
        at: dict[int, int] = {}
        for place, step in enumerate(record.steps):
            if step is None:
                at[place] = self._register(None)
                self._given.append((at[place], self._tests.get(place, {})))
            elif place in needed:
                arguments = [
                    at[x] if isinstance(x, _Place) else self._register(x) for x in step.arguments
                ]
                # The result takes the place of an argument if it can: that is twice as fast.
                ends = [
                    x
                    for x in dict.fromkeys(step.arguments[::-1])
                    if isinstance(x, _Place) and last[x] == place and x not in kept
                ]
                for x in ends:
                    made = record.steps[x]
                    if made is not None:
                        free[made.dtype].append(at[x])
                pool = free[step.dtype]
                at[place] = pool.pop() if pool else self._register(step.dtype)
                self._acts.append((step.function, arguments, at[place], self._tests.get(place)))
                if place not in last and place not in kept:
                    free[step.dtype].append(at[place])
        self._outputs = [
            at[x] if isinstance(x, _Place) else self._register(x) for x in self._outputs
        ]

    def _register(self, content: Any) -> int:
        self._registers.append(content)
        return len(self._registers) - 1

    def run(self, values: Sequence[Floats]) -> list[Any] | None:
        """Return the outputs for these numbers; None if they give different answers.

        They are overwritten by the next run.
        """
        size = len(values[0])
        held = list(self._registers)
        if size != self.size:
            held = [x[:size] if np.ndim(x) else x for x in held]
        for (register, tests), numbers in zip(self._given, values, strict=True):
            held[register] = numbers
            if not _passed(numbers, tests):
                return None
        for function, arguments, target, tests in self._acts:
            inputs = [held[k] for k in arguments]
            if function is np.where:
                held[target] = function(*inputs)
            else:
                function(*inputs, out=held[target])
            if tests and not _passed(held[target], tests):
                return None
        return [held[k] for k in self._outputs]


def _passed(numbers: Any, tests: dict[Any, bool]) -> bool:
    """Return whether numbers give the same answers as before."""
    extremes: dict[Any, Any] = {}
    for (extreme, compare, limit), answer in tests.items():
        x = extremes.get(extreme)
        if x is None:
            x = extremes[extreme] = extreme(numbers).item()
        if compare(x, limit) != answer or x != x:
            return False
    return True
