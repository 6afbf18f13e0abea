"""Odds before a draw: redrawn qualifiers, Swiss rounds, the lines of a blind draw.

Draws are sampled, with standard errors, if there are too many to enumerate.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import permutations
from math import factorial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import floats, whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Place
from evenbreak.tournaments.brackets.double import losers_qualifiers, redrawn
from evenbreak.tournaments.brackets.standing import Results, standing
from evenbreak.tournaments.brackets.swiss import (
    Pairing,
    Swiss,
    check_rounds,
    swiss_bracket,
    swiss_round,
    swiss_standings,
)
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of, of_samples
from evenbreak.tournaments.odds.passes import forward_pass
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.rematches import group_meetings, place_odds, plan_meetings
from evenbreak.tournaments.odds.sampled import places_of_samples
from evenbreak.tournaments.odds.title import PlaceOdds, title_odds
from evenbreak.tournaments.odds.uncertain import error_of_pairs

_ALL = 24


def redraw_odds(
    bracket: Bracket,
    win: Wins,
    *,
    results: Results | None = None,
    samples: int = 40,
    rng: np.random.Generator | None = None,
    **asked: Any,
) -> PlaceOdds:
    """Return who finishes where if the losers'-side qualifiers are still to be drawn.

    Parameters
    ----------
    bracket
        a double elimination down to qualifiers; how its losers'-side qualifiers are placed doesn't
        matter.
    win, results
        as in `title_odds`, before the knockout starts.
    samples
        how many redraws are sampled if there are more than 24.
    rng
        the random number generator in that case; None: a generator with seed 0.
    asked
        other parameters for `title_odds`.

    Raises
    ------
    InputError
        if the bracket has no such qualifiers.

    >>> from evenbreak.tournaments import double_elimination
    >>> coin = np.full((8, 8), 0.5)
    >>> odds = redraw_odds(double_elimination(8, qualifiers=4), coin)
    >>> odds.title.round(3).tolist(), odds.samples
    ([0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125], 0)
    """
    qualifiers = losers_qualifiers(bracket)
    if factorial(len(qualifiers)) <= _ALL:
        orders = list(permutations(qualifiers))
    else:
        rng = rng or np.random.default_rng(0)
        many = whole(samples, "samples", at_least=2)
        seats = [rng.permutation(len(qualifiers)).tolist() for _ in range(many)]
        orders = [tuple(qualifiers[k] for k in seat) for seat in seats]
    found = [title_odds(redrawn(bracket, order), win, results=results, **asked) for order in orders]
    laws = np.stack([odds.p_place for odds in found])
    inner = np.stack([odds.error for odds in found])
    variance = (inner**2).mean(axis=0) / len(found)
    if len(orders) < factorial(len(qualifiers)):
        variance = laws.var(axis=0, ddof=1) / len(found)
    samples = 0 if not variance.any() else max(len(orders), sum(odds.samples for odds in found))
    return PlaceOdds(bracket, laws.mean(axis=0), np.sqrt(variance), samples)


# Who finishes where in a Swiss: by simulation, since each round is paired by the one before.


def swiss_odds(
    event: Swiss,
    win: ArrayLike,
    *,
    played: Sequence[Sequence[Pairing]] = (),
    without: Collection[str] = (),
    runs: int = 1000,
    rng: np.random.Generator | None = None,
) -> PlaceOdds:
    """Return who finishes where in a Swiss tournament.

    Upcoming rounds are paired with the 'casual' system, whatever the event uses, because it is a
    hundred times as fast.

    Parameters
    ----------
    win
        P(i beats j), a table in the order of the players; a third axis, if any, is for samples of
        the ratings, which are used in turn.
    played
        the rounds so far. In the last round, matches without a winner are still to be played.
    without
        as in `swiss_round`.
    rng
        the random number generator; None: a generator with seed 0.

    Raises
    ------
    InputError
        if a parameter has an invalid value, or the extra is not installed.
    """
    table = floats(win, "win", low=0.0, high=1.0)
    count = len(event.players)
    if table.shape[:2] != (count, count) or table.ndim > 3:
        raise InputError(
            "{win} must have a row and a column for each player; its shape is {table_shape}",
            table_shape=table.shape,
        )
    tables = np.moveaxis(table.reshape(count, count, -1), 2, 0)
    complete, begun = _begun(played)
    check_rounds(event, complete)
    many = whole(runs, "runs", at_least=1)
    rng = rng or np.random.default_rng(0)
    quick = replace(event, system="casual")
    seat = {player: k for k, player in enumerate(event.players)}
    law, won = np.zeros((count, count)), np.zeros((count, min(many, len(tables))))
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
        won[seat[order[0].player], run % len(tables)] += 1.0
    error = np.sqrt(np.maximum(law * (1.0 - law), 0.0) / many)
    by_draw = won / won.sum(axis=0) if len(tables) > 1 else None
    return PlaceOdds(swiss_bracket(event), law, error, many, by_draw=by_draw)


def _begun(
    played: Sequence[Sequence[Pairing]],
) -> tuple[Sequence[Sequence[Pairing]], list[Pairing]]:
    """Return the finished rounds, and the unfinished one."""
    if played and any(p.second is not None and p.winner is None for p in played[-1]):
        return played[:-1], list(played[-1])
    return played, []


def _won(pairing: Pairing, table: Floats, seat: dict[str, int], luck: float) -> Pairing:
    if pairing.second is None or pairing.winner is not None:
        return pairing
    first_wins = luck < table[seat[pairing.first], seat[pairing.second]]
    return pairing._replace(winner=pairing.first if first_wins else pairing.second)


# Odds of a blind draw: everybody is as likely to be drawn to each line.
#
# Draws are sampled, and the odds of each of them are calculated. Groups of draws pass through one
# plan together, so hundreds of them take a second.


_CELLS = 4_000_000
"""The largest number of states times draws processed at once."""

_PLAYED_EACH = 20
"""How often a draw's first rounds are simulated if its bracket is too large to be exact."""


def blind_draw_odds(
    bracket: Bracket,
    win: Wins,
    *,
    walkovers: float | Mapping[str, float] = 0.0,
    samples: int = 400,
    rng: np.random.Generator | None = None,
) -> PlaceOdds:
    """Return who finishes where before the draw, if everyone is equally likely to be on any line.

    Parameters
    ----------
    bracket
        which player is on which line doesn't matter.
    win
        as in `title_odds`. Tables may have a third axis for samples of the ratings, an even number
        whose second half may mirror the first; then each sample has its own draw.
    walkovers
        as in `title_odds`.
    samples
        how many draws are sampled otherwise; odd numbers are rounded up to even.
    rng
        the random number generator; None: a generator with seed 0.

    Raises
    ------
    InputError
        if a chance is invalid.

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
    title = laws[:, bracket.places.index(Place(1, 1))]
    return PlaceOdds(bracket, laws.mean(axis=2), error_of_pairs(laws), many, by_draw=title)


def _laws(
    bracket: Bracket, chances: Chances, orders: Ints, rng: np.random.Generator
) -> Iterator[Floats]:
    """Yield the players' places, for some draws at a time; draws are the last axis."""
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
    """Return each player's places, given those of the player on each line."""
    return np.take_along_axis(law, np.argsort(seated, axis=0)[:, None, :], axis=0)


def _seated(chances: Chances, players: Ints, start: int) -> Chances:
    """Return the chances of the players on the lines, in each draw from number `start` on."""
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
