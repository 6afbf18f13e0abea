"""Each page is read back from its texts and their places, as a person reads it."""

import itertools

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from evenbreak.answers.league.report import report_answer
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.ratings.results import Results
from evenbreak.sheets.pdf_page import MARGIN, PAPERS, width_of
from evenbreak.sheets.pdf_sheet import (
    GAP,
    LARGEST,
    LONGEST_NAME,
    MOST_ON_A_PAGE,
    NARROWEST_BARS,
    page_sizes,
    rating_text,
    sheet_pages,
    sheet_pdf,
    slanted_name,
)
from evenbreak.sheets.race_blocks import PlayerLine
from leagues import league, sheet_of, two_groups

WIDTH, _ = PAPERS["a4"]


def pages_of(season, *, paper="a4", **how):
    """Return the pages, and the sheet that they are made from."""
    sheet = sheet_of(season, prior_sd=1.0, **how)
    return sheet_pages(sheet, paper), sheet


def texts(page: Figure) -> list[str]:
    return [text.get_text() for text in page.axes[0].texts]


def races_on(page: Figure) -> dict[tuple[str, str], str]:
    """Return the race in each cell by the names of its row and of its column."""
    written = page.axes[0].texts
    columns = {
        text.get_position()[0]: text.get_text().split("  ", 1)[1]
        for text in written
        if text.get_rotation()
    }
    rows = {
        text.get_position()[1]: text.get_text()
        for text in written
        if text.get_text() in columns.values()
    }
    rows |= {
        text.get_position()[1]: text.get_text()
        for text in written
        if text.get_text().startswith("Player ")
    }
    found = {}
    for text in written:
        x, y = text.get_position()
        column = min(columns, key=lambda place: abs(place - x))
        row = min(rows, key=lambda place: abs(place - y))
        if text.get_ha() == "center" and (":" in text.get_text() or text.get_text() == "-"):
            found[rows[row], columns[column]] = text.get_text()
    return found


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("players", [2, 10, 25, 29])
def test_every_race_stands_in_the_row_and_column_of_its_players(players):
    pages, sheet = pages_of(league(players))
    found: dict[tuple[str, str], str] = {}
    for page in pages:
        on_page = races_on(page)
        assert not found.keys() & on_page.keys()
        found |= on_page
    assert found == sheet.races
    blocks = -(-players // MOST_ON_A_PAGE)
    assert len(pages) == blocks**2
    assert all((f"page {k} of 4" in texts(page)) for k, page in enumerate(pages, 1) if blocks == 2)


def test_a_season_is_named_and_explained():
    season = Results.from_names(
        *(["Ann", "Bo", "Cy", "Ann", "Bo"], ["Bo", "Cy", "Ann", "Bo", "Ann"]),
        *([7, 7, 3, 7, 0], [4, 5, 7, 0, 0]),
        date=["2024-09-03", "2024-09-10", "2024-09-17", "2024-09-18", "2024-09-18"],
        forfeit=[False, False, False, True, False],
    )
    (page,), sheet = pages_of(season, scale="fargo")
    words = " ".join(texts(page))
    for text in (
        *("season.csv, 2024-09-03 to 2024-09-17", sheet.offered.in_words, "Fargo-like"),
        *("1 forfeited match; 1 match at 0-0", "SHA-256 0123456789ab…"),
    ):
        assert text in words
    assert {"559 ± 93", "491 ± 92", "450 ± 92"} <= set(texts(page))
    assert "place among" not in words


def test_the_paper_says_what_the_terminal_says():
    (page,), sheet = pages_of(league(5))
    words = " ".join(texts(page))
    answer = report_answer(sheet)
    first, about_ratings = answer.sentences
    assert answer.parts[1].title in words
    assert about_ratings in words
    assert first.removeprefix(sheet.offered.in_words).strip() in words


def test_bars_are_two_standard_errors_either_way():
    (page,), sheet = pages_of(league(5))
    lines = page.axes[0].lines
    bars = [line.get_xdata() for line in lines if line.get_linewidth() > 2]
    dots = [line.get_xdata()[0] for line in lines if line.get_marker() == "o"]
    ratings = list(zip(sheet.rated["rating"], sheet.rated["standard_error"], strict=True))
    (high, _), (low, _) = ratings[0], ratings[-1]
    inch = (dots[0] - dots[-1]) / (high - low)
    for (start, end), dot, (rating, error) in zip(bars, dots, ratings, strict=True):
        assert dot - dots[-1] == pytest.approx(inch * (rating - low), abs=1e-3)
        assert dot - start == pytest.approx(2 * error * inch, abs=1e-3)
        assert end - dot == pytest.approx(2 * error * inch, abs=1e-3)


@pytest.mark.slow
def test_more_players_than_paper_holds_are_counted(monkeypatch):
    monkeypatch.setattr("evenbreak.sheets.pdf_sheet.MOST_ON_SHEET", 48)
    pages, _ = pages_of(league(50), top=49)
    words = " ".join(texts(pages[0]))
    assert "1 of 49 paired players" in words
    assert "place among all 50 players" in words
    assert len({name for page in pages for pair in races_on(page) for name in pair}) == 48


def test_players_who_cannot_be_compared_have_a_dash():
    season = Results.from_names(["Player 1", "Player 3"], ["Player 2", "Player 4"], [7, 7], [5, 4])
    (page,), sheet = pages_of(season)
    found = races_on(page)
    assert found["Player 1", "Player 3"] == found["Player 3", "Player 1"] == "-"
    assert found.items() >= sheet.races.items()
    assert len(sheet.races) == 4


def test_players_who_never_met_have_their_group_beside_them():
    (page,), sheet = pages_of(two_groups())
    words = texts(page)
    assert "group" in words
    for player, group in zip(sheet.rated["player"], sheet.rated["component"], strict=True):
        (y,) = (text.get_position()[1] for text in page.axes[0].texts if text.get_text() == player)
        on_line = [t for t in page.axes[0].texts if t.get_position()[1] == pytest.approx(y)]
        rightmost = max(on_line, key=lambda text: text.get_position()[0])
        assert rightmost.get_text() == str(group)
        assert rightmost.get_position()[0] <= WIDTH - MARGIN + 1e-9
    (one_group,), _ = pages_of(league(3))
    assert "group" not in texts(one_group)


def test_a_sheet_without_any_race_can_be_printed():
    assert sheet_pdf(sheet_of(two_groups(), players=["Ann", "Cy"])).startswith(b"%PDF")


UNUSUAL_NAMES = [
    "Player {}",
    "W" * 60 + " {}",
    "選手{}",
    "\N{GRINNING FACE}\N{ZERO WIDTH JOINER}\N{PILE OF POO} {}",
    r"$\frac{{}} {}",
    "عبد الله {}",
]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("season", "options"),
    [
        *((league(10, name), {}) for name in UNUSUAL_NAMES),
        (league(7, "W" * 60 + " {}"), {"offered": OfferedRaces(race_to=120)}),
        (league(24), {"source": "a file with a very long name " * 9 + ".csv"}),
        (league(2), {"offered": OfferedRaces(race_to=1000)}),
        (league(3), {"scale": 1e6}),
        (league(3), {"scale": 0.01}),
        (league(24), {"offered": OfferedRaces((3, 13)), "scale": "elo"}),
        (league(25, "Maximiliane Vandersloot-Hale {}"), {}),
        (league(28, "Maximiliane Vandersloot-Hale {}"), {"paper": "letter"}),
        (league(10, UNUSUAL_NAMES[0]), {"paper": "letter"}),
    ],
)
def test_nothing_leaves_the_page_or_touches_the_lines_next_to_it(season, options):
    pages, _ = pages_of(season, **options)
    for page in pages:
        wide, high = page.get_size_inches()
        assert (wide, high) == PAPERS[options.get("paper", "a4")]
        page.set_dpi(300)
        renderer = FigureCanvasAgg(page).get_renderer()
        boxes = []
        for text in page.axes[0].texts:
            box = text.get_window_extent(renderer)
            left, right = box.x0 / 300, box.x1 / 300
            assert left >= MARGIN - 0.02, text.get_text()
            assert right <= wide - MARGIN + 0.2, text.get_text()
            assert box.y0 / 300 >= MARGIN - 0.1, text.get_text()
            assert box.y1 / 300 <= high - MARGIN + 0.15, text.get_text()
            if not text.get_rotation() and text.get_text():
                boxes.append((box.shrunk(0.98, 0.8), text.get_text()))
        boxes.sort(key=lambda box: box[0].y0)
        for k, (one, first) in enumerate(boxes):
            for other, second in itertools.takewhile(
                lambda box, top=one.y1: box[0].y0 < top, boxes[k + 1 :]
            ):
                assert not one.overlaps(other), (first, second)


@pytest.mark.slow
@pytest.mark.parametrize("paper", PAPERS)
def test_a_league_of_25_fits_a_page_as_one_of_24_does(paper):
    for players in (24, 25, 28):
        sheet = sheet_of(league(players, "Maximiliane Vandersloot-Hale {}"), prior_sd=1.0)
        assert len(sheet_pages(sheet, paper)) == 1


@pytest.mark.slow
def test_letters_that_the_font_lacks_are_accounted_for():
    (page,), _ = pages_of(league(3, "選手{}"))
    assert "□□00" in texts(page)
    assert any(text.startswith("□ is a letter") for text in texts(page))
    (page,), _ = pages_of(league(3, "Zoë {}"))
    assert not any("□" in text for text in texts(page))


ROOM = 7.0


def lines_of(players, name="Player"):
    return [
        PlayerLine(str(k), f"{name} {k}", "612", "35", 9, 5, 4, None, 40.0, 50.0, 60.0)
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
