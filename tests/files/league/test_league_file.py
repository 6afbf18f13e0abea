"""`league.toml`: what it holds, and every problem of it at once, each with its line."""

from datetime import date, time

import pytest

from evenbreak.errors import DataError
from evenbreak.fields.question import declared
from evenbreak.files.league.league_file import (
    SECTIONS,
    LeagueFile,
    Source,
    find_league,
    read_league,
)
from evenbreak.league import TableRules

WHOLE = """\
name = "Tuesday 8-Ball"
discipline = "8-ball"
scale = "fargo"
chart = "races.csv"
system = "npl"
begins = 2026-09-01
ends = 2026-12-15
venue = "Corner Pocket"
tables = 6
hours = ["19:00", "23:00"]
minutes_per_game = 7.5
turnover = 5
paper = "letter"

[files]
roster = "players.csv"
fixtures = "fixtures.csv"
teams = "teams.csv"
team_results = "team_results.csv"

[[results]]
file = "autumn.csv"
dates = "dmy"
columns = { player_a = "Heim", player_b = "Gast", score_a = "H", score_b = "G" }

[[results]]
file = "spring.csv"

[aliases]
"Big Al Peterson" = "Al Peterson"

[team]
players = 5
sets = 5
cap = 23
at_most = "2:6"
order = "alternate"
count = "points"

[standings]
points = [3, 1, 0]
ties = ["head-to-head", "difference"]

[prices]
entry = 10
currency = "$"

[publish]
color = "#1B6e53"
logo = "logo.png"
names = "full"

[publish.players]
"Ann Lee" = "initials"
"""
FILES = "players.csv fixtures.csv teams.csv team_results.csv autumn.csv spring.csv logo.png"
CHART = "difference_from,difference_to,games_higher,games_lower\n0,9,5,5\n10,,5,4\n"


@pytest.fixture
def folder(tmp_path):
    for name in FILES.split():
        (tmp_path / name).write_text("")
    (tmp_path / "races.csv").write_text(CHART)
    return tmp_path


def read(folder, text):
    (folder / "league.toml").write_text(text, encoding="utf-8")
    return read_league(folder)


def problems(folder, text):
    with pytest.raises(DataError) as refused:
        read(folder, text)
    source = f"{folder / 'league.toml'}:"
    return [problem.removeprefix(source) for problem in refused.value.problems]


def test_every_key_is_read(folder):
    league = read(folder, WHOLE)
    assert (league.folder, league.path) == (folder, find_league(folder))
    assert (league.name, league.scale.name, league.system) == (
        "Tuesday 8-Ball",
        "fargo",
        "npl",
    )
    assert (league.begins, league.hours) == (date(2026, 9, 1), (time(19), time(23)))
    assert (league.tables, league.minutes_per_game, league.turnover) == (6, 7.5, 5)
    assert league.place(league.files.roster) == str(folder / "players.csv")
    assert [one.file for one in league.results] == ["autumn.csv", "spring.csv"]
    assert (league.results[0].columns["score_b"], league.results[0].dates) == ("G", "dmy")
    assert league.aliases == {"Big Al Peterson": "Al Peterson"}
    assert (league.team.cap, league.team.at_most) == (23, (2, 6))
    assert league.standings.rules == TableRules(3, 1, 0, ties=("head-to-head", "difference"))
    assert league.standings.ties == ("head-to-head", "difference")
    assert (league.publish.color, league.publish.players) == ("#1b6e53", {"Ann Lee": "initials"})


def test_the_whole_example_has_every_key_but_those_that_the_chart_excludes():
    for of in (LeagueFile, Source, *SECTIONS.values()):
        for one in declared(of):
            assert f"\n{one.name} = " in "\n" + WHOLE or one.name in ("race", "race_to"), one.name


def test_an_empty_file_has_the_defaults(folder):
    league = read(folder, "")
    assert league == LeagueFile(folder=folder)
    assert (league.scale, league.results, league.publish.names) == (None, (), "full")


