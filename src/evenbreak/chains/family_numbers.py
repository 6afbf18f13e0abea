"""Many numbers that pass through a game as if they were one.

`Numbers` adds, multiplies and divides entry by entry. It answers a comparison with one True or
False, as a float does, if all entries agree; otherwise it raises `Disagreement` with the entries
for which the answer is True, so that the caller can ask again for these and for the others. So
code that branches on a value stays right. What needs one true number (`float`, `round`, `hash`,
`str`) raises `Disagreement` without such a list: only one entry at a time can answer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from evenbreak.checks import ManyAsOne

if TYPE_CHECKING:
    from evenbreak.arrays import Bools


class Disagreement(Exception):  # noqa: N818  it is an answer, not a failure
    """The entries of `Numbers` do not answer alike.

    Parameters
    ----------
    true
        shape (k,): where the answer is True; None if there is no answer for many at once.
    """

    def __init__(self, true: Bools | None) -> None:
        super().__init__("the numbers do not agree")
        self.true = true


class Numbers(NDArrayOperatorsMixin, ManyAsOne):
    """Several numbers, or several truth values, that go through arithmetic as one.

    Parameters
    ----------
    values
        shape (k,).

    >>> p = Numbers(np.array([0.25, 0.5]))
    >>> (1.0 - p).values, bool(p < 0.75)
    (array([0.75, 0.5 ]), True)
    >>> try:
    ...     bool(p < 0.5)
    ... except Disagreement as who:
    ...     print(who.true)
    [ True False]
    """

    __slots__ = ("values",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, values: Any) -> None:
        self.values = values

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Numbers:
        """Return a function of numpy, entry by entry."""
        if method != "__call__" or options or ufunc.nout != 1:
            raise Disagreement(None)
        return Numbers(ufunc(*map(_plain, inputs)))

    def __array_function__(self, function: Any, _types: Any, args: Any, options: Any) -> Numbers:
        """Return `numpy.where`, the one other function that works entry by entry."""
        if function is not np.where or options:
            raise Disagreement(None)
        return Numbers(np.where(*map(_plain, args)))

    def __bool__(self) -> bool:
        true = self.values != 0
        if true.all():
            return True
        if true.any():
            raise Disagreement(true)
        return False

    def _one(self, *_: Any) -> NoReturn:
        raise Disagreement(None)

    __float__ = __int__ = __index__ = __complex__ = __round__ = __trunc__ = _one
    __floor__ = __ceil__ = __str__ = __repr__ = __format__ = __array__ = _one


def _plain(value: Any) -> Any:
    """Return what numpy calculates with: entries, or one number for all of them."""
    if isinstance(value, Numbers):
        return value.values
    if np.ndim(value):
        raise Disagreement(None)
    return value
