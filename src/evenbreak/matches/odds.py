"""Odds of one match in plain numbers, without numpy: what the command line needs."""

from __future__ import annotations

import math
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.matches.parameters import checked_match
from evenbreak.matches.races import race_odds


class MatchOdds(NamedTuple):
    """What there is to know about one match before its next rack.

    Everything is conditional on the match's start score and first breaker.

    Parameters
    ----------
    p_win_1, p_win_2
        P(player 1, 2 wins).
    p_never_ends
        P(the match goes on for ever).
    mean_games, sd_games
        mean and standard deviation of the racks still to be played, sets included rack
        by rack; None if the match may never end, or no float holds so large a number.
    games_p50, games_p90
        the smallest number of racks within which the match ends with chance .5, .9;
        None if it never reaches that chance, or only after more than 100,000 racks of a
        match with more than 1,000 states.
    p_hill_hill
        P(the last possible rack decides); None where no rack is the last possible one
        (n-ahead, win by 2 or more) and in sets.
    p_shutout_1, p_shutout_2
        P(player 1, 2 wins and the other wins no rack from the start score on); None for
        n-ahead matches and sets.
    """

    p_win_1: float
    p_win_2: float
    p_never_ends: float
    mean_games: float | None
    sd_games: float | None
    games_p50: int | None
    games_p90: int | None
    p_hill_hill: float | None
    p_shutout_1: float | None
    p_shutout_2: float | None


def match_odds(match: Match) -> MatchOdds:
    """Return the odds of `match`: who wins, how long it takes, how close it gets.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets, with plain numbers as chances.

    Raises
    ------
    InputError
        if the chances are arrays, or `match` is another game.

    Notes
    -----
    Source: problems P5.5 (races), P5.8 (sets), P5.24 (break formats), P5.27 (n-ahead).

    >>> from evenbreak.games import Race, Rack
    >>> odds = match_odds(Race(2, 2, Rack(0.5)))
    >>> odds.p_win_1, odds.mean_games, odds.games_p50, odds.p_hill_hill, odds.p_shutout_1
    (0.5, 2.5, 2, 0.5, 0.25)
    """
    rack = checked_match(match).innermost_rack
    if not isinstance(rack.p1, float) or not isinstance(rack.p2, float | None):
        raise InputError("match holds arrays; use win_probability and match_length for those")
    if isinstance(match, Race) and match.win_by == 1 and match.rack is rack:
        law = race_odds(
            match.m, match.n, rack.p1, rack.p2, match.breaks, match.first_breaker, match.score
        )
        return MatchOdds(
            p_win_1=law.p_win_1,
            p_win_2=law.p_win_2,
            p_never_ends=0.0,
            mean_games=law.mean,
            sd_games=law.sd,
            games_p50=law.quantile(0.5),
            games_p90=law.quantile(0.9),
            p_hill_hill=law.p_hill_hill,
            p_shutout_1=law.p_shutout_1,
            p_shutout_2=law.p_shutout_2,
        )
    # A plain race, the commonest question by far, is answered without loading what follows.
    from evenbreak.matches.outcomes import outcomes_of
    from evenbreak.matches.rack_by_rack import racks_within
    from evenbreak.matches.rack_graph import rack_moves
    from evenbreak.matches.shutout import shutout_probability

    outcomes = outcomes_of(match)
    ends = outcomes.never == 0.0
    length = outcomes.length
    start = match.start
    moves = rack_moves(match)
    p50, p90 = racks_within(moves, [(start, 0.5), (start, 0.9)], {start: outcomes.never})
    return MatchOdds(
        p_win_1=outcomes.p_win(1),
        p_win_2=outcomes.p_win(2),
        p_never_ends=outcomes.never,
        mean_games=length.mean if ends and math.isfinite(length.mean) else None,
        sd_games=length.sd if ends and math.isfinite(length.sd) else None,
        games_p50=p50,
        games_p90=p90,
        p_hill_hill=None,
        p_shutout_1=shutout_probability(match, player=1) if match.rack is rack else None,
        p_shutout_2=shutout_probability(match, player=2) if match.rack is rack else None,
    )
