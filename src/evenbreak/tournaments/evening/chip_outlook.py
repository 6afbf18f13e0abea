"""A chip night's outlook: who finishes where, and when it ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.chips.endgame import last_players
from evenbreak.tournaments.chips.play import ChipOdds, play_chips, tables_in_use
from evenbreak.tournaments.clock.evenings import lognormal
from evenbreak.tournaments.evening.chip_night import ChipNight
from evenbreak.tournaments.odds.title import PlaceOdds
from evenbreak.tournaments.odds.uncertain import drawn_ratings

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening

_RUNS = 10_000
_EXACT = 4  # players at most whose odds are exact
_CELLS, _FEWEST, _MOST = 4e6, 200, 2_000  # draws of the skills


def drawn_skills(skills: Floats, covariance: Floats) -> Floats:
    """Return many draws of the players' skills, one per row."""
    count = int(np.clip(_CELLS / len(skills) ** 2, _FEWEST, _MOST))
    return drawn_ratings(skills, covariance, count // 2, np.random.default_rng(0))


def drawn_racks(state: Evening, drawn: Floats) -> Floats:
    """Return P(i beats j in a rack) for each draw of the players' skills, the third axis."""
    each = drawn.T
    return np.asarray(state.scale.win_probability(each[:, None] - each))


def chip_odds(state: Evening, win: Floats) -> PlaceOdds:
    """Return who finishes where: exactly for the last players at one table, else by simulation.

    `win` is P(i beats j in a rack), with an optional third axis for samples of the ratings.
    """
    night = state.chip_night
    count, left = len(night.chips), len(night.order)
    law, error, runs = np.zeros((count, count)), np.zeros((count, count)), 0
    by_draw = None
    seat = {name: k for k, name in enumerate(state.order)}
    for place, name in enumerate(reversed(night.gone), left):
        law[seat[name], place] = 1.0
    still = [seat[name] for name in night.order]
    if left == 1:
        law[still[0], 0] = 1.0
    elif left > 1:
        found = _exactly(night, win[np.ix_(still, still)])
        if found is None:
            played = _played(state, win)
            found, runs = played.p_place, played.runs
            error[np.ix_(still, range(left))] = played.error
            by_draw = np.zeros((count, played.by_sample.shape[1]))
            by_draw[still] = played.by_sample
        law[np.ix_(still, range(left))] = found
    return PlaceOdds(state.bracket, law, error, runs, by_draw=by_draw)


def _exactly(night: ChipNight, win: Floats) -> Floats | None:
    if win.ndim > 2 or len(night.order) > _EXACT or len(night.tables) != 1:
        return None
    try:
        return last_players([night.chips[name] for name in night.order], win).p_place
    except InputError:  # too many chips
        return None


def _played(
    state: Evening, win: Floats, tables: int | None = None, *, to_the_end: bool = False
) -> ChipOdds:
    night = state.chip_night
    still = [state.order.index(name) for name in night.order]
    most = state.plan.tables if tables is None else tables
    return play_chips(
        [night.chips[name] for name in night.order],
        win[np.ix_(still, still)],
        tables=most,
        line=range(len(still)),
        in_use=max(len(night.tables), tables_in_use(len(still), most)),
        to_the_end=to_the_end,
        runs=_RUNS,
    )


def chip_minutes(
    state: Evening,
    win: Floats,
    pace: Pace,
    *,
    tables: int | None = None,
    turnover: Turnover | None = None,
) -> Floats:
    """Return the evening's remaining minutes, in each of many simulated evenings.

    `win` is as in `chip_odds`; a rack is a one-game match. Without a turnover, the time between two
    racks is what a one-game match includes anyway.
    """
    lengths = _played(state, win, tables, to_the_end=True).lengths
    rng = np.random.default_rng(0)
    rack = pace.mean_minutes(1) + (0.0 if turnover is None else turnover.mean)
    luck = lengths + pace.match_sd * np.sqrt(lengths) * rng.standard_normal(len(lengths))
    evening = lognormal(rng.standard_normal(len(lengths)), pace.evening_sd)
    return np.asarray(rack * np.maximum(luck, 0.0) * evening)
