"""The chance of a shutout: one player wins every rack (or set) still played."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

from evenbreak.checks import one_of
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.matches.outcomes import unit_outcomes
from evenbreak.matches.parameters import at_score, first_breaker, in_shape

if TYPE_CHECKING:
    from evenbreak.arrays import Floats


@overload
def shutout_probability(
    match: Match[float], score: Score | None = None, *, player: int = 1
) -> float | None: ...
@overload
def shutout_probability(
    match: Match[Any], score: Score | None = None, *, player: int = 1
) -> Floats | None: ...
def shutout_probability(match: Match, score: Score | None = None, *, player: int = 1) -> Any:
    """Return P(`player` wins and the other player scores nothing from the start score on).

    It is a product of probabilities, accurate even if it is tiny. None for n-ahead matches,
    which are about the lead and not the score. In a match of sets it is about sets.

    Parameters
    ----------
    match
        a race, of racks or of sets; p1 and p2 may be arrays.
    score
        the score now (see `win_probability`); None: the match's own start score.
    player
        who wins, 1 or 2.

    Returns
    -------
    float, numpy.ndarray or None
        a float for plain numbers, otherwise an array of the shape of the parameters.

    Raises
    ------
    InputError
        if the score cannot be reached, or `player` is not 1 or 2.

    >>> from evenbreak.games import Race, Rack
    >>> shutout_probability(Race(2, 2, Rack(0.5)), player=2)
    0.25
    """
    one_of(player, "player", (1, 2))
    if not isinstance(match, Race):
        return None
    match, shape = at_score(match, score)
    a, b = match.score
    # P(the run has come this far and this player breaks next), by breaker.
    run: dict[int, Any] = {first_breaker(match): 1.0}
    if match.decided(a, b) is None:
        units = unit_outcomes(match, lengths=False)
    while match.decided(a, b) is None:
        a, b = (a + 1, b) if player == 1 else (a, b + 1)
        after: dict[int, Any] = {}
        for breaker, held in run.items():
            for (winner, then), outcome in units[breaker].by_result.items():
                if winner == player:
                    after[then] = after.get(then, 0.0) + held * outcome.chance
        run = after
    return in_shape(sum(run.values(), 0.0) if match.decided(a, b) == player else 0.0, shape)
