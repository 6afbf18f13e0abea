"""Two players, described in one of three ways."""

import pytest

from evenbreak.answers.match.asked import players_of
from evenbreak.errors import InputError
from evenbreak.fields.question import AskedError
from evenbreak.games import Rack, loser_breaks, player_2_breaks
from evenbreak.questions.match import Players
from evenbreak.ratings.scale import SCALES


def players(
    *ratings: str, from_file=None, scale=None, p=None, p1=None, p2=None, breaks=None, first=None
):
    asked = Players(
        ratings=ratings,
        scale=scale,
        p=p,
        p1=p1,
        p2=p2,
        breaks=breaks,
        first_break=first,
        from_file=from_file,
    )
    return players_of(asked)


def test_by_ratings() -> None:
    found = players("612", "512", scale=SCALES["fargo"])
    assert found.rack == SCALES["npl"].rack(30.0)
    assert players("110", "80").rack == SCALES["npl"].rack(
        30.0
    )  # points of the NPL, if no scale is given


def test_by_one_chance() -> None:
    assert players(p=0.6).rack == Rack(0.6)


@pytest.mark.parametrize(
    ("breaks", "first", "breaker"), [("loser", None, 1), ("loser", "b", 2), ("b", None, 2)]
)
def test_by_a_chance_for_each_breaker(breaks: str, first: str | None, breaker: int) -> None:
    found = players(p1=0.6, p2=0.5, breaks=breaks, first=first)
    assert (found.rack, found.first_breaker) == (Rack(0.6, 0.5), breaker)
    assert found.break_format is (loser_breaks if breaks == "loser" else player_2_breaks)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"p": 0.6, "p1": 0.5, "p2": 0.5, "breaks": "loser"},
        {"p1": 0.6, "p2": 0.5},
        {"p1": 0.6, "breaks": "loser"},
        {"p": 0.6, "breaks": "loser"},
        {"p": 0.6, "first": "b"},
        {"p": 0.6, "scale": SCALES["npl"]},
    ],
)
def test_options_that_contradict_are_refused(given) -> None:
    with pytest.raises(AskedError):
        players(**given)


@pytest.fixture
def listed(tmp_path):
    path = tmp_path / "ratings.csv"
    path.write_text(
        "player,rating,standard_error,quasi_error,games,component,scale\n"
        "Ann Lee,612,90,20,140,1,fargo\nBo Diaz,521,80,15,90,1,fargo\n"
        "Cy,500,80,30,90,2,fargo\nDi,,,,0,,fargo\n",
        encoding="utf-8",
    )
    return str(path)


def test_by_name_with_the_ratings_scale_and_errors_of_a_list(listed) -> None:
    found = players("ann lee", "Bo Diaz", from_file=listed)
    assert found.names == ("Ann Lee", "Bo Diaz")
    assert found.rack == SCALES["fargo"].rack(91.0)
    assert found.error == pytest.approx(25.0)
    assert players("Ann Lee", "Bo Diaz", from_file=listed, scale=SCALES["fargo"]) == found


@pytest.mark.parametrize(
    ("names", "more", "named"),
    [
        (("Ann Lee",), {}, "you named 1"),
        (("Ann Lee", "Bo Dias"), {}, "'Bo Diaz'"),
        (("Ann Lee", "ann lee"), {}, "the same player"),
        (("Ann Lee", "Cy"), {}, "chain of opponents"),
        (("Ann Lee", "Di"), {}, "no rating"),
        (("Ann Lee", "Bo Diaz"), {"scale": SCALES["npl"]}, "scale"),
        ((), {"p": 0.6}, "from_file"),
    ],
)
def test_names_that_cannot_be_used_are_refused(listed, names, more, named) -> None:
    with pytest.raises(InputError, match=named):
        players(*names, from_file=listed, **more)


@pytest.mark.parametrize("ratings", [("612",), ("1", "2", "3"), ("1e308", "-1e308")])
def test_two_ratings_of_a_size_to_calculate_with(ratings: tuple[str, ...]) -> None:
    with pytest.raises(AskedError):
        players(*ratings)
