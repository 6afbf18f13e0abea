"""Names that may mean one player: spelt in another case, with other blanks or accents, or mistyped.

Mistyped names are found without comparing every pair: two words that differ by one
letter (changed, left out or swapped with its neighbour) have a word in common among
those that come of leaving out one letter (the symmetric deletion method of W. Garbe,
2012).
"""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Iterator
from itertools import combinations

__all__ = ["similar_names"]

SHORTEST_MISTYPED = 8
"""Letters that two names need before one other letter is taken for a slip."""

SHORTEST_WORD = 4
"""Letters that the word with the slip needs: J and K are initials, not slips."""

# Letters that Unicode does not take apart into a letter and an accent.
_PLAIN = str.maketrans(
    {"ø": "o", "ł": "l", "đ": "d", "ð": "d", "ı": "i", "æ": "ae", "œ": "oe", "þ": "th"}
)


def similar_names(names: Iterable[str]) -> list[tuple[str, ...]]:
    """Return groups of different names that may mean one player.

    First those that differ in case, blanks, accents or the order of words, then those
    that one slip of the hand explains; both in the order of the names.

    >>> similar_names(["Ann Lee", "Lee, Ann", "Bo Petersen", "Bo Peterson", "Cy", "CY", "Di"])
    [('Ann Lee', 'Lee, Ann'), ('CY', 'Cy'), ('Bo Petersen', 'Bo Peterson')]
    """
    words = {name: _words(name) for name in sorted(set(names))}
    groups = set()
    for key in (_run_together, _in_order):
        alike = defaultdict(list)
        for name, split in words.items():
            if split:
                alike[key(split)].append(name)
        groups |= {tuple(group) for group in alike.values() if len(group) > 1}
    slips = {(one, other) for one, other in _nearly_alike(words) if _slip(words[one], words[other])}
    return [*sorted(groups), *sorted(slips)]


def _words(name: str) -> tuple[str, ...]:
    """Return the words of a name, without accents and in one case."""
    apart = unicodedata.normalize("NFKD", name.casefold().translate(_PLAIN))
    bare = "".join(letter for letter in apart if not unicodedata.combining(letter))
    return tuple(re.findall(r"[^\W_]+", bare))


def _run_together(words: tuple[str, ...]) -> str:
    return "".join(words)


def _in_order(words: tuple[str, ...]) -> str:
    return " ".join(sorted(words))


def _nearly_alike(words: dict[str, tuple[str, ...]]) -> Iterator[tuple[str, str]]:
    """Yield pairs of names that may be one letter apart, each pair once."""
    shortened = defaultdict(list)
    for name, split in words.items():
        if sum(map(len, split)) >= SHORTEST_MISTYPED:
            for key in {split, *_one_letter_less(split)}:
                shortened[key].append(name)
    yield from {pair for group in shortened.values() for pair in combinations(group, 2)}


def _one_letter_less(words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """Yield the words without one letter of a long one; numbered names keep their digits."""
    for place, word in enumerate(words):
        if len(word) >= SHORTEST_WORD:
            for k, letter in enumerate(word):
                if not letter.isdigit():
                    yield (*words[:place], word[:k] + word[k + 1 :], *words[place + 1 :])


def _slip(one: tuple[str, ...], other: tuple[str, ...]) -> bool:
    """Tell whether just one long word differs, by one letter that is no digit."""
    if len(one) != len(other):
        return False
    differing = [(a, b) for a, b in zip(one, other, strict=True) if a != b]
    if len(differing) != 1:
        return False
    a, b = differing[0]
    if min(len(a), len(b)) < SHORTEST_WORD:
        return False
    start = 0
    while start < min(len(a), len(b)) and a[start] == b[start]:
        start += 1
    a, b = a[start:], b[start:]
    if any(map(str.isdigit, a[:1] + b[:1])):
        return False
    return a[1:] == b[1:] or a[1:] == b or a == b[1:] or a[:2] + b[2:] == b[1::-1] + a[2:]
