"""The columns of a simulated league."""

import pickle

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.league import ESTABLISHED, LeaguePlayers
from rows import each_of


def test_one_number_stands_for_everybody() -> None:
    club = LeaguePlayers.of([50, 60, 70], day_sd=4, absence=0.25)
    assert club.day_sd.tolist() == [4.0] * 3
    assert club.absence.tolist() == [0.25] * 3
    assert club.skill.tolist() == [50.0, 60.0, 70.0]
    assert club.played.tolist() == [ESTABLISHED] * 3


def test_columns_are_read_only_copies() -> None:
    rating = np.array([50, 60])
    club = LeaguePlayers.of(rating)
    rating[0] = 99
    assert club.rating.tolist() == [50, 60]
    with pytest.raises(ValueError, match="read-only"):
        club.rating[0] = 1


def test_players_can_be_sent_elsewhere() -> None:
    club = LeaguePlayers.of([50, 60], drift=0.5, names=["Ann", "Bo"])
    again = pickle.loads(pickle.dumps(club))  # noqa: S301
    assert again.names == ("Ann", "Bo")
    assert again.drift.tolist() == [0.5, 0.5]


def test_players_join_and_leave() -> None:
    club = LeaguePlayers.of([50, 60, 70], joins=[1, 3, 1], leaves=[0, 0, 2])
    here = [club.here(week).tolist() for week in (1, 2, 3)]
    assert here == [[True, False, True], [True, False, True], [True, True, False]]


@each_of(
    "columns, said",
    [
        ({"rating": [50]}, "player, two or more"),
        ({"rating": [[50, 60]]}, "player, two or more"),
        (
            {"rating": [50.5, 60]},
            r"rating must be whole numbers from -15000 to 15000; it holds 50\.5",
        ),
        (
            {"rating": [50, 60], "skill": [50]},
            r"skill must have one value for each of 2 players; its shape is \(1,\)",
        ),
        (
            {"rating": [50, 60], "skill": [50, np.nan]},
            "skill must be numbers from -15000 to 15000; it holds nan",
        ),
        ({"rating": [50, 60], "skill": ["a", "b"]}, "skill must be numbers from"),
        ({"rating": [50, 60], "absence": 1.5}, "absence must be numbers from 0 to 1; it is 1.5"),
        ({"rating": [50, 60], "day_sd": -1}, "day_sd .*-1"),
        ({"rating": [50, 60], "joins": 0}, "joins must be whole numbers of 1 or more"),
        ({"rating": [50, 60], "played": -1}, "played must be whole numbers of 0 or more"),
        (
            {"rating": [50, 60_000]},
            "rating must be whole numbers from -15000 to 15000; it holds 60000",
        ),
        (
            {"rating": [50, 60], "joins": [1, 4], "leaves": [0, 2]},
            "joins in week 4 but leaves in week 2",
        ),
        ({"rating": [50, 60], "names": ["Ann"]}, "names must"),
        ({"rating": [50, 60], "names": ["Ann", "Ann"]}, "names must"),
    ],
)
def test_what_is_refused(columns: dict, said: str) -> None:
    with pytest.raises(InputError, match=said):
        LeaguePlayers.of(**columns)
