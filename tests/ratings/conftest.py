"""Seasons that tests of the ratings share."""

import math

import numpy as np
import pytest

from evenbreak.ratings import Results, walk_forward

PLAYERS = 20


def play_season(rng, *, matches=1200, form=0.0, advantage=0.0, side=0.0, breaks=3, streak=0.0):
    """Return a season of races to 7, rack by rack, with what the model does not know."""
    skill = rng.normal(0.0, 0.5, PLAYERS)
    a = rng.integers(0, PLAYERS, matches)
    b = (a + rng.integers(1, PLAYERS, matches)) % PLAYERS
    first = rng.integers(1, 3, matches)
    racks = []
    for k in range(matches):
        d = skill[a[k]] - skill[b[k]] + side + form * rng.standard_normal()
        text, broke, last = "", first[k], 0.0
        while max(text.count("a"), text.count("b")) < 7:
            edge = advantage if broke == 1 else -advantage
            won = rng.random() < 1 / (1 + math.exp(-(d + edge + streak * last)))
            text, last = text + "ba"[won], 1.0 if won else -1.0
            broke = 3 - broke if breaks == 3 else (1 if won else 2)
        racks.append(text)
    return Results(
        tuple(f"p{k:02d}" for k in range(PLAYERS)), a, b,
        [text.count("a") for text in racks], [text.count("b") for text in racks],
        date=np.datetime64("2024-09-03") + np.arange(matches) // 40,
        racks=np.array(racks, dtype=object), first_break=first,
        break_format=np.full(matches, breaks),
    )  # fmt: skip


@pytest.fixture(scope="session", name="play_season")
def play_season_fixture():
    """What plays a season of races to 7."""
    return play_season


@pytest.fixture(scope="session")
def plain():
    """The forecasts of a season that the model describes."""
    return walk_forward(play_season(np.random.default_rng(1)), prior_sd=0.5)
