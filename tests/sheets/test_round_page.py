"""The page of a round is read back by a parser, cell by cell."""

import re
from html import unescape
from html.parser import HTMLParser

import pytest

from evenbreak import __version__
from evenbreak.answers.league.matchups import matchups_answer
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.errors import InputError
from evenbreak.matches.pace import own_pace
from evenbreak.ratings.roster import Roster
from evenbreak.sheets.html_page import shown_name
from evenbreak.sheets.sheet_page import MOST_ACROSS, MOST_MATCHES, round_html
from leagues import CLUB, HOSTILE, SHA, round_of

LIST = ((1, 0), (2, 3))


def page_of(roster=CLUB, pairs=None, **asked):
    """Return the page as text, and the races that it is made from."""
    tonight = round_of(roster, pairs, **asked)
    return round_html(tonight).decode(), tonight.matchups.frame


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


def test_a_list_has_each_match_in_its_order():
    text, frame = page_of(pairs=LIST, pace=own_pace(8.0))
    head, *rows = Tables(text, "matches").rows
    assert len(head) == 9
    for number, (cells, row) in enumerate(zip(rows, frame.itertuples(), strict=True), 1):
        assert cells[0] == str(number)
        assert cells[1].split()[0] == row.player_a
        assert cells[4].split()[0] == row.player_b
        assert cells[2:4] == [str(row.chart_race_a), str(row.chart_race_b)]
        assert cells[6] == f"{row.chart_p_win_a:.2f}"
        assert cells[7] == f"{row.chart_mean_minutes:.0f} to {row.chart_minutes_p90:.0f}"
        assert cells[8] == f"{row.chart_mean_games:.1f} to {row.chart_games_p90}"
    assert [cells[1] for cells in rows] == ["Bo 71 ± 6.0", "Cy ~80"]


def test_the_page_says_what_the_terminal_says():
    offered, asked = OfferedRaces((7, 13)), {"pace": own_pace(8.0), "tables": 2}
    text, _ = page_of(pairs=LIST, offered=offered, **asked)
    answer = matchups_answer(round_of(pairs=LIST, offered=offered, **asked))
    page = " ".join(re.sub("<[^>]*>", "", unescape(text)).split())
    for said in (answer.heading, *answer.sentences, *answer.details):
        for line in said.split("\n"):
            assert line.removeprefix("- ") in page


def test_a_phone_gets_the_same_matches():
    text, frame = page_of(pairs=LIST)
    head, *rows = Tables(text, "match").rows
    assert len(head) == 3
    (row, _) = frame.itertuples()
    p = round(row.chart_p_win_a, 2)
    assert rows[:2] == [
        ["Bo 71 ± 6.0", str(row.chart_race_a), f"{p:.2f}"],
        ["Ann 92 ± 5.0", str(row.chart_race_b), f"{1 - p:.2f}"],
    ]
    below = re.findall(r"[\d.]+", rows[2][0])
    assert [below[0], below[-1]] == [f"{row.chart_mean_games:.1f}", str(row.chart_games_p90)]
    assert len(rows) == 6


def test_with_both_the_fairest_race_stands_beside_that_of_the_chart():
    offered = OfferedRaces(games=(7, 13))
    text, frame = page_of(pairs=[[0, 3]], offered=offered)
    _, cells = Tables(text, "matches").rows
    (row,) = frame.itertuples()
    assert cells[2:4] == [str(row.chart_race_a), str(row.chart_race_b)]
    assert cells[-1] == f"{row.race_a}:{row.race_b} A {row.p_win_a:.2f}"
    both, _ = page_of(offered=offered)
    assert {"races", "fairest", "ratings", "assumed"} <= set(Tables(both).ids)


