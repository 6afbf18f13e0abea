"""The value of a team night: game trees played out in fractions, and the laws of the game."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.teams import Cap, Point, Squad, TeamNight, advice, sealed, solved
from rows import each_of
from tiers import examples

ORDERS = ["ABABA", "BAABB", "AAAAA", "=====", "A=B=A", "AWWWW", "BLLLL", "AWL=B"]


def squad(count: int, team: str, *caps: Cap, times: int = 1) -> Squad:
    return Squad(tuple(f"{team}{k}" for k in range(count)), caps, times)


def law(win: np.ndarray) -> np.ndarray:
    found = np.zeros((*win.shape, 2, 3))
    found[..., 0, 2], found[..., 1, 0] = win, 1.0 - win
    return found


def chances(ours: int, theirs: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).integers(1, 16, (ours, theirs)) / 16.0


def by_tree(win, order, sets, mine, others, lead=0, last=None):
    """The value in fractions, by going through every pick; no blind sets."""
    k = sets - len(order)
    if not order:
        return Fraction(1) if lead > 0 else Fraction(1, 2) if lead == 0 else Fraction(0)
    letter = order[0]
    if letter in "WL":
        letter = "A" if last == (letter == "W") else "B"

    def value(i, j):
        p = Fraction(win[i, j])
        left = mine - {i}, others - {j}
        won, lost = (
            by_tree(win, order[1:], sets, *left, lead + step, step > 0) for step in (1, -1)
        )
        return p * won + (1 - p) * lost

    assert k >= 0
    if letter == "A":
        return max(min(value(i, j) for j in others) for i in mine)
    return min(max(value(i, j) for i in mine) for j in others)


@each_of("order", ["ABA", "BAB", "AWW", "BLW", "ALL"])
@each_of("sizes", [(3, 3), (4, 3), (3, 4)])
def test_three_a_side_equals_the_whole_game_tree(order: str, sizes: tuple[int, int]) -> None:
    win = chances(*sizes, seed=sum(sizes))
    night = TeamNight(squad(sizes[0], "a"), squad(sizes[1], "b"), law(win), sets=3, order=order)
    exact = by_tree(win, order, 3, frozenset(range(sizes[0])), frozenset(range(sizes[1])))
    assert solved(night).value == pytest.approx(float(exact), abs=1e-14)


@pytest.mark.parametrize("order", ORDERS)
def test_swapping_the_teams_is_complementary(order: str) -> None:
    win = chances(6, 5, seed=1)
    swapped = order.translate(str.maketrans("AB", "BA"))
    ours = TeamNight(squad(6, "a"), squad(5, "b"), law(win), sets=5, order=order)
    theirs = TeamNight(squad(5, "b"), squad(6, "a"), law(1.0 - win.T), sets=5, order=swapped)
    assert solved(ours).value == pytest.approx(1.0 - solved(theirs).value, abs=1e-12)


@pytest.mark.parametrize("order", ORDERS)
def test_a_cap_that_does_not_bind_changes_nothing(order: str) -> None:
    win = chances(5, 6, seed=2)
    capped = squad(5, "a", Cap((5, 4, 3, 2, 1), 15))
    free = TeamNight(squad(5, "a"), squad(6, "b"), law(win), sets=5, order=order)
    tied = TeamNight(capped, squad(6, "b"), law(win), sets=5, order=order)
    assert solved(tied).value == solved(free).value


@pytest.mark.parametrize("seed", range(3))
def test_blind_picks_without_spare_players_are_worth_the_mean_over_all_pairings(seed: int) -> None:
    win = chances(4, 4, seed)
    night = TeamNight(squad(4, "a"), squad(4, "b"), law(win), sets=4, order="blind")
    total = 0.0
    for pairing in itertools.permutations(range(4)):
        won = np.ones(1)
        for i, j in enumerate(pairing):
            won = np.convolve(won, [1.0 - win[i, j], win[i, j]])
        total += won[3:].sum() + won[2] / 2
    assert solved(night).value == pytest.approx(total / 24, abs=1e-10)
    assert sealed(night).worth == pytest.approx(total / 24, abs=1e-12)
    mixes = [option.mix for option in advice(solved(night)).options]
    assert len(mixes) == 4


def test_naming_unseen_lies_between_naming_first_and_answering_in_one_set() -> None:
    win = chances(5, 5, seed=4)
    values = [
        solved(TeamNight(squad(5, "a"), squad(5, "b"), law(win), sets=1, order=order)).value
        for order in "A=B"
    ]
    assert values == sorted(values)


@settings(max_examples=examples(20))
@given(st.integers(0, 10_000), st.sampled_from(ORDERS))
def test_the_advice_at_each_point_has_the_value_of_the_point(seed: int, order: str) -> None:
    """After the best pick and the best answer, the mean over the set's result is the value."""
    win = chances(5, 5, seed)
    solution = solved(TeamNight(squad(5, "a"), squad(5, "b"), law(win), sets=5, order=order))
    found = advice(solution)
    assert found.worth == pytest.approx(solution.value, abs=1e-9)
    if found.blind:
        return
    first = found.best
    answer = advice(solution, Point(named=first.names))
    assert answer.worth == pytest.approx(found.worth, abs=1e-12)
    mine, others = (
        (first.names, answer.best.names) if found.ours else (answer.best.names, first.names)
    )
    after = [
        advice(solution, Point(mine, others, lead, last_won=lead > 0)).worth for lead in (1, -1)
    ]
    p = win[int(mine[0][1:]), int(others[0][1:])]
    assert p * after[0] + (1.0 - p) * after[1] == pytest.approx(found.worth, abs=1e-9)


