"""Each page is read back from its texts and their places, as a person reads it."""

import itertools

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from evenbreak.answers.fair_pairs import RaceLimits, matchups_frame, most_active
from evenbreak.answers.frames import ratings_frame
from evenbreak.answers.sheet_words import races_by_name
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.sheets.pdf_page import HEIGHT, MARGIN, WIDTH, pdf_bytes
from evenbreak.sheets.pdf_sheet import MOST_ON_A_PAGE, MOST_PAIRED, sheet_pages


def sheet_of(season, *, limits=None, top=99, scale="npl", source="r.csv"):
    """Return the pages and the pairs they are made of."""
    limits = limits or RaceLimits(race_to=7)
    ratings = fit(season, prior_sd=1.0, scale=scale)
    paired = matchups_frame(ratings, most_active(ratings, top), limits)
    file = ResultsFile(season, source, (), (), "0123456789abcdef" * 4)
    return sheet_pages(file, ratings, limits, ratings_frame(ratings), paired), paired


def league(players, name="Player {}"):
    pairs = list(itertools.combinations(range(players), 2))
    return Results.from_names(
        [name.format(f"{a:02}") for a, _ in pairs],
        [name.format(f"{b:02}") for _, b in pairs],
        [7] * len(pairs),
        [(a + 2 * b) % 7 for a, b in pairs],
    )


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


@pytest.mark.parametrize("players", [2, 3, 10, 24, 25, 48])
def test_every_race_stands_in_the_row_and_column_of_its_players(players):
    pages, paired = sheet_of(league(players))
    found: dict[tuple[str, str], str] = {}
    for page in pages:
        on_page = races_on(page)
        assert not found.keys() & on_page.keys()
        found |= on_page
    assert found == races_by_name(paired)
    blocks = -(-players // MOST_ON_A_PAGE)
    assert len(pages) == blocks**2
    assert all((f"page {k} of 4" in texts(page)) for k, page in enumerate(pages, 1) if blocks == 2)


def test_a_season_is_named_and_explained():
    season = Results.from_names(
        ["Ann", "Bo", "Cy", "Ann", "Bo"],
        ["Bo", "Cy", "Ann", "Bo", "Ann"],
        [7, 7, 3, 7, 0],
        [4, 5, 7, 0, 0],
        date=["2024-09-03", "2024-09-10", "2024-09-17", "2024-09-18", "2024-09-18"],
        forfeit=[False, False, False, True, False],
    )
    (page,), _ = sheet_of(season, scale="fargo")
    told = texts(page)
    assert "Fair races" in told
    assert "r.csv, 2024-09-03 to 2024-09-17. 3 matches of 3 players, 33 games." in told
    assert "The fairest races in which the stronger player needs 7 games." in told
    assert "Row: you. Column: your opponent. 7:4: you need 7 games, your opponent 4." in told
    assert (
        "Ratings on a Fargo-like scale (100 points double the odds of a game), mean 500. "
        "They are nobody's official ratings. Left out: 1 forfeited and 1 at 0-0."
    ) in told
    assert any("SHA-256 0123456789ab…" in text for text in told)
    assert {"559 ± 93", "491 ± 92", "450 ± 92"} <= set(told)
    assert not any("place among" in text for text in told)


def test_bars_are_two_standard_errors_either_way():
    season = league(5)
    ratings = fit(season, prior_sd=1.0)
    (page,), _ = sheet_of(season)
    lines = page.axes[0].lines
    bars = [line.get_xdata() for line in lines if line.get_linewidth() > 2]
    dots = [line.get_xdata()[0] for line in lines if line.get_marker() == "o"]
    strongest_first = sorted(zip(ratings.rating, ratings.standard_error, strict=True), reverse=True)
    (high, error), (low, _) = strongest_first[0], strongest_first[-1]
    inch = (dots[0] - dots[-1]) / (high - low)
    for (start, end), dot, (rating, error) in zip(bars, dots, strongest_first, strict=True):
        assert dot - dots[-1] == pytest.approx(inch * (rating - low), abs=1e-4)
        assert dot - start == pytest.approx(2 * error * inch, abs=1e-4)
        assert end - dot == pytest.approx(2 * error * inch, abs=1e-4)


def test_more_players_than_paper_holds_are_told():
    pages, _ = sheet_of(league(50), top=49)
    told = texts(pages[0])
    assert (
        f"Of 49 paired players the {MOST_PAIRED} strongest are on paper; matchups.csv has all."
        in told
    )
    assert "The number at a name is its place among all 50 players." in told
    names = {row for page in pages for row, _ in races_on(page)}
    assert len(names) == MOST_PAIRED


def test_pairs_that_cannot_be_compared_have_a_dash():
    season = Results.from_names(["Player 1", "Player 3"], ["Player 2", "Player 4"], [7, 7], [5, 4])
    (page,), paired = sheet_of(season)
    found = races_on(page)
    assert found["Player 1", "Player 3"] == found["Player 3", "Player 1"] == "-"
    assert found.items() >= races_by_name(paired).items()
    assert len(races_by_name(paired)) == 4
    told = " ".join(texts(page))
    assert "- is a pair without a race" in told
    assert "2 groups of players never met" in told


ODD_NAMES = [
    "Player {}",
    "W" * 60 + " {}",
    "選手{}",
    "\N{GRINNING FACE}\N{ZERO WIDTH JOINER}\N{PILE OF POO} {}",
    r"$\frac{{}} {}",
    "عبد الله {}",
]


@pytest.mark.parametrize(
    ("season", "options"),
    [
        *((league(10, name), {}) for name in ODD_NAMES),
        (league(14, "W" * 60 + " {}"), {"limits": RaceLimits(race_to=120)}),
        (league(24), {"source": "a file with a very long name " * 9 + ".csv"}),
        (league(2), {"limits": RaceLimits(race_to=1000)}),
        (league(3), {"scale": 1e6}),
        (league(3), {"scale": 0.01}),
        (league(24), {"limits": RaceLimits((3, 13)), "scale": "elo"}),
    ],
)
def test_nothing_leaves_the_page_or_touches_the_lines_next_to_it(season, options):
    pages, _ = sheet_of(season, **options)
    for page in pages:
        page.set_dpi(300)
        renderer = FigureCanvasAgg(page).get_renderer()
        boxes = []
        for text in page.axes[0].texts:
            box = text.get_window_extent(renderer)
            left, right = box.x0 / 300, box.x1 / 300
            assert left >= MARGIN - 0.02, text.get_text()
            assert right <= WIDTH - MARGIN + 0.2, text.get_text()
            assert box.y0 / 300 >= MARGIN - 0.1, text.get_text()
            assert box.y1 / 300 <= HEIGHT - MARGIN + 0.15, text.get_text()
            if not text.get_rotation() and text.get_text():
                boxes.append((box.shrunk(0.98, 0.8), text.get_text()))
        boxes.sort(key=lambda box: box[0].y0)
        for k, (one, first) in enumerate(boxes):
            for other, second in itertools.takewhile(
                lambda box, top=one.y1: box[0].y0 < top, boxes[k + 1 :]
            ):
                assert not one.overlaps(other), (first, second)
    assert pdf_bytes(pages, "odd").startswith(b"%PDF")


def test_letters_that_the_font_lacks_are_accounted_for():
    (page,), _ = sheet_of(league(3, "選手{}"))
    assert "□□00" in texts(page)
    assert any(
        text.startswith("□ is a letter that the font of this page lacks") for text in texts(page)
    )
    (page,), _ = sheet_of(league(3, "Zoë {}"))
    assert not any("□" in text for text in texts(page))
