"""Three tiers of tests: a newcomer waits for the first; CI runs two, and a release needs all.

| tier | command | marks |
|---|---|---|
| first | the README's second command | none |
| CI | `.ci/run` | `slow` too |
| release | `make thorough` | `thorough`; and whatever is `drawn` at random, with more of each |

EVENBREAK_TIER is `first` unless a command says `ci` or `thorough`.
"""

import os
from collections.abc import Iterable
from typing import Any

import pytest

SHARES = {"first": 0.4, "ci": 1.0, "thorough": 20.0}
"""How many examples a tier makes, to one of CI."""

SHARE = SHARES[os.environ.get("EVENBREAK_TIER", "first")]


def examples(usual: int) -> int:
    """Return how many examples Hypothesis makes of a property in this tier.

    >>> examples(50) >= 20
    True
    """
    return max(3, round(SHARE * usual))


def slow_after(count: int, rows: Iterable[Any]) -> list[Any]:
    """Mark all rows of a parametrized test slow but the first ones, which stand for them.

    >>> [bool(getattr(row, "marks", ())) for row in slow_after(1, ["a", "b"])]
    [False, True]
    """
    return [row if k < count else _slow(row) for k, row in enumerate(rows)]


def _slow(row: Any) -> Any:
    if hasattr(row, "marks"):
        return row._replace(marks=(*row.marks, pytest.mark.slow))
    return pytest.param(*(row if isinstance(row, tuple) else (row,)), marks=pytest.mark.slow)
