"""Who plays whom in a season: every two teams, round by round."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from evenbreak.arrays import Ints
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.league.schedule import RoundRobin


def circle(teams: int, times: int = 1) -> Ints:
    """Return a schedule in which every two teams meet, round by round: home, away.

    Parameters
    ----------
    teams
        how many teams there are.
    times
        how often every two meet; home and away change from one time to the next.

    Notes
    -----
    The circle method: one team stays, the others move on by a place each round.

    >>> circle(4).tolist()
    [[0, 3], [2, 1], [1, 0], [3, 2], [0, 2], [1, 3]]
    """
    order = RoundRobin(whole(teams, "teams", at_least=2))
    rounds = teams - 1 + teams % 2
    rows: list[tuple[int, int]] = []
    for time in range(whole(times, "times", at_least=1)):
        for week in range(1, rounds + 1):
            ((a, b),) = order.pairs(week, np.random.default_rng(0), teams)
            for k, (x, y) in enumerate(zip(a.tolist(), b.tolist(), strict=True)):
                # The team that stays is home every other round; the others by where they sit.
                turned = week % 2 == 0 if 0 in (x, y) else k % 2 == 1
                rows.append((y, x) if turned != (time % 2 == 1) else (x, y))
    return np.array(rows, dtype=np.int64)


def still_to_play(teams: Sequence[str], times: int, played: Ints) -> Ints:
    """Return the matches of a round robin that have not been played yet: home, away.

    Parameters
    ----------
    teams
        their names.
    times
        how often every two meet.
    played
        the matches played: home, away. Who was home does not matter.

    Raises
    ------
    InputError
        if two teams have met more often than `times`.

    >>> still_to_play(["Acers", "Bankers", "Caroms"], 1, np.array([[1, 0]])).tolist()
    [[1, 2], [0, 2]]
    """
    met = Counter(tuple(sorted(pair)) for pair in played[:, :2].tolist())
    for pair, many in met.items():
        if many > times:
            raise InputError(
                "{team} and {team_2} have met {many} times, more than the {times} of this "
                "round robin",
                team=teams[pair[0]],
                team_2=teams[pair[1]],
                many=many,
                times=times,
            )
    left = []
    for home, away in circle(len(teams), times).tolist():
        pair = min(home, away), max(home, away)
        if met[pair]:
            met[pair] -= 1
        else:
            left.append((home, away))
    return np.array(left, dtype=np.int64).reshape(-1, 2)
