"""The page is read back by a parser, table by table, as a browser or a screen reader reads it."""

import base64
import hashlib
import itertools
import re
from html.parser import HTMLParser

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak import __version__
from evenbreak.answers.fair_pairs import RaceLimits, matchups_frame, most_active
from evenbreak.answers.frames import ratings_frame
from evenbreak.answers.sheet_words import races_by_name
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.sheets.html_page import shown_name
from evenbreak.sheets.html_sheet import MOST_IN_TABLE, MOST_LISTED, sheet_html

VOID = {"meta", "line", "circle", "polyline"}
SHA = "0123456789abcdef" * 4
HOSTILE = [
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "O'Brien & Sons",
    "=cmd()",
    "مريم الخطيب",
    "👨‍👩‍👧",
    "a\x01b",
    "{{ 7 * 7 }}",
]


def league(names):
    pairs = list(itertools.combinations(range(len(names)), 2))
    return Results.from_names(
        [names[a] for a, _ in pairs],
        [names[b] for _, b in pairs],
        [7] * len(pairs),
        [(a + 2 * b) % 7 for a, b in pairs],
    )


def made(season, *, limits=None, top=9999, warnings=(), source="folder/season.csv"):
    """Return the page as text and the races that it is made of."""
    limits = limits or RaceLimits(race_to=7)
    ratings = fit(season)
    paired = matchups_frame(ratings, most_active(ratings, top), limits)
    file = ResultsFile(season, source, warnings, (), SHA)
    page = sheet_html(file, ratings, limits, ratings_frame(ratings), paired)
    return page.decode(), paired


class Page(HTMLParser):
    """Elements in the order of the page; each with its attributes, path and own text."""

    def __init__(self, text):
        super().__init__()
        self.open, self.elements = [], []
        self.feed(text)
        self.close()
        assert not self.open, "elements are left open"

    def handle_starttag(self, tag, attributes):
        element = {"tag": tag, "attributes": dict(attributes), "text": "", "path": list(self.open)}
        self.elements.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_startendtag(self, tag, attributes):
        assert tag in VOID
        self.handle_starttag(tag, attributes)

    def handle_endtag(self, tag):
        assert self.open[-1]["tag"] == tag
        self.open.pop()

    def handle_data(self, data):
        for element in self.open:
            element["text"] += data

    def all(self, tag, **wanted):
        return [
            element
            for element in self.elements
            if element["tag"] == tag
            and all(
                element["attributes"].get(key.rstrip("_")) == value for key, value in wanted.items()
            )
        ]

    def within(self, outer, *tags):
        return [e for e in self.elements if e["tag"] in tags and any(p is outer for p in e["path"])]


def plain(element):
    return " ".join(element["text"].split())


def races_on(page):
    """Return the race in each cell of the wide tables by the names of its row and column."""
    found = {}
    for table in page.all("table"):
        if "races" not in table["attributes"].get("class", "").split():
            continue
        head, *rows = page.within(table, "tr")
        columns = [plain(cell).split(" ", 1)[1] for cell in page.within(head, "th")]
        for row in rows:
            (header,) = page.within(row, "th")
            name = plain(header).split(" ", 1)[1]
            cells = [plain(cell) for cell in page.within(row, "td")]
            assert len(cells) == len(columns)
            found |= {(name, other): cell for other, cell in zip(columns, cells, strict=True)}
    return found


@pytest.mark.parametrize("players", [2, 3, 24, 25, 48])
def test_every_race_stands_in_the_row_and_column_of_its_players(players):
    names = [f"Player {k:02}" for k in range(players)]
    text, paired = made(league(names))
    races = races_by_name(paired)
    assert races_on(Page(text)) == races | {(name, name): "" for name in names}


def test_a_narrow_page_has_each_players_races_and_chances():
    text, paired = made(league(["Ann", "Bo", "Cy"]))
    page = Page(text)
    races = races_by_name(paired)
    chances = {(row.player_a, row.player_b): row.p_win_a for row in paired.itertuples()}
    chances |= {(b, a): 1 - p for (a, b), p in chances.items()}
    seen = set()
    for details in page.all("details"):
        player = plain(page.within(details, "summary")[0]).split(" ", 1)[1]
        for row in page.within(details, "tr")[1:]:
            other, race, chance = (plain(cell) for cell in page.within(row, "th", "td"))
            assert race == races[player, other]
            assert chance == f"{chances[player, other]:.2f}"
            seen.add((player, other))
    assert seen == set(races)


def test_the_policy_allows_the_style_of_the_page_and_nothing_else():
    text, _ = made(league(["Ann", "Bo"]))
    page = Page(text)
    (policy,) = page.all("meta", **{"http-equiv": "Content-Security-Policy"})
    style = re.search(r"<style>(.*)</style>", text, re.DOTALL)[1]
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    assert policy["attributes"]["content"].split("; ") == [
        "default-src 'none'",
        f"style-src 'sha256-{digest}'",
        "base-uri 'none'",
        "form-action 'none'",
    ]
    assert "://" not in text
    assert "url(" not in style
    assert "@import" not in style
    for element in page.elements:
        names = set(element["attributes"])
        assert not names & {"style", "src", "onload", "onclick"}
        assert element["attributes"].get("href", "#").startswith("#")
        assert element["tag"] not in {"script", "link", "img", "iframe"}


