"""Team nights by skill level: published match points, and game trees played out pick by pick."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_chart import LevelChart, level_chart, points_chart
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES
from evenbreak.teams.meeting import Meeting
from evenbreak.teams.set_laws import Points, Shares, law_in_play, set_laws, set_lengths
from evenbreak.teams.solve import solved
from evenbreak.teams.squad import Squad, caps_of
from rows import each_of

EIGHT, NINE = level_chart("apa_8ball"), points_chart("apa_9ball")
SKILLS = level_skills(EIGHT)
NOBODY = [np.nan]

MEAN_POINTS = {
    (7, 6): (1.50, 0.89),
    (7, 5): (1.60, 0.92),
    (7, 4): (1.78, 0.99),
    (7, 3): (2.15, 0.72),
    (7, 2): (2.23, 0.68),
    (6, 5): (1.42, 0.96),
    (6, 4): (1.49, 1.00),
    (6, 3): (1.80, 1.00),
    (6, 2): (2.31, 0.63),
    (5, 4): (1.33, 1.22),
    (5, 3): (1.53, 1.23),
    (5, 2): (2.03, 0.81),
    (4, 3): (1.48, 1.35),
    (4, 2): (1.86, 0.98),
    (3, 2): (1.63, 1.23),
}
"""The mean match points of some 40,000 APA 8-ball matches of one region, by the two levels."""


def team(*levels: float, names: str = "abcdefghi") -> Roster:
    return Roster(list(names[: len(levels)]), NOBODY * len(levels), level=levels)


def lead_of(law: np.ndarray) -> np.ndarray:
    """Return P(the set adds k - reach to our lead)."""
    return law.sum(axis=0)


@pytest.mark.parametrize("pair", MEAN_POINTS)
def test_the_lead_that_a_set_adds_is_that_of_real_matches(pair: tuple[int, int]) -> None:
    """Either mean is within .021 of the fit, so the difference within .042."""
    law = set_laws(team(pair[0]), team(pair[1]), EIGHT, count=Points(), levels=SKILLS)[0, 0]
    mean = float(lead_of(law) @ np.arange(-3, 4))
    higher, lower = MEAN_POINTS[pair]
    assert mean == pytest.approx(higher - lower, abs=0.042)


def rack_by_rack(p: float, m: int, n: int, count: object) -> dict[int, float]:
    """Return the law of the lead after a race, by playing every rack."""
    found: dict[int, float] = {}

    def play(a: int, b: int, chance: float) -> None:
        if a < m and b < n:
            play(a + 1, b, chance * p)
            play(a, b + 1, chance * (1.0 - p))
            return
        if count == "sets":
            lead = 1 if a == m else -1
        elif count == "games":
            lead = a - b
        elif a == m:
            lead = 3 if b == 0 else 2 - (b == n - 1)
        else:
            lead = -3 if a == 0 else -2 + (a == m - 1)
        found[lead] = found.get(lead, 0.0) + chance

    play(0, 0, 1.0)
    return found


@each_of("count", ["sets", "games", Points()])
def test_a_set_by_level_is_played_rack_by_rack(count: object) -> None:
    law = set_laws(team(6, 4, 2), team(7, 3), EIGHT, count=count, levels=SKILLS)  # type: ignore[arg-type]
    for (i, mine), (j, other) in itertools.product(enumerate((6, 4, 2)), enumerate((7, 3))):
        p = averaged = SKILLS.chance(mine, other)
        m, n = EIGHT.race(mine, other)
        nodes, weights = np.polynomial.hermite_e.hermegauss(40)
        gap, off = SKILLS.difference(mine, other), SKILLS.error(mine, other)
        wanted: dict[int, float] = {}
        for node, weight in zip(nodes, weights / weights.sum(), strict=True):
            p = 1.0 / (1.0 + 2.0 ** (-(gap + node * off) / 100.0))
            for lead, chance in rack_by_rack(p, m, n, count).items():
                wanted[lead] = wanted.get(lead, 0.0) + weight * chance
        reach = law.shape[3] // 2
        assert averaged == pytest.approx(1.0 / (1.0 + 2.0 ** (-gap / 100.0)))
        for lead, chance in wanted.items():
            assert lead_of(law[i, j])[reach + lead] == pytest.approx(chance, abs=1e-9)


def shared(levels: tuple[int, int]) -> np.ndarray:
    """Return the law of the lead of an APA 9-ball set, by another route: shot by shot."""
    needs = NINE.race(*levels)
    p = np.array([need / (25.0 + need) for need in needs])
    shape = needs[0] + 1, needs[1] + 1, 2
    reach = np.zeros(shape)  # how often the state with this turn is come to
    reach[needs[0], needs[1]] = 0.5
    ends: dict[tuple[int, int], float] = {}
    for total in range(sum(needs), 0, -1):
        for a in range(max(1, total - needs[1]), min(needs[0], total - 1) + 1):
            b = total - a
            first, second = reach[a, b]
            q = 1.0 - p
            # Misses pass the turn on; the visits of either side form a geometric sum.
            visits = np.array([first + q[1] * second, second + q[0] * first]) / (1.0 - q[0] * q[1])
            for turn, (da, db) in enumerate(((1, 0), (0, 1))):
                chance = visits[turn] * p[turn]
                if (a - da) == 0 or (b - db) == 0:
                    loser = 1 - turn
                    made = needs[loser] - (a, b)[loser]
                    ends[turn, made] = ends.get((turn, made), 0.0) + chance
                else:
                    reach[a - da, b - db, turn] += chance
    law = np.zeros(41)
    for (winner, made), chance in ends.items():
        share = next(k for k, most in enumerate(LIMITS[levels[1 - winner]]) if made <= most)
        law[20 + (20 - 2 * share) * (1 if winner == 0 else -1)] += chance
    return law


LIMITS = {
    1: (2, 3, 4, 6, 7, 8, 10, 11, 13),
    3: (4, 6, 9, 11, 14, 16, 19, 21, 24),
    5: (6, 10, 14, 18, 22, 26, 29, 33, 37),
    9: (17, 24, 31, 38, 46, 53, 60, 67, 74),
}
"""The largest points of a loser for each share of the 20, by level (the score sheet's table)."""


@each_of("levels", [(1, 3), (5, 5), (9, 1)])
def test_shares_of_twenty_are_those_of_the_match_shot_by_shot(levels: tuple[int, int]) -> None:
    law = set_laws(team(levels[0]), team(levels[1]), NINE, count=Shares())[0, 0]
    assert lead_of(law) == pytest.approx(shared(levels), abs=1e-10)


def by_tree(laws, line_ups, order, lead, used):
    """The value of a night by every pick, where a lineup must be one of those allowed."""
    k = len(used[0])
    if k == len(order):
        return 1.0 if lead > 0 else 0.5 if lead == 0 else 0.0

    def able(side: int) -> list[int]:
        so_far = set(used[side])
        return sorted({p for one in line_ups[side] if so_far <= one for p in one - so_far})

    def value(i: int, j: int) -> float:
        law = lead_of(laws[i, j])
        reach = len(law) // 2
        after = (*used[0], i), (*used[1], j)
        return sum(
            chance * by_tree(laws, line_ups, order, lead + at - reach, after)
            for at, chance in enumerate(law)
            if chance
        )

    if order[k] == "A":
        return max(min(value(i, j) for j in able(1)) for i in able(0))
    return min(max(value(i, j) for i in able(0)) for j in able(1))


@pytest.mark.parametrize(
    ("race", "count"),
    [
        (EIGHT, "sets"),
        (EIGHT, Points()),
        (NINE, "sets"),
        pytest.param(NINE, Shares(), marks=pytest.mark.slow),
    ],
)
def test_a_night_under_the_caps_equals_the_whole_game_tree(race, count) -> None:
    """Three of four, levels of 12 at most and one player of level 6 or more."""
    ours, theirs = (7, 6, 3, 2), (6, 4, 4, 2)
    cap, at_most, order = 13, (1, 6), "ABA"
    squads, line_ups = [], []
    for levels in (ours, theirs):
        squads.append(Squad(tuple("abcd"), caps_of(levels, cap, at_most)))
        kept = [
            frozenset(one)
            for one in itertools.combinations(range(4), 3)
            if sum(levels[k] for k in one) <= cap and sum(levels[k] >= 6 for k in one) <= 1
        ]
        assert 0 < len(kept) < 4
        line_ups.append(kept)
    levels = SKILLS if race is EIGHT else None
    fargo = SCALES["fargo"]
    meeting = Meeting(
        team(*ours),
        team(*theirs),
        tuple(squads),
        race,
        fargo,
        (1,) * 3,
        order,
        count,
        levels=levels,
    )
    night = meeting.night()
    wanted = by_tree(night.laws[0], line_ups, order, 0, ((), ()))
    assert solved(night).value == pytest.approx(wanted, abs=1e-12)


@each_of("race", [EIGHT, NINE])
def test_a_set_in_play_goes_on_from_its_score(race) -> None:
    count = Points() if race is EIGHT else Shares()
    asked = {"count": count, "levels": SKILLS if race is EIGHT else None}
    ours, theirs = team(5), team(4)
    begun = law_in_play(ours, theirs, race, (0, 0), **asked)
    assert begun == pytest.approx(set_laws(ours, theirs, race, **asked)[0, 0], abs=1e-12)
    m, n = race.race(5, 4)
    for score, low, high in (((m - 1, 0), 0.6, 1.0), ((0, n - 1), 0.0, 0.4)):
        won = law_in_play(ours, theirs, race, score, **asked).sum(axis=1)
        assert won.sum() == pytest.approx(1.0)
        assert low < won[0] < high


def test_a_pair_has_the_mean_level_rounded_up_and_the_mean_strength() -> None:
    laws = set_laws(team(5, 4), team(3, 3), EIGHT, size=2, levels=SKILLS)
    gap = np.mean([SKILLS.difference(a, 3) for a in (5, 4)])
    off = np.mean([SKILLS.error(a, 3) for a in (5, 4)])
    as_rated = set_laws(Roster(["x"], [gap], [off]), Roster(["y"], [0.0]), two_races(5, 3))
    assert laws == pytest.approx(as_rated, abs=1e-9)


def two_races(high: int, low: int):
    """Return a chart of rating differences that plays the race of two levels at every gap."""
    from evenbreak.handicaps.charts.chart import Chart

    m, n = EIGHT.race(high, low)
    return Chart("one", [(0, 0, m, m), (1, None, m, n)])


def test_levels_give_the_race_and_ratings_the_chance_where_there_are_ratings() -> None:
    ours = Roster(["a"], [600.0], level=[6])
    theirs = Roster(["b"], [500.0], level=[3])
    law = set_laws(ours, theirs, EIGHT)
    m, n = EIGHT.race(6, 3)
    leads = rack_by_rack(2 / 3, m, n, "sets")
    assert law[0, 0, 0].sum() == pytest.approx(leads[1])


def test_nine_ball_sets_last_as_many_racks_as_their_points_fill() -> None:
    law = set_lengths(team(5), team(3), NINE)[0, 0]
    assert law.sum() == pytest.approx(1.0)
    racks = np.flatnonzero(law > 0)
    assert racks.min() == 3  # 25 to 0
    assert racks.max() == 7  # 38 to 24, or 37 to 25
    assert 4.0 < float(law @ np.arange(len(law))) < 6.0


@pytest.mark.parametrize(
    ("ours", "race", "count", "words"),
    [
        (team(np.nan), EIGHT, "sets", "no skill level"),
        (team(8), EIGHT, "sets", "skill level 8, but apa_8ball has levels 2, 3"),
        (team(5), NINE, "games", "points, not games"),
        (team(5), NINE, Points(), "count_by"),
        (team(5), LevelChart("own", [5, 6], [[3, 3], [4, 4]]), Shares(), "count_by"),
    ],
)
def test_what_cannot_be_played_is_refused(ours, race, count, words) -> None:
    levels = level_skills(race) if isinstance(race, LevelChart) else None
    with pytest.raises(InputError, match=words):
        set_laws(ours, team(5), race, count=count, levels=levels)
