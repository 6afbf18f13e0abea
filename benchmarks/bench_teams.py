"""Team nights beside a memoised game tree, and a season beside drawing its random numbers."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from evenbreak.teams import (
    Cap,
    Squad,
    TeamNight,
    TeamSeason,
    circle,
    score_chances,
    scores_of,
    season_chances,
    solved,
)

Beside = Callable[..., float]
DRAW = np.random.default_rng(1)


def squad(players: int, team: str, *caps: Cap) -> Squad:
    return Squad(tuple(f"{team}{k}" for k in range(players)), caps)


def chances(players: int) -> np.ndarray:
    ours, theirs = DRAW.normal(0.0, 1.0, (2, players))
    return np.asarray(1.0 / (1.0 + np.exp(theirs - ours[:, None])))


def law(win: np.ndarray) -> np.ndarray:
    found = np.zeros((*win.shape, 2, 3))
    found[..., 0, 2], found[..., 1, 0] = win, 1.0 - win
    return found


def game_tree(win: np.ndarray, sets: int) -> float:
    """Return the value of a night with picks in turn, from a dictionary of its points."""
    p = win.tolist()

    @cache
    def value(mine: frozenset[int], others: frozenset[int], lead: int) -> float:
        left = sets - (len(p) - len(mine))
        if abs(lead) > left or left == 0:
            return 1.0 if lead > 0 else 0.0 if lead < 0 else 0.5

        def after(i: int, j: int) -> float:
            rest = mine - {i}, others - {j}
            return float(
                p[i][j] * value(*rest, lead + 1) + (1.0 - p[i][j]) * value(*rest, lead - 1)
            )

        if (sets - left) % 2 == 0:
            return max(min(after(i, j) for j in others) for i in mine)
        return min(max(after(i, j) for i in mine) for j in others)

    everybody = frozenset(range(len(p)))
    return value(everybody, everybody, 0)


@pytest.mark.parametrize("players", [5, 8])
def test_a_night_in_turn(beside: Beside, players: int) -> None:
    win = chances(players)
    night = TeamNight(squad(players, "a"), squad(players, "b"), law(win), sets=5)
    off = abs(solved(night).value - game_tree(win, 5))
    beside(
        f"{players} players a side, 5 sets in turn / game tree in a dictionary",
        lambda: solved(night).value,
        lambda: game_tree(win, 5),
        rounds=5,
        note=f"difference {off:.0e}",
    )


def test_eight_players_unseen_under_a_cap(beside: Beside) -> None:
    levels = (7.0, 6.0, 5.0, 5.0, 4.0, 4.0, 3.0, 2.0)
    win = chances(8)
    capped = [squad(8, team, Cap(levels, 23.0)) for team in "ab"]
    unseen, in_turn = (
        TeamNight(capped[0], capped[1], law(win), sets=5, order=order)
        for order in ("blind", "alternate")
    )
    beside(
        "8 players, 5 sets unseen, 23-rule / the same in turn",
        lambda: solved(unseen).value,
        lambda: solved(in_turn).value,
        rounds=5,
    )


def test_a_season_of_forty_teams(beside: Beside) -> None:
    teams, seasons = 40, 100_000
    rows = circle(teams, 2)
    half = len(rows) // 2
    won = DRAW.integers(0, 6, half)
    played = np.column_stack([rows[:half], won, 5 - won])
    law = score_chances(DRAW.normal(0.0, 0.4, (1, teams)), rows[half:], scores_of(sets=5))
    names = [f"team {k}" for k in range(teams)]
    season = TeamSeason(names, played, rows[half:], scores_of(sets=5), law)

    def bare() -> float:
        rng = np.random.default_rng(1)
        return sum(float(rng.random(seasons)[0]) for _ in range(len(rows) - half))

    beside(
        "40 teams, 780 matches to come, 100,000 seasons / their random numbers",
        lambda: season_chances(season, seasons=seasons),
        bare,
        rounds=1,
    )
