"""Who wins a game and when, for any game and any number of players."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import number_probability
from evenbreak.matches.length_law import MatchLength
from evenbreak.matches.own_games import Ends, ends_of_game

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    from evenbreak.chains.passage_times import PassageTime
    from evenbreak.game import Game

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
        P(the game goes on for ever).
    length
        how many moves the game takes, whoever wins; its `games` are numbers of moves.
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
        """Return P(each outcome after exactly so many moves): a row for each number of moves."""
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
        the state now; None: the start of the game.
    tail
        how much probability may be left out of the law of the length if there is no longest
        length. It is cut off after 100,000 moves in any case.

    Raises
    ------
    InputError
        if `game` is not a game, or `tail` is not a probability.
    GameError
        if a winner is not the number of a player, somebody has won in a state that has moves,
        or a probability is not one.
    ChainError
        if the probabilities of a state do not sum to 1, or the start is unknown.

    Notes
    -----
    Chances, mean and standard deviation come from the absorbing chain of the game, not from
    the law of the length. Source: Kemeny & Snell, Finite Markov Chains, chapter III.

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
    """Return the law of the number of moves until the game is over; None: it never is."""
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
