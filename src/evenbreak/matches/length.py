"""How long a match takes in racks; who wins any game with any number of players, and when."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, overload

import numpy as np

from evenbreak.arrays import Floats, Ints, array_values, own_arrays
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import number_probability
from evenbreak.errors import AccuracyError, InputError
from evenbreak.game import Game
from evenbreak.games.match import Match, Score
from evenbreak.games.rack import ChanceT
from evenbreak.matches.endings import endings_of, is_bounded
from evenbreak.matches.form import form_of, on_days
from evenbreak.matches.outcomes import outcomes_of
from evenbreak.matches.parameters import Ends, at_score, ends_of_game, in_shape, rack_in
from evenbreak.matches.quantiles import TIE

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    from evenbreak.chains.passage_times import PassageTime


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
    """Return the distribution of the number of racks left in `match`.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets; p1 and p2 may be arrays. In a match of a
        custom game, each game counts as one rack. Any other game is measured in its moves, as in
        `game_odds`.
    score
        the current score (see `win_probability`); None: the match's own start score.
    tail
        how much probability may be omitted from the distribution if there is no longest length. It
        is cut off after 100,000 racks in any case (fewer for large arrays); `tail_mass` is the
        omitted probability.
    via
        the method, for plain numbers: 'kernel', or 'elimination' in the chain of the match's graph.
        A length is not a stochastic limit, so it cannot be found from the eigenvectors of
        eigenvalue 1. None: the kernel, or elimination for any other game, which has no kernel.
    form
        how much the log-odds of a game vary from match to match (standard deviation); see
        `final_scores`.

    Raises
    ------
    InputError
        if the score cannot be reached, `tail` is not a probability, `via` is unknown, form is not
        in 0 to 3, or form is combined with `via` or with a game that is not a match.

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
            "via is 'eigen', but a length isn't a stochastic limit. Give 'kernel' or 'elimination'."
        )
    if form:
        return _with_form(match, score, tail, via, form)
    if not isinstance(match, Match) and isinstance(match, Game):
        if via == "kernel":
            raise InputError("via is 'kernel', but a game of your own has none. Use elimination.")
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
            "via is for a single chain, but with form the answer is an average over many "
            "chains. Leave out via or form."
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


if TYPE_CHECKING:
    from typing_extensions import TypeVar

    MeanT = TypeVar("MeanT", covariant=True, default=Any)
else:
    from typing import TypeVar

    MeanT = TypeVar("MeanT", covariant=True)


@array_values
@dataclass(frozen=True, eq=False)
class MatchLength(Generic[ChanceT, MeanT]):
    """The distribution of the length of a match in racks, from its start score on.

    Parameters
    ----------
    games
        lengths in racks, ascending, shape (k,).
    probability
        P(the match takes exactly games[i] racks), shape `(*parameters, k)`.
    mean, sd
        mean and standard deviation in racks, exact even where `games` leaves out a tail;
        None (NaN in arrays) if the match may never end.
    p_never_ends
        P(the match goes on forever).
    tail_mass
        P(the match ends, but after more than games[-1]
        racks); 0 if there is a longest length.
    bounded
        whether there is a longest length.
    """

    games: Ints
    probability: Floats
    mean: MeanT
    sd: MeanT
    p_never_ends: ChanceT
    tail_mass: ChanceT
    bounded: bool

    @property
    def span(self) -> int:
        """The longest length in `games`."""
        return int(self.games[-1])

    @overload
    def quantile(self: MatchLength[float, Any], q: float) -> int | None: ...
    @overload
    def quantile(self: MatchLength[Any, Any], q: float) -> Floats: ...
    def quantile(self: MatchLength[Any, Any], q: float) -> Any:
        """Return the smallest k with P(length <= k) >= q; ties within rounding count.

        Returns
        -------
        int, None or numpy.ndarray
            None (NaN in arrays) if the probability of ending never reaches q.

        Raises
        ------
        InputError
            if q is not a probability.
        AccuracyError
            if the quantile lies in the omitted tail.

        >>> from evenbreak.games import Race, Rack
        >>> from evenbreak.matches import match_length
        >>> match_length(Race(2, 2, Rack(0.5))).quantile(0.5)
        2
        """
        q = number_probability(q, "q")
        chances = self.probability
        if q <= 0.5:
            reached = (np.cumsum(chances, axis=-1) >= q * (1.0 - TIE)) & (chances > 0.0)
        else:
            # The upper levels are read off the tail, a small sum of small terms.
            beyond = np.asarray(self.tail_mass + self.p_never_ends)[..., np.newaxis]
            tail = np.cumsum(np.concatenate([beyond, chances[..., :0:-1]], axis=-1), axis=-1)
            reached = tail[..., ::-1] <= (1.0 - q) * (1.0 + TIE)
        is_reached = reached.any(axis=-1)
        ends = np.asarray(1.0 - self.p_never_ends)
        if not self.bounded and ((ends >= q) & (q < 1.0) & ~is_reached).any():
            raise AccuracyError(
                "the {q:g} quantile lies beyond {span} racks, where the distribution is "
                "cut off. Give a smaller tail, or use match_odds for the .5 and .9 quantiles.",
                q=q,
                span=self.span,
            )
        at = self.games[reached.argmax(axis=-1)]
        if chances.ndim == 1:
            return int(at) if is_reached else None
        return at if is_reached.all() else np.where(is_reached, at, np.nan)


_LONGEST = 100_000
NO_WINNER, NEVER_ENDS = "no winner", "never ends"


