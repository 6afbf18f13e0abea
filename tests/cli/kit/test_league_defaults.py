"""What commands take from the league's file: every option that it can set, in every command."""

import click
import pytest

from evenbreak.cli.kit.asked import AskedCommand, asked_of
from evenbreak.cli.kit.faces import FACES
from evenbreak.cli.kit.said import runs
from evenbreak.cli.program import program
from evenbreak.fields.question import declared
from evenbreak.questions.of_league import BY_LEVEL, KEYS, key_of
from evenbreak.questions.results import ByChart

RACES = {"chart": 'chart = "npl_8"', "race": "race = 6", "race_to": "race_to = 6"}
TOP = {
    "scale": 'scale = "elo"',
    "system": 'system = "step 2"',
    "hours": 'hours = ["18:30", "23:00"]',
    "tables": "tables = 3",
    "turnover": "turnover = 4.5",
    "discipline": 'discipline = "10-ball"',
    "minutes_per_game": "minutes_per_game = 6.5",
    "name": 'name = "Tuesday"',
    "paper": 'paper = "letter"',
    "venue": 'venue = "Corner Pocket"',
    "begins": "begins = 2026-09-01",
    "ends": "ends = 2026-11-01",
}
TABLES = """
[files]
roster = "players.csv"
fixtures = "fixtures.csv"
teams = "teams.csv"
team_results = "team_results.csv"
[[results]]
file = "autumn.csv"
columns = { score_a = "H", score_b = "G" }
dates = "mdy"
[aliases]
"Al P" = "Al Peterson"
[team]
sets = 4
order = "ABBA"
cap = 23
at_most = "2:6"
count = "points"
[standings]
points = [3, 1, 0]
ties = ["wins"]
[prices]
entry = 12
[publish]
color = "#123456"
logo = "logo.png"
names = "initials"
"""
OTHER = {
    "scale": "fargo",
    "system": "npl",
    "hours": "20:00",
    "tables": "7",
    "turnover": "2",
    "discipline": "8-ball",
    "minutes_per_game": "9",
    "name": "Another",
    "venue": "Elsewhere",
    "begins": "2026-10-01",
    "ends": "2026-12-01",
    "paper": "a4",
    "race": "4",
    "race_to": "4",
    "team.sets": "3",
    "team.order": "home",
    "team.cap": "19",
    "team.at_most": "1:5",
    "team.count": "games",
    "standings.points": "2,1,0",
    "standings.ties": "scored",
    "prices.entry": "5",
    "publish.color": "#654321",
    "publish.names": "hidden",
    "results.columns": "score_a=X,score_b=Y",
    "results.dates": "dmy",
}
"""Another value for each key, as it is typed; that of a file is other.csv."""

LEVELS = "level,opponent_level,needs,opponent_needs\n4,4,3,3\n5,4,4,3\n5,5,4,4\n"
MADE = ("files.teams or files.roster", "begins", "ends")
"""What is for fixtures that are not made yet."""

LINEUP = ["ours.csv", "theirs.csv"]
WORDS = {
    "odds": ["5", "4"],
    "fair": ["5", "4"],
    "live": ["5", "4"],
    "compare": ["7:7", "9:9", "5", "4"],
    "why": ["Ann", "Bo"],
    "lineup": LINEUP,
    "round": LINEUP,
    "report": ["--out", "sheet"],
    "simulate": ["--out", "season"],
    "chart design": ["--games", "7..13"],
    "chart team": ["417", "447"],
    "chips odds": ["entrants.csv", "--chips", "hoboken"],
    "chips audit": ["hoboken"],
    "chips design": ["entrants.csv"],
    "tournament new": ["entrants.csv"],
    "tournament print": ["cards"],
    "tournament odds": ["entrants.csv"],
    "tournament time": ["entrants.csv"],
    "tournament import": ["saved.json"],
}
"""What is typed with each command that needs more than the file of the league."""

