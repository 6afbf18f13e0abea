"""Round robins, alone or in groups before a knockout."""

from __future__ import annotations

import math
from collections.abc import Sequence
from string import ascii_uppercase

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import (
    Bracket,
    Group,
    Match,
    Place,
    RunnersUp,
    Source,
)
from evenbreak.tournaments.brackets.drafts import (
    DraftSlot,
    bracket_of,
    checked_players,
)
from evenbreak.tournaments.brackets.knockout import FINALS, apart_by_club, knockout, seeded_lines
from evenbreak.words import Parameter


def round_robin(players: Sequence[str] | int, *, times: int = 1) -> Bracket:
    """Return a round robin: everyone plays everyone.

    Parameters
    ----------
    players
        names, or their number.
    times
        how many matches each pair plays.

    >>> [match.name for match in round_robin(4).matches]
    ['R1.1', 'R1.2', 'R2.1', 'R2.2', 'R3.1', 'R3.2']
    """
    names = checked_players(players)
    places = tuple(Place(k, k) for k in range(1, len(names) + 1))
    group, matches = _group("R", tuple(range(len(names))), places, times, "R", "round robin")
    return Bracket("round robin", names, tuple(matches), (group,))


def groups_then_knockout(
    players: Sequence[str] | int,
    groups: int,
    *,
    qualifiers: int = 2,
    knockout_size: int | None = None,
    times: int = 1,
    third_place: bool = False,
) -> Bracket:
    """Return round-robin groups whose best players advance to a knockout.

    Seeds are dealt to the groups in a snake: 1 to A, 2 to B, and so on, then back. A group winner
    first meets another group's runner-up, and two qualifiers from one group are in different halves
    of the knockout, except the best runners-up.

    Parameters
    ----------
    players
        the names in seed order, or the number of players.
    qualifiers
        how many qualify from each group.
    knockout_size
        how many qualify in all, instead: as many as possible from each group, plus the best of the
        next rank by the share of matches won.
    times
        how often each pair in a group plays.
    third_place
        whether the losing semifinalists play for third place.

    Raises
    ------
    InputError
        if a group would be too small, or only one player would qualify.

    16 from 5 groups are the top three in each, and the best fourth-placed player:

    >>> groups_then_knockout(20, 5, knockout_size=16).runners_up.places
    (None, Place(first=17, last=20, event=''), Place(first=17, last=20, event=''),
     Place(first=17, last=20, event=''), Place(first=17, last=20, event=''))

    >>> bracket = groups_then_knockout(8, 2)
    >>> bracket.groups[0].members, bracket.match("K1.1").slots
    ((0, 3, 4, 7), (Source(match='A', outcome=1, via=None), Source(match='B', outcome=2, via=None)))
    >>> [str(place) for place in bracket.places]
    ['1', '2', '3-4', '5-6', '7-8']
    """
    names = checked_players(players)
    count = whole(groups, "groups", at_least=1)
    going_on, best = whole(qualifiers, "qualifiers", at_least=1), 0
    if knockout_size is not None:
        size = whole(knockout_size, "knockout_size", at_least=2, at_most=len(names))
        going_on, best = divmod(size, count)
    fewest = max(2, going_on + (best > 0))
    if len(names) // count < fewest:
        raise InputError(
            "{name} is {value!r} for {players} players, but each group needs {fewest}. Make "
            "fewer groups, or let fewer players advance.",
            name=Parameter("groups"),
            value=groups,
            players=len(names),
            fewest=fewest,
        )
    if count * going_on + best < 2:
        raise InputError(
            "{name} must be 2 or more if there's a single group", name=Parameter("qualifiers")
        )
    dealt = [_dealt(len(names), count, k) for k in range(count)]
    sizes = [len(members) for members in dealt]
    places = _group_places(sizes, going_on, best)
    runners_up = _runners_up(sizes, going_on, best, times) if best else None
    made = [
        _group(_letters(k), tuple(members), places[: len(members)], times)
        for k, members in enumerate(dealt)
    ]
    field = _field(count, going_on, best)
    last = final_of_groups(count)
    drafts, ranks = knockout(field, "K", "knock-out", last=last, third_place=third_place)
    later = bracket_of("", names, drafts, ranks).matches
    return Bracket(
        f"{count} groups, then knockout",
        names,
        (*(match for _, matches in made for match in matches), *later),
        tuple(group for group, _ in made),
        runners_up=runners_up,
    )