def test_a_screen_reader_finds_its_way():
    season = league(["Ann", "Bo", "Cy"])
    page = Page(made(season)[0])
    assert [e["tag"] for e in page.elements if e["tag"] in {"header", "nav", "main", "footer"}] == (
        ["header", "nav", "main", "footer"]
    )
    assert [e["tag"] for e in page.elements if re.fullmatch(r"h\d", e["tag"])] == (
        ["h1", *["h2"] * 5]
    )
    ids = [e["attributes"]["id"] for e in page.elements if "id" in e["attributes"]]
    assert len(ids) == len(set(ids))
    assert all(e["attributes"]["scope"] in {"row", "col"} for e in page.all("th"))
    assert all(plain(e) for e in page.all("th"))
    for link in page.all("a"):
        assert link["attributes"]["href"][1:] in ids
    for svg in page.all("svg"):
        if svg["attributes"].get("aria-hidden") != "true":
            assert svg["attributes"]["role"] == "img"
            title, text = svg["attributes"]["aria-labelledby"].split()
            assert plain(page.all("title", id=title)[0])
            assert plain(page.all("desc", id=text)[0])
    assert page.all("html", lang="en")
    assert page.all("meta", name="viewport")


def test_the_footer_says_what_the_page_was_made_of():
    page = Page(made(league(["Ann", "Bo"]))[0])
    footer = plain(page.all("footer")[0])
    assert f"evenbreak {__version__}" in footer
    assert SHA in footer
    assert "1/(1 + 2^(−d/30))" in footer
    assert "80 ± 30 (normal prior" in footer
    assert "folder" not in page.all("title")[0]["text"]


def test_the_same_input_gives_the_same_bytes():
    season = league(["Ann", "Bo", "Cy"])
    assert made(season)[0] == made(season)[0]


def test_names_are_text_whatever_they_look_like():
    page = Page(made(league(HOSTILE))[0])
    names = {element["text"] for element in page.all("bdi")}
    assert names == {shown_name(name) for name in HOSTILE}
    assert not page.all("script")
    assert not page.all("img")


@given(st.text(min_size=1, max_size=30).filter(lambda name: name.strip() == name and name != "Bo"))
@settings(max_examples=30, deadline=None)
def test_any_name_stays_one_name(name):
    page = Page(made(league([name, "Bo"]))[0])
    assert {element["text"] for element in page.all("bdi")} == {shown_name(name), "Bo"}


def test_a_large_league_is_cut_and_the_page_says_so(monkeypatch):
    monkeypatch.setattr("evenbreak.sheets.html_sheet.MOST_LISTED", 51)
    page = Page(made(league([f"Player {k:02}" for k in range(52)]))[0])
    assert len(page.all("details")) == MOST_IN_TABLE < 52 < MOST_LISTED
    (ratings,) = page.all("table", class_="ratings")
    assert len(page.within(ratings, "tr")) == 1 + 51
    told = zip(page.all("dt"), page.all("dd"), strict=True)
    assert [(plain(what), plain(why).split(";")[0]) for what, why in told] == [
        ("1 of 52 rated players", "the list ends with the 51 strongest"),
        ("the races of 4 of 52 paired players", "the table holds the 48 strongest"),
    ]


def test_nothing_left_out_is_said():
    page = Page(made(league(["Ann", "Bo"]))[0])
    assert "Nothing: every match" in plain(page.all("section", id="left-out")[0])


def test_players_who_never_met_have_a_group_and_no_race():
    season = Results.from_names(["Ann", "Cy"], ["Bo", "Di"], [7, 7], [5, 5])
    page = Page(made(season)[0])
    races = races_on(page)
    assert races["Ann", "Cy"] == races["Di", "Bo"] == "-"
    (ratings,) = page.all("table", class_="ratings")
    assert "Group" in plain(page.within(ratings, "thead")[0])
    assert "the races of 4 pairs" in plain(page.all("section", id="left-out")[0])


def test_a_page_without_any_race_can_be_made():
    season = Results.from_names(["Ann", "Cy"], ["Bo", "Di"], [7, 7], [5, 5])
    ratings = fit(season)
    apart = [ratings.players.index("Ann"), ratings.players.index("Cy")]
    paired = matchups_frame(ratings, apart, RaceLimits(race_to=7))
    file = ResultsFile(season, "season.csv", (), (), SHA)
    text = sheet_html(file, ratings, RaceLimits(race_to=7), ratings_frame(ratings), paired)
    page = Page(text.decode())
    assert not page.all("polyline")
    assert not page.all("section", id="chart")
    assert not [link for link in page.all("a") if link["attributes"]["href"] == "#chart"]


def test_where_lengths_differ_there_are_dots_and_no_chart():
    page = Page(made(league(["Ann", "Bo", "Cy"]), limits=RaceLimits(games=(5, 13)))[0])
    assert not page.all("table", class_="chart")
    assert not page.all("polyline")
    assert "There is no short chart" in plain(page.all("section", id="chart")[0])


def test_warnings_are_told_without_the_folder_of_the_file():
    warnings = (
        "folder/season.csv: columns not used: 'x'",
        "folder/season.csv:7: 1 row is again",
        "aliases.csv: is not UTF-8",
    )
    text, _ = made(league(["Ann", "Bo"]), warnings=warnings)
    assert "folder" not in text
    assert "<dd>columns not used: &#39;x&#39;</dd>" in text
    assert "<dd>line 7: 1 row is again</dd>" in text
    assert "<dt>a warning</dt><dd>aliases.csv: is not UTF-8</dd>" in text
