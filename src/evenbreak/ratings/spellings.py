"""One spelling for names that differ in case or blanks alone: they are one player's."""

from collections.abc import Mapping, Set


def folded(name: str) -> str:
    """Return what names have in common that differ in case or blanks alone.

    >>> folded("Ann Lee") == folded("ann  LEE") == folded("AnnLee")
    True
    """
    return "".join(name.casefold().split())


def usual_spellings(counts: Mapping[str, int], meant: Set[str] = frozenset()) -> dict[str, str]:
    """Return the spelling to use of each name, by what `folded` makes of it.

    It is the most frequent one; of several, one in mixed case, and with more blanks.

    Parameters
    ----------
    counts
        how often each name is written.
    meant
        spellings that come before all others.

    >>> usual_spellings({"ann lee": 1, "Ann Lee": 1, "BO": 2, "Bo": 1})
    {'annlee': 'Ann Lee', 'bo': 'BO'}
    """

    def rank(name: str) -> tuple[bool, int, bool, int]:
        mixed = name not in (name.lower(), name.upper())
        return name in meant, counts[name], mixed, name.count(" ")

    spelling: dict[str, str] = {}
    for name in sorted(counts):
        key = folded(name)
        if key not in spelling or rank(name) > rank(spelling[key]):
            spelling[key] = name
    return spelling
