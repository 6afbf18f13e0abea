"""The page of a round is read back by a parser, cell by cell."""

import base64
import hashlib
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from evenbreak import __version__
from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.roster_matchups import all_pairs, roster_matchups
from evenbreak.errors import InputError
from evenbreak.files.roster import RosterFile
from evenbreak.handicaps.charts.chart import chart
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES
from evenbreak.sheets.html_page import shown_name
from evenbreak.sheets.html_round import MOST_ACROSS, MOST_MATCHES, Round, round_html

SHA = "0123456789abcdef" * 4
CLUB = Roster(["Ann", "Bo", "Cy", "Di"], [92, 71, 80, 60], [5, 6, np.nan, 4], [140, 60, 9, 30])
HOSTILE = [
    "<script>alert(1)</script>",
    '"><img src=x>',
    "O'Brien & Sons",
    "مريم",
    "a\x01b",
    "{{ 7 }}",
]


def made(roster=CLUB, pairs=None, *, read=None, warnings=(), **asked):
    """Return the page as text, and the races that it is made of."""
    races = {"scale": SCALES["npl"], "chart": chart("npl_10"), "limits": None, **asked}
    races.setdefault("minutes_per_game", None)
    evening = races.pop("evening", ())
    file = RosterFile(read or roster, np.arange(2, 2 + len(roster)), "in/club.csv", warnings, SHA)
    meets = all_pairs(roster) if pairs is None else np.array(pairs)
    answer = roster_matchups(roster, meets, **races)
    made_of = Round(file=file, roster=roster, **races, listed=pairs is not None, evening=evening)
    return round_html(made_of, answer).decode(), answer.frame


class Tables(HTMLParser):
    """The rows of the tables of one class, as the texts of their cells; all tags and ids."""

    def __init__(self, text, wanted=""):
        super().__init__()
        self.wanted, self.rows, self.inside, self.cell = wanted, [], False, None
        self.tags, self.ids, self.links, self.scopes, self.names = [], [], [], [], set()
        self.bdi = None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.tags.append(tag)
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given["href"]] if "href" in given else []
        if tag == "table":
            self.inside = self.wanted in given.get("class", "").split()
        elif tag == "tr" and self.inside:
            self.rows.append([])
        elif tag in {"td", "th"}:
            self.scopes += [given.get("scope")] if tag == "th" else []
            self.cell = ""
        elif tag == "bdi":
            self.bdi = ""

    def handle_endtag(self, tag):
        if tag in {"td", "th"}:
            if self.inside:
                self.rows[-1].append(" ".join(self.cell.split()))
            self.cell = None
        elif tag == "bdi":
            self.names.add(self.bdi)
            self.bdi = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell += data
        if self.bdi is not None:
            self.bdi += data


def test_a_list_tells_each_match_in_the_order_of_the_list():
    text, frame = made(pairs=[[1, 0], [2, 3]], minutes_per_game=8.0)
    head, *rows = Tables(text, "matches").rows
    assert head == [
        "#",
        "A",
        "A needs",
        "B needs",
        "B",
        "Score A : B",
        "A wins",
        "Minutes",
        "Games",
    ]
    for number, (cells, row) in enumerate(zip(rows, frame.itertuples(), strict=True), 1):
        assert cells[0] == str(number)
        assert cells[1].split()[0] == row.player_a
        assert cells[4].split()[0] == row.player_b
        assert cells[2:4] == [str(row.chart_race_a), str(row.chart_race_b)]
        assert cells[6] == f"{row.chart_p_win_a:.2f}"
        assert cells[7] == f"{row.chart_mean_minutes:.0f} to {row.chart_minutes_p90:.0f}"
        assert cells[8] == f"{row.chart_mean_games:.1f} to {row.chart_games_p90}"
    assert [cells[1] for cells in rows] == ["Bo 71 ± 6.0", "Cy 80"]


def test_a_phone_gets_the_same_matches():
    text, frame = made(pairs=[[1, 0], [2, 3]])
    head, *rows = Tables(text, "match").rows
    assert head == ["Player", "Needs", "Wins"]
    (row, _) = frame.itertuples()
    p = round(row.chart_p_win_a, 2)
    assert rows[:2] == [
        ["Bo 71 ± 6.0", str(row.chart_race_a), f"{p:.2f}"],
        ["Ann 92 ± 5.0", str(row.chart_race_b), f"{1 - p:.2f}"],
    ]
    assert rows[2] == [f"{row.chart_mean_games:.1f} games, 9 of 10 within {row.chart_games_p90}"]
    assert len(rows) == 6


def test_with_both_the_fairest_race_stands_beside_that_of_the_chart():
    limits = RaceLimits(games=(7, 13))
    text, frame = made(pairs=[[0, 3]], limits=limits)
    head, cells = Tables(text, "matches").rows
    (row,) = frame.itertuples()
    assert head[-1] == "Fairest"
    assert cells[2:4] == [str(row.chart_race_a), str(row.chart_race_b)]
    assert cells[-1] == f"{row.race_a}:{row.race_b} A {row.p_win_a:.2f}"
    assert "longest possible match has 7 to 13 games" in text
    both, _ = made(limits=limits)
    assert {"races", "fairest", "ratings", "assumed"} <= set(Tables(both).ids)


