"""Title odds the slow, obvious way: every course of a tournament, one after the other.

Exact with fractions. It knows nothing of joint laws, of orders or of states.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
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
            taken = weight * share
            for ranks, orders in _lots(bracket, match.name, here):
                lots = taken if orders == 1 else taken / orders
                yield from _play(bracket, chance, at + 1, after | ranks, here, lots)


def _came(name, won, lost, slot):
    """What a match sends on: by outcome, and by the slot that the player sat in."""
    return {
        (name, "winner"): {None: won, slot: won, 3 - slot: NOBODY},
        (name, "loser"): {None: lost, 3 - slot: lost, slot: NOBODY},
    }


def _lots(bracket, name, met):
    """Yield the orders of a group once its last match is over, and how many there are."""
    for group in bracket.groups:
        if group.matches[-1] == name:
            results = [(a, b, won) for match, a, b, won in met if match in group.matches]
            orders = list(_orders(list(group.members), results))
            for order in orders:
                ranks = {(group.name, k): {None: who} for k, who in enumerate(order, 1)}
                yield ranks, len(orders)
            return
    yield {}, 1


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
    ends, places = _ends(bracket), {}
    for name, one, other, won in met:
        for outcome, who in (("winner", won), ("loser", other if won == one else one)):
            place = ends.get((name, outcome, 1 if who == one else 2))
            if place is not None:
                places[who] = place
    for group in bracket.groups:
        for rank, place in enumerate(group.places, 1):
            if place is not None and (group.name, rank) in sent:
                places[sent[group.name, rank][None]] = place
    return places


@cache
def _ends(bracket):
    """Return the place of each outcome, by the slot that the player sat in, with no next match."""
    waiting = {slot for match in bracket.matches for slot in match.slots}
    grouped = {name for group in bracket.groups for name in group.matches}
    return {
        (match.name, outcome, sat): place
        for match in bracket.matches
        for outcome, place in (("winner", match.winner_place), ("loser", match.loser_place))
        for sat in (1, 2)
        if match.name not in grouped
        and not {Source(match.name, outcome), Source(match.name, outcome, sat)} & waiting
    }


def place_odds(bracket: Bracket, chance: Chance) -> list[list[Fraction]]:
    """Return P(each player has each place)."""
    return odds(bracket, chance)[0]


def odds(bracket: Bracket, chance: Chance) -> tuple[list[list[Fraction]], Fraction]:
    """Return P(each player has each place), and the mean number of matches."""
    column = {place: k for k, place in enumerate(bracket.places)}
    law = [[Fraction(0)] * len(column) for _ in bracket.players]
    matches = Fraction(0)
    for places, weight, count in _gathered(bracket, chance):
        matches += weight * count
        for player, place in places:
            law[player][column[place]] += weight
    return law, matches


def _gathered(bracket: Bracket, chance: Chance):
    """Yield the outcomes: the places, the chance of all courses to them, how many matches."""
    total: dict[Any, Fraction] = {}
    for weight, places, met in courses(bracket, chance):
        outcome = tuple(places.items()), len(met)
        total[outcome] = total.get(outcome, 0) + weight
    for (places, count), weight in total.items():
        yield places, weight, count


def expected(bracket: Bracket, chance: Chance, value: Callable[[list[Any]], int]) -> Fraction:
    """Return the mean of a value of who met whom."""
    return sum((weight * value(met) for weight, _, met in courses(bracket, chance)), Fraction(0))


def by_strength(strengths: list[int]) -> Chance:
    """Return the chances where strength shares decide."""

    def chance(_: str, one: int, other: int) -> Fraction:
        return Fraction(strengths[one], strengths[one] + strengths[other])

    return chance