def test_a_match_in_play_counts_by_its_own_chance() -> None:
    win = chances(4, 4, seed=7)
    solution = solved(TeamNight(squad(4, "a"), squad(4, "b"), law(win), sets=3, order="ABA"))
    live = law(np.array([[0.7]]))[0, 0]
    found = advice(solution, Point(("a0",), ("b1",), in_play=(live,)))
    asked = {"named": found.best.names}
    won, lost = (
        {o.names: o.worth for o in advice(solution, Point(("a0",), ("b1",), lead, **asked)).options}
        for lead in (1, -1)
    )
    answers = advice(solution, Point(("a0",), ("b1",), in_play=(live,), **asked)).options
    for names, worth, *_ in answers:
        assert worth == pytest.approx(0.7 * won[names] + 0.3 * lost[names], abs=1e-12)
    assert found.worth == max(option.worth for option in answers)


def test_the_cap_keeps_players_from_being_put_up() -> None:
    levels = (7.0, 6.0, 5.0, 3.0, 2.0, 2.0)
    ours = squad(6, "a", Cap(levels, 21))
    night = TeamNight(ours, squad(5, "b"), law(chances(6, 5, 9)), sets=5, order="A")
    first = {option.names[0] for option in advice(solved(night)).options}
    assert first == {"a0", "a1", "a2", "a3", "a4", "a5"}
    after = advice(solved(night), Point(("a0", "a1"), ("b0", "b1"), 0))
    assert "a2" not in {option.names[0] for option in after.options}  # 18, then 2 + 2


def test_two_of_level_six_at_most() -> None:
    ours = squad(6, "a", Cap((1, 1, 1, 0, 0, 0), 2))
    night = TeamNight(ours, squad(5, "b"), law(chances(6, 5, 9)), sets=5, order="A")
    found = advice(solved(night), Point(("a0", "a1"), ("b0", "b1"), 0))
    assert {option.names[0] for option in found.options} == {"a3", "a4", "a5"}


def test_doubles_use_up_both_players() -> None:
    ours, theirs = squad(3, "a"), squad(3, "b")
    night = TeamNight(
        ours, theirs, [law(chances(3, 3, 1)), law(chances(3, 3, 2))], sizes=(2, 1), order="AB"
    )
    found = advice(solved(night), Point(("a0", "a2"), ("b1", "b0"), 1))
    assert [option.names for option in found.options] == [("b2",)]
    assert found.best.answer == ("a1",)


@pytest.mark.parametrize(
    ("point", "what"),
    [
        (Point(("a0",), ()), "both sides"),
        (Point(("a0",), ("x",), 1), "'x' isn't in the squad"),
        (Point(("a0", "a0"), ("b0", "b1"), 0), "too often"),
        (Point(("a0",), ("b0",), 3), "lead of 3"),
        (Point(("a0",), ("b0",), 0), "lead of 0"),
        (Point(named=("b0",)), "can't be named"),
        (Point(("a0", "a1", "a2"), ("b0", "b1", "b2"), 1), "no one left"),
    ],
)
def test_points_that_cannot_be_are_refused(point: Point, what: str) -> None:
    solution = solved(TeamNight(squad(4, "a"), squad(4, "b"), law(chances(4, 4, 1)), sets=3))
    with pytest.raises(InputError, match=what):
        advice(solution, point)


def test_nights_that_cannot_be_are_refused() -> None:
    with pytest.raises(InputError, match="can't fill 3 sets"):
        TeamNight(squad(2, "a"), squad(3, "b"), law(chances(2, 3, 1)), sets=3)
    capped = squad(3, "a", Cap((3, 3, 3), 5, "the sum of the levels"))
    with pytest.raises(InputError, match="sum of the levels to 5"):
        TeamNight(capped, squad(3, "b"), law(chances(3, 3, 1)), sets=2)
    with pytest.raises(InputError, match="add up to"):
        TeamNight(squad(1, "a"), squad(1, "b"), [np.full((1, 1, 2, 3), 0.3)])
    with pytest.raises(InputError, match="too many lineups"):
        TeamNight(squad(30, "a"), squad(30, "b"), law(chances(30, 30, 1)), sets=8)