def test_all_pairs_become_a_table_with_names_on_both_sides_and_ratings():
    text, frame = made()
    head, *rows = Tables(text, "races").rows
    assert head[1:] == ["1 Ann", "2 Cy", "3 Bo", "4 Di"]
    races = {
        (row[0].split()[1], name.split()[1]): cell
        for row in rows
        for name, cell in zip(head[1:], row[1:], strict=True)
    }
    for row in frame.itertuples():
        assert races[row.player_a, row.player_b] == f"{row.chart_race_a}:{row.chart_race_b}"
        assert races[row.player_b, row.player_a] == f"{row.chart_race_b}:{row.chart_race_a}"
    assert [row[:3] for row in Tables(text, "ratings").rows[1:3]] == [
        ["1", "Ann", "92 ± 5.0"], ["2", "Cy", "80"],
    ]  # fmt: skip


def test_it_says_what_was_assumed():
    read = Roster(["Ann", "Bo", "Cy"], [92, np.nan, 85], None, [140, 0, 0])
    text, _ = made(read.with_starters(80, 30), read=read, minutes_per_game=8.0)
    told = re.sub("[\N{FIRST STRONG ISOLATE}\N{POP DIRECTIONAL ISOLATE}]", "", text)
    for what, why in (
        ("1 player: Bo", "no rating yet, taken as 80 ± 30"),
        ("1 player: Cy", "no games yet, rating taken as right to ± 30"),
        ("1 player: Ann", "taken as rated right"),
        ("The chart npl_10", "asked with ratings rounded to whole points"),
        ("8 minutes a game", "without pauses"),
    ):
        assert f"<dt>{what}</dt><dd>{why}</dd>" in told
    assert "30 points double the odds" in text
    sure, _ = made(Roster(["Ann", "Bo"], [92, 71]))
    assert "not stated; every rating is taken as exact" in sure


def test_only_players_on_the_page_are_told_of():
    text, _ = made(pairs=[[0, 1]])
    assert "Cy" not in Tables(text).names
    assert "taken as rated right" not in text


def test_pairs_that_cannot_be_compared_or_made_even_are_told():
    apart = Roster(["Ann", "Bo"], [92, 71], None, [9, 9], component=[1, 2])
    text, _ = made(apart, pairs=[[0, 1]])
    assert Tables(text, "matches").rows[1][2:4] == ["-", "-"]
    assert "no chain of opponents" in text
    assert "no chain of opponents" in made(apart)[0]
    assert "(A)" not in made(apart, chart=None, limits=RaceLimits(race_to=7))[0]
    far = Roster([f"P{k}" for k in range(8)], [300 - 40 * k for k in range(8)])
    text, _ = made(far, chart=None, limits=RaceLimits(race_to=3))
    assert text.count("no race allowed is fair") == 8
    assert re.search(r"And so \d+ more\.", text)


def test_the_evening_and_the_warnings_are_told_without_a_folder():
    text, _ = made(
        pairs=[[0, 1]], evening=["All over by ten."], warnings=("in/club.csv:3: looks odd",)
    )
    assert '<p class="evening">All over by ten.</p>' in text
    assert "<dt>a warning on club.csv</dt><dd>line 3: looks odd</dd>" in text
    assert "in/club" not in text


@pytest.mark.parametrize("pairs", [None, [[0, 1], [2, 3], [4, 5]]])
def test_names_are_text_whatever_they_look_like(pairs):
    text, _ = made(Roster(HOSTILE, [90, 80, 70, 60, 50, 40]), pairs=pairs)
    page = Tables(text)
    assert page.names == {shown_name(name) for name in HOSTILE}
    assert not {"script", "img", "link", "iframe"} & set(page.tags)


@pytest.mark.parametrize("pairs", [None, [[0, 1]]])
def test_the_policy_allows_the_style_of_the_page_and_nothing_else(pairs):
    text, _ = made(pairs=pairs)
    style = re.search(r"<style>(.*)</style>", text, re.DOTALL)[1]
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    assert (
        f"content=\"default-src 'none'; style-src 'sha256-{digest}'; base-uri 'none'; "
        "form-action 'none'\""
    ) in text.replace("&#39;", "'")
    assert "://" not in text
    assert not re.search(r"\s(style|src|on\w+)=", text)


@pytest.mark.parametrize("pairs", [None, [[0, 1]]])
def test_a_screen_reader_finds_its_way(pairs):
    page = Tables(made(pairs=pairs)[0])
    assert len(page.ids) == len(set(page.ids))
    assert {link.removeprefix("#") for link in page.links} <= set(page.ids)
    assert set(page.scopes) == {"row", "col"}
    assert page.tags.count("caption") == page.tags.count("table")


def test_the_footer_says_what_the_page_was_made_of():
    footer = made()[0].partition("<footer>")[2]
    assert f"evenbreak {__version__}" in footer
    assert SHA in footer
    assert "1/(1 + 2^(−d/30))" in footer


def test_the_same_input_gives_the_same_bytes():
    assert made()[0] == made()[0]


def test_equal_ratings_without_errors_have_a_page():
    assert (
        "<td>7:7</td>"
        in made(Roster(["Ann", "Bo"], [80, 80]), chart=None, limits=RaceLimits(race_to=7))[0]
    )


def test_more_than_a_page_holds_is_refused():
    many = Roster([f"P{k}" for k in range(MOST_ACROSS + 1)], range(MOST_ACROSS + 1))
    with pytest.raises(InputError, match="49 players; give 48 at most"):
        made(many)
    with pytest.raises(InputError, match="501 matches; give 500 at most"):
        made(pairs=[[0, 1]] * (MOST_MATCHES + 1))
