"""What a site's files hold: every page and table, whole, small, linked, the same each time."""

import csv
import hashlib
import io
import json
import posixpath
import re
from datetime import date
from html import unescape
from html.parser import HTMLParser

import numpy as np
import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import matchups_frame
from evenbreak.answers.league.why import matches_behind
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps import chart
from evenbreak.league.tables.fixtures import Fixture
from evenbreak.league.tables.table import league_table, player_matches
from evenbreak.ratings import Results, fit
from evenbreak.ratings.usual import rated_alike
from evenbreak.site.league import WEEK
from evenbreak.site.pages import MOST_BYTES, site_files
from evenbreak.site.tournaments import tournament_of
from leagues import HOSTILE
from published_leagues import PLAYERS, published, season
from tournament_nights import night


@pytest.fixture(scope="module")
def league():
    return published()


@pytest.fixture(scope="module")
def files(league):
    return site_files(
        league, fixtures=[Fixture(1, "Ann Lee", "Bo Diaz", date(2025, 9, 23), "Corner", 2)]
    )


class Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag, attrs) -> None:  # noqa: ARG002
        self.found += [value for name, value in attrs if name in ("href", "src") and value]


def test_every_link_leads_to_a_file_of_the_site(files) -> None:
    for name, content in files.items():
        if name.endswith(".html"):
            parser = Links()
            parser.feed(content.decode())
            for link in parser.found:
                if link not in ("data:,", "#main"):
                    assert (
                        posixpath.normpath(posixpath.join(posixpath.dirname(name), link)) in files
                    )


def test_nothing_is_fetched_from_elsewhere(files) -> None:
    for name, content in files.items():
        assert not re.search(rb"(?:https?:)?//[a-z]", content, re.IGNORECASE), name
        if name.endswith(".html"):
            assert "default-src 'none'" in unescape(content.decode())


def test_the_same_league_gives_the_same_bytes(files) -> None:
    again = published(season())
    assert (
        site_files(
            again, fixtures=[Fixture(1, "Ann Lee", "Bo Diaz", date(2025, 9, 23), "Corner", 2)]
        )
        == files
    )


def table_of(content: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(content.decode(), newline="")))


def test_the_manifest_has_the_sum_of_each_table(files) -> None:
    manifest = json.loads(files["data/manifest.json"])
    assert manifest["schema_version"] == 1
    assert manifest["last_match"] == "2025-09-16"
    for name, said in manifest["files"].items():
        content = files[f"data/{name}"]
        assert said["sha256"] == hashlib.sha256(content).hexdigest()
        assert said["rows"] == len(table_of(content))
        assert said["columns"] == content.decode().split("\n")[0].split(",")
    assert {f"data/{name}" for name in manifest["files"]} | {*manifest["pages"]} == {*files} - {
        "data/manifest.json"
    }


def test_standings_are_those_of_the_league_table(league, files) -> None:
    table = league_table(player_matches(league.results))
    rows = table_of(files["data/standings.csv"])
    assert [row["name"] for row in rows] == list(table.names)
    assert [float(row["points"]) for row in rows] == table.points.tolist()


def test_races_are_those_of_the_report(league, files) -> None:
    frame = matchups_frame(league.ratings, range(len(PLAYERS)), OfferedRaces(race_to=7))
    rows = table_of(files["data/races.csv"])
    for row, wanted in zip(rows, frame.to_dict("records"), strict=True):
        assert (row["player_a"], row["player_b"]) == (wanted["player_a"], wanted["player_b"])
        assert (int(row["race_a"]), int(row["race_b"])) == (wanted["race_a"], wanted["race_b"])
        assert float(row["p_win_a"]) == pytest.approx(wanted["p_win_a"], abs=1e-6)


def test_matches_can_be_read_again_and_give_the_same_ratings(league, files, tmp_path) -> None:
    path = tmp_path / "matches.csv"
    path.write_bytes(files["data/matches.csv"])
    again = fit(read_results(path).results, scale="fargo")
    order = [again.players.index(name) for name in league.ratings.players]
    np.testing.assert_allclose(again.rating[order], league.ratings.rating, atol=1e-6)


def test_changes_are_since_a_week_before_the_last_match(league, files) -> None:
    results = league.results
    earlier = fit(results.select(results.date <= results.date.max() - WEEK), scale="fargo")
    for row in table_of(files["data/changes.csv"]):
        seat = results.players.index(row["player"])
        assert float(row["rating_before"]) == pytest.approx(earlier.rating[seat], abs=1e-5)
        assert float(row["change"]) == pytest.approx(
            league.ratings.rating[seat] - earlier.rating[seat], abs=1e-5
        )
        assert int(row["matches_since"]) == 4