def test_every_key_with_a_value_that_it_cannot_have_is_named_with_its_line(folder):
    text = "".join(
        line + "\n" if line.startswith("[") or not line else line.partition(" = ")[0] + " = '\t'\n"
        for line in WHOLE.splitlines()
    )
    wrong = {int(problem.split(":")[0]) for problem in problems(folder, text)}
    keys = {n for n, line in enumerate(text.splitlines(), 1) if line and line[0] != "["}
    ties = {n for n, line in enumerate(text.splitlines(), 1) if line.startswith("ties")}
    assert wrong == keys - ties  # no rule at all is a rule


@pytest.mark.parametrize(
    ("text", "line", "remedy"),
    [
        ('naem = "A"', 1, "there's no key 'naem'. Write 'name'"),
        ("zzz = 1", 1, "there's no key 'zzz'. The keys here are name, discipline"),
        ('[files]\nroster = "players.csv"\ntables = 6', 3, "Move it to the top, above the first"),
        ("tables = 6\ncap = 23", 2, "'cap' doesn't belong here. Move it below a line [team]"),
        ("\n\nteam = 5", 3, "'team' is a table. Write its keys below a line [team]"),
        ("results = 'autumn.csv'", 1, "write a [[results]] line for each file"),
        ("[[results]]", 1, 'file is missing. Add file = "..."'),
        ("tables = [\n 6,\n { a = 1 },\n]", 1, "tables takes a single value"),
        ("name = 'A'\nhours = [\n '19:00',\n '25:00',\n]", 2, "write when a night starts and ends"),
        ("[files]\nroster = 'player.csv'", 2, "(did you mean 'players.csv'?), or delete the line"),
        ("chart = 'nochart'", 1, "no chart or file with this name"),
        ("chart = 'npl_10'\nrace = 5", 2, "race and chart both set the length of races. Keep one"),
        ("begins = 2026-09-01\nends = 2026-08-01", 2, "ends before it starts."),
        ("ends = '1/2/2026'", 1, "'1/2/2026' isn't a date. Write it as 2026-09-01"),
        ("[aliases]\nAl = 'Bo'\nBo = 'Cy'", 2, "'Al' means 'Bo', which means 'Cy'"),
        ("[publish.players]\n'Ann Lee' = 'none'", 2, "isn't one of 'full', 'initials', 'hidden'"),
        (
            "[[results]]\nfile = 'autumn.csv'\n[[results]]\nfile = 'spring.csv'\n"
            "[results.columns]\nplayera = 'Heim'",
            6,
            "there's no key 'playera'. Write 'player_a'",
        ),
        ("[[results]]\nfile = 'autumn.csv'\n[[results]]\nfile = 'autumn.csv'", 4, "listed twice"),
        ("name = 'A'\nvenue = Corner Pocket", 2, "can't be read"),
    ],
)
def test_a_problem_has_its_line_and_its_remedy(folder, text, line, remedy):
    (problem,) = problems(folder, text)
    assert problem.startswith(f"{line}: ")
    assert remedy in problem


def test_all_problems_come_at_once(folder):
    text = 'scale = "fargoo"\ntabels = 6\n[team]\ncap = -1\nat_most = "two"\n'
    assert [problem[:2] for problem in problems(folder, text)] == ["1:", "2:", "4:", "5:"]


def test_read_quickly_neither_chart_nor_system_is_looked_up(folder):
    (folder / "league.toml").write_text('chart = "nochart"\nsystem = "nosystem"\ntables = 6\n')
    assert read_league(folder, quickly=True).system == "nosystem"
    assert len(problems(folder, (folder / "league.toml").read_text())) == 2


def test_only_the_folder_itself_is_looked_at(folder):
    assert find_league(folder) is None
    read(folder, WHOLE)
    (folder / "deeper").mkdir()
    assert find_league(folder / "deeper") is None
    assert read_league(folder / "league.toml") == read_league(folder)
