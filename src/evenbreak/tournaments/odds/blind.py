"""Odds of a blind draw: everybody is as likely to be drawn to each line.

Single elimination is exact to 16 players by a program over sets of players. With f(S, i) the
chance that i wins a part of the bracket whose lines the set S was drawn to, and A, B the
sets on the two halves of the part, all splits of S into A and B being equally likely,

    f(S, i) = mean over splits of f(A, i) sum over j in B of f(B, j) P(i beats j), i in A,

and likewise for i in B. The n!/2^(n-1) draws of n players are never written out. Other
formats go through all draws where they are few, and through a sample of them otherwise;
each draw is exact.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from functools import cache
from itertools import combinations, permutations
from math import comb, factorial

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.tournaments.brackets.bracket import Bracket, Slot, Source
from evenbreak.tournaments.brackets.standing import standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of
from evenbreak.tournaments.odds.forward import forward_pass
from evenbreak.tournaments.odds.meetings import group_meetings, place_odds, plan_meetings
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.title import PlaceOdds, odds_now

_MOST_PLAYERS = 16
_FEW_DRAWS = 5040
_CELLS = 4_000_000


def blind_draw_odds(
    bracket: Bracket,
    win: Wins,
    *,
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
        as in `title_odds`.
    samples
        how many draws are sampled where there are too many to go through all of them.
    rng
        where pseudo-random numbers come from then; None: a generator with the seed 0.

    Raises
    ------
    InputError
        if a chance cannot be used.

    >>> from evenbreak.tournaments import single_elimination
    >>> better = np.array([[0.5, 2 / 3, 2 / 3], [1 / 3, 0.5, 0.5], [1 / 3, 0.5, 0.5]])
    >>> blind_draw_odds(single_elimination(3), better).title.round(6)
    array([0.518519, 0.240741, 0.240741])
    """
    chances = chances_of(standing(bracket), win)
    law: Floats | None = None
    if len(bracket.players) <= _MOST_PLAYERS and not bracket.groups:
        law = _over_subsets(bracket, chances)
    if law is not None:
        return PlaceOdds(bracket, law, np.zeros_like(law), 0)
    orders = _all_draws(bracket)
    if orders is not None:
        law = np.concatenate(list(_laws(bracket, chances, orders)), axis=2).mean(axis=2)
        return PlaceOdds(bracket, law, np.zeros_like(law), 0)
    rng = rng or np.random.default_rng(0)
    many = whole(samples, "samples", at_least=2)
    players = np.tile(np.arange(len(bracket.players)), (many, 1))
    laws = np.concatenate(list(_laws(bracket, chances, rng.permuted(players, axis=1))), axis=2)
    error = laws.std(axis=2, ddof=1) / np.sqrt(many)
    return PlaceOdds(bracket, laws.mean(axis=2), error, many)


def _over_subsets(bracket: Bracket, chances: Chances) -> Floats | None:
    """Return the places of a single elimination; None for any other bracket."""
    fed = {slot for match in bracket.matches for slot in match.slots}
    if any(isinstance(slot, Source) and slot.outcome != "winner" for slot in fed):
        return None
    count = len(bracket.players)
    program = _Program(count)
    column = {place: k for k, place in enumerate(bracket.places)}
    law = np.zeros((count, len(column)))
    parts: dict[Slot, Hashable] = dict.fromkeys(range(count), "line")
    for match in bracket.matches:
        one, other = (parts[slot] for slot in match.slots)
        part = program.part(one, other, chances.of(match.name)[:-1, :-1])
        parts[Source(match.name, "winner")] = part
        won = program.wins(part)
        if match.loser_place is not None:
            lost = program.wins(one) + program.wins(other) - won
            law[:, column[match.loser_place]] += lost
        if match.winner_place is not None:
            law[:, column[match.winner_place]] += won
    return law


