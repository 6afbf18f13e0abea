"""What a season is."""

import pickle

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import chart, system_of
from evenbreak.league import FixedSchedule, LeaguePlayers, RandomPairing, RoundRobin, Season

CLUB = LeaguePlayers.of([50, 60, 70])


def test_names_become_what_they_name() -> None:
    season = Season(CLUB, "npl", "npl_8", weeks=3.0)
    assert season.system is system_of("npl")
    assert season.chart == chart("npl_8")
    assert season.schedule == RoundRobin(3)
    assert season.weeks == 3
    assert Season(CLUB, "npl").chart.name == "npl_10"


def test_what_is_worked_out_is_not_sent() -> None:
    season = Season(CLUB, "npl")
    before = len(pickle.dumps(season))
    assert season.lookup.wins.size > 1000
    assert len(pickle.dumps(season)) == before
    again = pickle.loads(pickle.dumps(season))  # noqa: S301
    assert np.array_equal(again.lookup.wins, season.lookup.wins)


@pytest.mark.parametrize("system", ["npl", "step 2", "margin", "elo 16", "fixed 9"])
def test_every_system_can_be_sent(system: str) -> None:
    again = pickle.loads(pickle.dumps(Season(CLUB, system)))  # noqa: S301
    assert again.system == system_of(system)


def test_the_longest_move_is_a_newcomers_if_there_is_one() -> None:
    assert Season(LeaguePlayers.of([50, 60], played=[100, 29]), "npl").longest_move == 3
    assert Season(LeaguePlayers.of([50, 60], played=[100, 30]), "npl").longest_move == 1
    assert Season(CLUB, "step 2").longest_move == 2


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"players": [50, 60]}, r"players must be LeaguePlayers; you gave \[50, 60\]"),
        (
            {"system": "nobody"},
            (
                r"system must be npl, step UP \[DOWN\], margin \[MOST\], elo \[K\], fixed "
                r"\[GAMES\], none \[GAMES\], fargo-like, level-review, apa-like, tap-like, "
                r"level-steps \[STEPS\], averages, win-percent or napa-like; you gave 'nobody'"
            ),
        ),
        (
            {"chart": "nobody"},
            (
                "chart must be a chart by rating difference: fargo_r6_hot, npl_8, npl_10, "
                "npl_12, npl_20, or a Chart of your own; you gave 'nobody'"
            ),
        ),
        ({"weeks": 0}, "weeks must"),
        ({"play": "frames"}, "play must be 'matches' or 'racks'; you gave 'frames'"),
        ({"schedule": RoundRobin(4)}, "players is 4, but the league has 3"),
        ({"schedule": FixedSchedule([1], [0], [5])}, "the schedule has matches for player 5"),
        (
            {"schedule": "weekly"},
            "schedule must be RoundRobin, RandomPairing or FixedSchedule; you gave 'weekly'",
        ),
    ],
)
def test_what_is_refused(given: dict, said: str) -> None:
    with pytest.raises(InputError, match=said):
        Season(**({"players": CLUB, "system": "npl"} | given))


def test_random_pairing_fits_any_league() -> None:
    assert Season(CLUB, "npl", schedule=RandomPairing(2)).schedule.matches_a_week == 2
