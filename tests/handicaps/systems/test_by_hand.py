"""Systems that look at all results, beside the obvious loop over one league's matches."""

import math

import numpy as np
import pytest

from evenbreak.handicaps import system_of
from evenbreak.handicaps.systems.laws import played_nights
from evenbreak.matches import race_win_probability

LEVELS = (2, 3, 4, 5, 6, 7)


def seen(history, replica):
    """Return each player's matches in order: (night, levels, games, innings, won)."""
    one = history.one(replica).matches
    of_player = [[] for _ in range(history.players)]
    for row in np.flatnonzero(one.played).tolist():
        sides = ("a", "b") if one.won_a[row] else ("b", "a")
        for mine, other in (sides, sides[::-1]):
            of = {side: getattr(one, side)[row] for side in "ab"}
            of_player[of[mine]].append(
                (
                    int(one.night[row]),
                    float(getattr(one, f"rating_{mine}")[row]),
                    float(getattr(one, f"rating_{other}")[row]),
                    int(getattr(one, f"score_{mine}")[row]),
                    int(getattr(one, f"score_{other}")[row]),
                    int(getattr(one, f"innings_{mine}")[row]),
                    mine == sides[0],
                )
            )
    return of_player


def reviewed(matches, level, start, past, *, innings):
    """Return a level after a night, by the rules of `tap-like`, or else of `apa-like`."""
    window = 20 if innings else 21
    share = sum(match[6] for match in matches[-window:]) / max(len(matches[-window:]), 1)
    scores = []
    for _, own, opponent, won, lost, taken, victory in matches:
        if innings:
            score = min(taken / won, 10.0) if won else 10.0
            if victory:
                tenth = math.floor(10 * share + 1e-9)
                within = 1.1 + 0.1 * min(max(9 - tenth, 0), 8)
                score = min(score, 7.0 if level <= 2 else within + 7 - level)
        else:
            performance = opponent + math.log2((won + 0.5) / (lost + 0.5)) / 0.74
            score = 0.8 * performance + 0.2 * (own + (1 if victory else -1))
        scores.append(score)
    usual = {2: 8.5, 3: 6.0, 4: 4.5, 5: 3.5, 6: 2.5, 7: 1.5}[start] if innings else start
    counted = ([usual] * past + scores)[-window:]
    if innings:
        many = 2 if len(counted) == 2 else math.ceil(len(counted) / 2)
        mean = sum(sorted(counted)[:many]) / many
        goal = next(
            (k for k, top in zip((7, 6, 5, 4, 3), (2, 3, 4, 5, 7), strict=True) if mean <= top), 2
        )
    else:
        counted.sort()
        counted = counted[1:-1] if len(counted) > 2 else counted
        mean = sum(counted) / len(counted)
        up, down = math.floor(mean - 0.33 + 0.5), math.floor(mean + 0.33 + 0.5)
        goal = up if up > level else down if down < level else level
    peak = max(start, level, *(match[1] for match in matches))
    new = max(min(max(goal, level - 1), level + 1), min(peak - 2, level))
    return min(max(new, 2), 7)


@pytest.mark.parametrize("name", ["tap-like", "apa-like"])
def test_levels_are_reviewed_as_by_hand(name):
    moved, system = 0, system_of(name)
    nights = [
        night for seed in range(6) for night in played_nights(system, np.random.default_rng(seed))
    ]
    for history, levels in nights:
        for replica in range(levels.shape[1]):
            for player, matches in enumerate(seen(history, replica)):
                level, start = history.ratings[player, replica], history.initial[player, replica]
                many = int(history.entries.matches[player, replica])
                expected = level
                if matches and matches[-1][0] == history.night:
                    past = 21 if many < 0 else many
                    expected = reviewed(matches, level, start, past, innings=name == "apa-like")
                assert levels[player, replica] == expected
                moved += expected != level
    assert moved > 5


def test_averages_and_percentages_are_those_of_a_loop():
    for name, highest in (("averages", 10.0), ("win-percent window=12", 100.0)):
        system = system_of(name)
        for history, numbers in played_nights(system, np.random.default_rng(5)):
            for replica in range(numbers.shape[1]):
                for player, matches in enumerate(seen(history, replica)):
                    stated = history.entries.rating[player, replica] <= highest
                    games = int(history.entries.games[player, replica])
                    before = (50 if games < 0 else games) * bool(stated)
                    start = history.initial[player, replica]
                    if name == "averages":
                        points = sum(10.0 * match[3] + 3.8 * match[4] for match in matches)
                        played = sum(match[3] + match[4] for match in matches)
                    else:
                        points = played = 0.0
                        for match in reversed(matches):
                            games = match[3] + match[4]
                            counted = min(games, 12.0 - played)
                            points += 100.0 * match[3] * counted / games
                            played += counted
                        before = min(before, 12.0 - played)
                    all_games = played + before
                    expected = (points + before * start) / all_games if all_games else start
                    assert numbers[player, replica] == pytest.approx(expected)


def test_napa_like_ratings_are_those_of_a_loop():
    for history, ratings in played_nights(system_of("napa-like"), np.random.default_rng(6)):
        for replica in range(ratings.shape[1]):
            one = history.one(replica)
            expected = one.ratings.copy()
            before = one.matches_before
            night = one.tonight
            for row in np.flatnonzero(night.played):
                p = 1.0 / (1.0 + 2.0 ** ((night.rating_b[row] - night.rating_a[row]) / 30.0))
                wins = float(race_win_probability(p, night.race_a[row], night.race_b[row]))
                points = 6.0 * (float(night.won_a[row]) - wins)
                for who, moved in ((night.a[row], points), (night.b[row], -points)):
                    expected[who] += moved * (2.0 if before[who] < 12 else 1.0)
            np.testing.assert_allclose(ratings[:, replica], np.maximum(expected, 0.0))