def final_of_groups(groups: int) -> str:
    """Return the final's name after groups: with six or more groups, one is called F itself.

    >>> final_of_groups(5), final_of_groups(6)
    ('F', 'KF')
    """
    return FINALS[groups >= len("ABCDEF")]


def rounds_of_circle(players: int) -> list[list[tuple[int, int]]]:
    """Return the rounds of a single round robin, by the circle method.

    >>> rounds_of_circle(4)
    [[(0, 3), (1, 2)], [(0, 2), (3, 1)], [(0, 1), (2, 3)]]
    """
    seats: list[int | None] = [*range(players)] + [None] * (players % 2)
    rounds = []
    for _ in range(len(seats) - 1):
        half = len(seats) // 2
        pairs = zip(seats[:half], reversed(seats[half:]), strict=True)
        rounds.append([(a, b) for a, b in pairs if a is not None and b is not None])
        seats = [seats[0], seats[-1], *seats[1:-1]]
    return rounds


def _group(
    name: str,
    members: tuple[int, ...],
    places: tuple[Place | None, ...],
    times: int,
    prefix: str | None = None,
    side: str | None = None,
) -> tuple[Group, list[Match]]:
    prefix = f"{name}:" if prefix is None else prefix
    rounds = rounds_of_circle(len(members)) * whole(times, "times", at_least=1)
    pairs = [(members[one], members[other]) for round_ in rounds for one, other in round_]
    numbers = [(k, i) for k, round_ in enumerate(rounds, 1) for i in range(1, len(round_) + 1)]
    matches = [
        Match(f"{prefix}{number}.{i}", f"group {name}" if side is None else side, number, pair)
        for (number, i), pair in zip(numbers, pairs, strict=True)
    ]
    names = tuple(match.name for match in matches)
    return Group(name, members, names, tuple(pairs), places), matches


def _dealt(players: int, groups: int, number: int) -> list[int]:
    """Return a group's members when seeds are dealt in a snake."""
    turns = range((players + groups - 1) // groups)
    seats = (turn * groups + (number if turn % 2 == 0 else groups - 1 - number) for turn in turns)
    return [seat for seat in seats if seat < players]


def _runners_up(sizes: list[int], going_on: int, best: int, times: int) -> RunnersUp:
    matches = [times * (size - 1) for size in sizes]
    together = math.lcm(*matches)
    weights = tuple((_letters(k), together // played) for k, played in enumerate(matches))
    shared = Place(going_on * len(sizes) + best + 1, (going_on + 1) * len(sizes))
    places = (*[None] * best, *[shared] * (len(sizes) - best))
    return RunnersUp(going_on + 1, weights, places)


def _group_places(sizes: list[int], going_on: int, best: int) -> tuple[Place | None, ...]:
    going_on += best > 0
    places: list[Place | None] = [None] * going_on
    first = going_on * len(sizes) + 1
    for rank in range(going_on + 1, max(sizes) + 1):
        last = first - 1 + sum(rank <= size for size in sizes)
        places.append(Place(first, last))
        first = last + 1
    return tuple(places)


def _field(groups: int, going_on: int, best: int) -> list[DraftSlot]:
    """Return the knockout's lines."""
    first: list[DraftSlot] = [Source(_letters(k), 1) for k in range(groups)]
    if going_on == 2 and not best and groups & (groups - 1) == 0 and groups > 1:
        # Groups in pairs (A, B), (C, D): 1A-2B in the upper half, 1B-2A in the lower.
        order = [*range(0, groups, 2), *range(1, groups, 2)]
        half = groups // 2
        return [
            source
            for i in range(groups)
            for source in (
                first[order[i]],
                Source(_letters(order[(i + half) % groups]), 2),
            )
        ]
    seeds = [(_letters(k), rank) for rank in range(1, going_on + 1) for k in range(groups)]
    seeds += [(str(going_on + 1), k) for k in range(1, best + 1)]
    clubs = [None if letters.isdigit() else letters for letters, _ in seeds]
    seeds = apart_by_club(seeds, clubs)
    return [None if k is None else Source(*seeds[k]) for k in seeded_lines(len(seeds))]


def _letters(number: int) -> str:
    """Return A, B, ..., Z, AA, AB, ..."""
    letters = ""
    while number >= 0:
        letters = ascii_uppercase[number % 26] + letters
        number = number // 26 - 1
    return letters
