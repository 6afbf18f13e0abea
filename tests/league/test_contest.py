"""Systems side by side in one league: exact chains, an independent simulation, errors that hold."""

from __future__ import annotations

import random
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

from evenbreak.handicaps import EQUAL_SKILL, Ladder, StepSystem, in_step_law, system_of
from evenbreak.handicaps.systems.system import System
from evenbreak.league import (
    MEASURES,
    PARTS,
    Contest,
    LeaguePlayers,
    RandomPairing,
    World,
    estimate,
    play_systems,
)
from evenbreak.matches import race_win_probability
from evenbreak.ratings.scale import SCALES

NPL = SCALES["npl"]
SKILL = [110, 96, 84, 71, 60, 47]


def world_of(rating: Any, **options: Any) -> World:
    columns = {name: options.pop(name) for name in ("skill", "day_sd", "absence", "drift")
               if name in options}  # fmt: skip
    options = {"newcomers": 0.0, "sandbaggers": 0.0, "weeks": 20} | options
    return World(LeaguePlayers.of(rating, **columns), NPL, **options)


def off(found: float, exact: float, error: float) -> float:
    return abs(found - exact) / error


class InTurn(System):
    """A step system that takes one league at a time."""

    name, in_words, scale = "in turn", "as npl, one league after the other", NPL
    vectorised = False

    def __init__(self) -> None:
        self.npl: Any = system_of("step 1")

    def initial(self, entries: Any) -> Any:
        return self.npl.initial(entries)

    def race(self, a: Any, b: Any) -> Any:
        return self.npl.race(a, b)

    def update(self, history: Any) -> Any:
        assert history.ratings.ndim == 1
        return self.npl.update(history)


# Exact.


def exact_pair(system: StepSystem, gap: float, weeks: int) -> dict[str, Any]:
    """Follow the chain of the rating difference of two players, both rated alike at first."""
    span, p = np.arange(-weeks, weeks + 1), 1.0 / (1.0 + 2.0 ** (-gap / 30.0))
    races = [system.usual_chart().race(2 * int(d)) for d in span]  # a win is 2 points apart
    wins = np.array([race_win_probability(p, m, n) for m, n in races])
    law = np.zeros(len(span))
    law[weeks] = 1.0
    even, chance, errors = 0.0, 0.0, [(gap / 60.0) ** 2]
    for _ in range(weeks):
        even += law @ (np.maximum(wins, 1.0 - wins) <= 0.6)
        chance += law @ wins
        law = np.roll(law * wins, 1) + np.roll(law * (1.0 - wins), -1)
        errors.append(law @ (((2 * span - gap) / 60.0) ** 2))
    return {"p_even": even / weeks, "p_better_wins": chance / weeks, "errors": errors}


def pair_of() -> tuple[World, Contest, dict[str, Any]]:
    system = system_of("step 1")
    world = world_of([80, 80], skill=[95, 80], weeks=12)
    contest = play_systems(world, [system], replicas=4000, seed=3)
    return world, contest, exact_pair(system, 15.0, 12)


@pytest.fixture(scope="module")
def pair() -> tuple[World, Contest, dict[str, Any]]:
    return pair_of()


@pytest.mark.parametrize("measure", ["p_even", "p_better_wins"])
def test_two_players_follow_the_exact_chain_of_their_difference(measure: str, pair: Any) -> None:
    world, contest, exact = pair
    found = estimate(contest, MEASURES[measure], world)
    assert off(found.value[0], exact[measure], found.error[0]) < 4.0


def test_the_error_of_two_ratings_is_the_exact_one_after_every_week(pair: Any) -> None:
    world, contest, exact = pair
    found = estimate(contest, PARTS["error"], world)
    sd = np.sqrt(exact["errors"])
    assert (np.abs(found.value[0] - sd) <= 4.0 * found.error[0] + 1e-9).all()


@pytest.mark.slow
@pytest.mark.parametrize("mixed", [0, 1])
def test_a_large_league_of_equals_settles_where_the_exact_laws_say(mixed: int) -> None:
    """Ratings that may differ by odd numbers are the ladder's; all in step, a closed league's."""
    rating = 80 + mixed * (np.arange(400) % 2)
    world = world_of(rating, skill=np.full(400, 80), schedule=RandomPairing(), weeks=400)
    contest = play_systems(world, [system_of("step 1")], replicas=8, seed=1)
    found = estimate(contest, MEASURES["rating_error"], world, cycle=2)
    law = Ladder("step 1", opponents=EQUAL_SKILL).law() if mixed else in_step_law("step 1")
    exact = law.sd / 30.0 * np.sqrt(399 / 400)
    assert off(found.value[0], exact, float(found.error[0])) < 3.5