def test_a_match_is_worth_what_why_says(league) -> None:
    again = rated_alike(league.ratings, league.results)
    rows = matches_behind(league.results, league.ratings, (0, 1), again)
    name = league.results.players[0]
    wanted = sorted(row[-1] for row in rows if row[0] == name)
    assert sorted(one.worth for one in league.matches[name]) == pytest.approx(wanted)


def test_the_race_of_a_fixture_is_on_the_page_of_races(league, files) -> None:
    m, n, _ = league.races.by_pair["Ann Lee", "Bo Diaz"]
    page = files["races.html"].decode()
    assert "Races on Sep 23, 2025" in page
    assert f'<td class="number rating">{m}:{n}</td>' in page


def test_hostile_names_are_text() -> None:
    files = site_files(published(season(HOSTILE, rounds=1)))
    for name, content in files.items():
        if name.endswith(".html"):
            assert b"<script>alert" not in content
            assert b"<img" not in content
            assert b"{{" not in content or b"{{ 7 * 7 }}" in content
    assert b"\\u003cscript" in files["races.html"]
    assert not any(line.startswith("=") for line in files["data/ratings.csv"].decode().split("\n"))


def test_provisional_players_are_last_and_have_no_place() -> None:
    first, late = (
        season(),
        Results.from_names(
            ["Late Comer"], ["Ann Lee"], [5], [0], date=[np.datetime64("2025-09-16")]
        ),
    )
    league = published(
        first.joined(late) if first.players == late.players else _joined(first, late)
    )
    assert [(one.place, one.player) for one in league.rated][-1] == (None, "Late Comer")
    assert b"Provisional" in site_files(league)["ratings.html"]


def _joined(first: Results, late: Results) -> Results:
    rows = [
        (r.players[a], r.players[b], x, y, d)
        for r in (first, late)
        for a, b, x, y, d in zip(r.player_a, r.player_b, r.score_a, r.score_b, r.date, strict=True)
    ]
    a, b, x, y, date = map(list, zip(*rows, strict=True))
    return Results.from_names(a, b, x, y, date=date)


def test_a_league_without_dates_races_or_a_second_week_has_a_site() -> None:
    plain = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    files = site_files(published(plain))
    assert files["data/changes.csv"].count(b"\n") == 4
    assert b"Results up to" not in files["index.html"]


def test_teams_have_their_own_standings() -> None:
    many = len(season())
    teams = {"team_a": ["Acers"] * many, "team_b": ["Bankers"] * many}
    files = site_files(published(season(**teams)))
    assert b"Acers" in files["index.html"]
    assert files["data/teams.csv"].startswith(b"place,name,")


@pytest.mark.parametrize("rule", [OfferedRaces(games=(7, 9)), chart("fargo_r6_hot")])
def test_a_player_is_told_why_a_race_is_what_it_is(rule) -> None:
    page = site_files(published(rule=rule))["players/ann-lee.html"].decode()
    assert re.search(
        r"Ann Lee is rated \d+, and the last opponent, [^,]+, is rated \d+: a difference of \d+ "
        "points",
        page,
    )


@pytest.mark.slow
@pytest.mark.parametrize("many", [100, 250])
def test_a_large_league_has_small_pages(many: int) -> None:
    """100 players of long names, 3,000 matches; more of them; and a bracket of 64."""
    players = tuple(f"Maximiliana-Josephine Featherstonehaugh {k:03}" for k in range(many))
    league = published(_drawn(players, 3000))
    league.__dict__.update(_worth={}, history=[])
    object.__setattr__(league, "one_more", lambda *_: [])  # what takes long, and few bytes
    tournament = tournament_of("open", night(64, "double", 999), league.names)
    files = site_files(league, [tournament])
    for name, content in files.items():
        assert not name.endswith(".html") or len(content) <= MOST_BYTES, (name, len(content))
    assert ("standings-2.html" in files) == (many > 100)
    assert b"tournament-open-side-2.html" in files["tournament-open.html"]


def _drawn(players: tuple[str, ...], many: int) -> Results:
    rng = np.random.default_rng(1)
    pairs = np.array([rng.choice(len(players), 2, replace=False) for _ in range(many)])
    lost = rng.integers(0, 7, many)
    return Results.from_names(
        [players[a] for a, _ in pairs],
        [players[b] for _, b in pairs],
        np.full(many, 7),
        lost,
        date=np.datetime64("2025-09-02") + 7 * (np.arange(many) // 100),
        race_a=np.full(many, 7),
        race_b=np.full(many, 7),
    )
