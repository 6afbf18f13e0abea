"""Names that may mean one player: spelt in another way, mistyped, or with a shortened given name.

Mistyped names are found without comparing every pair: two words that differ by one
letter (changed, left out or swapped with its neighbour) have a word in common among
those that come of leaving out one letter (the symmetric deletion method of W. Garbe,
2012).
"""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping
from itertools import combinations

SHORTEST_WORD = 4
"""Letters that the longer of two words needs before one is a slip: Tim is not Tom mistyped."""

ALIKE = 3
"""Letters that two given names share at their beginning if one may be short for the other."""

# Letters that Unicode does not take apart into a letter and an accent.
_PLAIN = str.maketrans(
    {"ø": "o", "ł": "l", "đ": "d", "ð": "d", "ı": "i", "æ": "ae", "œ": "oe", "þ": "th"}
)
_UMLAUT = re.compile("([aou])e")


def similar_names(
    names: Iterable[str], met: Collection[tuple[str, str]] = ()
) -> list[tuple[str, ...]]:
    """Return groups of different names that may mean one player.

    First those that differ in case, blanks, punctuation, accents (ä, a and ae are one) or
    the order of words; then those that differ in given names with the same first three
    letters; then those that one slip of the hand explains, in a word of four letters or
    more. Each kind is in the order of the names, and no group is part of another.

    Parameters
    ----------
    names
        as they are written.
    met
        pairs of names that played each other: two players then, so that a group of the
        latter two kinds in which all have met is left out. Of the first kind none is:
        somebody has entered one player twice.

    >>> similar_names(["Ann Lee", "Lee, Ann", "Bo Petersen", "Bo Peterson", "Cy", "CY", "Di"])
    [('Ann Lee', 'Lee, Ann'), ('CY', 'Cy'), ('Bo Petersen', 'Bo Peterson')]
    >>> similar_names(["Dave Jones", "David Jones", "Anna", "Anne"], met=[("Anne", "Anna")])
    [('Dave Jones', 'David Jones')]
    """
    words = {name: split for name in sorted(set(names)) if (split := _words(name))}
    bare = {name: tuple(map(_without_umlauts, split)) for name, split in words.items()}
    kinds: tuple[Collection[tuple[str, ...]], ...] = (
        {*_alike(bare, _run_together), *_alike(bare, _in_order)},
        set(_alike(bare, _given_name)),
        {pair for pair in _nearly_alike(words) if _slip(words[pair[0]], words[pair[1]])},
    )
    apart = {frozenset(pair) for pair in met}
    ranked = [
        (kind, group)
        for kind, groups in enumerate(kinds)
        for group in groups
        if kind == 0 or any(frozenset(pair) not in apart for pair in combinations(group, 2))
    ]
    return [group for _, group in sorted(_largest(ranked))]


def _words(name: str) -> tuple[str, ...]:
    """Return the words of a name, given names first, without accents and in one case."""
    last, _, given = name.partition(",")
    plain = f"{given} {last}".casefold().translate(_PLAIN)
    letters = unicodedata.normalize("NFKD", plain)
    bare = "".join(letter for letter in letters if not unicodedata.combining(letter))
    return tuple(re.findall(r"[^\W_]+", bare))


def _without_umlauts(word: str) -> str:
    """Return a word with ae, oe and ue as a, o and u, as ä, ö and ü have become already."""
    return _UMLAUT.sub(r"\1", word)


def _run_together(words: tuple[str, ...]) -> str:
    return "".join(words)


def _in_order(words: tuple[str, ...]) -> str:
    return " ".join(sorted(words))


def _given_name(words: tuple[str, ...]) -> Hashable:
    """Return the beginning of a given name and all that follows it; None where there is none."""
    given, *rest = words
    if len(given) < ALIKE or not given.isalpha() or not rest or len(rest[-1]) == 1:
        return None
    return given[:ALIKE], *rest


def _alike(
    words: Mapping[str, tuple[str, ...]], key: Callable[[tuple[str, ...]], Hashable]
) -> Iterator[tuple[str, ...]]:
    """Yield the groups of names that have the same key."""
    groups = defaultdict(list)
    for name, split in words.items():
        groups[key(split)].append(name)
    groups.pop(None, None)
    yield from (tuple(group) for group in groups.values() if len(group) > 1)


def _largest(
    ranked: Iterable[tuple[int, tuple[str, ...]]],
) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Yield the groups that are not part of another, of equal ones the first."""
    holding: dict[str, set[int]] = defaultdict(set)
    by_size = sorted(ranked, key=lambda entry: (-len(entry[1]), entry))
    for number, (kind, group) in enumerate(by_size):
        if not set.intersection(*(holding[name] for name in group)):
            yield kind, group
        for name in group:
            holding[name].add(number)


def _nearly_alike(words: Mapping[str, tuple[str, ...]]) -> Iterator[tuple[str, str]]:
    """Yield pairs of names that may be one letter apart."""
    shortened = defaultdict(list)
    for name, split in words.items():
        for key in {split, *_one_letter_less(split)}:
            shortened[key].append(name)
    yield from (pair for group in shortened.values() for pair in combinations(group, 2))


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
    if max(len(a), len(b)) < SHORTEST_WORD:
        return False
    start = 0
    while start < min(len(a), len(b)) and a[start] == b[start]:
        start += 1
    a, b = a[start:], b[start:]
    if any(map(str.isdigit, a[:1] + b[:1])):
        return False
    return a[1:] == b[1:] or a[1:] == b or a == b[1:] or a[:2] + b[2:] == b[1::-1] + a[2:]