MORE = {
    ("matchups", "tables"): ["--pairs", "tonight.csv"],
    ("matchups", "turnover"): ["--pairs", "tonight.csv"],
    ("publish", "race_to"): [],
    **{(name, "from_file"): ["Ann", "Bo"] for name in ("odds", "fair", "live")},
}
"""What is typed for some options besides, or in place of the words."""


def commands(group, words=()):
    for name in group.list_commands(None):
        command = group.get_command(click.Context(group), name)
        if isinstance(command, click.Group):
            yield from commands(command, (*words, name))
        elif isinstance(command, AskedCommand):
            yield " ".join((*words, name)), command


COMMANDS = dict(commands(program))
OPTIONS = [
    pytest.param(name, one, id=f"{name} {one.name}")
    for name, command in COMMANDS.items()
    for one in declared(command.question)
    if key_of(command.question, one.name)
]


@pytest.fixture
def league(tmp_path, monkeypatch):
    names = "players fixtures teams team_results autumn other ours theirs entrants start last"
    for name in names.split():
        (tmp_path / f"{name}.csv").write_text("player,level\nAnn,5\nBo,4\n")
    (tmp_path / "logo.png").write_text("")
    (tmp_path / "levels.csv").write_text(LEVELS)
    monkeypatch.chdir(tmp_path)

    def write(key, question, required):
        by_chart = any(one.name == "chart" for one in declared(question))
        races = key if key in RACES else "chart" if by_chart else "race"
        pace = "discipline" if key != "minutes_per_game" else "minutes_per_game"
        leaves_out = {"discipline", "minutes_per_game"} - {pace}
        by_level = (question.__name__, key) in BY_LEVEL or (key == "results" and not required)
        if key == "chart" and issubclass(question, ByChart):
            by_level = question.__name__ != "Publish"
        if by_level:
            leaves_out |= {"scale"}
        top = [line for name, line in TOP.items() if name not in leaves_out]
        chart = 'chart = "apa_8ball"' if by_level else RACES[races]
        tables = TABLES.replace('fixtures = "fixtures.csv"\n', "") if key in MADE else TABLES
        (tmp_path / "league.toml").write_text("\n".join([*top, chart, tables]))

    return write


def asked(name, words):
    command = COMMANDS[name]
    runs(command)
    with command.make_context(name, list(words)) as ctx:
        values = {name: value for name, value in ctx.params.items() if name not in FACES}
        return asked_of(command.question, values, ctx)


@pytest.mark.parametrize(("name", "one"), OPTIONS)
def test_each_option_is_taken_shown_and_overridden(league, capsys, name, one):
    question = COMMANDS[name].question
    key = key_of(question, one.name)
    league(key, question, one.required)
    words = WORDS.get(name, [])
    more = MORE.get((name, one.name), [])
    words = more if one.name == "from_file" else [*words, *more]
    if key.startswith("results."):
        option = {"why": ["--results"], "league fixtures": ["--left"]}.get(name, [])
        words = [*words, *option, "autumn.csv"]
    value = getattr(asked(name, words), one.name)
    assert value != one.default
    verbose = ["-v"] if any(param.name == "verbose" for param in COMMANDS[name].params) else []
    if verbose:
        capsys.readouterr()
        asked(name, [*words, "-v"])
        shown = capsys.readouterr().err
        assert f" {one.name} " in shown or f" {one.option} " in shown
    other = "levels.csv" if key == "chart" else OTHER.get(key, "other.csv")
    typed = [other] if one.field.argument else [one.option, other]
    if one.name == "schedule" and one.field.argument:
        typed = ["results.csv", other]
    own = getattr(asked(name, [*words, *typed]), one.name)
    read = one.kind.read(other)
    assert own == ((read,) if one.field.many else read) != value


def test_every_key_of_the_map_is_an_option_of_some_command():
    assert {one.values[1].name for one in OPTIONS} >= {*KEYS}
