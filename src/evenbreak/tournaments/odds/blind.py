"""Odds of a blind draw: everybody is as likely to be drawn to each line.

They are exact where a program over sets of players is cheap (`over_subsets`): for single
elimination to 16 players, for pods, and for double elimination if its losers drop straight
down. Otherwise draws are sampled, and each of them is exact. A double elimination is then
compared, draw by draw, with the one whose losers drop straight down: the differences are
small, and the odds that they are added to are known.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.double import Final, double_elimination
from evenbreak.tournaments.brackets.standing import standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of, of_samples
from evenbreak.tournaments.odds.forward import forward_pass
from evenbreak.tournaments.odds.meetings import group_meetings, place_odds, plan_meetings
from evenbreak.tournaments.odds.over_subsets import meetings_before_the_draw
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.title import PlaceOdds, odds_now
from evenbreak.tournaments.odds.uncertain import error_of_pairs

_MOST_PLAYERS = 16
_CELLS = 4_000_000
_FINALS: tuple[Final, ...] = ("true", "single")
_DOUBLES = {f"double elimination, {final} final": final for final in _FINALS}


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
        how many draws are sampled where the odds are not exact; an odd number gets one more.
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
    chances = chances_of(standing(bracket), win, walkovers=walkovers)
    rng = rng or np.random.default_rng(0)
    many = max(table.shape[2] if table.ndim > 2 else 0 for table in chances.tables.values())
    known: Floats | float = 0.0
    law = None if many else _exact(bracket, chances)
    if law is not None:
        return PlaceOdds(bracket, law, np.zeros_like(law), 0)
    straight = None if many else _with_straight_drops(bracket)
    many = many or 2 * -(-whole(samples, "samples", at_least=4) // 2)
    players = np.tile(np.arange(len(bracket.players)), (many, 1))
    orders = rng.permuted(players, axis=1)
    laws = np.concatenate(list(_laws(bracket, chances, orders)), axis=2)
    if straight is not None:
        chances = Chances({match.name: chances.of(match.name) for match in straight.matches})
        law = _exact(straight, chances)
        if law is not None:
            known = law
            laws -= np.concatenate(list(_laws(straight, chances, orders)), axis=2)
    p_place = np.clip(known + laws.mean(axis=2), 0.0, 1.0)
    return PlaceOdds(bracket, p_place, error_of_pairs(laws), many)


def _exact(bracket: Bracket, chances: Chances) -> Floats | None:
    if len(bracket.players) > _MOST_PLAYERS:
        return None
    meetings = meetings_before_the_draw(bracket, chances)
    return None if meetings is None else place_odds(bracket, meetings, {})


def _with_straight_drops(bracket: Bracket) -> Bracket | None:
    """Return a double elimination of as many players whose losers drop straight down.

    None if the bracket is not a double elimination with the same matches and places.
    """
    final = _DOUBLES.get(bracket.format)
    if final is None:
        return None
    found = double_elimination(bracket.players, final=final, drops="straight")
    alike = found.by_name.keys() == bracket.by_name.keys() and found.places == bracket.places
    return found if alike else None


def _laws(bracket: Bracket, chances: Chances, orders: Ints) -> Iterator[Floats]:
    """Yield the places of the players, for some draws at a time; they are the last axis."""
    plan = exact_plan(bracket)
    if plan is None:
        for k, order in enumerate(orders):
            law = odds_now(standing(bracket), _seated(chances, order[:, None], k)).p_place
            yield law[np.argsort(order)][:, :, None]
        return
    at_once = max(1, _CELLS // max(step.size for step in plan.steps))
    for start in range(0, len(orders), at_once):
        seated = orders[start : start + at_once].T
        tables = _seated(chances, seated, start)
        through = forward_pass(plan, tables)
        meetings = plan_meetings(plan, through) | group_meetings(bracket, tables)
        law = place_odds(bracket, meetings, through.ranks)
        line = np.argsort(seated, axis=0)
        yield np.take_along_axis(law, line[:, None, :], axis=0)


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
