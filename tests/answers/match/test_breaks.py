import pytest

from evenbreak.answers.match.formats import breaks_answer
from evenbreak.games import Rack
from evenbreak.practice import compare_break_formats


def test_the_rows_are_the_formats_best_for_a_first():
    rows = breaks_answer(Rack(0.9, 0.5), lose=2).to_dict()["formats"]
    values = compare_break_formats(Rack(0.9, 0.5), lose=2)
    assert [row["share_a"] for row in rows] == [value.share for value in values]
    assert [row["points_per_rack"] for row in rows] == [value.points for value in values]
    assert rows[0]["first_break_racks"] is None


@pytest.mark.parametrize(
    ("p1", "p2", "for_a", "for_b"),
    [(0.5, 0.1, "loser", "winner"), (0.95, 0.94, "winner", "loser")],
)
def test_the_best_format_for_each(p1, p2, for_a, for_b):
    words = breaks_answer(Rack(p1, p2)).sentences[0]
    assert words.index(f"A does best with {for_a} breaks") < words.index(f"with {for_b} breaks")


def test_where_the_stakes_turn():
    words = breaks_answer(Rack(0.9, 0.5), lose=3).sentences[0].split("\n")[1]
    assert "ahead with winner breaks" in words
    assert "behind with alternate and loser breaks" in words


@pytest.mark.parametrize(("p1", "p2"), [(0.6, 0.4), (0.7, 0.7)])
def test_formats_that_are_worth_the_same(p1, p2):
    assert "worth the same" in breaks_answer(Rack(p1, p2)).sentences[0]


@pytest.mark.parametrize(("p", "name"), [(1.0, "winner"), (0.0, "loser")])
def test_a_break_that_never_passes_on(p, name):
    assert breaks_answer(Rack(p, p)).sentences[0].startswith(f"With {name} breaks, the player who")


def test_a_session_in_points():
    # W = 5/6 in winner breaks: 5/6 - 2/6 points a rack.
    assert "50 points ahead" in breaks_answer(Rack(0.9, 0.5), lose=2).sentences[0]
    assert "even on average" in breaks_answer(Rack(0.75, 0.75)).sentences[0]
    assert "behind" in breaks_answer(Rack(0.2, 0.9)).sentences[0]
