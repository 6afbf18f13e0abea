"""Who finishes where in a Swiss: by simulation, since each round is paired by the one before."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import floats, whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.swiss import (
    Pairing,
    Swiss,
    check_rounds,
    swiss_round,
    swiss_standings,
)


@dataclass(frozen=True, eq=False)
class SwissOdds:
    """Who finishes where, by simulation.

    Parameters
    ----------
    players
        the names.
    p_place
        p_place[i, k] = P(player i finishes in place k + 1); lots decide between players with
        the same score and the same opponents' scores.
    error
        the standard errors of `p_place`.
    runs
        how many tournaments were played.
    """

    players: tuple[str, ...]
    p_place: Floats
    error: Floats
    runs: int

    @property
    def title(self) -> Floats:
        """P(each player wins the tournament)."""
        return self.p_place[:, 0]


def swiss_odds(
    event: Swiss,
    win: ArrayLike,
    *,
    played: Sequence[Sequence[Pairing]] = (),
    runs: int = 1000,
    rng: np.random.Generator | None = None,
) -> SwissOdds:
    """Return who finishes where in a Swiss.

    Rounds to come are paired by the 'casual' system, whatever the event's own is: it is a
    hundred times as fast.

    Parameters
    ----------
    event
        the tournament.
    win
        P(i beats j), a table in the order of the players.
    played
        the rounds so far.
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
    if table.shape != (count, count):
        raise InputError(f"win has shape {table.shape}; give a row and a column for each player")
    check_rounds(event, played)
    many = whole(runs, "runs", at_least=1)
    rng = rng or np.random.default_rng(0)
    quick = replace(event, system="casual")
    seat = {player: k for k, player in enumerate(event.players)}
    law = np.zeros((count, count))
    for _ in range(many):
        rounds = [list(pairings) for pairings in played]
        while len(rounds) < event.rounds:
            pairings = swiss_round(quick, rounds)
            luck = rng.random(len(pairings)).tolist()
            rounds.append([_won(p, table, seat, u) for p, u in zip(pairings, luck, strict=True)])
        rows = swiss_standings(event, rounds)
        lots = rng.random(count)
        order = sorted(rows, key=lambda row: (-row.score, -row.buchholz, lots[seat[row.player]]))
        for place, row in enumerate(order):
            law[seat[row.player], place] += 1.0 / many
    return SwissOdds(event.players, law, np.sqrt(law * (1.0 - law) / many), many)


def _won(pairing: Pairing, table: Floats, seat: dict[str, int], luck: float) -> Pairing:
    if pairing.second is None:
        return pairing
    first_wins = luck < table[seat[pairing.first], seat[pairing.second]]
    return pairing._replace(winner=pairing.first if first_wins else pairing.second)
