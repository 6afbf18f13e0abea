from evenbreak import games
from evenbreak.game import Game
from evenbreak.games import CATALOGUE, Match


def test_every_kind_of_game_is_in_the_catalogue():
    public = [getattr(games, name) for name in games.__all__]
    kinds = {one for one in public if isinstance(one, type) and hasattr(one, "moves")}
    assert {type(game) for game in CATALOGUE.values()} == kinds - {Match}


def test_all_of_them_are_games():
    assert all(isinstance(game, Game) for game in CATALOGUE.values())
