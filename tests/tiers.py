"""Three tiers of tests: a newcomer waits for the first; CI runs two, and a release needs all.

| tier | command | marks |
|---|---|---|
| first | the README's second command | none |
| CI | `.ci/run` | `slow` too |
| release | `make thorough` | `thorough`; and whatever is `drawn` at random, with more of each |

Of a parametrized test marked `slow_after(n)`, the first n rows stand for the rest, which are slow.
EVENBREAK_TIER is `first` unless a command says `ci` or `thorough`.
"""

import os

SHARES = {"first": 0.4, "ci": 1.0, "thorough": 20.0}
"""How many examples a tier makes, to one of CI."""

SHARE = SHARES[os.environ.get("EVENBREAK_TIER", "first")]


def examples(usual: int) -> int:
    """Return how many examples Hypothesis makes of a property in this tier.

    >>> examples(50) >= 20
    True
    """
    return max(3, round(SHARE * usual))
