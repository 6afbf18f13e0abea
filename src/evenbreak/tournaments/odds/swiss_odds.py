"""Who finishes where in a Swiss: by simulation, since each round is paired by the one before."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import floats, whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.swiss import (
    Pairing,
    Swiss,
    check_rounds,
    swiss_bracket,
    swiss_round,
    swiss_standings,
)
from evenbreak.tournaments.odds.title import PlaceOdds


def swiss_odds(
    event: Swiss,
    win: ArrayLike,
    *,
    played: Sequence[Sequence[Pairing]] = (),
    without: Collection[str] = (),
    runs: int = 1000,
    rng: np.random.Generator | None = None,
) -> PlaceOdds:
    """Return who finishes where in a Swiss.

    Rounds to come are paired by the 'casual' system, whatever the event's own is: it is a
    hundred times as fast.

    Parameters
    ----------
    event
        the tournament.
    win
        P(i beats j), a table in the order of the players; a third axis, if there is one, is
        for samples of the ratings, which take turns.
    played
        the rounds so far. In the last one, matches without a winner are still to be played.
    without
        as in `swiss_round`.
    runs
        how many tournaments are played out.
    rng
        where pseudo-random numbers come from; None: a generator with the seed 0.

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have, or the extra is not installed.
    """
    table = floats(win, "win", low=0.0, high=1.0)
    count = len(event.players)
    if table.shape[:2] != (count, count) or table.ndim > 3:
        raise InputError(
            "win has shape {table_shape}; give a row and a column for each player",
            table_shape=table.shape,
        )
    tables = np.moveaxis(table.reshape(count, count, -1), 2, 0)
    complete, begun = _begun(played)
    check_rounds(event, complete)
    many = whole(runs, "runs", at_least=1)
    rng = rng or np.random.default_rng(0)
    quick = replace(event, system="casual")
    seat = {player: k for k, player in enumerate(event.players)}
    law = np.zeros((count, count))
    for run in range(many):
        chances = tables[run % len(tables)]
        rounds = [list(pairings) for pairings in complete]
        while len(rounds) < event.rounds:
            at_begun = begun and len(rounds) == len(complete)
            pairings = begun if at_begun else swiss_round(quick, rounds, without=without)
            luck = rng.random(len(pairings)).tolist()
            rounds.append([_won(p, chances, seat, u) for p, u in zip(pairings, luck, strict=True)])
        rows = swiss_standings(event, rounds)
        lots = rng.random(count)
        order = sorted(rows, key=lambda row: (-row.score, -row.buchholz, lots[seat[row.player]]))
        for place, row in enumerate(order):
            law[seat[row.player], place] += 1.0 / many
    return PlaceOdds(
        swiss_bracket(event), law, np.sqrt(np.maximum(law * (1.0 - law), 0.0) / many), many
    )


def _begun(
    played: Sequence[Sequence[Pairing]],
) -> tuple[Sequence[Sequence[Pairing]], list[Pairing]]:
    """Return the rounds that are over, and the one that is not."""
    if played and any(p.second is not None and p.winner is None for p in played[-1]):
        return played[:-1], list(played[-1])
    return played, []


def _won(pairing: Pairing, table: Floats, seat: dict[str, int], luck: float) -> Pairing:
    if pairing.second is None or pairing.winner is not None:
        return pairing
    first_wins = luck < table[seat[pairing.first], seat[pairing.second]]
    return pairing._replace(winner=pairing.first if first_wins else pairing.second)