# The same league for everybody.


def test_what_a_system_comes_to_does_not_depend_on_the_others() -> None:
    world = world_of(SKILL, newcomers=0.3, sandbaggers=0.3, day_sd=5, absence=0.1)
    alone = play_systems(world, [system_of("elo")], replicas=50, seed=1)
    both = play_systems(world, [system_of("npl"), system_of("elo")], replicas=50, seed=1)
    assert (alone.matches[0] == both.matches[1]).all()


@pytest.mark.slow
def test_sums_are_the_same_for_any_number_of_workers() -> None:
    world = world_of([80] * 60, weeks=4)
    one, two = (
        play_systems(world, [system_of("npl")], replicas=400, seed=1, jobs=jobs) for jobs in (1, 2)
    )
    assert all((getattr(one, name) == getattr(two, name)).all() for name in vars(one))


def test_a_system_that_takes_a_league_at_a_time_comes_to_the_same() -> None:
    world = world_of(SKILL, newcomers=0.3, weeks=6)
    contest = play_systems(world, [InTurn(), system_of("step 1")], replicas=10, seed=1)
    assert (contest.weeks[0] == contest.weeks[1]).all()


def test_a_difference_is_far_surer_than_the_two_values() -> None:
    world = world_of(
        SKILL * 2, skill=[rating + 8 * (-1) ** k for k, rating in enumerate(SKILL * 2)]
    )
    contest = play_systems(world, [system_of("npl"), system_of("step 2")], replicas=200, seed=1)
    found = estimate(contest, MEASURES["p_better_wins"], world, cycle=2)
    assert found.change_error[1] < 0.5 * np.hypot(*found.error)


@pytest.mark.parametrize("name", ["npl", "margin", "elo"])
def test_points_that_are_kept_are_those_of_the_rule(name: str) -> None:
    """The table of points changes nothing: one league at a time, too small for it, does as well."""
    world = world_of(SKILL * 2, newcomers=0.3, weeks=6)

    class Alone(InTurn):
        def __init__(self) -> None:
            self.npl = system_of(name)
            self.scale, self.asks = self.npl.scale, self.npl.asks

    contest = play_systems(world, [Alone(), system_of(name)], replicas=10, seed=1)
    assert (contest.weeks[0] == contest.weeks[1]).all()


def test_a_coin_flip_has_more_even_matches_but_no_more_right_races() -> None:
    world = world_of([80] * 6, skill=SKILL)
    systems = [system_of(name) for name in ("none 5", "none 1", "none 15", "npl")]
    contest = play_systems(world, systems, replicas=100, seed=1)
    even, right, wins = (
        estimate(contest, MEASURES[name], world)
        for name in ("p_even", "p_right", "p_doubling_wins")
    )
    assert even.value[1] > even.value[0] >= even.value[2]
    assert right.value[0] == right.value[1] == right.value[2] < right.value[3]
    exact = [float(race_win_probability(2 / 3, n, n)) for n in (5, 1, 15)]
    assert wins.value[:3] == pytest.approx(exact, abs=1e-4)


# By hand: the same league in plain Python, a rack at a time.


