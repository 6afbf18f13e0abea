"""The rules of our league: a handicap system, a chart of races, and a game."""

from dataclasses import dataclass

import numpy as np

from evenbreak.handicaps import Chart, System


class LastTen(System):
    """Everyone's number is the percentage of games won in their last ten matches."""

    name = "last ten"
    in_words = "percent of the games of the last ten matches; a game for every 15 points"
    asks = ("games",)

    def initial(self, entries):
        """Start with the number on the list, and newcomers with 50."""
        return np.where(np.isnan(entries.rating), 50.0, entries.rating)

    def race(self, a, b):
        """Race to 5; the better player gives a game for every 15 points, 3 at most."""
        a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
        fewer = 5 - np.minimum(np.abs(a - b) // 15, 3).astype(int)
        return np.where(a >= b, 5, fewer), np.where(a >= b, fewer, 5)

    def update(self, history):
        """Publish the new percentages; players who haven't played keep theirs."""
        won = np.nan_to_num(history.last(10, "won", lambda match: match.score_a)).sum(axis=0)
        lost = np.nan_to_num(history.last(10, "lost", lambda match: match.score_b)).sum(axis=0)
        games = won + lost
        return np.where(games > 0, 100.0 * won / np.maximum(games, 1), history.ratings)


HOUSE = Chart("fargo_house", [(0, 39, 5, 5), (40, 89, 5, 4), (90, 149, 6, 4), (150, None, 5, 3)])


@dataclass(frozen=True)
class TwoInARow:
    """Whoever first wins two racks in a row wins; `p` is player 1's chance in a rack."""

    p: float = 0.6
    start = "even"

    def moves(self, state):
        """Return the chance of each next state: who won the last rack, or both of the last two."""
        if state in ("1 wins", "2 wins"):
            return {}
        return {
            "1 wins" if state == "1 leads" else "1 leads": self.p,
            "2 wins" if state == "2 leads" else "2 leads": 1.0 - self.p,
        }

    def winner(self, state):
        """Return who has won, if anyone."""
        return {"1 wins": 1, "2 wins": 2}.get(state)
