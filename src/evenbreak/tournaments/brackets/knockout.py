"""Single elimination, single elimination with a consolation event, and king of the hill."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from evenbreak.checks import column
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Source
from evenbreak.tournaments.brackets.drafts import (
    Draft,
    DraftSlot,
    Rank,
    bracket_of,
    checked_players,
    loser,
    winner,
)


def single_elimination(
    players: Sequence[str] | int,
    *,
    third_place: bool = False,
    lines: Sequence[int | None] | None = None,
) -> Bracket:
    """Return a single-elimination bracket: one loss and you are out.

    Parameters
    ----------
    players
        2 to 256 names in seed order, or the number of players.
    third_place
        whether the losing semifinalists play for third place.
    lines
        the player on each first-round line, by position from 0 on, with None for a bye; the
        number of lines is a power of 2. None: standard seeding, byes to the top seeds.

    Raises
    ------
    InputError
        if the players or the lines cannot be used.

    >>> [str(place) for place in single_elimination(8).places]
    ['1', '2', '3-4', '5-8']
    >>> len(single_elimination(8, third_place=True).matches)
    8
    """
    names = checked_players(players)
    entrants = checked_lines(lines, len(names))
    drafts, ranks = knockout(list(entrants), "W", "winners", third_place=third_place)
    return bracket_of("single elimination", names, drafts, ranks)


def consolation(
    players: Sequence[str] | int, *, lines: Sequence[int | None] | None = None
) -> Bracket:
    """Return a single-elimination bracket with a consolation event.

    Players who lose their first match go to the consolation event, a separate single elimination.
    After a bye, a player's first match is the one in the second round.

    Parameters
    ----------
    players, lines
        as in `single_elimination`; at least 4 players.

    >>> bracket = consolation(8)
    >>> [str(place) for place in bracket.places]
    ['1', '2', '3-4', '5-8', 'consolation 1', 'consolation 2', 'consolation 3-4']
    >>> bracket.match("C1.1").slots[0]
    Source(match='W1.1', outcome='loser', via=None)
    """
    names = checked_players(players, fewest=4)
    entrants = checked_lines(lines, len(names))
    drafts, ranks = knockout(list(entrants), "W", "winners")
    losers: list[DraftSlot] = []
    for draft in drafts:
        if draft.round == 1:
            losers += [loser(draft.name)] if None not in draft.slots else []
        elif draft.round == 2:
            byes = [slot for slot in (1, 2) if _had_bye(drafts, draft, slot)]
            losers += [Source(draft.name, "loser", via=slot) for slot in byes]
    extra, extra_ranks = knockout(_with_byes(losers), "C", "consolation", last="CF")
    return bracket_of("consolation", names, [*drafts, *extra], ranks, consolation=extra_ranks)


def king_of_the_hill(players: Sequence[str] | int) -> Bracket:
    """Return a ladder: the first two play, the winner meets the third, and so on.

    Parameters
    ----------
    players
        the names in the order they come to the table, or the number of players.

    >>> [match.slots for match in king_of_the_hill(["Ann", "Bo", "Cy"]).matches]
    [(0, 1), (Source(match='W1.1', outcome='winner', via=None), 2)]
    """
    names = checked_players(players)
    count = len(names) - 1
    ladder = [f"W{k}.1" for k in range(1, count)] + ["F"]
    drafts = [
        Draft(
            name,
            "final" if name == "F" else "winners",
            k + 1,
            (winner(ladder[k - 1]) if k else 0, k + 1),
        )
        for k, name in enumerate(ladder)
    ]
    ranks = [Rank((winner("F"),)), *(Rank((loser(name),)) for name in reversed(ladder))]
    return bracket_of("king of the hill", names, drafts, ranks)


FINALS = ("F", "KF")
"""A final's possible names: the second is used if a group is called F."""


