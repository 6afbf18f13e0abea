"""Captains of a simulated league of teams."""

import numpy as np
import pytest

from evenbreak.answers.league.captains import SealedCaptains
from evenbreak.handicaps import system_of
from evenbreak.league import LeaguePlayers, World, estimate, play_systems
from evenbreak.league.contest import Doublings
from evenbreak.league.judged import MEASURES
from evenbreak.ratings.scale import SCALES

LEVELS = np.array([5.0, 2.0, 7.0, 3.0])
TEAMS = np.repeat([0, 1, 2], 4)
RATED = np.tile([600, 540, 500, 440], 3) + TEAMS * 10


def world(**options):
    players = LeaguePlayers.of(RATED)
    return World(players, SCALES["fargo"], teams=TEAMS, sets=2, weeks=12, **options)


def picked(cap, luck=(0.5, 0.5)):
    review = Doublings(system_of("level-review"), world())
    return SealedCaptains(2, cap)(review, LEVELS, LEVELS, np.array(luck))


@pytest.mark.parametrize(("cap", "most"), [(12, 12), (9, 9), (5, 5), (3, 5)])
def test_a_line_up_keeps_the_cap_or_is_the_weakest(cap, most):
    for luck in np.linspace(0.0, 1.0, 7):
        for places in picked(cap, (luck, luck)):
            assert len(set(places.tolist())) == 2
            assert LEVELS[places].sum() <= most


def test_captains_put_up_those_whom_the_chart_favors():
    """The chart's higher levels are favored in every cell, so without a cap the two best play."""
    mine, others = picked(None)
    assert sorted(LEVELS[mine]) == sorted(LEVELS[others]) == [5.0, 7.0]


def test_best_line_ups_change_who_plays():
    review = [system_of("level-review")]
    usual, best = (
        play_systems(world(), review, replicas=8, seed=1, captains=captains)
        for captains in (None, SealedCaptains(2))
    )
    games = [estimate(one, MEASURES["mean_games"], world()).value[0] for one in (usual, best)]
    assert games[1] > games[0]  # the higher levels' races are the longer ones
