"""A log of single shots: against scipy, brute force, and players whose chances are known."""

import itertools
import math

import numpy as np
import pytest
from scipy.stats import binomtest, fisher_exact
from scipy.stats.contingency import odds_ratio

from evenbreak.errors import InputError
from evenbreak.practice.single_shots import ShotLog, analyze_shots, change_of
from rows import each_of

DAYS = np.array(["2025-01-01", "2025-01-08", "2025-01-15"], dtype="M8[D]")


def log_of(made, tried, day=None):
    names = tuple(f"shot {k}" for k in range(len(made)))
    return ShotLog(names, np.arange(len(made)), made, tried, day)


def test_the_interval_of_a_shot_is_the_exact_one() -> None:
    made, tried = [0, 3, 20, 7], [5, 10, 20, 30]
    found = {one.name: one for one in analyze_shots(log_of(made, tried), confidence=0.9).shots}
    for k, (won, n) in enumerate(zip(made, tried, strict=True)):
        wanted = binomtest(won, n).proportion_ci(0.9, method="exact")
        assert (found[f"shot {k}"].low, found[f"shot {k}"].high) == pytest.approx(tuple(wanted))


@each_of("table", [((10, 30), (20, 30)), ((3, 4), (9, 40)), ((0, 5), (4, 6)), ((7, 7), (2, 9))])
def test_one_shot_is_compared_as_by_the_conditional_odds_ratio(table) -> None:
    (k1, n1), (k2, n2) = table
    change = change_of(table, 0.9)
    assert change is not None
    cells = [[k2, n2 - k2], [k1, n1 - k1]]
    wanted = odds_ratio(cells, kind="conditional")
    interval = wanted.confidence_interval(0.9)
    assert change.ratio == pytest.approx(wanted.statistic, rel=1e-4)
    assert (change.low, change.high) == pytest.approx((interval.low, interval.high), rel=1e-4)
    sides = [fisher_exact(cells, side).pvalue for side in ("greater", "less")]
    assert change.p_value == pytest.approx(min(1.0, 2 * min(sides)))
    assert (change.before, change.after) == (k1 / n1, k2 / n2)


def test_several_shots_together_equal_every_way_of_sharing_out_what_was_made() -> None:
    halves = (np.array([2, 1, 3]), np.array([4, 3, 5])), (np.array([3, 2, 1]), np.array([3, 5, 2]))
    change = change_of(halves)
    assert change is not None
    (k1, n1), (k2, n2) = halves
    total, as_high, as_low = 0, 0, 0
    for later in itertools.product(*(range(n + 1) for n in n2)):
        earlier = k1 + k2 - np.array(later)
        if (earlier < 0).any() or (earlier > n1).any():
            continue
        ways = math.prod(
            math.comb(int(n), int(x)) * math.comb(int(m), int(y))
            for n, x, m, y in zip(n2, later, n1, earlier, strict=True)
        )
        total += ways
        as_high += ways * (sum(later) >= k2.sum())
        as_low += ways * (sum(later) <= k2.sum())
    assert change.p_value == pytest.approx(min(1.0, 2 * min(as_high, as_low) / total))
    mix = (n1 + n2) / (n1 + n2).sum()
    assert change.after == pytest.approx(float(mix @ (k2 / n2)))


def test_the_half_is_of_the_tries_and_does_not_look_at_what_was_made() -> None:
    log = ShotLog(("a",), [0, 0, 0], [0, 1, 4], [4, 5, 5], DAYS)
    found = analyze_shots(log)
    assert found.since == DAYS[2]
    assert found.change is not None
    assert (found.change.before, found.change.after) == (1 / 9, 4 / 5)
    assert analyze_shots(ShotLog(("a",), [0], [1], [4], DAYS[:1])).since is None
    assert analyze_shots(ShotLog(("a", "b"), [0, 1], [1, 1], [4, 4], DAYS[:2])).change is None


def players(rng: np.random.Generator, many: int, shots: int = 8):
    """Yield the true chances of a player's shots, and how often they were made and tried."""
    for _ in range(many):
        mean, weight = rng.uniform(0.3, 0.8), np.exp(rng.uniform(1.0, 4.0))
        true = rng.beta(mean * weight, (1.0 - mean) * weight, shots)
        tried = rng.integers(3, 40, shots)
        yield true, rng.binomial(tried, true), tried


@pytest.mark.slow
def test_shots_drawn_together_are_nearer_to_the_truth_and_the_weakest_is_as_likely_as_stated() -> (
    None
):
    """150 players of 8 shots, 3 to 39 tries each; the prior is not the one assumed."""
    rng = np.random.default_rng(11)
    off = {"raw": 0.0, "shrunk": 0.0}
    stated, right = [], []
    for true, made, tried in players(rng, 150):
        reports = {one.name: one for one in analyze_shots(log_of(made, tried)).shots}
        chance = np.array([reports[f"shot {k}"].chance for k in range(8)])
        off["raw"] += ((made / tried - true) ** 2).mean()
        off["shrunk"] += ((chance - true) ** 2).mean()
        for k in range(8):
            stated.append(reports[f"shot {k}"].p_weakest)
            right.append(k == true.argmin())
    assert off["shrunk"] < 0.75 * off["raw"]
    likely, is_so = np.array(stated), np.array(right)
    for low, high in ((0.05, 0.3), (0.3, 0.6), (0.6, 1.0)):
        some = (likely >= low) & (likely < high)
        error = np.sqrt(likely[some].mean() / some.sum())
        assert is_so[some].mean() == pytest.approx(likely[some].mean(), abs=3.5 * error)


def test_a_player_who_does_not_change_is_seldom_told_so() -> None:
    """The exact test keeps its level: at most 10 of 100 below .1, and intervals that cover."""
    rng = np.random.default_rng(12)
    false, covered = 0, 0
    for true, made, tried in players(rng, 300, shots=4):
        later = rng.integers(3, 40, 4)
        change = change_of([(made, tried), (rng.binomial(later, true), later)], 0.9)
        assert change is not None
        false += change.p_value < 0.1
        covered += change.low <= 1.0 <= change.high
    assert false <= 30 + 3 * math.sqrt(30)
    assert covered >= 270 - 3 * math.sqrt(30)


@pytest.mark.parametrize(("made", "tried"), [([3], [2]), ([], []), ([0], [0])])
def test_what_cannot_be_is_refused(made, tried) -> None:
    with pytest.raises(InputError):
        log_of(made, tried)
