"""Seeding: the order in which players enter a bracket, and the line of each seed."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from evenbreak.checks import column
from evenbreak.errors import InputError

Name = TypeVar("Name")


def standard_lines(size: int) -> list[int]:
    """Return the seeds, from 1 on, in the order of the first-round lines.

    Seeds 1 and 2 can meet only in the final, seeds 1 to 4 only in the last four, and so on.

    Parameters
    ----------
    size
        the number of lines, a power of 2.

    >>> standard_lines(8)
    [1, 8, 4, 5, 2, 7, 3, 6]
    """
    lines = [1]
    while len(lines) < size:
        lines = [x for seed in lines for x in (seed, 2 * len(lines) + 1 - seed)]
    return lines


def bracket_size(players: int) -> int:
    """Return the number of lines for so many players: a power of 2, at least 2.

    >>> bracket_size(5), bracket_size(8)
    (8, 8)
    """
    return max(2, 1 << (players - 1).bit_length())


def seeded_lines(players: int) -> list[int | None]:
    """Return the player on each line, from 0 on, or None for a bye; top seeds get the byes.

    >>> seeded_lines(3)
    [0, None, 1, 2]
    """
    return [seed - 1 if seed <= players else None for seed in standard_lines(bracket_size(players))]


def by_rating(players: Sequence[Name], ratings: Sequence[float]) -> list[Name]:
    """Return the players, highest rating first; equal ratings stay in the order given.

    Raises
    ------
    InputError
        if there is not one number for each player.

    >>> by_rating(["Ann", "Bo", "Cy"], [500, 640, 500])
    ['Bo', 'Ann', 'Cy']
    """
    rated = column(ratings, "ratings", len(players), "players")
    if np.isnan(rated).any():
        raise InputError("ratings holds a value that is not a number; give one for each player")
    return [players[i] for i in np.argsort(-rated, kind="stable")]


def blind_draw(players: Sequence[Name], rng: np.random.Generator) -> list[Name]:
    """Return the players in random order; all orders are equally likely.

    >>> blind_draw(["Ann", "Bo", "Cy"], np.random.default_rng(2))
    ['Cy', 'Ann', 'Bo']
    """
    return [players[i] for i in rng.permutation(len(players))]


def apart_by_club(players: Sequence[Name], clubs: Sequence[str | None]) -> list[Name]:
    """Return the seeds with clubmates kept as far apart as their tiers allow.

    Players move only within their tier: seeds 3-4, 5-8, 9-16 and so on; seeds 1 and 2 stay.
    The search minimises a penalty for each pair of clubmates, four times as high for each
    round earlier that they can meet, by the best swap as long as a swap helps.

    Parameters
    ----------
    players
        the players in seed order.
    clubs
        each player's club; None for a player without one.

    Raises
    ------
    InputError
        if there is not one club for each player.

    >>> apart_by_club(["A", "B", "C", "D"], ["East", "West", "West", "East"])
    ['A', 'B', 'D', 'C']
    """
    if len(clubs) != len(players):
        raise InputError(
            "clubs has {n_clubs} values; give one for each of {n_players}",
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
    """Return the change of the penalty if seeds i and j swap; 0 where they may not."""
    _, own = np.unique(club, return_inverse=True)
    members = np.equal.outer(np.arange(own.max() + 1), own)
    near = early @ members.T  # of each seed's line to the members of each club
    seats = np.arange(len(club))
    mine = near[seats, own]
    crossed = near[:, own]  # [j, i]: from the line of j to the club of i
    gains: NDArray[np.float64] = crossed + crossed.T - 2.0 * early - mine[:, None] - mine
    return np.where((tier[:, None] == tier) & (own[:, None] != own), gains, 0.0)
