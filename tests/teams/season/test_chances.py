"""Final places against every ending played out, exact against simulated, laws of a table."""

import itertools
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.league import TableRules
from evenbreak.teams import TeamSeason, score_chances, scores_of, season_chances

NAMES = ["Acers", "Bankers", "Caroms", "Diamonds"]
PLAYED = [[0, 1, 3, 2], [2, 3, 5, 0], [1, 2, 2, 3], [3, 0, 1, 4]]
TO_COME = [[0, 2], [1, 3], [3, 1]]


def season(ties: tuple[str, ...] = ("difference", "scored"), **more) -> TeamSeason:
    skills = np.array([[0.4, 0.1, -0.2, -0.3], [0.0, 0.3, 0.1, -0.4]])
    left = np.array(TO_COME)
    chances = score_chances(skills, left, scores_of(sets=5))
    rules = TableRules(ties=ties)
    return TeamSeason(NAMES, PLAYED, left, scores_of(sets=5), chances, rules=rules, **more)


def by_hand(asked: TeamSeason) -> np.ndarray:
    """P(each place) by going through every ending, in plain Python; lots share places."""
    found = np.zeros((4, 4))
    scores = asked.scores.tolist()
    for ends in itertools.product(range(len(scores)), repeat=len(TO_COME)):
        weight = np.mean(
            [np.prod([layer[k, end] for k, end in enumerate(ends)]) for layer in asked.chances]
        )
        rows = PLAYED + [[*pair, *scores[end]] for pair, end in zip(TO_COME, ends, strict=True)]
        keys = [_key(asked.rules, team, rows) for team in range(4)]
        if "head-to-head" in asked.rules.ties:
            level = [[t for t in range(4) if keys[t] == keys[team]] for team in range(4)]
            keys = [(*keys[team], _met(asked.rules, team, rows, level[team])) for team in range(4)]
        for team in range(4):
            ahead = sum(key > keys[team] for key in keys)
            many = keys.count(keys[team])
            found[team, ahead : ahead + many] += weight / many
    return found


def _points(rules: TableRules, team: int, rows: list[list[int]]) -> float:
    total = 0.0
    for home, away, a, b in rows:
        gain = rules.points(a, b)
        total += gain[0] * (home == team) + gain[1] * (away == team)
    return total


def _met(rules: TableRules, team: int, rows: list[list[int]], level: list[int]) -> float:
    """The points of the meetings of those who are level, if all met equally often."""
    rows = [row for row in rows if {*row[:2]} <= {*level}]
    met = [{*row[:2]} for row in rows]
    often = {met.count({a, b}) for a, b in itertools.combinations(level, 2)}
    return _points(rules, team, rows) if len(often) == 1 else 0.0


def _key(rules: TableRules, team: int, rows: list[list[int]]) -> tuple[float, ...]:
    won = sum(a * (home == team) + b * (away == team) for home, away, a, b in rows)
    lost = sum(b * (home == team) + a * (away == team) for home, away, a, b in rows)
    of = {"difference": won - lost, "scored": won}
    return _points(rules, team, rows), *(of[tie] for tie in rules.ties if tie in of)


@pytest.mark.slow
@pytest.mark.parametrize("ties", [("difference", "scored"), (), ("head-to-head",)])
def test_places_equal_every_ending_played_out(ties: tuple[str, ...]) -> None:
    asked = season(ties)
    found = season_chances(asked)
    assert found.exact
    assert found.p_place == pytest.approx(by_hand(asked), abs=1e-12)


def test_places_and_teams_sum_to_one() -> None:
    found = season_chances(season(), places=(1, 2), matches=(0, 1, 2))
    assert found.p_place.sum(axis=0) == pytest.approx(np.ones(4))
    assert found.p_place.sum(axis=1) == pytest.approx(np.ones(4))
    # Total probability over how a match ends.
    total = np.nansum(found.p_result[:, :, None] * found.p_if[1], axis=1)
    assert total == pytest.approx(np.tile(found.p_first(2), (3, 1)))


def test_simulated_seasons_come_near_the_exact_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    exact = season_chances(season())
    monkeypatch.setattr("evenbreak.teams.season.chances.MOST_ENDINGS", 0)
    drawn = season_chances(season(), seasons=20_000, seed=5)
    assert not drawn.exact
    assert np.abs(drawn.p_place - exact.p_place).max() < 5.0 * 0.5 / np.sqrt(20_000)
    with ThreadPoolExecutor(2) as pool:
        other = season_chances(season(), seasons=20_000, seed=5, executor=pool)
    assert np.array_equal(other.p_place, drawn.p_place)


def test_two_equal_teams_with_a_match_to_come() -> None:
    asked = TeamSeason(["A", "B"], [], [[0, 1]], scores_of(sets=2), [[0.25, 0.5, 0.25]])
    assert season_chances(asked).p_place.tolist() == [[0.5, 0.5], [0.5, 0.5]]


def test_points_to_be_sure_is_what_no_ending_can_take_away() -> None:
    asked = season()
    found = season_chances(asked)
    for places in (1, 2, 3):
        sure = asked.points_to_be_sure(places)
        for team in range(4):
            if sure[team] == 0.0:
                assert found.p_first(places)[team] == pytest.approx(1.0)
            if found.p_first(places)[team] < 1.0 - 1e-12:
                assert sure[team] != 0.0


def test_a_deduction_counts() -> None:
    free = season_chances(season()).p_first(1)[0]
    docked = season_chances(season(head_start=[-4, 0, 0, 0])).p_first(1)[0]
    assert docked < free


def test_exact_chances_are_fractions_where_the_sets_are_even() -> None:
    asked = TeamSeason(
        ["A", "B", "C"], [[0, 1, 2, 1]], [[0, 2], [1, 2]], scores_of(race=2), np.full((2, 4), 0.25)
    )
    exact = by_fractions()
    assert season_chances(asked).p_first(1) == pytest.approx([float(p) for p in exact], abs=1e-15)


def by_fractions() -> list[Fraction]:
    """A beat B 2:1; A:C and B:C end 2:0, 2:1, 1:2 or 0:2 alike likely; points, difference, sets."""
    title = [Fraction(0)] * 3
    ends = [(0, 2), (1, 2), (2, 1), (2, 0)]
    for (a, c1), (b, c2) in itertools.product(ends, ends):
        points = [2 + 2 * (a > c1), 2 * (b > c2), 2 * (c1 > a) + 2 * (c2 > b)]
        won = [2 + a, 1 + b, c1 + c2]
        lost = [1 + c1, 2 + c2, a + b]
        keys = [(points[t], won[t] - lost[t], won[t]) for t in range(3)]
        best = [t for t in range(3) if keys[t] == max(keys)]
        for t in best:
            title[t] += Fraction(1, 16 * len(best))
    return title


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(InputError, match="A loss can't be worth more"):
        TableRules(win=1, draw=2)
    with pytest.raises(InputError, match="plays itself"):
        TeamSeason(["A", "B"], [[1, 1, 3, 2]], [], [[1, 0]], np.zeros((0, 1)))
    with pytest.raises(InputError, match="add up to 1"):
        TeamSeason(["A", "B"], [], [[0, 1]], [[1, 0], [0, 1]], [[0.5, 0.6]])
    with pytest.raises(InputError, match="places must be from 1 to 4"):
        season_chances(season(), places=(5,))
