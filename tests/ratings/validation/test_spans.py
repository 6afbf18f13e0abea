"""A season walked through in spans of dates, by whoever has time."""

import numpy as np
import pytest

from evenbreak.ratings import Results, best_prior, validate
from evenbreak.ratings.levels import Levels
from evenbreak.ratings.validation import walk_forward as module
from evenbreak.ratings.validation.walk_forward import walk_forward
from evenbreak.workers import crew


def season(dates, matches=12, players=40, seed=3):
    rng = np.random.default_rng(seed)
    many = dates * matches
    # Players join as the season goes on.
    here = 4 + (players - 4) * np.arange(many) // many
    a = rng.integers(0, here)
    b = (a + rng.integers(1, here)) % here
    won = rng.random(many) < 0.5
    lost = rng.integers(0, 5, many)
    day = np.datetime64("2024-01-01") + np.repeat(np.cumsum(rng.integers(1, 9, dates)), matches)
    scores = np.where(won, 5, lost), np.where(won, lost, 5)
    return Results(tuple(f"p{k:02d}" for k in range(players)), a, b, *scores, date=day)


WAYS = [{}, {"half_life": 90.0, "prior_sd": 0.4, "levels": Levels(newcomers=0.3, joined=0.2)}]


@pytest.mark.parametrize("way", WAYS)
def test_where_a_season_is_cut_does_not_matter(monkeypatch, way):
    results = season(40)
    monkeypatch.setattr(module, "LEAST_DATES", 40)
    whole = walk_forward(results, **way)
    monkeypatch.setattr(module, "LEAST_DATES", 5)
    parts = walk_forward(results, **way)
    np.testing.assert_allclose(parts.difference, whole.difference, atol=2e-6)
    np.testing.assert_allclose(parts.sd, whole.sd, rtol=2e-6)


def test_with_form_a_cut_changes_the_weights_of_earlier_matches_a_little(monkeypatch):
    """They are those of a fit without form, not those that the matches had on their own day."""
    results, moved = season(60), []
    way = {"form": 0.4, "prior_sd": 0.5}
    for least in (60, 5):
        monkeypatch.setattr(module, "LEAST_DATES", least)
        moved.append(walk_forward(results, **way))
    without = walk_forward(results, prior_sd=0.5)
    shift = np.abs(moved[0].difference - moved[1].difference)
    assert shift.max() < 0.02
    assert shift.mean() < 0.15 * np.abs(without.difference - moved[0].difference).mean()


@pytest.mark.parametrize("dates", [2, 60, 400])
def test_spans_hold_every_date_once_and_are_about_equally_much_work(dates):
    results = season(dates, matches=3)
    days, date_of = np.unique(results.date, return_inverse=True)
    walk = module._Walk(results, days, date_of, 1.0, None, Levels())
    spans = walk.spans()
    assert [day for span in spans for day in range(*span)] == list(range(dates))
    assert len(spans) == max(min(module.SPANS, dates // module.LEAST_DATES), 1)
    work = np.diff(walk.done[[start for start, _ in spans] + [dates]])
    assert work.max() < 1.3 / len(spans)


def by_two(task, shared, pieces):
    """Do the pieces from the last to the first, as others might."""
    return reversed([task(shared, piece) for piece in reversed(list(pieces))])


@pytest.mark.parametrize("way", [*WAYS, {"form": 0.4}])
def test_who_walks_a_span_makes_no_difference(way):
    results, seen = season(60), []
    alone = walk_forward(results, **way)
    shared = walk_forward(results, **way, share=by_two, progress=lambda *done: seen.append(done))
    for name in ("difference", "sd", "p_match_integrated"):
        np.testing.assert_array_equal(getattr(alone, name), getattr(shared, name))
    assert [count for count, _, _ in seen] == sorted({count for count, _, _ in seen})
    assert seen[-1] == (60, 60, pytest.approx(1.0))


@pytest.mark.slow
def test_who_predicts_a_stretch_makes_no_difference(monkeypatch):
    """In a large season, of which nothing is kept from one search to the next."""
    monkeypatch.setattr("evenbreak.ratings.stretches.KEPT_UP_TO", 0)
    monkeypatch.setattr("evenbreak.ratings.stretches.SOLVED_AT_ONCE", 0)
    alone, shared = (
        best_prior(season(12), widths=[0.3, 0.6], share=share) for share in (None, by_two)
    )
    assert alone == shared


@pytest.mark.slow
def test_two_processes_say_the_same_to_the_last_bit():
    results = season(50, matches=3, players=12)
    alone, shared = (validate(results, prior_sd=0.5, half_life=None, jobs=jobs) for jobs in (1, 2))
    np.testing.assert_array_equal(alone.forecasts.sd, shared.forecasts.sd)
    assert alone.scored == shared.scored


def test_a_crew_of_one_is_this_process():
    with crew() as share:
        assert share is None


@pytest.mark.slow
def test_a_crew_does_several_tasks_with_the_same_processes():
    with crew(jobs=2) as share:
        assert list(share(pow, 2, range(5))) == [1, 2, 4, 8, 16]
        assert list(share(divmod, 7, [2, 3])) == [(3, 1), (2, 1)]


@pytest.mark.thorough
def test_a_cluster_says_the_same_to_the_last_bit():
    distributed = pytest.importorskip("distributed", reason="the extra evenbreak[dask] is missing")
    results = season(50, matches=3, players=12)
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50
        ) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        shared = validate(results, executor=client)
    alone = validate(results)
    np.testing.assert_array_equal(alone.forecasts.sd, shared.forecasts.sd)
    assert alone.scored == shared.scored
    assert alone.choice == shared.choice