def test_all_pairs_become_a_table_with_names_on_both_sides_and_ratings():
    text, frame = page_of()
    head, *rows = Tables(text, "races").rows
    assert head[1:] == ["1 Ann", "2 Bo", "P1 Cy", "P2 Di"]
    races = {
        (row[0].split()[1], name.split()[1]): cell
        for row in rows
        for name, cell in zip(head[1:], row[1:], strict=True)
    }
    for row in frame.itertuples():
        assert races[row.player_a, row.player_b] == f"{row.chart_race_a}:{row.chart_race_b}"
        assert races[row.player_b, row.player_a] == f"{row.chart_race_b}:{row.chart_race_a}"
    assert [row[:3] for row in Tables(text, "ratings").rows[2:5]] == [
        ["2", "Bo", "71 ± 6.0"], ["Provisional: too few games for a place"], ["P1", "Cy", "~80"],
    ]  # fmt: skip


def test_only_players_on_the_page_are_named():
    assert "Cy" not in Tables(page_of(pairs=[[0, 1]])[0]).names


@pytest.mark.parametrize("pairs", [None, [[0, 1]]])
def test_pairs_that_cannot_be_compared_have_no_race(pairs):
    apart = Roster(["Ann", "Bo"], [92, 71], None, [9, 9], component=[1, 2])
    text, _ = page_of(apart, pairs)
    page = Tables(text, "matches" if pairs else "races")
    assert "-" in page.rows[1][1:]
    assert "Ann – Bo" in page.names


def test_the_evening_stands_above_the_matches():
    text, _ = page_of(pairs=LIST, pace=own_pace(8.0), tables=2)
    assert 0 < text.index("2 matches on 2 tables") < text.index("<table")


def test_warnings_do_not_name_the_folder_of_the_file():
    text, _ = page_of(warnings=("in/club.csv:3: looks unusual",))
    assert "line 3: looks unusual." in text
    assert "in/club" not in text


@pytest.mark.parametrize("pairs", [None, [[0, 1], [2, 3], [4, 5], [6, 7]]])
def test_names_are_text_whatever_they_look_like(pairs):
    text, _ = page_of(Roster(HOSTILE, range(90, 10, -10)), pairs)
    page = Tables(text)
    assert {shown_name(name) for name in HOSTILE} <= page.names
    assert page.tags.count("script") == 1
    assert not {"img", "link", "iframe"} & set(page.tags)


@pytest.mark.parametrize("pairs", [None, [[0, 1]]])
def test_a_screen_reader_finds_its_way_and_nothing_is_run_or_fetched(pairs):
    text, _ = page_of(pairs=pairs)
    page = Tables(text)
    assert len(page.ids) == len(set(page.ids))
    assert {link.removeprefix("#") for link in page.links} <= set(page.ids)
    assert set(page.scopes) == {"row", "col"}
    assert page.tags.count("caption") == page.tags.count("table")
    assert "Content-Security-Policy" in text
    assert "://" not in text
    assert not re.search(r"\s(style|src|on\w+)=", text)


def test_warnings_of_the_question_are_on_the_page():
    text = round_html(round_of(), warnings=["the ratings look like Fargo ratings"]).decode()
    assert "the ratings look like Fargo ratings" in text


def test_the_footer_says_what_the_page_was_made_from():
    footer = page_of()[0].partition("<footer>")[2]
    assert f"evenbreak {__version__}" in footer
    assert SHA in footer
    assert "1/(1 + 2^(−d/30))" in footer


def test_the_same_input_gives_the_same_bytes():
    assert page_of()[0] == page_of()[0]


def test_equal_ratings_without_errors_have_a_page():
    text, _ = page_of(Roster(["Ann", "Bo"], [80, 80]), chart=None, offered=OfferedRaces(race_to=7))
    assert "<td>7:7</td>" in text


def test_more_than_a_page_holds_is_refused():
    many = Roster([f"P{k}" for k in range(MOST_ACROSS + 1)], range(MOST_ACROSS + 1))
    with pytest.raises(InputError, match=f"{MOST_ACROSS + 1} players"):
        page_of(many)
    with pytest.raises(InputError, match=f"{MOST_MATCHES + 1} matches"):
        page_of(pairs=[[0, 1]] * (MOST_MATCHES + 1))
