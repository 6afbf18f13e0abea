import math
import statistics
from itertools import combinations

import pytest

from derived import derived
from evenbreak.source_text.answers import compute
from evenbreak.source_text.section5 import samples


def test_merging_two_lists_gives_the_mean_and_the_variance_of_all_values():
    values = [0, 1, 1, 4, 5, 0, 1, 1, 8, 9]
    found = derived(samples, "P5.2")
    assert found["merged mean", "all ten values"] == statistics.mean(values)
    assert found["merged variance", "all ten values"] == pytest.approx(10.0)
    merged = compute("P5.2", "merged variance", "as above")
    assert float(merged) == pytest.approx(statistics.pvariance(values))


def test_choices_are_all_subsets():
    found = derived(samples, "P5.3")
    chosen = [text for (quantity, _), text in found.items() if quantity.startswith("choice")]
    assert len(chosen) == len(set(chosen)) == 16
    assert {"{}", "{1 3}", "{1 2 3 4}"} <= set(chosen)


def test_pascals_triangle_is_that_of_the_binomial_coefficients():
    rows = samples.pascals_triangle()
    assert rows == [[math.comb(n, m) for m in range(n + 1)] for n in range(11)]


def test_larger_samples_scatter_less():
    found = derived(samples, "P5.18")
    name = "sd of the mean, without replacement"
    without = [found[name, f"1 2 4 5 m={n}"] for n in (1, 2, 3, 4)]
    assert without == sorted(without, reverse=True)
    assert without[-1] == 0
    pairs = statistics.pstdev((a + b) / 2 for a, b in combinations((1, 2, 4, 5), 2))
    assert without[1] == pytest.approx(pairs)
    assert found[name, "1 2 4 5 m=2 from all six pairs"] == pytest.approx(pairs)


def test_the_interval_of_few_scores_is_wider_by_students_t():
    found = derived(samples, "P5.19")
    scores = "scores 50 44 46 52 47 51 49 45 48 50 confidence=0.8"
    normal, student = (
        found[f"interval of the true mean, {name}, high", scores]
        for name in ("normal", "Student t")
    )
    assert student > normal == pytest.approx(49.222, abs=5e-4)
