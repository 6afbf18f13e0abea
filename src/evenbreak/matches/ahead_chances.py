"""The chances of an n-ahead match in closed form.

The lead walks up and down by one. Let rho be the weight of a step down relative to a step up, and
G(s) = 1 + rho + ... + rho^(s - 1). A player who is m games from winning and n from losing wins with
the gambler's-ruin probability G(n)/G(m + n) (P5.27). Most break formats keep this form:

* Who breaks depends on who won the last rack. If u is the chance of another step up after a step
  up, and d is the chance of another step down after a step down, then rho = d/u, and G includes the
  chance of a turn: after a step up, the player wins with probability
  (u + (1 - u) G(n - 1)) / (u + (1 - u) G(m + n - 1)).
* The breaks alternate. The parity of the lead determines who breaks, and rho = (q/p)(q'/p') is the
  weight of two racks.

The walk is viewed from the side for which rho <= 1. Each chance is then a quotient of sums of
positive numbers, none of them large, and G(s) = (1 - rho^s)/(1 - rho) is formed with a logarithm of
rho that has the digits of two floats: no digits are lost if rho is near 1 or a chance is tiny.

Reference: Feller, An Introduction to Probability Theory I, chapter XIV.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

Pair = tuple[Any, Any]
"""A number for player 1 (a step up) and the same for player 2 (a step down); floats or arrays."""

_LN_2, _LN_2_REST = 0.6931471803691238, 1.9082149292705877e-10
"""The logarithm of 2: 32 bits, whose products with exponents are exact, and the rest."""
_SERIES = tuple(1.0 / k for k in range(23, 1, -2))
"""The terms of atanh(z)/z - 1 in z^2, last term first: enough for |z| < 0.18."""
_AT_ONCE = 4096
"""Entries processed at a time, so that they stay in the cache."""
_NEVER, _EVEN = -1e4, -(2.0**-960)
"""Logarithms that stand for log 0 and log 1: G(s) becomes 1 and s."""


def ahead_chances(
    m: int,
    n: int,
    breaker: int,
    racks: Mapping[int, Pair],
    after: Mapping[int, tuple[int, int]],
) -> tuple[dict[tuple[int, int], Any], Any] | None:
    """Return the chance of each (winner, next breaker), and P(the match never ends).

    None if the break format does not keep the closed form. m and n are the number of games by which
    player 1 and player 2 still have to pull ahead; `racks` has, by breaker, each player's chance of
    winning the rack, and `after` is the next breaker if player 1 won and if player 2 won.

    >>> chances, never = ahead_chances(2, 2, 1, {1: (0.75, 0.25)}, {1: (1, 1)})
    >>> round(chances[1, 1], 15), never
    (0.9, 0.0)
    """
    first = racks[breaker]
    if all(then == (b, b) for b, then in after.items()):
        walk = _Walk(_by_nobody, m, n, (first,), slice(0, 1))
        return _by_result(walk, [breaker, breaker])
    if all(then == (3 - b, 3 - b) for b, then in after.items()):
        ends = [breaker if needed % 2 == 0 else 3 - breaker for needed in (m, n)]
        walk = _Walk(_by_turns, m, n, (first, racks[3 - breaker]), slice(0, 2))
        return _by_result(walk, ends)
    if len(set(after.values())) > 1:
        return None
    up, down = after[breaker]
    (u, turn_down), (turn_up, d) = racks[up], racks[down]
    pairs = first, (u, d), (turn_down, turn_up)
    return _by_result(_Walk(_by_last_winner, m, n, pairs, slice(1, 2)), [up, down])


class _Ratio:
    """A ratio given by its logarithm, whose `top` has so few bits that products are exact."""

    def __init__(self, top: Any, rest: Any) -> None:
        self.top, self.rest, self._library = top, rest, _library(top)
        self._of_one = self.missing(1)

    def power(self, s: int) -> Any:
        x = s * self.rest  # below 1e-5 where the power is not 0
        return self._library.exp(s * self.top) * (1.0 + x * (1.0 + 0.5 * x))

    def total(self, s: int) -> Any:
        """Return 1 + rho + ... + rho^(s - 1), for rho <= 1."""
        return self.missing(s) / self._of_one

    def missing(self, s: int) -> Any:
        """Return rho^s - 1."""
        x, most = s * self.rest, self._library.expm1(s * self.top)
        return most + (most + 1.0) * (x * (1.0 + 0.5 * x))


def _by_nobody(m: int, n: int, rho: _Ratio, _: Pair) -> Pair:
    whole = rho.missing(m + n)
    return rho.missing(n) / whole, rho.power(n) * rho.missing(m) / whole


def _by_last_winner(m: int, n: int, rho: _Ratio, first: Pair, on: Pair, turn: Pair) -> Pair:
    (p, q), u, (turn_down, turn_up) = first, on[0], turn
    whole = u + turn_down * rho.total(m + n - 1)
    wins_1 = p * (u + turn_down * rho.total(n)) + q * turn_up * rho.total(n - 1)
    two = p * turn_down * rho.power(1) * rho.total(m - 1) + q * (u + turn_down * rho.total(m))
    return wins_1 / whole, rho.power(n - 1) * two / whole


def _by_turns(m: int, n: int, rho: _Ratio, even: Pair, odd: Pair) -> Pair:
    def total(step: Pair, s: int) -> Any:
        """Return p times the sum of s weights that start with this step."""
        p, q = step
        if s % 2 == 0:
            return (p + q) * rho.total(s // 2)
        return p + (p * rho.power(1) + q) * rho.total(s // 2)

    lowest = even if n % 2 else odd
    whole = total(lowest, m + n)
    two = rho.power(n // 2) * total(odd, m) / whole
    return total(lowest, n) / whole, two * (even[1] / odd[0]) if n % 2 else two


class _Walk(NamedTuple):
    """The walk of the lead to m and -n, with the chances of its steps up and down."""

    ends: Callable[..., Pair]
    m: int
    n: int
    pairs: Any
    """Pairs of chances for `ends`, the first of which is that of the first step."""
    weights: slice
    """The pairs whose quotients down / up make rho."""

    def chances(self) -> Any:
        """Return the chances of player 1 and of player 2."""
        up, down = zip(*self.pairs[self.weights], strict=True)
        if isinstance(self.pairs[0][0], float):
            if 0.0 in up and 0.0 in down:
                return self.stuck()
            return self.moving(*_log_ratio(down, up))
        import numpy as np

        chances = np.empty(self.pairs[0].shape)
        stuck = (np.array(up) == 0.0).any(axis=0) & (np.array(down) == 0.0).any(axis=0)
        chances[:, stuck] = self.of(self.pairs, stuck).stuck()
        rest = self.of(self.pairs, ~stuck)
        up, down = zip(*rest.pairs[self.weights], strict=True)
        top, less = _log_ratio(down, up)
        moved = np.empty(rest.pairs[0].shape)
        for part in (top <= 0.0, top > 0.0):
            if part.any():
                moved[:, part] = rest.of(rest.pairs, part).moving(top[part], less[part])
        chances[:, ~stuck] = moved
        return chances

    def of(self, pairs: Any, part: Any) -> _Walk:
        """Return the walk with some entries of these pairs."""
        return self._replace(pairs=pairs[:, :, part])

    def stuck(self) -> Any:
        """Return the chances if play never leaves two leads unless the first rack decides."""
        p, q = self.pairs[0]
        return p * float(self.m == 1), q * float(self.n == 1)

    def moving(self, top: Any, rest: Any) -> Any:
        """Return the chances, given the logarithm of rho, with the same sign for all entries."""
        if (top if isinstance(top, float) else top[0]) <= 0.0:
            return self.ends(self.m, self.n, _Ratio(top, rest), *self.pairs)
        turned = [(wins_2, wins_1) for wins_1, wins_2 in self.pairs]
        wins_1, wins_2 = self.ends(self.n, self.m, _Ratio(-top, -rest), *turned)
        return wins_2, wins_1


def _by_result(walk: _Walk, ends: Sequence[int]) -> tuple[dict[tuple[int, int], Any], Any]:
    """Return the chance of each (winner, next breaker), and P(never)."""
    numbers = [number for pair in walk.pairs for number in pair]
    if all(isinstance(number, float) for number in numbers):
        wins_1, wins_2 = walk.chances()
        never = 0.0 if wins_1 or wins_2 else 1.0
    else:
        import numpy as np

        arrays = np.array(np.broadcast_arrays(*numbers), dtype=float)
        flat = arrays.reshape(len(walk.pairs), 2, -1)
        wins = np.empty(flat.shape[1:])
        for start in range(0, wins.shape[1], _AT_ONCE):
            part = slice(start, start + _AT_ONCE)
            wins[:, part] = walk.of(flat, part).chances()
        wins_1, wins_2 = wins.reshape(2, *arrays.shape[1:])
        never = ((wins_1 == 0.0) & (wins_2 == 0.0)).astype(float)
    return {(1, ends[0]): wins_1, (2, ends[1]): wins_2}, never


def _log_ratio(above: Sequence[Any], below: Sequence[Any]) -> Pair:
    """Return the logarithm of a quotient of products in two parts, from its difference from 1.

    The fractions of the two products are brought within a factor of the square root of 2 of each
    other, so that their difference is exact.
    """
    lib = _library(above[0])
    x, x_rest, x_exponent = _product(above, lib)
    y, y_rest, y_exponent = _product(below, lib)
    shift = 1 * (x > math.sqrt(2.0) * y) - 1 * (x * math.sqrt(2.0) < y)
    x, x_rest = lib.ldexp(x, -shift), lib.ldexp(x_rest, -shift)
    exponent = x_exponent - y_exponent + shift
    less, less_rest = _exact_sum(x - y, x_rest - y_rest)
    more, more_rest = _exact_sum(x, y)
    z = less / more
    back, back_rest = _exact_product(z, more)
    z_rest = ((less - back) - back_rest + less_rest - z * (more_rest + x_rest + y_rest)) / more
    square, series = z * z, 0.0
    for term in _SERIES:
        series = (series + term) * square
    top, rest = _exact_sum(exponent * _LN_2, 2.0 * z)
    rest = rest + 2.0 * (z_rest + z * series) + exponent * _LN_2_REST
    top, rest = _halves(*_exact_sum(top, rest))
    top = _where((top == 0.0) & (rest == 0.0), _EVEN, top)
    top = _where(x == 0.0, _NEVER, top)
    return _where(y == 0.0, -_NEVER, top), rest


def _product(factors: Sequence[Any], lib: Any) -> tuple[Any, Any, Any]:
    """Return the fraction of a product of one or two factors, its rounding error, and the exponent.

    No exponent is too large or too small for a float.
    """
    fraction, exponent = lib.frexp(factors[0])
    if len(factors) == 1:
        return fraction, 0.0 * fraction, exponent
    other, other_exponent = lib.frexp(factors[1])
    whole, rest = _exact_product(fraction, other)
    fraction, carried = lib.frexp(whole)
    return fraction, lib.ldexp(rest, -carried), exponent + other_exponent + carried


def _exact_sum(x: Any, y: Any) -> Pair:
    """Return x + y and its rounding error."""
    total = x + y
    of_y = total - x
    return total, (x - (total - of_y)) + (y - of_y)


def _exact_product(x: Any, y: Any) -> Pair:
    """Return xy and its rounding error."""
    product = x * y
    (x, x_rest), (y, y_rest) = _halves(x, 0.0), _halves(y, 0.0)
    return product, ((x * y - product) + x * y_rest + x_rest * y) + x_rest * y_rest


def _halves(x: Any, rest: Any) -> Pair:
    """Return the upper 26 bits of x, and the sum of the other bits and `rest`."""
    far = x * (2.0**27 + 1.0)
    upper = far - (far - x)
    return upper, (x - upper) + rest


def _where(condition: Any, x: float, y: Any) -> Any:
    """Return x where the condition holds, else y."""
    if isinstance(y, float):
        return x if condition else y
    import numpy as np

    return np.where(condition, x, y)


def _library(x: Any) -> Any:
    """Return the math library for a float or an array."""
    if isinstance(x, float):
        return math
    import numpy as np

    return np
