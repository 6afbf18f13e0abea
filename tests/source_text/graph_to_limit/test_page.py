import re

import pytest

from evenbreak.source_text.graph_to_limit.page import graph_to_limit_page
from evenbreak.source_text.graph_to_limit.tables import GAMES, game_tables


@pytest.fixture(scope="module")
def page():
    return graph_to_limit_page(game_tables())


def test_every_place_is_filled_and_every_game_shown(page):
    assert "{{" not in page
    assert [asked.words for asked in GAMES.values() if page.count(asked.words) < 2] == []


def test_links_lead_to_its_tables(page):
    links = set(re.findall(r"\]\((\w+)\.csv\)", page))
    assert links == set(game_tables())
