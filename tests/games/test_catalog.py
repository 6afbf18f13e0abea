import pytest

from evenbreak import games
from evenbreak.errors import InputError
from evenbreak.game import Game
from evenbreak.games import (
    CATALOG,
    Drill,
    Match,
    OneBall,
    Race,
    Rack,
    Series,
    game_of_catalog,
    loser_breaks,
)
from rows import each_of


def test_every_kind_of_game_is_in_the_catalog():
    public = [getattr(games, name) for name in games.__all__]
    kinds = {one for one in public if isinstance(one, type) and hasattr(one, "moves")}
    assert {type(game) for game in CATALOG.values()} == kinds - {Match}


def test_all_of_them_are_games():
    assert all(isinstance(game, Game) for game in CATALOG.values())


@each_of("name", CATALOG)
def test_each_name_means_its_game(name):
    assert game_of_catalog(name.upper()) == (name, CATALOG[name])


@pytest.mark.parametrize(
    ("words", "chances", "game"),
    [
        ("drill 8-ball", (0.5,), Drill.eight_ball(0.5)),
        ("drill 9-ball", (0.5,), Drill.progressive(0.5)),
        ("series loser", (0.9, 0.5), Series(Rack(0.9, 0.5), breaks=loser_breaks)),
        ("race of one-ball", (0.3, 0.6), Race(3, 2, OneBall(0.3, 0.6))),
        ("3:1 match", (0.6,), Race(3, 1, Race(3, 3, Rack(0.6)))),
        ("One_Ball", (0.3, 0.6), OneBall(0.3, 0.6)),
        ("oneball", (0.3, 0.6), OneBall(0.3, 0.6)),
        ("Drill-9ball", (0.5,), Drill.progressive(0.5)),
    ],
)
def test_other_chances(words, chances, game):
    assert game_of_catalog(words, *chances)[1] == game


def test_a_slip_gets_the_nearest_name():
    with pytest.raises(InputError, match=r"Choose one of: one-ball$"):
        game_of_catalog("onebal")


@pytest.mark.parametrize("words", ["", "drill", "winner breaks", "chess"])
def test_names_of_none_or_of_several_are_refused(words):
    with pytest.raises(InputError, match="Choose one of"):
        game_of_catalog(words)
