"""The tails of binomial counts, with full precision down to the smallest float."""

from __future__ import annotations

from typing import Any

_TINY = 1e-285
"""Below this, powers inside the library's function may be too small for full precision."""

_CONVERGED = 1e-17


def beta_tail(a: Any, b: Any, x: Any) -> Any:
    """Return I_x(a, b), the regularized incomplete beta function, elementwise.

    For whole numbers a and b, it is the chance of at least a successes in a + b - 1 tries that each
    succeed with chance x, that is, of winning a games before losing b. A small x keeps its digits,
    so pass 1 - x as a small number instead of subtracting a result near 1 from 1.

    >>> f"{beta_tail(19, 10, 1e-16):.10e}"
    '6.9069000000e-298'
    """
    import numpy as np
    from scipy.special import betainc

    tail: Any = np.asarray(betainc(a, b, x), dtype=float)
    tiny = (tail < _TINY) & (np.asarray(x) > 0.0)
    if tiny.any():
        a, b, x = (
            np.broadcast_to(np.asarray(value, dtype=float), tail.shape)[tiny] for value in (a, b, x)
        )
        tail = tail.copy()
        tail[tiny] = _by_series(a, b, x)
    return tail[()]


def _by_series(a: Any, b: Any, x: Any) -> Any:
    """Return x^a (1 - x)^b / (a B(a, b)), times the sum of its hypergeometric series."""
    import numpy as np
    from scipy.special import betaln

    log_first = a * np.log(x) + b * np.log1p(-x) - betaln(a, b) - np.log(a)
    term, total, j = np.ones_like(a), np.ones_like(a), 0
    while (term > _CONVERGED * total).any():
        term = term * ((a + b + j) * x / (a + 1.0 + j))
        total, j = total + term, j + 1
    return np.exp(log_first) * total
