"""Every file that an earlier version wrote opens, and holds what it held then."""

import json
import logging
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner

from earlier_files import NIGHT, TOURNAMENTS, held
from evenbreak.cli.program import program
from evenbreak.errors import DataError
from evenbreak.files.store.desk import (
    CLAIMED,
    Act,
    change_secrets,
    enter,
    kept_secrets,
    phone_entries,
)
from evenbreak.files.store.team_night import add_team_events, read_team_events
from evenbreak.files.store.tournament import add_events, keep_prizes, read_tournament
from evenbreak.teams.evening.events import Undone as TeamUndone
from evenbreak.tournaments.evening.events import Event, Undone
from evenbreak.tournaments.money.payouts import PrizeMoney
from tournament_nights import AT, SAVED

VERSIONS = sorted(SAVED.glob("v*"))
CHANGES = {
    "events": lambda path: add_events(path, lambda _: [Event(AT, Undone())]),
    "secrets": lambda path: change_secrets(path, {"pin": "000000"}),
    "prizes": lambda path: keep_prizes(path, PrizeMoney(5.0)),
    "phones": lambda path: enter(
        path, read_tournament(path), lambda _: Act(CLAIMED, "Hui"), at=AT, form="f"
    ),
    "team events": lambda path: add_team_events(
        path, lambda *_: [TeamUndone()], at=AT, by="director's page"
    ),
}


@pytest.fixture(params=VERSIONS, ids=lambda folder: folder.name)
def earlier(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return a copy of the files of an earlier version."""
    return Path(shutil.copytree(request.param, tmp_path / "earlier"))


def pragma(path: Path, name: str, value: int | None = None) -> int:
    with closing(sqlite3.connect(path)) as base:
        if value is not None:
            base.execute(f"PRAGMA {name} = {value}")
        return int(base.execute(f"PRAGMA {name}").fetchone()[0])


@pytest.mark.slow
def test_the_files_of_earlier_versions_hold_what_they_held(earlier: Path) -> None:
    before = {path: path.read_bytes() for path in earlier.iterdir()}
    expected = json.loads((earlier / "states.json").read_text(encoding="utf-8"))
    assert held(earlier) == expected
    for name in TOURNAMENTS:
        assert CliRunner().invoke(program, show(earlier / f"{name}.db")).exit_code == 0
    assert {path: path.read_bytes() for path in earlier.iterdir()} == before  # reading changes none


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("change", CHANGES)
def test_an_earlier_file_is_copied_before_its_first_change(
    earlier: Path, change: str, caplog: pytest.LogCaptureFixture
) -> None:
    expected = json.loads((earlier / "states.json").read_text(encoding="utf-8"))
    names = (NIGHT,) if change == "team events" else TOURNAMENTS
    for name in names:
        path = earlier / f"{name}.db"
        written = pragma(path, "user_version")
        with caplog.at_level(logging.WARNING):
            for _ in range(2):
                CHANGES[change](path)
        [copy] = earlier.glob(f"{name}-*.backup.db")
        told = [
            record.getMessage() for record in caplog.records if path.name in record.getMessage()
        ]
        assert told == [
            f"{path.name} was written by an earlier version of evenbreak; "
            f"a copy for that version is {copy.name}"
        ]
        assert pragma(copy, "user_version") == written < pragma(path, "user_version") == 3
        copy.replace(path)
    assert held(earlier) == expected


def test_what_phones_did_is_the_same_in_the_log(earlier: Path) -> None:
    path = earlier / "tournament.db"
    with closing(sqlite3.connect(path)) as base:
        rows = base.execute("SELECT game, player, score, phone, at FROM proposal").fetchall()
        later = "SELECT game, player, score, phone, at, kind, address FROM phone ORDER BY number"
        rows = [(*row, "proposed", "") for row in rows]
        if base.execute("SELECT 1 FROM sqlite_master WHERE name = 'phone'").fetchone():
            rows += base.execute(later).fetchall()
    before = phone_entries(path)
    assert rows == [
        (e.what.match, e.what.player, json.dumps(e.what.score), e.phone, e.at, e.kind, e.address)
        for e in before
    ]
    for _ in range(2):  # the same form
        CHANGES["phones"](path)
    assert [*before, phone_entries(path)[-1]] == phone_entries(path)
    assert phone_entries(path)[-1].what == Act(CLAIMED, "Hui")


def test_a_copy_that_cannot_be_made_keeps_the_file_as_it_was(
    earlier: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(28, "no room")

    path = earlier / "tournament.db"
    before = path.read_bytes()
    monkeypatch.setattr("evenbreak.files.store.evening_file.os.link", refuse)
    monkeypatch.setattr("evenbreak.files.store.evening_file.Path.rename", refuse)
    with pytest.raises(
        DataError, match=r"^tournament-format-[12].backup.db can't be written .no room.$"
    ):
        add_events(path, lambda _: [Event(AT, Undone())])
    assert path.read_bytes() == before
    assert not [one for one in earlier.iterdir() if one.name.startswith(".")]


@pytest.mark.parametrize(
    ("name", "value", "truth"),
    [
        ("user_version", 4, "newer version of evenbreak, in format 4, .* Update evenbreak"),
        ("user_version", 2**31 - 1, "newer version of evenbreak"),
        ("user_version", 0, "damaged .no version of evenbreak has written a format 0.*backup"),
        ("user_version", -7, "damaged .no version of evenbreak has written a format -7"),
        ("application_id", 0, "isn't a tournament file"),
        ("application_id", 252006674, "isn't a tournament file"),
    ],
)
def test_other_formats_are_refused_with_the_truth(
    earlier: Path, name: str, value: int, truth: str
) -> None:
    path = earlier / "tournament.db"
    pragma(path, name, value)
    before = path.read_bytes()
    uses = (
        read_tournament,
        read_team_events,
        lambda path: kept_secrets(path, {"other": "x"}),
        *CHANGES.values(),
    )
    for use in uses:
        with pytest.raises(ValueError, match=f"^tournament.db .*{truth}"):
            use(path)
    ran = CliRunner().invoke(program, show(path))
    assert (ran.exit_code, ran.stdout) == (1, "") or ran.exception
    assert path.read_bytes() == before


def show(path: Path) -> list[str]:
    return ["tournament", "show", "--file", str(path)]
