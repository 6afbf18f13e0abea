"""How strong the field was on first evenings, and newcomers who start by it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.ratings import Beginning, Results, best_prior, fit, walk_forward
from evenbreak.ratings.beginning import STILL
from evenbreak.ratings.first_evenings import DRAWN, FirstEvenings
from evenbreak.ratings.levels import Levels, known_levels
from evenbreak.ratings.stretches import SeasonSoFar, stretch_losses
from simulated_fields import city, small_city
from tiers import examples

PLAYERS = 7


def by_hand(rows, skill):
    """Return the same as `strength`, match by match: rows of (a, b, event, day, score)."""
    event_of = {row[2] for row in rows}
    fields, first = {}, {}
    for day in sorted({row[3] for row in rows}):
        before = {p for row in rows if row[3] < day and row[4] for p in row[:2]}
        today = [row for row in rows if row[3] == day]
        for event in sorted({row[2] for row in today}):
            here = {p for row in today if row[2] == event for p in row[:2]}
            key = event if event and len(event_of) > 1 else day
            fields.setdefault(key, []).extend(skill[p] for p in sorted(here & before))
            for player in here:
                # Of two events on the first day, any: the tests have none.
                first.setdefault(player, list(fields[key]))
    first = {player: field for player, field in first.items() if field}
    weight = {player: len(field) / (len(field) + DRAWN) for player, field in first.items()}
    usual = sum(weight[p] * np.mean(first[p]) for p in first) / max(sum(weight.values()), 1e-9)
    found = np.zeros(PLAYERS)
    for player, field in first.items():
        found[player] = weight[player] * (np.mean(field) - usual)
    return found


@given(
    st.lists(
        st.tuples(
            st.integers(0, PLAYERS - 1), st.integers(1, PLAYERS - 1), st.integers(0, 5),
            st.booleans(),
        ),
        min_size=1, max_size=25,
    ),
    st.sampled_from([("",), ("Open",), ("Open", ""), ("Open", "Novices", "Pairs")]),
)  # fmt: skip
@settings(max_examples=examples(200))
def test_a_field_is_those_of_the_event_who_had_played_before(drawn, names):
    rows = [
        (a, (a + step) % PLAYERS, names[day % len(names)], day, True) for a, step, day, _ in drawn
    ]
    last = max(row[3] for row in rows)
    rows = [(*row[:4], row[3] < last or not one[3]) for row, one in zip(rows, drawn, strict=True)]
    a, b, event, day, played = zip(*rows, strict=True)
    results = Results(
        tuple("ABCDEFG"), a, b, np.array(played) * 5, np.array(played) * 3,
        date=np.datetime64("2026-01-01") + np.array(day), event=np.array(event, dtype=object),
    )  # fmt: skip
    skill = np.random.default_rng(len(rows)).normal(size=PLAYERS)
    evenings = FirstEvenings(results)
    evenings.see(slice(None))
    if not any(played):
        return
    np.testing.assert_allclose(evenings.strength(skill), by_hand(rows, skill), atol=1e-12)


def test_who_brings_games_along_is_known():
    season = Results.from_names(
        ["Ann", "Bo"], ["New", "Old"], [5, 5], [3, 3], date=["2026-01-01"] * 2, event=["X", "Y"]
    )
    evenings = FirstEvenings(season, np.array([True, True, False, False]))
    evenings.see(slice(None))
    np.testing.assert_allclose(evenings.strength(np.array([1.0, 0, 0, 0])), [0, 0, 0.25, -0.25])
    assert not FirstEvenings(season)


def small(seed, **options):
    return city(np.random.default_rng(seed), players=60, venues=3, weeks=8, **options)[0]


OLD = Beginning(["p0001", "p0002", "p0003"], [95, 70, 80], [10, 12, 9], prior_sd=30, games=40)
WAYS = [
    Levels(field=0.8),
    Levels(field=1.2, newcomers=0.4, joined=0.2, race=0.3),
    Levels(field=0.7, division_sd=0.3),
    Levels(field=0.7, beginning=OLD),
]


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("levels", WAYS)
@pytest.mark.parametrize("half_life", [None, 30.0])
def test_a_walk_a_fit_and_a_search_say_the_same(levels, half_life, monkeypatch):
    results = small(3)
    results = replace(results, division=results.event)
    way = {"prior_sd": 0.5, "levels": levels, "half_life": half_life}
    walk = walk_forward(results, **way)
    for day in (9, 15, int(walk.date_of.max())):
        here = walk.date_of == day
        coming = walk.results.select(here)
        earlier = walk.results.select(walk.date_of < day).joined(coming.unplayed())
        when = coming.date[0]
        ratings = fit(earlier, as_of=when, **way)
        skill = ratings.scale.log_odds(ratings.rating)
        apart = skill[coming.player_a] - skill[coming.player_b]
        np.testing.assert_allclose(walk.difference[here], apart, atol=STILL)
        if half_life is None:
            for at_once in (0, 1000):
                monkeypatch.setattr("evenbreak.ratings.stretches.SOLVED_AT_ONCE", at_once)
                (found, _), _ = SeasonSoFar(earlier).skills([way, {**way, "levels": Levels()}])
                apart = found[coming.player_a] - found[coming.player_b]
                np.testing.assert_allclose(walk.difference[here], apart, atol=STILL)


def test_the_means_are_those_at_the_mode():
    results = small(4)
    levels = Levels(field=0.9)
    ratings = fit(results, prior_sd=0.4, levels=levels)
    skill = ratings.scale.log_odds(ratings.rating - ratings.anchor)
    evenings = FirstEvenings(results)
    evenings.see(slice(None))
    above = 0.9 * evenings.strength(skill)
    means = ratings.scale.log_odds(ratings.expected - ratings.anchor)
    np.testing.assert_allclose(means, above - above[~ratings.idle].mean(), atol=STILL)
    assert above.std() > 0.05


def test_nothing_of_the_future_is_used():
    results = small(5)
    day = np.unique(results.date)[12]
    later = np.asarray(results.date) >= day
    turned = replace(
        results,
        score_a=np.where(later, results.score_b, results.score_a),
        score_b=np.where(later, results.score_a, results.score_b),
        event=np.where(np.asarray(results.date) > day, "other", results.event),
    )
    one, other = (walk_forward(r, levels=Levels(field=1.0)) for r in (results, turned))
    known = np.asarray(one.results.date) <= day
    np.testing.assert_allclose(one.difference[known], other.difference[known], atol=1e-9)


def test_a_file_without_dates_has_no_first_evenings():
    assert "field" not in known_levels(replace(small(6), date=None))
    assert "field" in known_levels(small(6))


@pytest.mark.slow
def test_newcomers_of_strong_events_are_found_to_be_stronger():
    results, skill = city(np.random.default_rng(2), players=200, venues=4)
    ways = [{"prior_sd": 0.5, "levels": Levels(field=size)} for size in (0.0, 0.5, 1.0)]
    none, half, whole = stretch_losses(results, ways).means
    assert whole < half < none
    new = ~np.isin(np.arange(200), np.concatenate([results.player_a, results.player_b])[:100])
    ratings = fit(results, prior_sd=0.5, levels=Levels(field=1.0))
    expected = ratings.expected[new & ~ratings.idle]
    assert np.corrcoef(expected, skill[new & ~ratings.idle])[0, 1] > 0.4


@pytest.mark.thorough
@pytest.mark.parametrize(("apart", "used"), [(1.0, True), (0.0, False)])
def test_the_search_finds_fields_that_differ_and_no_others(apart, used):
    results = small_city(9, apart)
    evidence = {one.of: one for one in best_prior(results).evidence}
    assert evidence["field"].used == used