def by_hand(world: World, name: str, seed: int) -> dict[str, float]:
    """Play one season as one would write it down, and return what it comes to."""
    rng, players = random.Random(seed), world.players
    system, many = system_of(name), world.many
    listed = len(players)
    skill = [float(x) for x in players.skill]
    mean = sum(skill) / listed
    sd = (sum((x - mean) ** 2 for x in skill) / listed) ** 0.5
    skill += [rng.gauss(mean, sd) for _ in range(many - listed)]
    rating = [float(x) for x in players.rating]
    rating += [float(round(x + 30.0 * rng.gauss(0.0, 1.0))) for x in skill[listed:]]
    dumps = [rng.random() < world.sandbaggers for _ in range(many)]
    joins, leaves = (x.tolist() for x in world.spans)
    sums = dict.fromkeys(
        ("matches", "even", "better", "games", "late", "late_n", "d_n", "d_won", "o_n", "o_won"),
        0.0,
    )
    for week in range(1, world.weeks + 1):
        quarter = 4 * (week - 1) // world.weeks
        holder: dict[int, int] = {}
        for player in range(many):
            if joins[player] <= week <= leaves[player]:
                holder[int(world.place[player])] = player
        there = {p: rng.random() >= float(players.absence[0]) for p in holder.values()}
        today = {p: skill[p] + rng.gauss(0.0, float(players.day_sd[0])) for p in holder.values()}
        move = [0.0] * many
        ((ones, others),) = world.schedule.pairs(week, np.random.default_rng(0), listed)
        for one, other in zip(ones.tolist(), others.tolist(), strict=True):
            a, b = holder[one], holder[other]
            if not (there[a] and there[b]):
                continue
            m, n = system.usual_chart().race(round(rating[a] - rating[b]))
            gaps = [skill[a] - skill[b] + x for x in np.linspace(-4, 4, 41) * 2**0.5 * 5.0]
            weights = np.exp(-(np.linspace(-4, 4, 41) ** 2) / 2)
            chances = [race_win_probability(1 / (1 + 2 ** (-g / 30.0)), m, n) for g in gaps]
            chance = float(np.average(chances, weights=weights))
            sums["matches"] += 1
            sums["even"] += max(chance, 1.0 - chance) <= 0.6
            sums["better"] += chance if skill[a] > skill[b] else 1.0 - chance
            held = [today[p] - 90.0 * (dumps[p] and quarter == 2) for p in (a, b)]
            p, won, lost = 1 / (1 + 2 ** (-(held[0] - held[1]) / 30.0)), 0, 0
            while won < m and lost < n:
                if rng.random() < p:
                    won += 1
                else:
                    lost += 1
            sums["games"] += won + lost
            for player, up in ((a, won == m), (b, lost == n)):
                move[player] += 1.0 if up else -1.0
                if quarter == 3:
                    kind = "d" if dumps[player] else "o"
                    sums[f"{kind}_n"] += 1
                    sums[f"{kind}_won"] += up
        rating = [r + change for r, change in zip(rating, move, strict=True)]
        if week > world.weeks - world.weeks // 4:
            errors = [(rating[p] - skill[p]) / 30.0 for p in holder.values()]
            middle = sum(errors) / len(errors)
            sums["late"] += sum((x - middle) ** 2 for x in errors)
            sums["late_n"] += len(errors)
    return sums


HAND: dict[str, Callable[[Any], Any]] = {
    "p_even": lambda s: s["even"] / s["matches"],
    "p_better_wins": lambda s: s["better"] / s["matches"],
    "mean_games": lambda s: s["games"] / s["matches"],
    "rating_error": lambda s: (s["late"] / s["late_n"]) ** 0.5,
    "sandbagging_pays": lambda s: s["d_won"] / s["d_n"] - s["o_won"] / s["o_n"],
}


@pytest.mark.slow
def test_an_independent_simulation_finds_the_same_within_its_errors() -> None:
    world = world_of(SKILL, day_sd=5.0, absence=0.1, newcomers=0.34, sandbaggers=0.2, weeks=16)
    contest = play_systems(world, [system_of("step 1")], replicas=2000, seed=5)
    groups = []
    for group in range(20):
        seasons = [by_hand(world, "step 1", 1000 * group + k) for k in range(6)]
        groups.append({key: sum(season[key] for season in seasons) for key in seasons[0]})
    total = {key: sum(group[key] for group in groups) for key in groups[0]}
    wrong = {}
    for name, measure in HAND.items():
        found = estimate(contest, MEASURES[name], world, cycle=2)
        left = [measure({key: total[key] - group[key] for key in total}) for group in groups]
        error = float(np.sqrt(19.0 / 20.0 * np.sum((np.array(left) - np.mean(left)) ** 2)))
        apart = off(found.value[0], measure(total), float(np.hypot(error, found.error[0])))
        if apart > 3.5:
            wrong[name] = (found.value[0], measure(total), apart)
    assert not wrong


@pytest.mark.thorough
def test_intervals_of_90_per_cent_hold_in_200_runs() -> None:
    """The truth is a run of 40,000 seasons; 200 runs of 200 seasons each."""
    skill = [105, 99, 84, 78, 60, 47, 85, 80, 75, 70]
    world = world_of([80] * 10, skill=skill, weeks=16, sandbaggers=0.1, newcomers=0.3)
    systems = [system_of("step 5"), system_of("step 3")]
    play = partial(play_systems, world, systems)
    names = ["p_even", "p_better_wins", "rating_error", "sandbagging_pays", "mean_games",
             "p_right", "p_doubling_wins", "nights_until_right"]  # fmt: skip
    long = play(replicas=40_000, seed=0)
    truth = {name: estimate(long, MEASURES[name], world, cycle=2) for name in names}
    inside = dict.fromkeys(names, 0)
    for seed in range(1, 201):
        contest = play(replicas=200, seed=seed)
        for name in names:
            found = estimate(contest, MEASURES[name], world, cycle=2)
            half = found.quantile * found.change_error[1]
            inside[name] += abs(found.change[1] - truth[name].change[1]) <= half
    # 180 of 200 are expected, with a standard deviation of 4.2.
    assert all(167 <= count <= 193 for count in inside.values()), inside