class _Program:
    """f(S, i) for each kind of part of a bracket; parts of one shape share it."""

    def __init__(self, count: int) -> None:
        self.count = count
        self.size: dict[Hashable, int] = {"line": 1}
        self.table: dict[Hashable, Floats] = {"line": np.eye(count)}

    def part(self, one: Hashable, other: Hashable, win: Floats) -> Hashable:
        """Return the part whose halves are two parts, and work it out."""
        halves = (one, other) if repr(one) <= repr(other) else (other, one)
        part = (*halves, id(win.base))
        if part not in self.table:
            self.size[part] = self.size[one] + self.size[other]
            self.table[part] = self._split(*halves, win)
        return part

    def wins(self, part: Hashable) -> Floats:
        """Return P(each player is drawn to a part and wins it)."""
        mean: Floats = self.table[part].mean(axis=0)
        return mean

    def _split(self, one: Hashable, other: Hashable, win: Floats) -> Floats:
        first, second = self.table[one], self.table[other]
        beats = (first @ win.T, second @ win.T)  # of each player the winner of that half
        members = _subsets(self.count, self.size[one] + self.size[other])
        total = np.zeros((len(members), self.count))
        where = np.zeros(1 << self.count, dtype=np.int32)
        for size in {self.size[one], self.size[other]}:
            part = _subsets(self.count, size)
            where[_masks(part)] = np.arange(len(part))
        whole_masks = _masks(members)
        ways = list(combinations(range(members.shape[1]), self.size[one]))
        if one == other:  # each split comes up twice
            ways = ways[: len(ways) // 2]
        for way in ways:
            mask = _masks(members[:, way])
            a, b = where[mask], where[whole_masks - mask]
            total += first[a] * beats[1][b] + second[b] * beats[0][a]
        return total / len(ways)


@cache
def _subsets(count: int, size: int) -> Ints:
    """Return all sets of so many players, a row each, ascending."""
    found = np.fromiter(
        (player for subset in combinations(range(count), size) for player in subset),
        dtype=np.int64,
        count=comb(count, size) * size,
    )
    return found.reshape(-1, size)


def _masks(members: Ints) -> Ints:
    masks: Ints = (1 << members).sum(axis=1)
    return masks


def _all_draws(bracket: Bracket) -> Ints | None:
    """Return all draws: who is on each line, once for each pair of first opponents.

    None if there are too many.
    """
    count = len(bracket.players)
    pairs = [
        match.slots
        for match in bracket.matches
        if isinstance(match.slots[0], int) and isinstance(match.slots[1], int)
    ]
    if bracket.groups or count > 10 or factorial(count) >> len(pairs) > _FEW_DRAWS:
        return None
    found = np.array(list(permutations(range(count))))
    for one, other in pairs:
        found = found[found[:, one] < found[:, other]]  # type: ignore[index]
    return found


def _laws(bracket: Bracket, chances: Chances, orders: Ints) -> Iterator[Floats]:
    """Yield the places of the players, for some draws at a time; they are the last axis."""
    plan = exact_plan(bracket)
    if plan is None:
        for order in orders:
            law = odds_now(standing(bracket), _seated(chances, order[:, None])).p_place
            yield law[np.argsort(order)][:, :, None]
        return
    at_once = max(1, _CELLS // max(step.size for step in plan.steps))
    for start in range(0, len(orders), at_once):
        seated = orders[start : start + at_once].T
        tables = _seated(chances, seated)
        through = forward_pass(plan, tables)
        meetings = plan_meetings(plan, through) | group_meetings(bracket, tables)
        law = place_odds(bracket, meetings, through.ranks)
        line = np.argsort(seated, axis=0)
        yield np.take_along_axis(law, line[:, None, :], axis=0)


def _seated(chances: Chances, players: Ints) -> Chances:
    """Return the chances of whoever sits on each line, in each draw."""
    nobody = np.full((1, players.shape[1]), len(players))
    who = np.concatenate([players, nobody])
    made: dict[int, Floats] = {}
    tables: dict[str, Floats] = {}
    for name, table in chances.tables.items():
        if id(table) not in made:
            made[id(table)] = table[who[:, None, :], who[None, :, :]]
        tables[name] = made[id(table)]
    return Chances(tables)
