"""What a system sees of a league: sums and last scores of each player, kept or counted anew."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import System, step_after, system_of, updated
from evenbreak.handicaps.systems.by_match import PlayedMatch
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.handicaps.systems.system import checked_races

PLAYERS, REPLICAS, NIGHTS = 6, 4, 5


def played_league(system, rng, nights=NIGHTS, kept=None):
    """Yield the histories of a small league, whose matches a coin decides."""
    shape = PLAYERS, REPLICAS
    entries = Entries.of(
        rng.integers(60, 100, shape).astype(float), matches=rng.integers(-1, 14, PLAYERS)
    )
    initial = ratings = system.initial(entries)
    columns = [[] for _ in range(9)]
    for night in range(1, nights + 1):
        for _ in range(3):
            pairs = np.array([rng.permutation(PLAYERS)[:2] for _ in range(REPLICAS)]).T
            a, b = np.where(rng.random(REPLICAS) < 0.2, -1, pairs)
            of_a, of_b = (ratings[np.maximum(who, 0), np.arange(REPLICAS)] for who in (a, b))
            race_a, race_b = system.race(of_a, of_b)
            won = rng.random(REPLICAS) < 0.5
            score_a = np.where(won, race_a, rng.integers(0, race_a))
            score_b = np.where(won, rng.integers(0, race_b), race_b)
            row = (night, a, b, score_a, score_b, race_a, race_b, of_a, of_b)
            for column, value in zip(columns, row, strict=True):
                column.append(value)
        matches = Matches(*map(np.array, columns))
        history = History(
            entries, initial, ratings, night, matches, kept={} if kept is None else kept
        )
        yield history
        ratings = updated(system, history)


@pytest.mark.parametrize("name", ["npl", "step 2 1", "margin 3", "elo 8"])
def test_step_systems_move_as_their_rule_does_match_by_match(name):
    system, rng = system_of(name), np.random.default_rng(5)
    for history in played_league(system, rng):
        expected = history.ratings.copy()
        for place in range(REPLICAS):
            played = history.entries.matches.copy()
            matches = history.one(place).matches
            for row in np.flatnonzero(matches.played):
                turn = 1 if matches.won_a[row] else -1
                who = (matches.a[row], matches.b[row])[::turn]
                if matches.night[row] == history.night:
                    match = PlayedMatch(
                        (matches.rating_a[row], matches.rating_b[row])[::turn],
                        (matches.score_a[row], matches.score_b[row])[::turn],
                        (matches.race_a[row], matches.race_b[row])[::turn],
                    )
                    for player, points in zip(who, system.rule(match), strict=True):
                        many = None if played[player] < 0 else int(played[player])
                        expected[player, place] += points * step_after(many, system.newcomer_steps)
                for player in who:
                    played[player] += played[player] >= 0
        np.testing.assert_array_equal(updated(system, history), expected)


def test_sums_and_last_scores_are_those_of_a_loop_whether_kept_or_not():
    kept = {}
    for history in played_league(system_of("npl"), np.random.default_rng(2), kept=kept):
        fresh = History(history.entries, history.initial, history.ratings, history.night,
                        history.matches)  # fmt: skip
        scores = {}
        for place in range(REPLICAS):
            one = history.one(place).matches
            for row in np.flatnonzero(one.played):
                for who, won in ((one.a, one.score_a), (one.b, one.score_b)):
                    scores.setdefault((who[row], place), []).append(won[row])
        for of in (history, fresh):
            sums = of.counts("won", lambda matches: matches.score_a)
            last = of.last(3, "scores", lambda matches: matches.score_a)
            for player in range(PLAYERS):
                for place in range(REPLICAS):
                    mine = scores.get((player, place), [])
                    assert sums[player, place] == sum(mine)
                    shown = last[:, player, place]
                    newest = mine[::-1][:3]
                    assert shown[: len(newest)].tolist() == newest
                    assert np.isnan(shown[len(newest) :]).all()


class Own(System):
    name, vectorised = "own", False

    def initial(self, entries):
        return entries.rating

    def race(self, a, b):
        return np.full(np.shape(a - b), 5), np.full(np.shape(a - b), 5)

    def update(self, history):
        assert history.ratings.ndim == history.matches.a.ndim == 1
        return history.initial + history.counts("won", lambda matches: matches.won_a)


def test_a_system_of_one_league_at_a_time_is_asked_for_each_replica():
    for history in played_league(Own(), np.random.default_rng(3)):
        wins = history.counts("all", lambda matches: matches.won_a)
        np.testing.assert_array_equal(updated(Own(), history), history.initial + wins)


@pytest.mark.parametrize(
    ("returned", "message"),
    [
        ([1.0, 2.0], "returned an array of shape"),
        (np.full((6, 4), np.nan), "returned nan for player 1"),
    ],
)
def test_what_an_own_system_must_not_return_is_refused(returned, message):
    class Wrong(Own):
        vectorised = True

        def update(self, _):
            return returned

    history = next(played_league(Own(), np.random.default_rng(3)))
    with pytest.raises(InputError, match=message):
        updated(Wrong(), history)


@pytest.mark.parametrize("races", [5, (np.array([0]), np.array([5])), (np.array(5), np.array(5))])
def test_races_must_be_whole_games_for_each_pair(races):
    class Wrong(Own):
        def race(self, *_):
            return races

    with pytest.raises(InputError, match="in the system own, race returned"):
        checked_races(Wrong(), np.array([1.0]), np.array([2.0]))
