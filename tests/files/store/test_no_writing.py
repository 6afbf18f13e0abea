"""Where nothing can be written, the file of an evening is shown, and an entry is refused."""

import os
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from click.testing import CliRunner

from earlier_files import tournament
from evenbreak.cli.program import program
from evenbreak.errors import DataError
from evenbreak.files.store.tournament import add_events, new_tournament, read_events
from evenbreak.tournaments.evening.events import Event, Undone
from evenbreak.web.site import Site
from tournament_nights import AT, SAVED

resource = pytest.importorskip("resource")
GOOD = SAVED / "v0_2_0" / "tournament.db"
NOBODY = 65534


@pytest.fixture
def folder() -> Iterator[Path]:
    """Return a folder that everybody may open, with a tournament."""
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        place.chmod(0o755)
        shutil.copyfile(GOOD, place / "tonight.db")
        yield place
        place.chmod(0o755)


@contextmanager
def without_rights() -> Iterator[None]:
    """Let go of the rights of an administrator."""
    before = os.geteuid()
    if before == 0:
        os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(before)


@contextmanager
def full_disk(room: int) -> Iterator[None]:
    """Let no file grow beyond so many bytes, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def undo(path: Path) -> None:
    add_events(path, lambda _: [Event(AT, Undone())])


@pytest.mark.parametrize("modes", [(0o444, 0o755), (0o444, 0o555)], ids=["file", "folder"])
def test_what_can_only_be_read_is_shown(folder: Path, modes: tuple[int, int]) -> None:
    path = folder / "tonight.db"
    expected = tournament(path)
    show = ["tournament", "export", "--file", str(path)]
    shown = CliRunner().invoke(program, show).stdout
    path.chmod(modes[0])
    folder.chmod(modes[1])
    with without_rights():
        assert tournament(path) == expected
        site = Site(path)
        assert (site.pin, site.night.state().order) == ("482913", expected["order"])
        with pytest.raises(DataError, match=r"^tonight.db (can't be opened|is read-only)"):
            undo(path)
        said = CliRunner().invoke(program, show)
    assert (said.exit_code, said.stdout) == (0, shown)
    assert shown.count("\n") > 3


def test_on_a_full_disk_the_file_is_shown_and_an_entry_refused(folder: Path) -> None:
    path = folder / "tonight.db"
    expected = tournament(path)
    with full_disk(1000):
        assert tournament(path) == expected
        with pytest.raises(DataError, match=r"^the disk that holds tonight.db"):
            undo(path)
        with pytest.raises(DataError, match=r"^the disk that holds other.db"):
            new_tournament(folder / "other.db", read_events(path))
    assert [one.name for one in folder.glob("*other*")] == []
    assert tournament(path) == expected
    undo(path)


def test_a_disk_that_fills_up_loses_nothing_acknowledged(folder: Path) -> None:
    path = folder / "tonight.db"
    undo(path)
    taken, said = len(read_events(path)), ""
    with closing(sqlite3.connect(path, isolation_level=None)) as reader:
        reader.execute("BEGIN")
        reader.execute("SELECT * FROM entry").fetchall()  # so that the log can only grow
        with full_disk(60_000):
            while not said and taken < 200:
                try:
                    add_events(path, lambda state: [state.events[-1]])
                    taken += 1
                except DataError as error:
                    said = str(error)
        assert said.startswith(("the disk that holds tonight.db", "there is no room"))
        assert len(read_events(path)) == taken
    assert len(read_events(path)) == taken
    add_events(path, lambda state: [state.events[-1]])
