"""The roads of the games, against what the text and closed forms say of them."""

import re
from decimal import Decimal

import pytest

from evenbreak.source_text.graph_to_limit import (
    GAMES,
    game_tables,
    graph_to_limit_page,
    places,
    small,
)


@pytest.fixture(scope="module")
def tables():
    return game_tables()


def test_every_game_is_in_every_table(tables):
    for name in ("game_graphs", "game_answers", "game_eigenvalues"):
        assert {row["game"] for row in tables[name]} == set(GAMES)
    assert {f"game_{name}" for name in GAMES} < set(tables)


def test_every_way_gives_the_same_number(tables):
    for row in tables["game_answers"]:
        assert row["kernel"] == row["elimination"] == row["eigen"], row["game"]
        assert row["apart"] == "below 1e-12"


def test_every_limit_sums_to_1_by_every_way(tables):
    for name in GAMES:
        rows = tables[f"game_{name}"]
        for way in ("elimination", "eigen"):
            assert float(sum(row[way] for row in rows)) == pytest.approx(1, abs=1e-8)
        assert {row["apart"] for row in rows} == {"below 1e-12"}


def test_what_the_text_says(tables):
    graphs = {row["game"]: row for row in tables["game_graphs"]}
    assert (graphs["one_ball"]["states"], graphs["one_ball"]["closed_classes"]) == (4, 2)
    assert graphs["alternate_breaks"]["period"] == 2
    assert graphs["winner_breaks"]["gap"] == Decimal("0.60000000")
    assert graphs["npl_10"]["eigenvectors"] == graphs["npl_10"]["states"] == 121
    assert [name for name, row in graphs.items() if not row["complete"]] == ["race_9_5"]
    answers = {row["game"]: row["kernel"] for row in tables["game_answers"]}
    assert float(answers["one_ball"]) == pytest.approx(5 / 11, abs=1e-10)
    assert float(answers["ahead_3_3"]) == pytest.approx(27 / 35, abs=1e-10)


def test_numbers_have_no_rounding_noise():
    assert str(places(-1e-17)) == "0"
    assert small(2e-13) == "below 1e-12"


@pytest.fixture(scope="module")
def page():
    return graph_to_limit_page(game_tables())


def test_every_place_is_filled_and_every_game_shown(page):
    assert "{{" not in page
    assert [asked.words for asked in GAMES.values() if page.count(asked.words) < 2] == []


def test_links_lead_to_its_tables(page):
    links = set(re.findall(r"\]\((\w+)\.csv\)", page))
    assert links == set(game_tables())
