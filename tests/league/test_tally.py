"""Tallies add up."""

import dataclasses
from functools import reduce
from operator import add

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.league import LeaguePlayers, RandomPairing, Season, Tally, run_chunk
from evenbreak.league.season import fifths_of

SEASON = Season(LeaguePlayers.of([50, 60, 70, 80, 90]), "npl", schedule=RandomPairing(), weeks=6)


def parts(many: int) -> list[Tally]:
    return [
        run_chunk(SEASON, 20 + k, seed)
        for k, seed in enumerate(np.random.SeedSequence(1).spawn(many))
    ]


def same(one: Tally, other: Tally) -> bool:
    return all(
        np.array_equal(getattr(one, field.name), getattr(other, field.name))
        for field in dataclasses.fields(Tally)
    )


def test_brackets_do_not_matter() -> None:
    one, two, three = parts(3)
    assert same((one + two) + three, one + (two + three))
    assert not same(one, two)


def test_a_sum_keeps_its_chunks() -> None:
    total = reduce(add, parts(3))
    assert total.replicas.tolist() == [20, 21, 22]
    assert total.gaps.shape[0] == total.weeks.shape[0] == total.fifths.shape[0] == 3
    assert total.gaps[..., 0].sum() == 63 * 6 * 2 == total.matches.sum() / 2
    assert total.wins_counts.sum() == total.rating_counts.sum() == 5 * 63


def test_one_sum_fits_the_others() -> None:
    total = reduce(add, parts(2))
    wins = total.wins_counts @ np.arange(total.wins_counts.shape[1])
    assert wins.tolist() == total.wins.tolist()
    moved = np.arange(total.rating_counts.shape[1]) - total.rating_counts.shape[1] // 2
    assert (total.rating_counts @ moved).tolist() == total.rating.tolist()
    assert (total.rating_counts @ moved**2).tolist() == total.rating_squared.tolist()
    assert (total.errors @ total.error_values).tolist() == total.weeks[..., 1].sum(axis=0).tolist()
    assert total.fifths[..., 1].sum() == total.wins.sum()


def test_other_seasons_are_refused() -> None:
    other = dataclasses.replace(SEASON, weeks=7)
    with pytest.raises(InputError, match="from different seasons"):
        parts(1)[0] + run_chunk(other, 3, np.random.SeedSequence(1))
    with pytest.raises(TypeError):
        parts(1)[0] + 1


def test_standard_errors_are_those_of_means_where_batches_are_equal() -> None:
    rng = np.random.default_rng(1)
    above, below = rng.normal(3.0, 1.0, (50, 2)), np.full((50, 2), 4.0)
    mean, error = parts(1)[0].mean_and_error(above, below)
    assert mean == pytest.approx(above.mean(axis=0) / 4)
    assert error == pytest.approx(above.std(axis=0, ddof=1) / np.sqrt(50) / 4)


def test_one_chunk_has_no_error() -> None:
    mean, error = parts(1)[0].mean_and_error([[3.0, 0.0]], [[4.0, 0.0]])
    assert mean[0] == 0.75
    assert np.isnan(mean[1])
    assert np.isnan(error).all()


def test_fifths_hold_as_many() -> None:
    skill = np.random.default_rng(1).normal(size=(103, 4))
    fifth = fifths_of(skill)
    assert [np.bincount(column).tolist() for column in fifth.T] == [[21, 21, 20, 21, 20]] * 4
    for column, group in zip(skill.T, fifth.T, strict=True):
        assert all(column[group == k].max() < column[group == k + 1].min() for k in range(4))