def knockout(
    entrants: list[DraftSlot],
    letter: str,
    side: str,
    *,
    last: str = "F",
    third_place: bool = False,
) -> tuple[list[Draft], list[Rank]]:
    """Return a knockout's matches, and who leaves it at which point, best first.

    The number of entrants, one per line, is a power of 2; matches are named with the letter:
    W1.1, ...
    """
    drafts: list[Draft] = []
    rounds: list[list[str]] = []
    slots = entrants
    while len(slots) > 1:
        number = len(rounds) + 1
        final = len(slots) == 2
        names = [f"{letter}{number}.{i}" for i in range(1, len(slots) // 2 + 1)]
        names = [last] if final else names
        drafts += [
            Draft(name, "final" if final and last in FINALS else side, number, (one, other))
            for name, one, other in zip(names, slots[::2], slots[1::2], strict=True)
        ]
        rounds.append(names)
        slots = [winner(name) for name in names]
    ranks = [Rank((winner(last),))]
    ranks += [Rank(tuple(loser(name) for name in names)) for names in reversed(rounds)]
    if third_place and len(rounds) > 1:
        one, other = rounds[-2]
        third = last[:-1] + "T"
        drafts.append(Draft(third, "third place", 1, (loser(one), loser(other))))
        ranks[2:3] = [Rank((winner(third),)), Rank((loser(third),))]
    return drafts, ranks


def checked_lines(lines: Sequence[int | None] | None, players: int) -> list[int | None]:
    """Return the given first-round lines if they are valid, or those from standard seeding."""
    if lines is None:
        return seeded_lines(players)
    listed = list(lines)
    seated = [player for player in listed if player is not None]
    if sorted(seated) != list(range(players)):
        raise InputError(
            "{lines} is {value!r}. Give each position from 0 to {players} once.",
            value=lines,
            players=players - 1,
        )
    if len(listed) != bracket_size(len(listed)):
        raise InputError(
            "{lines} must have 2, 4, 8, 16, ... entries; it has {n_listed}", n_listed=len(listed)
        )
    return listed


def _had_bye(drafts: list[Draft], match: Draft, slot: int) -> bool:
    source = match.slots[slot - 1]
    return isinstance(source, Source) and any(
        None in draft.slots for draft in drafts if draft.name == source.match
    )


def _with_byes(entrants: list[DraftSlot]) -> list[DraftSlot]:
    """Return the entrants on a bracket's lines, with byes for the top ones."""
    if len(entrants) == bracket_size(len(entrants)):
        return entrants
    return [None if k is None else entrants[k] for k in seeded_lines(len(entrants))]


# Seeding: the order in which players enter a bracket, and the line of each seed.


Name = TypeVar("Name")


def standard_lines(size: int) -> list[int]:
    """Return the seeds, counting from 1, in the order of the first-round lines (a power of 2).

    Seeds 1 and 2 can only meet in the final, seeds 1 to 4 only in the last four, and so on.

    >>> standard_lines(8)
    [1, 8, 4, 5, 2, 7, 3, 6]
    """
    lines = [1]
    while len(lines) < size:
        lines = [x for seed in lines for x in (seed, 2 * len(lines) + 1 - seed)]
    return lines


def bracket_size(players: int) -> int:
    """Return the number of lines for this many players: a power of 2, at least 2.

    >>> bracket_size(5), bracket_size(8)
    (8, 8)
    """
    return max(2, 1 << (players - 1).bit_length())


def seeded_lines(players: int) -> list[int | None]:
    """Return the player on each line, counting from 0, or None for a bye; top seeds get the byes.

    >>> seeded_lines(3)
    [0, None, 1, 2]
    """
    return [seed - 1 if seed <= players else None for seed in standard_lines(bracket_size(players))]


def by_rating(players: Sequence[Name], ratings: Sequence[float]) -> list[Name]:
    """Return the players, highest rating first; players with equal ratings keep their order.

    Raises
    ------
    InputError
        if there isn't one number per player.

    >>> by_rating(["Ann", "Bo", "Cy"], [500, 640, 500])
    ['Bo', 'Ann', 'Cy']
    """
    rated = column(ratings, "ratings", len(players), "players")
    if np.isnan(rated).any():
        raise InputError("ratings must be finite numbers; one of them isn't")
    return [players[i] for i in np.argsort(-rated, kind="stable")]


def blind_draw(players: Sequence[Name], rng: np.random.Generator) -> list[Name]:
    """Return the players in random order; all orders are equally likely.

    >>> blind_draw(["Ann", "Bo", "Cy"], np.random.default_rng(2))
    ['Cy', 'Ann', 'Bo']
    """
    return [players[i] for i in rng.permutation(len(players))]


def apart_by_club(players: Sequence[Name], clubs: Sequence[str | None]) -> list[Name]:
    """Return the seeds with clubmates kept as far apart as their tiers allow.

    Players move only within their tier: seeds 3-4, 5-8, 9-16 and so on; seeds 1 and 2 stay. The
    search minimizes a penalty for each pair of clubmates, four times as high for each round earlier
    that they can meet, by making the best swap as long as one helps.

    Parameters
    ----------
    players
        the players in seed order.
    clubs
        each player's club; None for a player without a club.

    Raises
    ------
    InputError
        if there isn't one club per player.

    >>> apart_by_club(["A", "B", "C", "D"], ["East", "West", "West", "East"])
    ['A', 'B', 'D', 'C']
    """
    if len(clubs) != len(players):
        raise InputError(
            "{clubs} must have one value for each of {n_players} players; it has {n_clubs}",
            n_clubs=len(clubs),
            n_players=len(players),
        )
    size = bracket_size(len(players))
    line = {seed: k for k, seed in enumerate(standard_lines(size), 1)}
    early = np.zeros((size, size))
    for one, other in combinations(range(size), 2):
        rounds = ((line[one + 1] - 1) ^ (line[other + 1] - 1)).bit_length()
        early[one, other] = early[other, one] = 4.0**-rounds
    numbers = {club: k for k, club in enumerate(dict.fromkeys(clubs))}
    club = np.array([len(clubs) + k if c is None else numbers[c] for k, c in enumerate(clubs)])
    tier = np.array([seed.bit_length() for seed in range(len(players))])
    order = np.arange(len(players))
    while True:
        gains = _gains(early[: len(players), : len(players)], club[order], tier)
        i, j = divmod(int(gains.argmin()), len(players))
        if gains[i, j] > -1e-12:
            return [players[k] for k in order.tolist()]
        order[[i, j]] = order[[j, i]]


def _gains(
    early: NDArray[np.float64], club: NDArray[np.int64], tier: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return how the penalty changes if seeds i and j swap; 0 if they may not."""
    _, own = np.unique(club, return_inverse=True)
    members = np.equal.outer(np.arange(own.max() + 1), own)
    near = early @ members.T  # of each seed's line to the members of each club
    seats = np.arange(len(club))
    mine = near[seats, own]
    crossed = near[:, own]  # [j, i]: from the line of j to the club of i
    gains: NDArray[np.float64] = crossed + crossed.T - 2.0 * early - mine[:, None] - mine
    return np.where((tier[:, None] == tier) & (own[:, None] != own), gains, 0.0)
