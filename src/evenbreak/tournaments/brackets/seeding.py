"""Seeding: in what order players enter a bracket, and which line each seed is on."""

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
    """Return the seeds, from 1 on, in the order of the bracket's first-round lines.

    Seeds 1 and 2 can meet only in the final, 1 to 4 only in the last four, and so on.

    Parameters
    ----------
    size
        the lines: a power of 2.

    >>> standard_lines(8)
    [1, 8, 4, 5, 2, 7, 3, 6]
    """
    lines = [1]
    while len(lines) < size:
        lines = [x for seed in lines for x in (seed, 2 * len(lines) + 1 - seed)]
    return lines


def bracket_size(players: int) -> int:
    """Return the smallest power of 2 that has a line for each player, at least 2.

    >>> bracket_size(5), bracket_size(8)
    (8, 8)
    """
    return max(2, 1 << (players - 1).bit_length())


def seeded_lines(players: int) -> list[int | None]:
    """Return the player on each line, from 0 on; None is a bye. The top seeds have the byes.

    >>> seeded_lines(3)
    [0, None, 1, 2]
    """
    return [seed - 1 if seed <= players else None for seed in standard_lines(bracket_size(players))]


def by_rating(players: Sequence[Name], ratings: Sequence[float]) -> list[Name]:
    """Return the players, the highest rating first; equal ratings stay in the order given.

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
    """Return the players in an order drawn by lot; all orders are equally likely.

    >>> blind_draw(["Ann", "Bo", "Cy"], np.random.default_rng(2))
    ['Cy', 'Ann', 'Bo']
    """
    return [players[i] for i in rng.permutation(len(players))]


def apart_by_club(players: Sequence[Name], clubs: Sequence[str | None]) -> list[Name]:
    """Return the seeds with players of one club as far apart as their tiers allow.

    Players change places only within their tier: seeds 3-4, 5-8, 9-16 and so on; seeds 1 and
    2 stay. Two players of a club who can meet count four times as much for each round earlier
    that they can. The best swap is made as long as one lowers the sum.

    Parameters
    ----------
    players
        the players in the order of the seeds.
    clubs
        the club of each; None for a player without one.

    Raises
    ------
    InputError
        if there is not one club for each player.

    >>> apart_by_club(["A", "B", "C", "D"], ["East", "West", "West", "East"])
    ['A', 'B', 'D', 'C']
    """
    if len(clubs) != len(players):
        raise InputError(f"clubs has {len(clubs)} values; give one for each of {len(players)}")
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
    """Return by how much the sum grows if seeds i and j change places; 0 where they may not."""
    _, own = np.unique(club, return_inverse=True)
    members = np.equal.outer(np.arange(own.max() + 1), own)
    near = early @ members.T  # of each seed's line to the members of each club
    seats = np.arange(len(club))
    mine = near[seats, own]
    crossed = near[:, own]  # [j, i]: from the line of j to the club of i
    gains: NDArray[np.float64] = crossed + crossed.T - 2.0 * early - mine[:, None] - mine
    return np.where((tier[:, None] == tier) & (own[:, None] != own), gains, 0.0)
