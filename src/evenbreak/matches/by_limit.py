"""Who wins a game, from the stochastic limit of its graph.

Every kernel in this package must give the same chances; the functions' `via` option leads here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak.chains.explore import chain_of
from evenbreak.chains.limits import Limit, limit_of
from evenbreak.chains.passage_times import steps_to_absorption
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.parameters import checked_match, ends_of_game

if TYPE_CHECKING:
    from evenbreak.chains.ways import Way
    from evenbreak.game import Game


class LimitOdds(NamedTuple):
    """Who wins, from the limit of the game's chain; None as a player means no winner."""

    limit: Limit
    by_winner: dict[int | None, float]
    p_never_ends: float

    def p_win(self, player: int) -> float:
        """Return P(`player` wins)."""
        return self.by_winner.get(player, 0.0)


def odds_by_limit(game: Game, via: Way, start: Any = None) -> LimitOdds:
    """Return who wins a game, from its stochastic limit by 'elimination' or 'eigen'.

    Raises InputError if the chances in a match are arrays; other errors are those of `limit_of` and
    `game_odds`.
    """
    rack = game.innermost_rack if isinstance(game, Match) else None
    if isinstance(rack, Rack):
        rack.of_numbers()
    by_winner = ends_of_game(game, start).by_winner
    limit = limit_of(game, start=start, via=via)
    chances = {
        winner: min(sum(limit[state] for state in final), 1.0)
        for winner, final in by_winner.items()
    }
    over = {state for final in by_winner.values() for state in final}
    never = sum(chance for state, chance in limit.items() if state not in over)
    return LimitOdds(limit, chances, never)


def match_odds_by_limit(match: Match, via: Way) -> dict[str, Any]:
    """Return the fields of a match's `MatchOdds` that its limit determines, by name.

    >>> from evenbreak.games import Race
    >>> match_odds_by_limit(Race(2, 2, Rack(0.5)), "eigen")
    {'p_win_1': 0.5, 'p_win_2': 0.5, 'p_never_ends': 0.0, 'p_hill_hill': 0.5, 'p_shutout_1': 0.25, \
'p_shutout_2': 0.25}
    """
    odds = odds_by_limit(match, via)
    by_name: dict[str, Any] = {
        "p_win_1": odds.p_win(1),
        "p_win_2": odds.p_win(2),
        "p_never_ends": odds.p_never_ends,
    }
    in_racks = isinstance(match, Race) and isinstance(match.rack, Rack) and match.win_by == 1
    if in_racks and match.decided(*match.score) is None:
        limit: dict[Any, float] = odds.limit.to_dict()
        ends = [(state[:2], p) for state, p in limit.items() if match.winner(state)]
        (a, b), last = match.score, match.m + match.n - 1
        by_name["p_hill_hill"] = sum(p for score, p in ends if sum(score) == last)
        by_name["p_shutout_1"] = sum(p for score, p in ends if score == (match.m, b))
        by_name["p_shutout_2"] = sum(p for score, p in ends if score == (a, match.n))
    if via == "elimination":
        racks = steps_to_absorption(chain_of(checked_match(match)))
        by_name["mean_games"] = racks.mean
        by_name["sd_games"] = None if racks.variance is None else racks.variance**0.5
    return by_name
