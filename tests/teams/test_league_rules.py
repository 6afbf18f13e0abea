"""Every team against every other: complements, caps that do not bind, the toss."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Roster
from evenbreak.teams import Cap, Squad, TeamNight, league_nights, set_laws, solved
from evenbreak.teams.solve import against_all, first_edges

ROSTERS = [
    Roster(["Ann", "Bo", "Cy"], [640, 560, 450]),
    Roster(["Di", "Ed", "Flo"], [540, 530, 500]),
    Roster(["Gus", "Hal", "Ida"], [600, 520, 430]),
]
SQUADS = [Squad(one.players) for one in ROSTERS]


def laws(i, j):
    return set_laws(ROSTERS[i], ROSTERS[j], 5)


@pytest.mark.parametrize("order", ["alternate", "home", "loser", "=AB"])
def test_each_night_is_the_one_solved_alone(order):
    nights = league_nights(SQUADS, laws, sets=3, order=order)
    for i, j in ((0, 1), (2, 0)):
        night = TeamNight(SQUADS[i], SQUADS[j], laws(i, j), sets=3, order=order)
        assert nights[i, j] == pytest.approx(solved(night).value, abs=1e-14)


def test_nobody_names_first_in_a_blind_order():
    nights = league_nights(SQUADS, laws, sets=3, order="blind")
    assert np.nanmax(np.abs(first_edges(nights))) < 1e-9


def test_edges_are_the_same_for_both_teams_and_chances_average_to_one_half():
    nights = league_nights(SQUADS, laws, sets=3, order="home")
    edges = first_edges(nights)
    assert edges == pytest.approx(edges.T, nan_ok=True, abs=1e-14)
    assert against_all(nights).mean() == pytest.approx(0.5, abs=1e-12)


def test_a_cap_that_does_not_bind_changes_nothing():
    loose = [Squad(one.names, (Cap((7.0, 5.0, 3.0), 15.0),)) for one in SQUADS]
    free, capped = (league_nights(each, laws, sets=3) for each in (SQUADS, loose))
    assert free == pytest.approx(capped, nan_ok=True, abs=1e-14)


def test_one_team_is_refused():
    with pytest.raises(InputError, match="at least two"):
        league_nights(SQUADS[:1], laws, sets=3)
