"""Parts of a season by which a prior is chosen, where it is far larger than that takes."""

import numpy as np
import pytest

from evenbreak.ratings import Results, best_prior, prior
from evenbreak.ratings.season_part import connected_part


def season(rng, players, matches, size=30, across=0.1, **columns):
    """Return matches in clubs, one in ten between them, a third of them not played."""
    a = rng.integers(0, players, matches)
    b = a - a % size + (a % size + rng.integers(1, size, matches)) % size
    b = np.where(rng.random(matches) < across, (a + rng.integers(1, players, matches)) % players, b)
    b = np.where(b >= players, (a + 1) % players, b)
    won = rng.integers(0, 3, matches)
    names = tuple(f"P{k:05d}" for k in range(players))
    date = np.datetime64("2026-01-01") + np.sort(rng.integers(0, 300, matches))
    return Results(names, a, b, won, np.where(won, 2, 0), date=date, **columns)


@pytest.mark.parametrize("wanted", [500, 2_000])
def test_a_part_has_about_as_many_matches_as_are_wanted(wanted):
    part = connected_part(season(np.random.default_rng(1), 3_000, 30_000), wanted)
    assert wanted <= part.counted.sum() < wanted + 1_500  # the last club's, and its links


def test_players_of_a_part_keep_nearly_all_of_their_matches():
    whole = season(np.random.default_rng(2), 6_000, 60_000)
    part = connected_part(whole, 5_000)
    assert 0.88 < (len(part) / len(part.players)) / (len(whole) / len(whole.players)) <= 1.0


def test_a_part_has_all_matches_of_its_players_with_each_other_as_they_were():
    rng = np.random.default_rng(3)
    whole = season(rng, 900, 9_000, division=np.array(["East", "West"])[rng.integers(0, 2, 9_000)])
    part = connected_part(whole, 1_000)
    chosen = {*part.players}
    rows = [
        row
        for row in range(len(whole))
        if {whole.players[whole.player_a[row]], whole.players[whole.player_b[row]]} <= chosen
    ]
    assert [part.players[k] for k in part.player_a] == [
        whole.players[whole.player_a[row]] for row in rows
    ]
    for column in ("score_a", "score_b", "date", "division"):
        np.testing.assert_array_equal(getattr(part, column), getattr(whole, column)[rows])


def test_a_season_that_is_small_enough_stays_whole():
    whole = season(np.random.default_rng(4), 90, 500)
    assert connected_part(whole, 500) is whole


def test_clubs_that_never_meet_are_all_drawn_if_need_be():
    whole = season(np.random.default_rng(5), 600, 6_000, size=20, across=0.0)
    part = connected_part(whole, 3_000)
    assert part.counted.sum() >= 3_000
    assert part.players == connected_part(whole, 3_000).players


def league(rng, players=1_000, matches=10_000):
    """Return a league in clubs in which a third join late, .4 weaker in log-odds."""
    whole = season(rng, players, matches)
    late = rng.random(players) < 1 / 3
    skill = rng.normal(0.0, 0.5, players) - 0.4 * late
    day = (whole.date - whole.date.min()).astype(int)
    a, b = (np.where(late[k] & (day < 90), k - k % 30, k) for k in (whole.player_a, whole.player_b))
    apart = a != b
    a, b = a[apart], b[apart]
    won = rng.binomial(9, 1.0 / (1.0 + np.exp(skill[b] - skill[a])))
    return Results(whole.players, a, b, won, 9 - won, date=whole.date[apart])


@pytest.mark.slow
@pytest.mark.thorough
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_part_chooses_as_the_whole_season_does(monkeypatch, seed):
    whole = league(np.random.default_rng(seed))
    by_all = best_prior(whole)
    assert by_all.part is None
    monkeypatch.setattr(prior, "ENOUGH", 3_000)
    by_part = best_prior(whole)
    assert 3_000 <= by_part.part < 5_000
    # Widths are a factor of √2 apart, and neither range is narrower than a step each way.
    assert by_part.low / 1.5 <= by_all.prior_sd <= by_part.high * 1.5
    assert by_part.half_life == by_all.half_life
    for of_all, of_part in zip(by_all.evidence, by_part.evidence, strict=True):
        both = of_all.gain, of_part.gain
        error = np.hypot(*((gain.high - gain.low) / 3.92 for gain in both))
        assert abs(of_all.gain.value - of_part.gain.value) < 4.0 * error
        if None not in (of_all.standard_error, of_part.standard_error):
            off = np.hypot(of_all.standard_error, of_part.standard_error)
            assert abs(of_all.value - of_part.value) < 4.0 * off
