"""Title odds the slow, obvious way: every course of a tournament, one after the other.

Exact with fractions. It knows nothing of joint laws, of orders or of states.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import permutations
from typing import Any

from evenbreak.tournaments import Bracket, Source

NOBODY = None
Chance = Callable[[str, int, int], Fraction]


def courses(
    bracket: Bracket, chance: Chance
) -> Iterator[tuple[Fraction, dict[int, Any], list[tuple[str, int, int, int]]]]:
    """Yield each course: its chance, each player's place, and who met whom and won."""
    yield from _play(bracket, chance, 0, {}, [], Fraction(1))


def _play(bracket, chance, at, sent, met, weight):
    if at == len(bracket.matches):
        yield weight, _places(bracket, sent, met), met
        return
    match = bracket.matches[at]
    one, other = (
        slot if isinstance(slot, int) else sent[slot[:2]][slot.via] for slot in match.slots
    )
    if one is NOBODY or other is NOBODY:
        there = other if one is NOBODY else one
        came = _came(match.name, there, NOBODY, 1 if other is NOBODY else 2)
        yield from _play(bracket, chance, at + 1, {**sent, **came}, met, weight)
        return
    p = chance(match.name, one, other)
    for won, lost, slot, share in ((one, other, 1, p), (other, one, 2, 1 - p)):
        if share:
            after = {**sent, **_came(match.name, won, lost, slot)}
            here = [*met, (match.name, one, other, won)]
            for ranks, lots in _lots(bracket, match.name, here):
                yield from _play(
                    bracket, chance, at + 1, {**after, **ranks}, here, weight * share * lots
                )


def _came(name, won, lost, slot):
    """What a match sends on: by outcome, and by the slot that the player sat in."""
    return {
        (name, "winner"): {None: won, slot: won, 3 - slot: NOBODY},
        (name, "loser"): {None: lost, 3 - slot: lost, slot: NOBODY},
    }


def _lots(bracket, name, met):
    """Yield the orders of a group once its last match is over, with the chance of the lots."""
    for group in bracket.groups:
        if group.matches[-1] == name:
            results = [(a, b, won) for match, a, b, won in met if match in group.matches]
            orders = list(_orders(list(group.members), results))
            for order in orders:
                ranks = {(group.name, k): {None: who} for k, who in enumerate(order, 1)}
                yield ranks, Fraction(1, len(orders))
            return
    yield {}, Fraction(1)


def _orders(level, results):
    """Yield all orders that wins, and then wins among those who are level, leave open."""
    among = [row for row in results if row[0] in level and row[1] in level]
    wins = Counter(won for *_, won in among)
    scores = sorted({wins[who] for who in level}, reverse=True)
    if len(scores) == 1:
        yield from permutations(level)
        return
    yield from _joined([[who for who in level if wins[who] == s] for s in scores], results)


def _joined(blocks, results):
    if not blocks:
        yield ()
        return
    for first in _orders(blocks[0], results):
        for rest in _joined(blocks[1:], results):
            yield (*first, *rest)


def _places(bracket, sent, met):
    played = {name: (one, other, won) for name, one, other, won in met}
    waiting = {slot for match in bracket.matches for slot in match.slots}
    grouped = {name for group in bracket.groups for name in group.matches}
    places = {}
    for match in bracket.matches:
        if match.name not in played or match.name in grouped:
            continue
        one, other, won = played[match.name]
        lost = other if won == one else one
        for outcome, who, place in (
            ("winner", won, match.winner_place),
            ("loser", lost, match.loser_place),
        ):
            sat = 1 if who == one else 2
            if not {Source(match.name, outcome), Source(match.name, outcome, sat)} & waiting:
                places[who] = place
    for group in bracket.groups:
        for rank, place in enumerate(group.places, 1):
            if place is not None and (group.name, rank) in sent:
                places[sent[group.name, rank][None]] = place
    return places


def place_odds(bracket: Bracket, chance: Chance) -> list[list[Fraction]]:
    """Return P(each player has each place)."""
    law = [[Fraction(0)] * len(bracket.places) for _ in bracket.players]
    for weight, places, _ in courses(bracket, chance):
        for player, place in places.items():
            law[player][bracket.places.index(place)] += weight
    return law


def expected(bracket: Bracket, chance: Chance, value: Callable[[list[Any]], int]) -> Fraction:
    """Return the mean of a value of who met whom."""
    return sum((weight * value(met) for weight, _, met in courses(bracket, chance)), Fraction(0))


def rematches(met: list[tuple[str, int, int, int]]) -> int:
    """Return how many matches were between two who had met before."""
    pairs = [frozenset((one, other)) for _, one, other, _ in met]
    return len(pairs) - len(set(pairs))


def by_strength(strengths: list[int]) -> Chance:
    """Return the chances where strength shares decide."""

    def chance(_: str, one: int, other: int) -> Fraction:
        return Fraction(strengths[one], strengths[one] + strengths[other])

    return chance
