"""How long a match takes, in racks."""

from __future__ import annotations

from typing import Any, overload

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import number_probability
from evenbreak.errors import InputError
from evenbreak.game import Game
from evenbreak.games.match import Match, Score
from evenbreak.matches.endings import endings_of, is_bounded
from evenbreak.matches.form import form_of, on_days
from evenbreak.matches.game_odds import game_odds
from evenbreak.matches.length_law import MatchLength
from evenbreak.matches.outcomes import outcomes_of
from evenbreak.matches.parameters import at_score, in_shape, rack_in


@overload
def match_length(
    match: Match[float],
    score: Score | None = None,
    *,
    tail: float = 1e-12,
    via: Way | None = None,
    form: float = 0.0,
) -> MatchLength[float, float | None]: ...
@overload
def match_length(  # type: ignore[overload-overlap]  # a match is a game too
    match: Match[Any], score: Score | None = None, *, tail: float = 1e-12, form: float = 0.0
) -> MatchLength[Floats, Floats]: ...
@overload
def match_length(
    match: Game, score: Any = None, *, tail: float = 1e-12, via: Way | None = None
) -> MatchLength[float, float | None]: ...
def match_length(
    match: Game,
    score: Any = None,
    *,
    tail: float = 1e-12,
    via: Way | None = None,
    form: float = 0.0,
) -> MatchLength[Any, Any]:
    """Return the distribution of the number of racks that `match` still takes.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets; p1 and p2 may be arrays. In a match
        of a game of your own, each of these games counts as one rack. Any other game is
        measured in its moves, as in `game_odds`.
    score
        the score now (see `win_probability`); None: the match's own start score.
    tail
        how much probability may be left out of the distribution if there is no longest
        length. It is cut off after 100,000 racks in any case (fewer for large arrays);
        `tail_mass` is what was left out.
    via
        the way, for plain numbers: 'kernel', or 'elimination' in the chain of the match's graph.
        A length is no stochastic limit, so there is no way by eigenvectors of eigenvalue 1.
        None: the kernel, or elimination for any other game, which has none.
    form
        how much the log-odds of a game vary from match to match (standard deviation); see
        `final_scores`.

    Raises
    ------
    InputError
        if the score cannot be reached, `tail` is not a probability, there is no such way, or form
        is not in 0 to 3, or given for a way or for another game than a match.

    Notes
    -----
    Source: problems P5.5, P5.24, P5.27. If there is no longest length, mean and standard
    deviation come from the absorbing chain of the score, not from the cut distribution.

    >>> from evenbreak.games import Ahead, Race, Rack
    >>> length = match_length(Race(2, 2, Rack(0.5)))
    >>> length.games.tolist(), length.probability.tolist(), length.mean, length.sd
    ([2, 3], [0.5, 0.5], 2.5, 0.5)
    >>> length = match_length(Ahead(2, 2, Rack(0.5)))
    >>> round(length.mean, 9), length.span, length.tail_mass < 1e-12
    (4.0, 80, True)
    """
    way = way_of_limit(via)
    if way == "eigen":
        raise InputError(
            "via is 'eigen', but a length is not a stochastic limit; give 'kernel' or 'elimination'"
        )
    if form:
        return _with_form(match, score, tail, via, form)
    if not isinstance(match, Match) and isinstance(match, Game):
        if via == "kernel":
            raise InputError("via is 'kernel', but a game of your own has none; use elimination")
        return game_odds(match, score, tail=tail).length
    match, shape = at_score(match, score)
    if way is not None:
        rack_in(match).of_numbers()
        return game_odds(match, tail=tail).length
    tail = number_probability(tail, "tail")
    bounded = is_bounded(match)
    # A race of racks has too many scores for a chain, and no tail.
    outcomes = None if bounded else outcomes_of(match)
    never = 0.0 if outcomes is None else outcomes.never
    endings = endings_of(match, never, tail)
    chances = np.moveaxis(endings.win_1 + endings.win_2, 0, -1)
    games = np.arange(chances.shape[-1])
    if outcomes is None:
        mean = (games * chances).sum(axis=-1)
        sd = np.sqrt(((games - mean[..., np.newaxis]) ** 2 * chances).sum(axis=-1))
        left = 0.0
    else:
        _, mean, sd = outcomes.length
        left = np.maximum(1.0 - chances.sum(axis=-1) - never, 0.0)
    possible = chances.reshape(-1, games.size).any(axis=0)
    first = int(possible.argmax())
    return MatchLength(
        games=games[first:],
        probability=chances[..., first:],
        mean=_unless_endless(mean, never, shape),
        sd=_unless_endless(sd, never, shape),
        p_never_ends=in_shape(never, shape),
        tail_mass=in_shape(left, shape),
        bounded=bounded,
    )


def _with_form(
    match: Any, score: Score | None, tail: float, via: Way | None, form: float
) -> MatchLength[Any, Any]:
    if via is not None:
        raise InputError(
            "via is for one chain, but with form the answer is an average over many; leave one out"
        )
    match, shape = at_score(match, score)
    many, weights = on_days(match, form_of(form))
    length = match_length(many, tail=tail)

    def mixed(value: Floats) -> Any:
        return (weights * value).sum(axis=-1)

    mean = mixed(length.mean)
    return MatchLength(
        games=length.games,
        probability=(weights[..., np.newaxis] * length.probability).sum(axis=-2),
        mean=_unless_endless(mean, mixed(length.p_never_ends), shape),
        sd=_unless_endless(
            np.sqrt(mixed(length.sd**2 + (length.mean - np.expand_dims(mean, -1)) ** 2)),
            mixed(length.p_never_ends),
            shape,
        ),
        p_never_ends=in_shape(mixed(length.p_never_ends), shape),
        tail_mass=in_shape(mixed(length.tail_mass), shape),
        bounded=length.bounded,
    )


def _unless_endless(value: Any, never: Any, shape: tuple[int, ...]) -> Any:
    if not shape:
        return None if never > 0.0 else float(value)
    return in_shape(np.where(np.asarray(never) > 0.0, np.nan, value), shape)
