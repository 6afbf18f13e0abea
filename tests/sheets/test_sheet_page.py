"""The page is read back by a parser, table by table, as a browser or a screen reader reads it."""

import re
from html.parser import HTMLParser

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak import __version__
from evenbreak.answers.league.report import report_answer
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.ratings.results import Results
from evenbreak.sheets.html_page import shown_name
from evenbreak.sheets.sheet_page import sheet_html
from leagues import HOSTILE, SHA, league, sheet_of, two_groups
from tiers import examples

VOID = {"meta", "line", "circle", "polyline", "input"}


def page_of(season, **how):
    """Return the page, and the sheet that it is made from."""
    sheet = sheet_of(season, **how)
    return Page(sheet_html(sheet).decode()), sheet


@pytest.fixture(scope="module")
def three():
    """A page of three players, and its sheet."""
    return page_of(league(("Ann", "Bo", "Cy")))


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


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("players", [2, 25])
def test_every_race_stands_in_the_row_and_column_of_its_players(players):
    page, sheet = page_of(league(players))
    assert races_on(page) == sheet.races | {(name, name): "" for name in sheet.rated["player"]}


def test_the_page_says_what_the_terminal_says(three):
    page, sheet = three
    text = plain(page.all("html")[0])
    answer = report_answer(sheet)
    title = answer.parts[1].title
    for said in (*answer.heading.split("\n"), *answer.sentences, *answer.details, title):
        assert said in text


def test_a_narrow_page_has_each_players_races_and_chances(three):
    page, sheet = three
    chances = {(row.player_a, row.player_b): row.p_win_a for row in sheet.paired.itertuples()}
    chances |= {(b, a): 1 - p for (a, b), p in chances.items()}
    seen = set()
    for details in page.all("details"):
        player = plain(page.within(details, "summary")[0]).split(" ", 1)[1]
        for row in page.within(details, "tr")[1:]:
            other, race, chance = (plain(cell) for cell in page.within(row, "th", "td"))
            assert race == sheet.races[player, other]
            assert chance == f"{chances[player, other]:.2f}"
            seen.add((player, other))
    assert seen == set(sheet.races)


def test_the_page_fetches_nothing_and_runs_its_search_only(three):
    page, _ = three
    assert page.all("meta", **{"http-equiv": "Content-Security-Policy"})
    assert len(page.all("script")) == 1
    for element in page.elements:
        assert not set(element["attributes"]) & {"style", "src", "onload", "onclick"}
        assert element["attributes"].get("href", "#").startswith("#")
        assert element["tag"] not in {"link", "img", "iframe"}
        assert "://" not in element["text"]


def test_a_screen_reader_finds_its_way(three):
    page, _ = three
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


def test_the_footer_says_what_the_page_was_made_from(three):
    page, _ = three
    footer = plain(page.all("footer")[0])
    assert f"evenbreak {__version__}" in footer
    assert SHA in footer
    assert "1/(1 + 2^(−d/30))" in footer
    assert "folder" not in page.all("title")[0]["text"]


def test_the_same_input_gives_the_same_bytes(three):
    _, sheet = three
    assert sheet_html(sheet) == sheet_html(sheet_of(league(("Ann", "Bo", "Cy"))))


@pytest.mark.slow
def test_names_are_text_whatever_they_look_like():
    page, _ = page_of(league(HOSTILE))
    names = {element["text"] for element in page.all("bdi")}
    assert names == {shown_name(name) for name in HOSTILE}
    assert len(page.all("script")) == 1
    assert not page.all("img")


@pytest.mark.slow
@given(st.text(min_size=1, max_size=30).filter(lambda name: name.strip() == name and name != "Bo"))
@settings(max_examples=examples(15))
def test_any_name_stays_one_name(name):
    page, _ = page_of(league((name, "Bo")))
    assert {element["text"] for element in page.all("bdi")} == {shown_name(name), "Bo"}


@pytest.mark.slow
def test_a_large_league_is_cut_and_the_page_says_so(monkeypatch):
    monkeypatch.setattr("evenbreak.sheets.sheet_page.MOST_LISTED", 51)
    for module in ("sheets.sheet_page", "answers.league.report"):
        monkeypatch.setattr(f"evenbreak.{module}.MOST_ON_SHEET", 48)
    page, _ = page_of(league(52))
    assert len(page.all("details")) == 48
    (ratings,) = page.all("table", class_="ratings")
    assert len(page.within(ratings, "tr")) == 1 + 51
    assert [plain(what) for what in page.all("strong")] == (
        ["1 of 52 rated players", "the races for 4 of 52 paired players"]
    )


def test_nothing_left_out_is_said(three):
    page, _ = three
    (section,) = page.all("section", id="left-out")
    assert not page.within(section, "ul")
    assert page.within(section, "p")


def test_players_without_a_result_are_named_each_by_itself():
    names = ["Bo", "Cy", "مريم", "Di", "Ed", "Flo", "Gus"]
    season = Results.from_names(["Ann"] * 7, names, [7] + [0] * 6, [5] + [0] * 6)
    page, _ = page_of(season, players=["Ann", "Bo"])
    (idle,) = (what for what in page.all("strong") if "without a result" in what["text"])
    assert [name["text"] for name in page.within(idle, "bdi")] == (["Cy", "Di", "Ed", "Flo", "Gus"])
    assert plain(idle).endswith("and 1 more)")


def test_players_who_never_met_have_a_group_and_no_race():
    page, _ = page_of(two_groups())
    races = races_on(page)
    assert races["Ann", "Cy"] == races["Di", "Bo"] == "-"
    (ratings,) = page.all("table", class_="ratings")
    assert "Group" in plain(page.within(ratings, "thead")[0])
    assert "4 pairs" in plain(page.all("section", id="left-out")[0])


def test_a_page_without_any_race_can_be_made():
    page, _ = page_of(two_groups(), players=["Ann", "Cy"])
    assert not page.all("polyline")
    assert not page.all("section", id="chart")
    assert not [link for link in page.all("a") if link["attributes"]["href"] == "#chart"]


def test_where_lengths_differ_there_are_dots_and_no_chart(three):
    page, sheet = page_of(league(("Ann", "Bo", "Cy")), offered=OfferedRaces(games=(5, 13)))
    (section,) = page.all("section", id="chart")
    assert not page.all("table", class_="chart")
    assert not page.all("polyline")
    assert len(page.within(section, "circle")) == len(sheet.sure)
    assert len(three[0].all("table", class_="chart")) == 1


def test_warnings_do_not_name_the_folder_of_the_file():
    warnings = ("folder/season.csv: columns not used: 'x'", "folder/season.csv:7: 1 row is again")
    page, _ = page_of(league(2), warnings=warnings)
    assert [plain(why) for why in page.all("li")[-2:]] == [
        "Warning about season.csv: columns not used: 'x'.",
        "Warning about season.csv: line 7: 1 row is again.",
    ]
    assert "folder" not in page.elements[0]["text"]
