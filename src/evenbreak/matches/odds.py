"""Odds of a single match in plain numbers; races are calculated without numpy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.parameters import checked_match, rack_in, with_rack
from evenbreak.matches.races import race_odds

if TYPE_CHECKING:
    from evenbreak.arrays import Floats


class MatchOdds(NamedTuple):
    """Odds of a match, from its start score and first breaker on.

    Parameters
    ----------
    p_win_1, p_win_2
        P(player 1, 2 wins).
    p_never_ends
        P(the match goes on forever).
    mean_games, sd_games
        mean and standard deviation of the number of racks left, in all sets; None if the match may
        never end, or if the number is too large for a float.
    games_p50, games_p90
        the smallest number of racks within which the match ends with probability .5, .9;
        None if it never does, or if it takes more than 100,000 racks and has more than 1,000
        states.
    p_hill_hill
        P(the last possible rack decides); None for matches of sets and those without a last
        possible rack (n-ahead, win by 2 or more).
    p_shutout_1, p_shutout_2
        P(player 1, 2 wins and the other wins no rack from the start score on); None for
        n-ahead matches and matches of sets.
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


def match_odds(match: Match, *, via: Way | None = None, form: float = 0.0) -> MatchOdds:
    """Return the odds of `match`: who wins, how long it takes, and how close it is.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks, sets or custom games, with plain numbers as
        probabilities. For other games see `game_odds`.
    via
        the method for the chances (see `win_probability`). By 'elimination', mean and standard
        deviation of the length come from the same chain; no eigenvector of eigenvalue 1 gives a
        length, so with 'eigen' they come from the kernel, as the quantiles always do.
    form
        standard deviation of a game's log-odds from match to match; see `final_scores`.

    Raises
    ------
    InputError
        if the probabilities are arrays, `match` is another game, `via` is unknown, form is not
        in 0 to 3, or it is combined with `via`.

    Notes
    -----
    Source: problems P5.5 (races), P5.8 (sets), P5.24 (break formats), P5.27 (n-ahead).

    >>> from evenbreak.games import Race, Rack
    >>> odds = match_odds(Race(2, 2, Rack(0.5)))
    >>> odds.p_win_1, odds.mean_games, odds.games_p50, odds.p_hill_hill, odds.p_shutout_1
    (0.5, 2.5, 2, 0.5, 0.25)
    """
    way = way_of_limit(via)
    if form:
        return _with_form(match, via, form)
    odds = _by_kernel(checked_match(match))
    if way is None:
        return odds
    from evenbreak.matches.by_limit import match_odds_by_limit

    return odds._replace(**match_odds_by_limit(match, way))


def mixed_odds(match: Match, weights: Floats | list[float]) -> MatchOdds:
    """Return the odds of a match whose chances are drawn from arrays, with weights that sum to 1.

    The lengths are mixed, and mean, standard deviation and quantiles are those of the mixture.

    >>> from evenbreak.games import Race, Rack
    >>> mixed_odds(Race(2, 2, Rack([0.25, 0.75])), [0.5, 0.5]).p_hill_hill
    0.375
    """
    import numpy as np

    from evenbreak.matches.length import match_length

    rack = rack_in(match)
    chances = [np.atleast_1d(p).tolist() for p in (rack.p1, rack.p2) if p is not None]
    each = [_by_kernel(with_rack(match, Rack(*both))) for both in zip(*chances, strict=True)]
    weights = np.asarray(weights)
    mixed: dict[str, Any] = {
        name: _mean([getattr(odds, name) for odds in each], weights)
        for name in each[0]._fields
        if name.startswith(("p_", "mean_"))
    }
    average = mixed["mean_games"]
    squares = [
        None
        if odds.mean_games is None or odds.sd_games is None
        else odds.mean_games**2 + odds.sd_games**2
        for odds in each
    ]
    square = _mean(squares, weights)
    sd = None
    if average is not None and square is not None:
        sd = math.sqrt(max(square - average**2, 0.0))
    length = match_length(match)
    of_mixture = replace(
        length,
        probability=weights @ length.probability,
        mean=average,
        sd=sd,
        p_never_ends=float(weights @ length.p_never_ends),
        tail_mass=float(weights @ length.tail_mass),
    )
    p50, p90 = of_mixture.quantile(0.5), of_mixture.quantile(0.9)
    return MatchOdds(**mixed, sd_games=sd, games_p50=p50, games_p90=p90)


def _mean(values: Sequence[float | None], weights: Floats) -> float | None:
    """Return the weighted mean, or None if any value is None."""
    if any(value is None for value in values):
        return None
    import numpy as np

    return float(np.array(values, dtype=float) @ weights)


def _with_form(match: Match, via: Way | None, form: float) -> MatchOdds:
    from evenbreak.matches.form import form_of, on_days

    if via is not None:
        raise InputError(
            "via is for a single chain, but with form the answer is an average over many "
            "chains. Leave out via or form."
        )
    rack_in(checked_match(match)).of_numbers()
    return mixed_odds(*on_days(match, form_of(form)))


def _by_kernel(match: Match) -> MatchOdds:
    rack = rack_in(match).of_numbers()
    if isinstance(match, Race) and match.win_by == 1 and match.rack is rack:
        race = race_odds(match.m, match.n, rack, match.breaks, match.first_breaker, match.score)
        return MatchOdds(
            p_win_1=race.p_win_1,
            p_win_2=race.p_win_2,
            p_never_ends=0.0,
            mean_games=race.mean,
            sd_games=race.sd,
            games_p50=race.quantile(0.5),
            games_p90=race.quantile(0.9),
            p_hill_hill=race.p_hill_hill,
            p_shutout_1=race.p_shutout_1,
            p_shutout_2=race.p_shutout_2,
        )
    # A plain race, by far the most common question, does not load what follows.
    from evenbreak.matches.outcomes import outcomes_of, shutout_probability
    from evenbreak.matches.rack_by_rack import rack_moves, racks_within

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
