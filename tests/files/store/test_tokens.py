"""Tokens of programs: the file has their hashes alone, and are gone when taken back."""

import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.errors import DataError, InputError
from evenbreak.evenings.log import PROGRAM
from evenbreak.files.store import tokens
from evenbreak.files.store.tournament import add_events, new_tournament
from evenbreak.tournaments.evening.events import Dropped, Entrant, Event, Opened, Plan, Undone

AT = "2025-03-01T19:{:02}:00"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    plan, names = Plan("single", 5), ("Ann", "Bo", "Cy", "Di")
    first = Opened(plan, tuple(Entrant(name, 80.0) for name in names))
    new_tournament(tmp_path / "tonight.db", [Event(AT.format(0), first)])
    return tmp_path / "tonight.db"


def test_the_file_does_not_hold_a_token(path: Path) -> None:
    created = {
        tokens.create_token(path, f"board {n}", tokens.SCORES, AT.format(1)) for n in range(9)
    }
    assert len(created) == 9
    held = b"".join(one.read_bytes() for one in path.parent.iterdir())
    for one in created:
        assert len(one.removeprefix("evenbreak-")) == 32  # of 5 bits each
        assert one.encode() not in held
        assert one.removeprefix("evenbreak-").encode() not in held
        assert tokens.token_in(tokens.kept_tokens(path), one) is not None
    for wrong in (
        "",
        "evenbreak-",
        next(iter(created))[:-1],
        next(iter(created)).upper(),
        "é\ud800",
    ):
        assert tokens.token_in(tokens.kept_tokens(path), wrong) is None


def test_a_token_is_gone_once_it_is_revoked_and_an_undo_does_not_bring_it_again(
    path: Path,
) -> None:
    created = tokens.create_token(path, "board", tokens.SCORES, AT.format(1))
    add_events(path, lambda _: [Event(AT.format(2), Dropped("Bo"))], by=PROGRAM + "board")
    for used in (False, True):  # who writes does not wait until all entries are looked through
        held = tokens.token_in(tokens.kept_tokens(path, used=used), created)
        assert held == tokens.Token("board", "scores", AT.format(1), AT.format(2) if used else "")
    with pytest.raises(InputError, match="Board already has a token"):
        tokens.create_token(path, "Board", tokens.DIRECTOR, AT.format(3))
    tokens.revoke_token(path, "board")
    for _ in range(2):
        assert not tokens.kept_tokens(path)
        add_events(path, lambda _: [Event(AT.format(3), Undone())] if _.dropped else [])
    with pytest.raises(InputError, match="no program called board"):
        tokens.revoke_token(path, "board")
    again = tokens.create_token(path, "board", tokens.SCORES, AT.format(4))
    ((_, one),) = tokens.kept_tokens(path, used=True).items()
    assert (again != created, one.used) == (True, "")  # what another token entered is not its use


@pytest.mark.parametrize("name", ["", " ", "\u202e", "x" * 41, "a\x00b"])
def test_a_program_has_a_name_that_can_be_shown(path: Path, name: str) -> None:
    with pytest.raises(InputError, match="isn't a name"):
        tokens.create_token(path, name, tokens.SCORES, AT.format(1))


def test_there_are_not_more_tokens_than_anybody_needs(path: Path) -> None:
    with closing(sqlite3.connect(path)) as base, base:
        base.execute(tokens._TABLE)
        for n in range(50):
            base.execute("INSERT INTO token VALUES (?, 'scores', ?, '')", (f"p{n}", f"{n}"))
    with pytest.raises(InputError, match="already 50 tokens"):
        tokens.create_token(path, "board", tokens.SCORES, AT.format(1))


@pytest.mark.parametrize(
    "scope",
    ["", "all", "table:", "table:x", "table:²", "4", "table:" + "9" * 5000, None, 4, b"scores"],
)
def test_a_damaged_token_is_named(path: Path, scope: object) -> None:
    tokens.create_token(path, "board", tokens.SCORES, AT.format(1))
    with closing(sqlite3.connect(path)) as base, base:
        base.execute("DROP TABLE token")
        base.execute("CREATE TABLE token (name, scope, hash, created)")
        base.execute("INSERT INTO token VALUES ('board', ?, 'x', '')", (scope,))
    with pytest.raises(DataError, match="tokens can't be read"):
        tokens.kept_tokens(path)


def test_a_command_creates_lists_and_revokes(path: Path) -> None:
    def says(*words: str) -> str:
        ran = CliRunner().invoke(program, ["tournament", "token", *words, "--file", str(path)])
        assert ran.exit_code == (0 if ran.stdout else 2), ran.output
        return ran.stdout or ran.stderr

    assert "No program can make entries" in says()
    (created,) = re.findall(r"evenbreak-\w{32}", says("board", "--may", "table:2"))
    (kept,) = tokens.kept_tokens(path).values()
    assert (kept.name, kept.scope) == ("board", "table:2")
    listed = says()
    assert "only table 2" in listed
    assert created not in listed
    assert "already has a token" in says("BOARD")
    assert "no program called tv has a token" in says("tv", "--revoke")
    assert "No program can make entries" in says("board", "--revoke")
