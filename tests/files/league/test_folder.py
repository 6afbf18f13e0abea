"""What the files of a folder are taken as, and the file of the league that they propose."""

import shutil

import pytest

from evenbreak.fields.question import declared
from evenbreak.files.league.folder import seen_files
from evenbreak.files.league.league_file import SECTIONS, LeagueFile, league_of
from evenbreak.files.league.new_file import EXAMPLES, NewLeague, league_toml, proposed
from evenbreak.files.results.proposals import readings_of
from evenbreak.files.results.seasons import read_seasons
from places import DATA

RESULTS = "date,player_a,player_b,score_a,score_b\n2026-09-01,Ann,Bo,5,3\n2026-09-08,Bo,Cy,5,4\n"
PLAYED = """\
Ann;Bo;7;2|Bo;Ann;4;7|Cy;Ann;7;5|Bo;Cy;7;6|Ann;Cy;3;7|Cy;Bo;0;7
Bo;Ann;7;5|Ann;Cy;7;1|Cy;Bo;7;4|Ann;Bo;6;7|Bo;Cy;2;7|Cy;Ann;4;7"""
MATCHES = PLAYED.replace("\n", "|").split("|")
GERMAN = "Datum;Name H;Name G;S1;S2\n" + "".join(
    f"{day:02}.10.2026;{match}\n" for day, match in enumerate(MATCHES, 1)
)
FILES = {
    "autumn.csv": RESULTS,
    "players.csv": "player,level,team\nAnn,7,Aces\nBo,4,Bolts\nCy,2,Aces\n",
    "teams.csv": "team,points\nAces,0\nBolts,-2\n",
    "nights.csv": "home,away,home_score,away_score\nAces,Bolts,3,2\n",
    "plan.csv": "date,home,away\n2026-09-15,Bolts,Aces\n",
    "chart.csv": "from,to,stronger,weaker\n0,9,5,5\n10,,5,4\n",
    "names.csv": "name,means\nAnnie,Ann\n",
    "others.csv": RESULTS.replace("Ann", "Xi").replace("Bo", "Yu").replace("Cy", "Zoe"),
    "drills.csv": "date,drill,score\n2026-01-01,L,4\n",
    "note.txt": "Bring chalk.\n",
    ".hidden.csv": RESULTS,
    "tidy.csv": RESULTS,
}
TAKEN = {
    "autumn.csv": "results",
    "players.csv": "roster",
    "teams.csv": "teams",
    "nights.csv": "team_results",
    "plan.csv": "fixtures",
    "chart.csv": "chart",
    "names.csv": "aliases",
    "others.csv": "",
    "drills.csv": "",
    "note.txt": "",
}


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def written(folder, name="Tuesday"):
    new = proposed(seen_files(folder), name)
    return new, league_of(league_toml(new).encode(), folder / "league.toml")


def test_each_file_is_taken_as_what_it_is(folder):
    assert {one.name: one.what for one in seen_files(folder)} == TAKEN


def test_the_file_that_is_proposed_can_be_read_and_names_them(folder):
    _, league = written(folder)
    assert (league.name, league.chart, league.scale) == ("Tuesday", "chart.csv", None)
    assert vars(league.files) == {
        "roster": "players.csv",
        "fixtures": "plan.csv",
        "teams": "teams.csv",
        "team_results": "nights.csv",
    }
    assert [one.file for one in league.results] == ["autumn.csv"]
    assert league.aliases == {"Annie": "Ann"}


def test_a_league_of_skill_levels_gets_the_chart_and_the_rules_of_its_levels(folder):
    (folder / "chart.csv").unlink()
    new, league = written(folder)
    assert new.levels
    assert (league.chart, league.team.cap, league.team.at_most) == ("apa_8ball", 23, (2, 6))
    assert league.standings.rules.split == "apa_8ball"


@pytest.mark.parametrize(
    ("ratings", "scale", "races"),
    [((612, 540), "fargo", (None, 7)), ((92, 71), "npl", ("npl_10", None))],
)
def test_the_ratings_show_the_scale(tmp_path, ratings, scale, races):
    (tmp_path / "club.csv").write_text("player,rating\nAnn,{}\nBo,{}\n".format(*ratings))
    _, league = written(tmp_path)
    assert league.scale.name == scale
    assert (league.chart, league.race_to) == races


