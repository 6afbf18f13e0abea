"""Ratings to begin from: laws of what is carried over from one season to the next."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Beginning, Levels, Results, best_prior, fit, validate, walk_forward

WIDTH = 0.5


def season(seed: int, *, matches: int = 260, first: str = "2026-01-01", players: int = 8):
    """Random matches among players of known skill, one day after another."""
    rng = np.random.default_rng(seed)
    skill = np.linspace(-0.8, 0.8, players)
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    won = rng.binomial(9, 1.0 / (1.0 + np.exp(skill[b] - skill[a])))
    names = [f"P{k}" for k in range(players)]
    days = np.datetime64(first) + np.arange(matches) // 4
    return Results(tuple(names), a, b, won, 9 - won, date=days)


def begun(ratings, **more) -> Beginning:
    return Beginning(
        ratings.players,
        ratings.rating,
        ratings.quasi_error,
        prior_sd=ratings.scale.points(ratings.prior_sd),
        prior_mean=ratings.expected,
        games=ratings.games,
        **more,
    )


def test_two_seasons_in_turn_are_nearly_one_career() -> None:
    whole = season(1)
    half = np.arange(len(whole)) < len(whole) // 2
    last, this = whole.select(half), whole.select(~half)
    joint = fit(whole, prior_sd=WIDTH)
    alone = fit(this, prior_sd=WIDTH)
    beginning = begun(fit(last, prior_sd=WIDTH))
    in_turn = fit(this, prior_sd=WIDTH, levels=Levels(beginning=beginning))
    assert np.abs(in_turn.rating - joint.rating).max() < 0.6
    assert np.abs(alone.rating - joint.rating).max() > 4.0
    assert in_turn.quasi_error == pytest.approx(joint.quasi_error, rel=0.02)


def test_ratings_off_by_anything_change_nothing() -> None:
    results = season(2)
    vague = Beginning(results.players, np.linspace(200, -50, 8), np.full(8, 1e5))
    plain = fit(results, prior_sd=WIDTH)
    told = fit(results, prior_sd=WIDTH, anchor=plain.anchor, levels=Levels(beginning=vague))
    assert told.rating == pytest.approx(plain.rating, abs=1e-3)
    assert told.standard_error == pytest.approx(plain.standard_error, rel=1e-6)


def test_ratings_that_are_certain_stay() -> None:
    results = season(3)
    sure = Beginning(results.players, np.linspace(60, 100, 8), np.full(8, 1e-3))
    found = fit(results, prior_sd=WIDTH, levels=Levels(beginning=sure))
    assert found.rating == pytest.approx(np.linspace(60, 100, 8), abs=1e-2)


def test_the_walk_forward_begins_from_them_and_predicts_better() -> None:
    whole = season(4)
    half = np.arange(len(whole)) < len(whole) // 2
    beginning = begun(fit(whole.select(half), prior_sd=WIDTH))
    this = whole.select(~half)
    plain = walk_forward(this, prior_sd=WIDTH)
    told = walk_forward(this, prior_sd=WIDTH, levels=Levels(beginning=beginning))
    first = plain.date_of == 0
    assert (plain.p_game[first] == 0.5).all()
    assert (told.p_game[first] != 0.5).all()

    def loss(walk):
        won, games = walk.results.score_a, walk.games
        return -(won * np.log(walk.p_game) + (games - won) * np.log1p(-walk.p_game)).sum()

    assert loss(told) < loss(plain) - 5.0
    assert validate(this, prior_sd=WIDTH, beginning=beginning).skill.value > 0.0


def test_old_ratings_fade_like_old_results() -> None:
    """A season rated with a half-life, then one match a long time after: as if both were rated."""
    whole = season(5)
    last = fit(whole, prior_sd=WIDTH, half_life=100)
    beginning = begun(last, as_of=whole.date.max())
    later = season(6, matches=40, first="2027-01-01")
    told = fit(later, prior_sd=WIDTH, half_life=100, levels=Levels(beginning=beginning))
    joint = fit(whole.joined(later), prior_sd=WIDTH, half_life=100)
    unfaded = fit(later, prior_sd=WIDTH, levels=Levels(beginning=beginning))
    assert np.abs(told.rating - joint.rating).max() < 1.5
    assert told.quasi_error == pytest.approx(joint.quasi_error, rel=0.05)
    assert (unfaded.quasi_error < told.quasi_error).all()


def test_groups_that_never_met_are_linked_by_what_they_bring_along() -> None:
    night = Results.from_names(["A", "C"], ["B", "D"], [7, 7], [5, 2])
    four = Beginning(["A", "B", "C", "D"], [90, 80, 70, 60], [5, 5, 5, 5])
    assert fit(night).component.max() == 2
    found = fit(night, levels=Levels(beginning=four))
    assert found.component.max() == 1
    assert found.difference_error("A", "C") < 9.0


@pytest.mark.slow
def test_how_far_off_ratings_are_that_do_not_say_is_chosen_by_prediction() -> None:
    results = season(7)
    skill = np.linspace(-0.8, 0.8, 8) * 30 / np.log(2)
    right = Beginning(results.players, 80 + skill)
    wrong = Beginning(results.players, 80 + np.random.default_rng(1).permutation(4 * skill))
    choice = best_prior(results, beginning=right, half_life=None)
    assert choice.levels.brought_sd in (0.05, 0.1, 0.2)
    assert best_prior(results, beginning=wrong, half_life=None).levels.brought_sd in (0.0, 0.8)


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(InputError, match="must be finite numbers of points"):
        Beginning(["A"], [np.nan])
    with pytest.raises(InputError, match="isn't above 0"):
        Beginning(["A"], [80], [0.0])
    with pytest.raises(InputError, match="name once; one appears twice"):
        Beginning(["A", "A"], [80, 70])
