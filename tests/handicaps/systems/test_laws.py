"""The laws of all systems find what breaks each of them."""

import numpy as np
import pytest

from evenbreak.handicaps.systems.fargo_like import FargoLike
from evenbreak.handicaps.systems.laws import broken_laws
from evenbreak.handicaps.systems.none import NoHandicap


class OneSided(NoHandicap):
    def race(self, a, b):
        return super().race(a, b)[0] + (np.asarray(a) > 0), super().race(a, b)[1]


class OnlyTonight(NoHandicap):
    def update(self, history):
        history.kept["nights"] = history.kept.get("nights", 0) + 1
        return history.ratings + history.kept["nights"]


class ByPlace(NoHandicap):
    def update(self, history):
        return history.ratings + np.arange(history.players).reshape(
            -1, *(1,) * (history.ratings.ndim - 1)
        )


class AcrossLeagues(NoHandicap):
    def update(self, history):
        return history.ratings * 0 + history.ratings.mean()


class Unfair(NoHandicap):
    def update(self, history):
        return history.ratings - history.counts("won", lambda matches: matches.won_a)


class Spoiler(NoHandicap):
    def update(self, history):
        history.ratings[:] = 0
        return history.ratings


class Shapeless(NoHandicap):
    def initial(self, entries):
        return entries.rating[0]


class NoGames(NoHandicap):
    def race(self, a, b):
        m, n = super().race(a, b)
        return m * 0, n


class Unbound(FargoLike):
    def update(self, history):
        return super().update(history) * np.nan


@pytest.mark.parametrize(
    ("system", "named"),
    [
        (OneSided(), "must be the same race either way"),
        (OnlyTonight(), "nothing is kept"),
        (ByPlace(), "a different order"),
        (AcrossLeagues(), "a league is simulated alone"),
        (Unfair(), "didn't lose a match"),
        (Spoiler(), "failed with ValueError"),
        (Shapeless(), "in the system none, initial returned an array of shape"),
        (NoGames(), "1 or more"),
        (Unbound(), "returned nan"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_each_law_is_found_broken(system, named):
    broken = broken_laws(system)
    assert broken
    assert named in " ".join(broken)