def test_titles_that_are_not_known_are_written_where_the_rows_leave_one_reading(tmp_path):
    (tmp_path / "herbst.csv").write_text(GERMAN)
    (tmp_path / "autumn.csv").write_text(RESULTS)
    new, league = written(tmp_path)
    assert dict(league.results[1].columns) == {
        "player_a": "Name H",
        "player_b": "Name G",
        "score_a": "S1",
        "score_b": "S2",
    }
    (tmp_path / "league.toml").write_text(league_toml(new))
    assert len(read_seasons([league.path]).results) == 14


def test_scores_that_go_with_the_player_are_not_proposed_the_other_way_around():
    rows = [row.split(";") for row in ["Ann;Bo;7;2", "Bo;Ann;4;7", "Cy;Ann;1;7", "Bo;Cy;7;6"] * 4]
    ways = readings_of({}, ["Wer", "Gegen", "S1", "S2"], rows)
    assert not any(way["player_a"] == "Gegen" and way["score_a"] == "S1" for way in ways)


@pytest.mark.slow
def test_of_the_demo_files_those_of_the_largest_league_are_taken(tmp_path):
    for place in DATA.glob("*.csv"):
        shutil.copy(place, tmp_path)
    new, league = written(tmp_path)
    assert "demo_league.csv" in dict(new.sources)
    assert "demo_sandbag.csv" not in dict(new.sources)
    assert league.files.roster == "demo_league_roster.csv"


def test_results_of_home_and_away_alone_are_those_of_a_team_season_too(tmp_path):
    (tmp_path / "nights.csv").write_text(FILES["nights.csv"])
    _, league = written(tmp_path)
    assert league.files.team_results == "nights.csv"
    assert [one.file for one in league.results] == ["nights.csv"]


def test_results_of_players_with_their_teams_are_not_those_of_a_team_season(tmp_path):
    head, *rows = RESULTS.splitlines()
    text = "\n".join([f"{head},team_a,team_b", *(f"{row},Aces,Bolts" for row in rows)])
    (tmp_path / "nights.csv").write_text(text)
    assert "files.team_results" not in proposed(seen_files(tmp_path), "Club").values


def test_an_empty_folder_proposes_a_league_too(tmp_path):
    _, league = written(tmp_path)
    assert (league.name, league.race_to, league.results) == ("Tuesday", 7, ())


def test_every_key_has_an_example_and_all_can_stand_in_one_file(folder):
    keys = [one.name for one in declared(LeagueFile)]
    keys += [f"{name}.{one.name}" for name, of in SECTIONS.items() for one in declared(of)]
    assert keys == [*EXAMPLES]
    for name in ("fixtures.csv", "team_results.csv", "logo.png"):
        (folder / name).write_text("")
    lines = league_toml(NewLeague(values={})).splitlines()
    races = ("# race = ", "# race_to = ", "# [[results]]", "# file", "# columns", "# dates")
    used = [
        line[2:] if line.startswith("# ") and " = " in line and not line.startswith(races) else line
        for line in lines
        if "Names that mean" not in line and "How individual" not in line
    ]
    league = league_of("\n".join(used).encode(), folder / "league.toml")
    assert all(getattr(league, key) is not None for key in EXAMPLES if "." not in key) is False
    missing = [key for key in EXAMPLES if "." not in key and getattr(league, key) is None]
    assert missing == ["race", "race_to"]
    assert (league.team.cap, league.prices.currency, league.publish.logo) == (23, "$", "logo.png")


def test_names_and_titles_with_quotes_survive(folder):
    new = NewLeague(
        values={"name": 'The "Big" \\ League'},
        sources=[("autumn.csv", {"player_a": 'The "A"', "score_a": "a=b, c"})],
        aliases={'"Big Al" Peterson': "Al Peterson"},
    )
    league = league_of(league_toml(new).encode(), folder / "league.toml")
    assert league.name == 'The "Big" \\ League'
    assert league.results[0].columns == {"player_a": 'The "A"', "score_a": "a=b, c"}
    assert league.aliases == {'"Big Al" Peterson': "Al Peterson"}
