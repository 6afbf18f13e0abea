"""Seasons that tests of `validate` share."""

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.files.results.results_file import read_results
from evenbreak.ratings import Results, validate
from evenbreak.ratings.validation.within_matches import play_races
from places import DATA

PLAYERS = 24


def play_season(
    seed: int,
    *,
    matches: int = 900,
    side: float = 0.0,
    spot: bool = False,
    skills: float = 0.5,
    days: float = 0.0,
) -> Results:
    """Return a season by the model; with `spot`, player a of each match gives two games.

    `skills` is the spread of strengths, `days` that of good and bad days.
    """
    rng = np.random.default_rng(seed)
    skill = rng.normal(0.0, skills, PLAYERS)
    a = rng.integers(0, PLAYERS, matches)
    b = (a + rng.integers(1, PLAYERS, matches)) % PLAYERS
    m, n = np.full(matches, 7), np.full(matches, 5 if spot else 7)
    day = days * rng.standard_normal(matches) if days else 0.0
    won, games = play_races(expit(skill[a] - skill[b] + side + day), m, n, rng)
    return Results(
        tuple(f"p{k:02d}" for k in range(PLAYERS)), a, b, won, games - won,
        race_a=m, race_b=n, date=np.datetime64("2024-09-03") + np.arange(matches) // 30,
    )  # fmt: skip


@pytest.fixture(scope="session", name="play_season")
def play_season_fixture():
    return play_season


@pytest.fixture(scope="session")
def demo():
    """The demo league, a handicap league whose scores vary more than the model says."""
    return validate(read_results(DATA / "demo_league.csv").results, prior_sd=0.52)


@pytest.fixture(scope="session")
def chosen():
    """A season of the model, with the prior chosen by it."""
    return validate(play_season(5))


@pytest.fixture(scope="session")
def alike():
    """A season of nearly equal players, for whom the default prior is too wide."""
    return validate(play_season(8, matches=500, skills=0.2))
