"""Names that may belong to one player: spelled differently, mistyped, or with a short given name.

Mistyped names are found without comparing every pair: names that differ in one letter become equal
when that letter is left blank, and a name with a missing letter equals the other name without that
letter. So the work grows with the number of names and not with its square, however many of them are
similar.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np

from evenbreak.files.tables.problems import first_ones, quoted, warning
from evenbreak.ratings.results_frame import without_accents
from evenbreak.words import listed, say

SHORTEST_WORD = 4
"""The least length of the longer word for a typo: Tim isn't Tom mistyped."""

ALIKE = 3
"""How many initial letters two given names share if one may be short for the other."""

BLANK, SWAPPED = "_", "~"
MARKS = {BLANK, SWAPPED}
"""Placeholders for any letter, and for the next two in either order; no word has them."""

MOST_LISTED = 20
"""How many groups of similar names are listed; the others are only counted."""

Words = tuple[str, ...]

# Letters that Unicode does not decompose into a letter and an accent.
_UMLAUT = re.compile("([aou])e")
_WORD = re.compile(r"[^\W_]+")
_LONG = re.compile(rf"\S{{{SHORTEST_WORD},}}")


def similar_names(
    names: Iterable[str], met: Iterable[tuple[str, str]] = ()
) -> list[tuple[str, ...]]:
    """Return groups of different names that may belong to one player.

    First come names that differ in case, spacing, punctuation, accents (ä, a and ae are the same)
    or word order; then names whose given names share the first three letters, or that have an extra
    word, such as a second surname; then names one typo apart, in a word of at least four letters.
    Each kind is sorted by name, and no group is part of another. Groups of the second and third
    kind are left out if all pairs in them have `met`: players don't play themselves. Groups of the
    first kind stay: someone has entered one player twice.
    """
    words = {name: split for name in sorted(set(names)) if (split := _words(name))}
    bare = {name: tuple(map(_without_umlauts, split)) for name, split in words.items()}
    kinds: tuple[Collection[tuple[str, ...]], ...] = (
        {*_alike(bare, _run_together), *_alike(bare, _in_order)},
        {*_alike(bare, _given_name), *_with_one_more_name(bare)},
        set(_a_slip_apart(words)),
    )
    doubted = {name for groups in kinds[1:] for group in groups for name in group}
    apart = {frozenset(pair) for pair in met if doubted.issuperset(pair)} if doubted else set()
    ranked = [
        (kind, group)
        for kind, groups in enumerate(kinds)
        for group in groups
        if kind == 0 or any(frozenset(pair) not in apart for pair in combinations(group, 2))
    ]
    return [group for _, group in sorted(_largest(ranked))]


def similar_name_warnings(
    groups: Sequence[tuple[str, ...]], source: str, remedy: str, *, of: str = "player"
) -> list[str]:
    """Return a warning for each group of names in a file that may belong to one player or team.

    >>> similar_name_warnings([("CY", "Cy")], "r.csv", "If so, keep one of them.")
    ["r.csv: 'CY' and 'Cy' may be the same player. If so, keep one of them."]
    """
    warnings = [
        warning(
            source,
            None,
            "{names} may be the same {kind}. {remedy}",
            names=listed(list(map(quoted, group))),
            kind=of,
            remedy=remedy,
        )
        for group in groups
    ]
    return first_ones(
        warnings, MOST_LISTED, source, lambda n: say("and {n:,} more groups of similar names", n=n)
    )


def _words(name: str) -> Words:
    """Return a name's words, given names first, without accents or capitals."""
    last, _, given = name.partition(",")
    return tuple(_WORD.findall(without_accents(f"{given} {last}")))


def _without_umlauts(word: str) -> str:
    """Return a word with ae, oe and ue as a, o and u, which ä, ö and ü have already become."""
    return _UMLAUT.sub(r"\1", word)


def _run_together(words: Words) -> str:
    return "".join(words)


def _in_order(words: Words) -> str:
    return " ".join(sorted(words))


def _given_name(words: Words) -> Hashable:
    """Return the start of a given name and everything after it; None if there is no given name."""
    given, *rest = words
    if len(given) < ALIKE or not given.isalpha() or not rest or len(rest[-1]) == 1:
        return None
    return given[:ALIKE], *rest


def _with_one_more_name(words: Mapping[str, Words]) -> Iterator[tuple[str, ...]]:
    """Yield pairs of names in which one has an extra word: a second surname, or Big before Al."""
    names = defaultdict(list)
    for name, split in words.items():
        names[split].append(name)
    for split, longer in names.items():
        if len(split) > 2:
            for k in range(len(split)):
                shorter = split[:k] + split[k + 1 :]
                if len(split[k]) > 1 and shorter in names:
                    yield from ((min(a, b), max(a, b)) for a in longer for b in names[shorter])


def _alike(
    words: Mapping[str, Words], key: Callable[[Words], Hashable]
) -> Iterator[tuple[str, ...]]:
    """Yield groups of names with the same key."""
    groups = defaultdict(list)
    for name, split in words.items():
        groups[key(split)].append(name)
    groups.pop(None, None)
    yield from (tuple(group) for group in groups.values() if len(group) > 1)


def _a_slip_apart(words: Mapping[str, Words]) -> Iterator[tuple[str, ...]]:
    """Yield groups of names that are the same except for one typo in a long word."""
    spelt: defaultdict[str, list[str]] = defaultdict(list)
    for name, split in words.items():
        spelt[" ".join(split)].append(name)
    # Hardly any of the many keys is that of two names: a look at their hashes finds those.
    numbers = [np.fromiter(map(hash, (text, *_slips(text))), dtype=np.int64) for text in spelt]
    number, many = np.unique(np.concatenate([np.zeros(0, np.int64), *numbers]), return_counts=True)
    shared = set(number[many > 1].tolist())
    alike: defaultdict[str, set[str]] = defaultdict(set)
    for text, own in zip(spelt, numbers, strict=True):
        if not shared.isdisjoint(own.tolist()):
            for key in (text, *_slips(text)):
                alike[key].add(text)
    for key, texts in alike.items():
        # A text without marks is the others with a letter left out, if it is a name itself.
        if len(texts) > 1 and (key in spelt or not MARKS.isdisjoint(key)):
            yield tuple(sorted(name for text in texts for name in spelt[text]))


def _slips(text: str) -> Iterator[str]:
    """Yield a string with one letter of a long word left out, left blank or swapped with the next.

    Digits are never treated as typos: numbered names keep them.

    >>> list(_slips("jo wu99"))
    ['jo u99', 'jo _u99', 'jo ~uw99', 'jo w99', 'jo w_99']
    """
    for word in _LONG.finditer(text):
        for k in range(*word.span()):
            letter, following = text[k], text[k + 1 : k + 2].strip()
            if letter.isdigit():
                continue
            before, after = text[:k], text[k + 1 :]
            yield before + after
            yield before + BLANK + after
            if following and not following.isdigit():
                yield before + SWAPPED + "".join(sorted(letter + following)) + text[k + 2 :]


def _largest(
    ranked: Iterable[tuple[int, tuple[str, ...]]],
) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Yield the groups that aren't part of another; of equal groups, yield the first."""
    holding: dict[str, set[int]] = defaultdict(set)
    by_size = sorted(ranked, key=lambda entry: (-len(entry[1]), entry))
    for number, (kind, group) in enumerate(by_size):
        if not set.intersection(*(holding[name] for name in group)):
            yield kind, group
        for name in group:
            holding[name].add(number)
