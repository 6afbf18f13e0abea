"""Double elimination: in full, down to a number of qualifiers, or in pods.

The losers' side plays two rounds for each round of the winners' side: first its survivors play each
other, then they meet the players who drop from the winners' side. The order of the drops determines
how many rematches there are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, TypeAlias, get_args

import numpy as np

from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Slot, Source
from evenbreak.tournaments.brackets.drafts import (
    Draft,
    DraftSlot,
    Rank,
    bracket_of,
    checked_players,
    loser,
    winner,
)
from evenbreak.tournaments.brackets.knockout import checked_lines, knockout
from evenbreak.words import Parameter

# Where the losers of the winners' side drop to.
#
# A player who drops straight down soon meets somebody they have already played. A good order
# sends each round's losers to another part of the losers' side. All orders here are flips: the
# loser of match i, counted from 0, drops to match i XOR mask. Mask 0 is straight, 1 swaps
# neighbors, half the number of matches shifts by half, all ones reverses the round. The
# measure of an order is the expected number of rematches among equal players
# (`expected_rematches`).


Drops: TypeAlias = Literal["fewest rematches", "usual", "straight"]
DROPS: tuple[Drops, ...] = get_args(Drops)
"""The drop patterns, by name."""

# The masks of each round of drops, by number of lines; later rounds are straight.
_MASKS: dict[Drops, dict[int, tuple[int, ...]]] = {
    # The best of all flips up to 64 lines, the best that a search found beyond.
    "fewest rematches": {
        8: (1,),
        16: (3, 0),
        32: (3, 3, 0),
        64: (15, 4, 1, 1),
        128: (31, 3, 2, 2, 0),
        256: (63, 24, 3, 2, 2, 0),
    },
    # What most bracket programs do by default.
    "usual": {
        8: (1,),
        16: (1, 1),
        32: (7, 2, 0),
        64: (15, 4, 3, 0),
        128: (31, 8, 1, 1, 1),
        256: (63, 16, 1, 1, 1, 1),
    },
    "straight": {},
}


def drop_orders(
    size: int, drops: Drops | Sequence[Sequence[int]], *, pod: int | None = None
) -> list[list[int]]:
    """Return, for each round of drops, whose loser drops into each match, counting from 1.

    'straight': the loser of match i drops into match i; 'usual': what most programs do; 'fewest
    rematches': the flips with the fewest expected rematches among equal players; or the orders
    themselves, starting with the first round of drops. Drops stay within pods of `pod` lines, if
    there are pods. Raises InputError if an order doesn't name each match once.

    >>> drop_orders(16, "fewest rematches")
    [[4, 3, 2, 1], [1, 2], [1]]
    >>> drop_orders(16, "usual")
    [[2, 1, 4, 3], [2, 1], [1]]
    """
    counts = [size // 2**r for r in range(2, size.bit_length())]
    if isinstance(drops, str):
        if drops not in DROPS:
            listed = ", ".join(repr(name) for name in DROPS)
            raise InputError(
                "{drops} must be {listed}, or the orders themselves; you gave {value!r}",
                value=drops,
                listed=listed,
            )
        masks = [*_MASKS[drops].get(pod or size, ()), *[0] * len(counts)]
        return [
            [(i ^ mask) + 1 for i in range(count)]
            for mask, count in zip(masks, counts, strict=False)
        ]
    given = [list(order) for order in drops]
    if len(given) > len(counts):
        raise InputError(
            "{drops} must have at most {n_counts} orders; it has {n_given}",
            n_given=len(given),
            n_counts=len(counts),
        )
    for number, (order, count) in enumerate(zip(given, counts, strict=False), 1):
        if sorted(order) != list(range(1, count + 1)):
            raise InputError(
                "{drops} has {order} for its round {number}. Give each number from 1 to {count} "
                "once.",
                order=order,
                number=number,
                count=count,
            )
    return given + [list(range(1, count + 1)) for count in counts[len(given) :]]


Final = Literal["true", "single"]
Placement = Literal["half shift", "redraw"]


def double_elimination(
    players: Sequence[str] | int,
    *,
    final: Final = "true",
    qualifiers: int | None = None,
    drops: Drops | Sequence[Sequence[int]] = DROPS[0],
    placement: Placement = "half shift",
    rng: np.random.Generator | None = None,
    lines: Sequence[int | None] | None = None,
) -> Bracket:
    """Return a double-elimination bracket: two losses and you are out.

    Parameters
    ----------
    players
        2 to 256 names in seed order, or the number of players.
    final
        'true': the winner of the losers' side must beat the winner of the winners' side twice;
        'single': once.
    qualifiers
        play double elimination until this many are left, half on each side, then single
        elimination; a power of 2. None: double elimination to the end.
    drops
        where losers drop to: 'fewest rematches', 'usual' or 'straight' (see `drop_orders`), or one
        list for each round of drops: for each match on the losers' side, the match on the winners'
        side, counting from 1, whose loser drops into it.
    placement
        how qualifiers from the losers' side are paired with those from the winners' side:
        'half shift' crosses the halves of the bracket, 'redraw' pairs them at random.
    rng
        the random number generator for a redraw.
    lines
        as in `single_elimination`.

    Raises
    ------
    InputError
        if a parameter is invalid.

    >>> bracket = double_elimination(8)
    >>> bracket.match("L2.1").slots[0], bracket.match("F").slots[1].match
    (Source(match='W2.2', outcome='loser', via=None), 'L4.1')
    >>> [str(place) for place in bracket.places]
    ['1', '2', '3', '4', '5-6', '7-8']
    >>> len(double_elimination(32, qualifiers=8).matches)
    59
    """
    names = checked_players(players)
    entrants = checked_lines(lines, len(names))
    one_of(final, "final", ("true", "single"))
    one_of(placement, "placement", ("half shift", "redraw"))
    if qualifiers is None:
        drafts, ranks = to_the_end(list(entrants), drops, true_final=final == "true")
        return bracket_of(f"double elimination, {final} final", names, drafts, ranks)
    last = _checked_qualifiers(qualifiers, len(entrants))
    drafts, winning, losing, ranks = double_down(list(entrants), last, drops)
    shift = _half_shift(losing) if placement == "half shift" else _redrawn(losing, rng)
    field = [slot for pair in zip(winning, shift, strict=True) for slot in pair]
    knocked, top = knockout(list(field), "K", "knock-out")
    form = f"double elimination to {last}, then single"
    return bracket_of(form, names, [*drafts, *knocked], [*top, *ranks])


def pods(
    players: Sequence[str] | int,
    *,
    size: int = 8,
    qualifiers: Literal[1, 2] = 1,
    drops: Drops = DROPS[0],
    lines: Sequence[int | None] | None = None,
) -> Bracket:
    """Return modified single elimination: double elimination in pods, then single elimination.

    Parameters
    ----------
    players, lines
        as in `single_elimination`; each pod takes the next `size` lines.
    size
        the lines in a pod: 4, 8 or 16.
    qualifiers
        how many qualify from each pod. 1: the winners of its two sides play one deciding
        match (P1, P2, ...). 2: both qualify, into different halves of the knockout.
    drops
        as in `double_elimination`, within each pod.

    >>> bracket = pods(32)
    >>> bracket.match("F").slots, len(bracket.matches)
    ((Source(match='K1.1', outcome='winner', via=None),
      Source(match='K1.2', outcome='winner', via=None)), 59)
    """
    names = checked_players(players)
    size = one_of(size, "size", (4, 8, 16))
    one_of(qualifiers, "qualifiers", (1, 2))
    entrants = checked_lines(lines, len(names))
    if len(entrants) < 2 * size:
        raise InputError(
            "{players} players are too few for pods of {size}; use smaller pods, or more than "
            "{size} players",
            players=len(names),
            size=size,
        )
    orders = drop_orders(len(entrants), drops, pod=size)
    last = 2 * len(entrants) // size
    drafts, winning, losing, ranks = double_down(list(entrants), last, orders)
    field: list[DraftSlot]
    if qualifiers == 2:
        shift = _half_shift(losing)
        field = [slot for pair in zip(winning, shift, strict=True) for slot in pair]
    else:
        finals = [
            Draft(f"P{i}", "pod final", 1, (one, other))
            for i, (one, other) in enumerate(zip(winning, losing, strict=True), 1)
        ]
        drafts += finals
        field = [winner(draft.name) for draft in finals]
        ranks = [Rank(tuple(loser(draft.name) for draft in finals)), *ranks]
    knocked, top = knockout(field, "K", "knock-out")
    return bracket_of(f"pods of {size}", names, [*drafts, *knocked], [*top, *ranks])


def double_down(
    entrants: list[DraftSlot], last: int, drops: Drops | Sequence[Sequence[int]]
) -> tuple[list[Draft], list[DraftSlot], list[DraftSlot], list[Rank]]:
    """Return both sides played down to `last` players: matches, each side's survivors, and places.

    >>> drafts, winning, losing, ranks = double_down([0, 3, 1, 2], 2, "straight")
    >>> [draft.name for draft in drafts], winning[0].match, losing[0].match
    (['W1.1', 'W1.2', 'L1.1', 'W2.1', 'L2.1'], 'W2.1', 'L2.1')
    """
    drafts: list[Draft] = []
    ranks: list[Rank] = []

    def play(letter: str, number: int, slots: list[DraftSlot]) -> list[str]:
        names = [f"{letter}{number}.{i}" for i in range(1, len(slots) // 2 + 1)]
        side = "winners" if letter == "W" else "losers"
        pairs = zip(names, slots[::2], slots[1::2], strict=True)
        drafts.extend(Draft(name, side, number, (one, other)) for name, one, other in pairs)
        if letter == "L":
            ranks.insert(0, Rank(tuple(loser(name) for name in names)))
        return names

    won = play("W", 1, entrants)
    winning: list[DraftSlot] = [winner(name) for name in won]
    losing: list[DraftSlot] = [loser(name) for name in won]
    orders = drop_orders(len(entrants), drops)
    while len(winning) > last // 2:
        number = won[0][1:].split(".")[0]
        losing = [winner(name) for name in play("L", 2 * int(number) - 1, losing)]
        won = play("W", int(number) + 1, winning)
        winning = [winner(name) for name in won]
        falls = [loser(won[k - 1]) for k in orders[int(number) - 1]]
        met = [slot for pair in zip(falls, losing, strict=True) for slot in pair]
        losing = [winner(name) for name in play("L", 2 * int(number), list(met))]
    return drafts, winning, losing, ranks


def losers_qualifiers(bracket: Bracket) -> tuple[Slot, ...]:
    """Return where a double elimination's losers'-side qualifiers come from.

    They are in the order of the knockout matches that they go into.

    Raises
    ------
    InputError
        if there are no such qualifiers, or only one.

    >>> [slot.match for slot in losers_qualifiers(double_elimination(8, qualifiers=4))]
    ['L2.2', 'L2.1']
    """
    found = tuple(match.slots[1] for match in bracket.matches if match.name.startswith("K1."))
    if not found or not bracket.format.startswith("double elimination"):
        raise InputError(
            "bracket has no qualifiers to redraw. Give double_elimination 4 or more qualifiers."
        )
    return found


def redrawn(bracket: Bracket, qualifiers: Sequence[Slot]) -> Bracket:
    """Return a double elimination with its losers'-side qualifiers in another order.

    >>> straight = redrawn(double_elimination(8, qualifiers=4), [Source("L2.1", "winner"),
    ...                                                         Source("L2.2", "winner")])
    >>> straight.match("K1.1").slots[1].match
    'L2.1'
    """
    order = iter(qualifiers)
    matches = tuple(
        replace(match, slots=(match.slots[0], next(order)))
        if match.name.startswith("K1.")
        else match
        for match in bracket.matches
    )
    return replace(bracket, matches=matches)


def to_the_end(
    entrants: list[DraftSlot], drops: Drops | Sequence[Sequence[int]], *, true_final: bool
) -> tuple[list[Draft], list[Rank]]:
    """Return a double elimination's matches, including byes, and the places.

    >>> [draft.name for draft in to_the_end([0, 3, 1, 2], "straight", true_final=True)[0]]
    ['W1.1', 'W1.2', 'L1.1', 'W2.1', 'L2.1', 'F', 'F2']
    """
    drafts, (best,), (other,), ranks = double_down(entrants, 2, drops)
    drafts.append(Draft("F", "final", 1, (best, other)))
    finals = ["F"]
    if true_final:
        again = (Source("F", "loser", via=1), Source("F", "winner", via=2))
        drafts.append(Draft("F2", "second final", 2, again))
        finals.append("F2")
    first, second = (tuple(map(outcome, finals)) for outcome in (winner, loser))
    return drafts, [Rank(first, 1), Rank(second, 1), *ranks]


def _checked_qualifiers(qualifiers: int, size: int) -> int:
    last = whole(qualifiers, "qualifiers", at_least=2)
    if last & (last - 1) or last > size:
        raise InputError(
            "{name} must be a power of 2, at most {most} for this bracket; it is {value!r}",
            name=Parameter("qualifiers"),
            most=size,
            value=qualifiers,
        )
    return last


def _half_shift(slots: list[DraftSlot]) -> list[DraftSlot]:
    half = len(slots) // 2
    return slots[half:] + slots[:half]


def _redrawn(slots: list[DraftSlot], rng: np.random.Generator | None) -> list[DraftSlot]:
    if rng is None:
        raise InputError("rng is missing. Give numpy.random.default_rng(seed) for a redraw.")
    return [slots[i] for i in rng.permutation(len(slots))]
