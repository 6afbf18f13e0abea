import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import pytest

from evenbreak.files.store.folder import MADE_BY_US, WORK, check_folder, write_files
from rows import posix

NAMES = ("a.csv", "b.csv", "c.csv")
OLD = {name: f"old {name}".encode() for name in NAMES}
NEW = {name: f"new {name}".encode() * 1000 for name in NAMES}


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture
def folder(tmp_path):
    write_files(tmp_path / "sheet", OLD)
    return tmp_path / "sheet"


def test_a_new_folder_is_made_with_its_parents(tmp_path):
    write_files(tmp_path / "x" / "y", OLD)
    assert content(tmp_path / "x" / "y") == OLD
    assert [path.name for path in (tmp_path / "x").iterdir()] == ["y"]


def test_old_files_are_replaced_and_others_left_alone(folder):
    (folder / "notes.txt").write_bytes(b"mine")
    write_files(folder, NEW)
    assert content(folder) == {**NEW, "notes.txt": b"mine"}


@posix
def test_files_and_folder_have_the_usual_permissions(tmp_path):
    mask = os.umask(0o022)
    try:
        write_files(tmp_path / "sheet", OLD)
    finally:
        os.umask(mask)
    assert (tmp_path / "sheet").stat().st_mode & 0o777 == 0o755
    assert (tmp_path / "sheet" / "a.csv").stat().st_mode & 0o777 == 0o644


@pytest.mark.parametrize("failing", range(3))
def test_a_full_disk_leaves_the_old_files(folder, monkeypatch, failing):
    calls = []

    def full(handle):
        calls.append(handle)
        if len(calls) > failing:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_files(folder, NEW)
    assert content(folder) == OLD


def test_a_full_disk_leaves_no_new_folder(tmp_path, monkeypatch):
    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_files(tmp_path / "sheet", NEW)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_place_of_a_file_changes_nothing(folder):
    (folder / "c.csv").unlink()
    (folder / "c.csv").mkdir()
    with pytest.raises(IsADirectoryError):
        write_files(folder, NEW)
    assert (folder / "a.csv").read_bytes() == OLD["a.csv"]
    assert sorted(path.name for path in folder.iterdir()) == list(NAMES)


@pytest.mark.parametrize("place", ["sheet", "deep/sheet"])
def test_a_file_in_the_place_of_a_folder_above_is_told(tmp_path, place):
    above = tmp_path / "one.csv"
    above.write_bytes(b"mine")
    with pytest.raises(NotADirectoryError) as caught:
        write_files(above / place, NEW)
    assert caught.value.filename == str(above / place)
    told = f"{above} is a file, so it can't hold a folder. Choose another."
    assert caught.value.strerror == told
    assert content(tmp_path) == {"one.csv": b"mine"}


