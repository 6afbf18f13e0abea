import pytest

from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.games import Rack, alternate_breaks
from evenbreak.ratings import scale_of


def test_rated_players():
    players = TwoPlayers.rated(612, 521, scale_of("fargo"), names=("Ann", "Bo"))
    assert players.p_game_a == pytest.approx(1 / (1 + 2**-0.91))
    assert players.doubts == []
    for part in ("Ann", "612", "Bo", "521", "Fargo"):
        assert part in players.description


def test_ratings_of_another_scale_raise_a_doubt():
    (doubt,) = TwoPlayers.rated(612, 521, scale_of("npl")).doubts
    assert "set scale to fargo" in doubt


def test_players_whose_break_matters():
    players = TwoPlayers(Rack(0.6, 0.5), "alternate", 2)
    assert players.p_game_a is None
    assert players.break_format is alternate_breaks
    assert players.description.endswith("alternate breaks, B breaks first")


@pytest.mark.parametrize(
    ("breaks", "first", "end"),
    [("b", 2, "B always breaks"), ("a", 1, "A always breaks"), ("b", 1, "A breaks first")],
)
def test_a_player_who_always_breaks(breaks, first, end):
    assert TwoPlayers(Rack(0.6, 0.5), breaks, first).description.endswith(end)
