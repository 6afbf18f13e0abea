"""Who works, and how fast, leaves no trace in what a simulated league comes to."""

import pickle
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.league import (
    LeaguePlayers,
    RandomPairing,
    Season,
    run_chunk,
    simulate,
)
from evenbreak.league.simulate import Batching, _Work, batching_of

SEASON = Season(
    LeaguePlayers.of([92, 80, 71, 64, 50, 47], skill_sd=5.0, day_sd=3.0, absence=0.1),
    "npl",
    schedule=RandomPairing(),
    weeks=6,
    play="racks",
)


def as_bytes(tally):
    return {
        name: None if value is None else np.asarray(value).tobytes()
        for name, value in vars(tally).items()
    }


@pytest.fixture(scope="module", autouse=True)
def small_chunks():
    """Part the few replicas of these tests as many are."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(sys.modules[batching_of.__module__], "_CHUNK", 20 * len(SEASON.players))
        yield


@pytest.fixture(scope="module")
def alone(small_chunks):  # noqa: ARG001
    return simulate(SEASON, replicas=205, seed=3)


@pytest.mark.slow
def test_the_bytes_do_not_depend_on_the_number_of_jobs(alone):
    assert as_bytes(simulate(SEASON, replicas=205, seed=3, jobs=3)) == as_bytes(alone)


def test_the_bytes_do_not_depend_on_the_executor(alone):
    with ThreadPoolExecutor(3) as threads:
        assert as_bytes(simulate(SEASON, replicas=205, seed=3, executor=threads)) == as_bytes(alone)


def test_a_season_sent_by_itself_is_the_same(alone):
    sent = pickle.loads(pickle.dumps(SEASON))  # noqa: S301
    assert as_bytes(simulate(sent, replicas=205, seed=3)) == as_bytes(alone)


def test_chunks_have_the_streams_that_the_seed_spawns(alone):
    assert batching_of(SEASON, 205) == Batching(replicas=10, batches=2)
    *full, left = np.random.SeedSequence(3).spawn(11)
    tallies = [run_chunk(SEASON, 10, seed, batches=2) for seed in full]
    tallies.append(run_chunk(SEASON, 5, left))
    total = tallies[0]
    for tally in tallies[1:]:
        total = total + tally
    assert as_bytes(total) == as_bytes(alone)
    assert alone.replicas.tolist() == [10] * 20 + [5]


@pytest.mark.parametrize(("name", "value"), [("_TALLIES", 1), ("_TALLIES", 3), ("_PARCELS", 3)])
def test_how_sums_are_bracketed_changes_nothing(monkeypatch, alone, name, value):
    monkeypatch.setattr(sys.modules[simulate.__module__], name, value)
    assert as_bytes(simulate(SEASON, replicas=205, seed=3)) == as_bytes(alone)


@pytest.mark.parametrize("replicas", [1, 9, 1000, 64_001, 1_000_000])
def test_parcels_are_every_chunk_once_in_order(replicas):
    work = _Work(SEASON, replicas, batching_of(SEASON, replicas), 1)
    numbers = [number for parcel in work.parcels() for number in parcel]
    assert numbers == list(range(work.chunks()))


def test_another_seed_is_another_season(alone):
    other = simulate(SEASON, replicas=205, seed=4)
    assert (other.wins != alone.wins).any()


def test_progress_goes_from_none_to_all():
    told = []
    simulate(SEASON, replicas=250, seed=1, progress=lambda done, total: told.append((done, total)))
    assert told[0] == (0, 250)
    assert told[-1] == (250, 250)
    assert [done for done, _ in told] == sorted({done for done, _ in told})
    assert len(told) > 10


@pytest.mark.parametrize(
    ("name", "value"),
    [("replicas", 0), ("replicas", 1.5), ("seed", -1), ("seed", "x"), ("jobs", 0)],
)
def test_numbers_are_whole_and_large_enough(name, value):
    right = {"replicas": 1, "seed": 1, "jobs": 1}
    with pytest.raises(InputError, match=f"{name} must be "):
        simulate(SEASON, **{**right, name: value})
