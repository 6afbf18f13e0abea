import pytest

from evenbreak.sheets.pdf_page import MARGIN, WIDTH, width_of
from evenbreak.sheets.pdf_sheet import (
    GAP,
    LARGEST,
    LONGEST_NAME,
    MOST_ON_A_PAGE,
    NARROWEST_BARS,
    page_sizes,
    rating_text,
    slanted_name,
)
from evenbreak.sheets.race_blocks import PlayerLine

ROOM = 7.0


def lines_of(players, name="Player"):
    return [
        PlayerLine(k, f"{name} {k}", "612", "35", 9, 5, 4, None, 40.0, 50.0, 60.0)
        for k in range(1, players + 1)
    ]


def layout(players, race="7:5", name="Player"):
    return page_sizes(lines_of(players, name), {("a", "b"): race}, ROOM)


@pytest.mark.parametrize("players", [1, 2, 12, 24, 25, 60])
@pytest.mark.parametrize("race", ["7:5", "100:100"])
def test_columns_and_bars_fill_no_more_than_the_page(players, race):
    found = layout(players, race)
    start, end = found.bars(found.columns)
    assert found.left == pytest.approx(MARGIN + found.place + found.name + 2 * GAP)
    assert found.right(found.columns) < start < end <= WIDTH - MARGIN + 1e-9
    assert end - start >= NARROWEST_BARS - 1e-9
    assert found.columns <= min(players, MOST_ON_A_PAGE)


@pytest.mark.parametrize("players", [2, 12, 24])
def test_names_rows_and_ticks_have_the_height_that_is_there(players):
    found = layout(players)
    assert found.row * players + (found.top - MARGIN) <= ROOM + 1.08
    assert found.text_size <= LARGEST


def test_more_players_have_smaller_letters_and_longer_races_fewer_columns():
    sizes = [layout(players).text_size for players in (4, 20, 24)]
    assert sizes == sorted(sizes, reverse=True)
    assert layout(24, "100:100").columns < layout(24).columns == 24


def test_a_race_fits_its_cell_and_a_long_name_is_cut():
    found = layout(24, "13:12", name="W" * 60)
    assert width_of("13:12", found.race_size) < found.cell
    assert found.name == LONGEST_NAME
    [line] = lines_of(1, "W" * 60)
    name = slanted_name(line, 9.0)
    assert name.startswith("1  WWW")
    assert width_of(name.removeprefix("1  "), 9.0) <= LONGEST_NAME + 1e-9


def test_a_rating_stands_with_its_error():
    assert rating_text(lines_of(1)[0]) == "612 ± 35"
