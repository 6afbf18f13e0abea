"""The table of moves: a command and a form for each, which enter the same."""

import pytest
from click.testing import CliRunner

from evenbreak.answers.tournament.move_table import MOVES
from evenbreak.cli.program import program
from evenbreak.files.store.tournament import new_tournament, read_events, read_tournament
from evenbreak.questions.moves import COMMANDS
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.web.app import make_app
from evenbreak.web.forms import Fields, Form
from evenbreak.web.pages.moves import asked_in
from evenbreak.web.site import Site

AT = "2025-03-01T19:30:00"
NAMES = ("Ann Lee", "Bo", "Cy", "Di", "Ed", "Flo")
DRAWN = Drawn(NAMES, (0, None, 3, 4, 2, 5, 1, None))
ENTERED = [
    ("call", "1 --table TV", {"match": "1", "table": "TV"}),
    ("call", "2", {"match": "2"}),
    ("swap-tables", "1 2", {"one": "1", "other": "2"}),
    ("wait", "2 --absent flo --until 20:15", {"match": "2", "absent": "Flo", "until": "20:15"}),
    ("uncall", "1", {"match": "1"}),
    ("score", "1 1:2", {"match": "1", "a": "1", "b": "2"}),
    ("result", "1 --winner di --games 2", {"match": "1", "winner": "Di", "games": "2"}),
    ("result", "2 2:1 --ended time", {"match": "2", "a": "2", "b": "1", "ended": "time"}),
    ("correct", "1 1:3 --yes", {"match": "1", "a": "1", "b": "3", "sure": "yes"}),
    ("rename", "ann Anne", {"player": "Ann Lee", "to": "Anne"}),
    ("swap", "anne bo --yes", {"one": "Anne", "other": "Bo", "sure": "yes"}),
    ("substitute", "bo Zoe --rating 71.5", {"player": "Bo", "to": "Zoe", "rating": "71,5"}),
    ("check-in", "cy --paid yes", {"player": "Cy", "paid": "yes"}),
    ("check-in", "cy", {"player": "Cy"}),
    ("late", "Gus --rating 60", {"player": "Gus", "rating": "60"}),
    ("undo", "", {}),
    ("redo", "", {}),
    ("change", "--tables 5-7,TV,A --reserved TV", {"tables": "5-7,TV,A", "reserved": "TV"}),
    ("change", "--tables 2 --race 4", {"tables": "2", "race": "4"}),
    ("forfeit", "zoe --yes", {"player": "Zoe", "sure": "yes"}),
    ("drop", "cy --yes", {"player": "Cy", "sure": "yes"}),
]


def test_each_move_has_a_command_and_a_form_of_one_question(tmp_path):
    assert {name: move.question for name, move in MOVES.items()} == {
        name: question for name, (question, _) in COMMANDS.items()
    }
    paths = {one.path for one in make_app(Site(tmp_path / "tonight.db")).routes}
    assert {f"/desk/{name}" for name in MOVES} <= paths


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_of_a_command_fits_a_screen(name):
    shown = CliRunner().invoke(program, ["tournament", name, "--help"])
    assert shown.exit_code == 0
    assert shown.stdout.count("\n") <= 40


@pytest.mark.slow
def test_what_a_command_enters_a_form_enters_too(tmp_path):
    path = tmp_path / "tonight.db"
    plan = Plan("double", 3, final="true", tables=4, labels=("1", "2", "3", "TV"))
    opened = Opened(plan, tuple(Entrant(name, 80.0 - k) for k, name in enumerate(NAMES)))
    new_tournament(path, [Event(AT, opened), Event(AT, DRAWN)])
    for name, words, fields in ENTERED:
        before, count = read_tournament(path), len(read_events(path))
        typed = ["tournament", name, *words.split(), "--file", str(path), "--at", "19:40"]
        ran = CliRunner().invoke(program, [*typed, "--text"])
        assert ran.exit_code == 0, (name, words, ran.stderr)
        after = [one.what for one in read_events(path)[count:]]
        assert after == entered(before, name, fields), (name, ran.stdout)


def entered(state, name, fields):
    move = MOVES[name]
    return [
        what
        for asked in asked_in(move.question, Form(Fields([*fields.items()])))
        for what in move.decide(state, asked, "2025-03-01T19:40:00")
    ]
