"""How many tries each class of attack gets: few in a normal run, and more where that is asked for.

EVENBREAK_TRIES=200 gives each class 200 tries or more; `tries.md` has them all.
"""

import os

_LEAST = int(os.environ.get("EVENBREAK_TRIES", "0"))


def tries(name: str, usual: int, *, parts: int = 1) -> int:
    """Return how many tries a class gets, in each of so many parts.

    >>> tries("names", 300) >= 300
    True
    """
    assert name
    return max(usual, -(-_LEAST // parts))