@own_arrays
@dataclass(frozen=True, eq=False, repr=False)
class GameOdds:
    """Who wins a game, and after how many moves.

    Parameters
    ----------
    p_win
        P(the player wins), for the number of each player who can win.
    p_no_winner
        P(the game ends in a state without a winner).
    p_never_ends
        P(the game goes on forever).
    length
        how many moves the game takes, regardless of who wins; its `games` are numbers of moves.
    by_length
        P(the player wins after exactly `length.games[k]` moves) at [i, k], for the i-th
        player of `p_win`; the last row is P(it ends then without a winner).
    """

    p_win: Mapping[int, float]
    p_no_winner: float
    p_never_ends: float
    length: MatchLength[float, float | None]
    by_length: Floats

    def __repr__(self) -> str:
        chances = [f"player {player} wins {chance:.4g}" for player, chance in self.p_win.items()]
        others = ((NO_WINNER, self.p_no_winner), (NEVER_ENDS, self.p_never_ends))
        chances += [f"{name} {chance:.4g}" for name, chance in others if chance > 0.0]
        return f"<GameOdds: {', '.join(chances)}>"

    def to_series(self) -> pd.Series[float]:
        """Return the probability of each outcome: the players' wins, no winner, never ends."""
        import pandas as pd

        chances: dict[int | str, float] = dict(self.p_win.items())
        chances |= {NO_WINNER: self.p_no_winner, NEVER_ENDS: self.p_never_ends}
        return pd.Series(chances, name="probability").rename_axis("outcome")

    def to_frame(self) -> pd.DataFrame:
        """Return P(each outcome after exactly k moves), with a row for each number of moves."""
        import pandas as pd

        moves = pd.Index(self.length.games, name="moves")
        columns = pd.Index([*self.p_win, NO_WINNER], name="outcome")
        return pd.DataFrame(self.by_length.T, index=moves, columns=columns)


def game_odds(
    game: Game | nx.DiGraph[Any], start: Hashable | None = None, *, tail: float = 1e-12
) -> GameOdds:
    """Return who wins a game and after how many moves, for any number of players.

    Parameters
    ----------
    game
        any object with `start`, `moves(state)` and `winner(state)` (see `evenbreak.game`), or a
        `networkx.DiGraph` with a `probability` on its arcs and a `winner` at its final nodes.
        It is over in a state without moves.
    start
        the current state; None: the start of the game.
    tail
        probability that may be omitted from the distribution of the length if there is no longest
        length. It is cut off after 100,000 moves in any case.

    Raises
    ------
    InputError
        if `game` is not a game, or `tail` is not a probability.
    GameError
        if a winner is not the number of a player, someone has won in a state that has moves,
        or a probability is not one.
    ChainError
        if the probabilities of a state do not sum to 1, or the start is unknown.

    Notes
    -----
    Chances, mean and standard deviation come from the absorbing chain of the game, not from the
    distribution of the length. Source: Kemeny & Snell, Finite Markov Chains, chapter III.

    Three players shoot in turn at one ball, and whoever makes it wins:

    >>> class Killer:
    ...     start = "Ann"
    ...     def moves(self, state):
    ...         turns = {"Ann": "Bo", "Bo": "Cy", "Cy": "Ann"}
    ...         return {state + " wins": 0.5, turns[state]: 0.5} if state in turns else {}
    ...     def winner(self, state):
    ...         return {"Ann wins": 1, "Bo wins": 2, "Cy wins": 3}.get(state)
    >>> odds = game_odds(Killer())
    >>> odds
    <GameOdds: player 1 wins 0.5714, player 2 wins 0.2857, player 3 wins 0.1429>
    >>> odds.length.mean, odds.length.quantile(0.9)
    (2.0, 4)
    >>> odds.to_frame().head(4)
    outcome       1     2      3  no winner
    moves
    1        0.5000  0.00  0.000        0.0
    2        0.0000  0.25  0.000        0.0
    3        0.0000  0.00  0.125        0.0
    4        0.0625  0.00  0.000        0.0
    """
    tail = number_probability(tail, "tail")
    ends = ends_of_game(game, start)
    players = sorted(player for player in ends.by_winner if player is not None)
    times = [ends.reached(ends.by_winner.get(outcome, [])) for outcome in (*players, None)]
    over = ends.reached([state for states in ends.by_winner.values() for state in states])
    length = _length(over, bounded=_is_bounded(ends), tail=tail)
    by_length = np.zeros((len(times), length.span + 1))
    for row, time in zip(by_length, times, strict=True):
        if time is not None:
            law, _ = time.distribution(tail=0.0, max_steps=length.span)
            row[: len(law)] = law
    chances = [0.0 if time is None else min(time.p_reached, 1.0) for time in times]
    return GameOdds(
        dict(zip(players, chances, strict=False)),
        chances[-1],
        length.p_never_ends,
        length,
        by_length[:, length.games[0] :],
    )


def _length(
    over: PassageTime | None, *, bounded: bool, tail: float
) -> MatchLength[float, float | None]:
    """Return the distribution of the number of moves until the game is over; None if endless."""
    if over is None:
        return MatchLength(np.arange(1), np.zeros(1), None, None, 1.0, 0.0, bounded=True)
    law, left = over.distribution(tail=0.0 if bounded else tail, max_steps=_LONGEST)
    first = int(law.astype(bool).argmax())
    return MatchLength(
        games=np.arange(first, len(law)),
        probability=law[first:],
        mean=over.mean,
        sd=None if over.variance is None else over.variance**0.5,
        p_never_ends=over.p_never,
        tail_mass=left,
        bounded=bounded,
    )


def _is_bounded(ends: Ends) -> bool:
    """Return whether the game has a longest possible length."""
    structure = ends.chain.structure
    return structure.is_acyclic and not (structure.loops & ~structure.recurrent).any()