@pytest.mark.parametrize("failing", range(1, 5))  # the journal and the three files
def test_an_interrupt_while_files_take_their_places_waits(folder, monkeypatch, failing):
    replace, calls = os.replace, []

    def replace_and_interrupt(*places):
        calls.append(places)
        if len(calls) == failing:
            signal.raise_signal(signal.SIGINT)
        return replace(*places)

    monkeypatch.setattr(os, "replace", replace_and_interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_files(folder, NEW)
    assert content(folder) == NEW
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_interrupt_before_that_leaves_the_old_files(folder, monkeypatch):
    def interrupt(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_files(folder, NEW)
    assert content(folder) == OLD


def test_other_threads_can_write(folder):
    thread = threading.Thread(target=write_files, args=(folder, NEW))
    thread.start()
    thread.join()
    assert content(folder) == NEW


def test_files_of_people_are_left_alone_whatever_they_are_called(folder):
    beside = folder.parent / ".sheet.old.tmp"
    beside.mkdir()
    mine = [
        folder / ".a.csv.0123456789abcdef.tmp",
        folder / ".evenbreak.txt",
        beside / "thesis.txt",
    ]
    long_ago = time.time() - 1e6
    for path in (*mine, beside):
        if path != beside:
            path.write_bytes(b"mine")
        os.utime(path, (long_ago, long_ago))
    write_files(folder, NEW)
    assert [path.read_bytes() for path in mine] == [b"mine"] * 3


@pytest.mark.parametrize("name", ["thesis.txt", "new-0", "journal"])
def test_a_folder_that_only_has_the_name_of_ours_is_left_alone(folder, name):
    (folder / WORK).mkdir()
    (folder / WORK / name).write_bytes(b"mine")
    with pytest.raises(OSError, match="isn't from this program"):
        write_files(folder, NEW)
    assert (folder / WORK / name).read_bytes() == b"mine"
    assert (folder / "a.csv").read_bytes() == OLD["a.csv"]


def test_a_file_put_into_our_folder_is_left_alone(folder):
    (folder / WORK).mkdir()
    for name in (MADE_BY_US, "new-0", "thesis.txt"):
        (folder / WORK / name).write_bytes(b"mine")
    with pytest.raises(OSError, match="isn't from this program"):
        write_files(folder, NEW)
    assert sorted(content(folder / WORK)) == [MADE_BY_US, "thesis.txt"]


@posix
def test_a_link_with_the_name_of_our_folder_is_not_followed(folder, tmp_path):
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / MADE_BY_US).write_bytes(b"")
    (tmp_path / "home" / "new-0").write_bytes(b"mine")
    (folder / WORK).symlink_to(tmp_path / "home")
    with pytest.raises(OSError, match="isn't from this program"):
        write_files(folder, NEW)
    assert (tmp_path / "home" / "new-0").read_bytes() == b"mine"


WRITER = """
import sys
from evenbreak.files.store.folder import write_files
print("ready", flush=True)
round = 0
while True:
    round += 1
    body = (b"%d " % round) * 20_000
    write_files(sys.argv[1], {name: body for name in ("a.csv", "b.csv", "c.csv")})
"""


@pytest.mark.slow_after(5)
@posix
@pytest.mark.parametrize("ending", ["SIGKILL", "SIGTERM", "SIGINT"])
@pytest.mark.parametrize("after", [0.0, 0.01, 0.02, 0.035, 0.05])
def test_an_end_at_any_moment_leaves_whole_files(tmp_path, ending, after):
    folder = tmp_path / "sheet"
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(WRITER), str(folder)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as writer:
        assert writer.stdout is not None
        assert writer.stdout.readline() == b"ready\n"
        time.sleep(after)
        writer.send_signal(getattr(signal, ending))
        try:
            writer.wait(timeout=30)
        finally:
            writer.kill()
    check_folder(folder)  # as the next run does
    if not folder.exists():
        return
    assert sorted(path.name for path in folder.iterdir()) == list(NAMES)
    rounds = [set((folder / name).read_bytes().split()) for name in NAMES]
    assert all(len(words) == 1 for words in rounds)
    numbers = [int(words.pop()) for words in rounds]
    assert max(numbers) == min(numbers)


def test_a_folder_is_checked_without_a_trace(tmp_path):
    check_folder(tmp_path)
    check_folder(tmp_path / "new" / "newer")
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "file").write_text("")
    with pytest.raises(NotADirectoryError, match="is a file, so it can't hold a folder"):
        check_folder(tmp_path / "file" / "x" / "y")


@posix
def test_a_link_to_nowhere_is_no_folder(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "nowhere")
    with pytest.raises(NotADirectoryError, match="a link to something that doesn't exist"):
        check_folder(tmp_path / "link")
    assert [path.name for path in tmp_path.iterdir()] == ["link"]


SITE = {"index.html": b"1", "players/ann.html": b"2", "players/bo.html": b"3", "data/a.csv": b"4"}
CHANGED = {**dict.fromkeys(SITE, b"new" * 1000), "players/bo.html": None, "data/b.csv": b"5"}


def whole(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_names_lead_into_folders_and_files_are_removed(tmp_path):
    for there in (tmp_path, tmp_path / "new" / "site"):
        write_files(there, SITE)
        assert {name: whole(there)[name] for name in SITE} == SITE
    write_files(there, {**CHANGED, "gone.html": None})
    assert whole(there) == {name: body for name, body in CHANGED.items() if body is not None}


def test_a_single_file_in_a_folder_is_written_or_removed(folder):
    write_files(folder, {"x/y.csv": b"1"})
    assert whole(folder) == {**OLD, "x/y.csv": b"1"}
    write_files(folder, {"x/y.csv": None})
    assert whole(folder) == OLD


@pytest.mark.parametrize("failing", range(5))
def test_what_cannot_be_changed_leaves_every_file_in_every_folder(tmp_path, monkeypatch, failing):
    write_files(tmp_path, SITE)
    moved, removed, done = Path.replace, Path.unlink, []

    def counted(self, *where, **how):
        if self.name.startswith("new-") or self.name == "bo.html":
            done.append(self)
            if len(done) > failing:
                raise OSError(28, "No space left on device")
        return (moved if where else removed)(self, *where, **how)

    monkeypatch.setattr(Path, "replace", counted)
    monkeypatch.setattr(Path, "unlink", counted)
    with pytest.raises(OSError, match="No space left"):
        write_files(tmp_path, CHANGED)
    monkeypatch.undo()
    check_folder(tmp_path)  # as the next run does
    assert whole(tmp_path) == SITE
