"""Odds of a blind draw: everybody is as likely to be drawn to each line.

Draws are sampled, and the odds of each of them are calculated. Groups of draws pass through one
plan together, so hundreds of them take a second.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.standing import standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of, of_samples
from evenbreak.tournaments.odds.forward import forward_pass
from evenbreak.tournaments.odds.meetings import group_meetings, place_odds, plan_meetings
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.sampled import places_of_samples
from evenbreak.tournaments.odds.title import PlaceOdds
from evenbreak.tournaments.odds.uncertain import error_of_pairs

_CELLS = 4_000_000
"""The largest number of states times draws that are processed at once."""

_PLAYED_EACH = 20
"""How often the first rounds of a draw are played where its bracket is too large to be exact."""


def blind_draw_odds(
    bracket: Bracket,
    win: Wins,
    *,
    walkovers: float | Mapping[str, float] = 0.0,
    samples: int = 400,
    rng: np.random.Generator | None = None,
) -> PlaceOdds:
    """Return who finishes where before the draw, if everybody may be drawn to any line.

    Parameters
    ----------
    bracket
        the bracket into which the players are drawn: who is on which line of it does not
        matter.
    win
        as in `title_odds`. Tables may have a third axis for samples of the ratings, an even number
        of which the second half may mirror the first; then each sample has a draw of its own.
    walkovers
        as in `title_odds`.
    samples
        how many draws are sampled otherwise; an odd number gets one more.
    rng
        where pseudo-random numbers come from; None: a generator with the seed 0.

    Raises
    ------
    InputError
        if a chance cannot be used.

    >>> from evenbreak.tournaments import single_elimination
    >>> better = np.array([[0.5, 2 / 3, 2 / 3], [1 / 3, 0.5, 0.5], [1 / 3, 0.5, 0.5]])
    >>> odds = blind_draw_odds(single_elimination(3), better)
    >>> odds.samples, bool(abs(odds.title[0] - 14 / 27) < 4 * odds.error[0, 0])
    (400, True)
    """
    chances = chances_of(standing(bracket), win, walkovers=walkovers)
    rng = rng or np.random.default_rng(0)
    many = max(table.shape[2] if table.ndim > 2 else 0 for table in chances.tables.values())
    many = many or 2 * -(-whole(samples, "samples", at_least=4) // 2)
    players = np.tile(np.arange(len(bracket.players)), (many, 1))
    orders = rng.permuted(players, axis=1)
    laws = np.concatenate(list(_laws(bracket, chances, orders, rng)), axis=2)
    return PlaceOdds(bracket, laws.mean(axis=2), error_of_pairs(laws), many)


def _laws(
    bracket: Bracket, chances: Chances, orders: Ints, rng: np.random.Generator
) -> Iterator[Floats]:
    """Yield the places of the players, for some draws at a time; they are the last axis."""
    plan = exact_plan(bracket)
    if plan is None:
        now, many = standing(bracket), len(orders)
        law = places_of_samples(now, _seated(chances, orders.T, 0), many, _PLAYED_EACH, rng)
        yield _by_player(law, orders.T)
        return
    at_once = max(1, _CELLS // max(step.size for step in plan.steps))
    for start in range(0, len(orders), at_once):
        seated = orders[start : start + at_once].T
        tables = _seated(chances, seated, start)
        through = forward_pass(plan, tables)
        meetings = plan_meetings(plan, through) | group_meetings(bracket, tables)
        law = place_odds(bracket, meetings, through.ranks)
        yield _by_player(law, seated)


def _by_player(law: Floats, seated: Ints) -> Floats:
    """Return the places of each player, given those of whoever sits on each line."""
    return np.take_along_axis(law, np.argsort(seated, axis=0)[:, None, :], axis=0)


def _seated(chances: Chances, players: Ints, start: int) -> Chances:
    """Return the chances of whoever sits on each line, in each draw from number `start` on."""
    many = players.shape[1]
    who = np.concatenate([players, np.full((1, many), len(players))])
    made: dict[int, Floats] = {}
    tables: dict[str, Floats] = {}
    for name, table in chances.tables.items():
        if id(table) not in made:
            part = table if table.ndim == 2 else table[:, :, start : start + many]
            made[id(table)] = of_samples(part, who[:, None, :], who[None, :, :])
        tables[name] = made[id(table)]
    return Chances(tables)
