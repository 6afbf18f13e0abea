"""All or nothing, shown as SQLite shows it: each system call fails in turn, or is the last one."""

import errno
import os
import re
import shutil
import signal
import subprocess
import sys
from itertools import count
from pathlib import Path

import pytest

from evenbreak.files.store.folder import LOCK, WORK, check_folder, write_files
from rows import posix

CALLS = (
    *("open", "write", "fsync", "close", "mkdir", "rmdir", "unlink", "replace", "link", "listdir"),
    *("stat", "lstat", "scandir", "readlink"),
)
OLD = {"a.csv": b"old a", "b.csv": b"old b", "mine.txt": b"mine"}
NEW = {"a.csv": b"new a", "b.csv": b"new b", "c.csv": b"new c"}
DONE = OLD | NEW


def content(folder: Path, *, visible: bool = False) -> dict[str, bytes] | None:
    """Return the files of a folder, None if there is none; nothing else may be in or beside it."""
    paths = [*folder.parent.iterdir(), *(folder.iterdir() if folder.exists() else ())]
    if visible:
        paths = [path for path in paths if path.name not in (WORK, LOCK)]
    files = {path.name: path.read_bytes() for path in paths if path != folder}
    assert all(path.parent == folder for path in paths if path != folder)
    return files if folder.exists() else None


@pytest.fixture(params=["existing", "new"])
def case(request, tmp_path):
    """Yield a folder in a state, what it holds then, and what it is to hold, again and again."""

    def states():
        for number in count():
            folder = tmp_path / str(number) / "sheet"
            folder.parent.mkdir()
            if request.param == "existing":
                folder.mkdir()
                for name, text in OLD.items():
                    (folder / name).write_bytes(text)
                yield folder, OLD, DONE
            else:
                yield folder, None, NEW

    return states()


class Faulty:
    """The calls of `os`, of which the n-th does as `fault` says: raise, before or after, or end."""

    def __init__(self, monkeypatch, nth: int, fault: str) -> None:
        self.nth, self.fault, self.made = nth, fault, 0
        self.hits: list[object] = []
        monkeypatch.setattr(os, "fsync", lambda _: None)  # the calls count; the disk takes long
        for name in CALLS:
            monkeypatch.setattr(os, name, self.wrapped(name, getattr(os, name)))

    def wrapped(self, name, call):
        def made(*args, **options):
            self.made += 1
            hit = self.made >= self.nth if self.fault == "from then on" else self.made == self.nth
            if not hit:
                return call(*args, **options)
            self.hits.append((name, args))
            if self.fault == "kill":
                os._exit(9)
            if self.fault == "after" or name == "close":  # a failed close has closed, too
                call(*args, **options)
            if self.fault == "interrupt":
                raise KeyboardInterrupt
            raise OSError(errno.EIO, "Input/output error")

        return made


@pytest.mark.slow
@pytest.mark.parametrize("fault", ["once", "after", "from then on", "interrupt"])
def test_each_call_fails_in_turn(case, fault):
    for nth in count(1):
        folder, old, new = next(case)
        failed = False
        with pytest.MonkeyPatch.context() as patch:
            faulty = Faulty(patch, nth, fault)
            try:
                write_files(folder, NEW)
            except (OSError, KeyboardInterrupt):
                failed = True
        if fault == "once":  # at once; only what is our own may be left to the next run
            assert content(folder, visible=True) == (old if failed else new), faulty.hits
        check_folder(folder)
        after = content(folder)
        assert after == new or (failed and after == old), faulty.hits
        if faulty.made < nth:
            break
    assert nth > 20


@pytest.mark.slow
@posix
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_each_call_is_the_last_of_a_killed_run(case):
    for nth in count(1):
        folder, old, new = next(case)
        child = os.fork()
        if not child:
            with pytest.MonkeyPatch.context() as patch:
                Faulty(patch, nth, "kill")
                write_files(folder, NEW)
            os._exit(0)
        done = os.waitpid(child, 0)[1] == 0
        check_folder(folder)
        assert content(folder) == new if done else content(folder) in (old, new)
        if done:
            break
    assert nth > 20


@pytest.mark.slow
@posix
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_each_call_of_the_recovery_may_be_the_last_one_too(tmp_path):
    torn = tmp_path / "torn" / "sheet"
    write_files(torn, OLD)
    child = os.fork()
    if not child:
        replace, made = os.replace, []

        def third(*args):
            made.append(args)
            if len(made) == 3:  # the journal, a.csv, and not b.csv
                os._exit(9)
            return replace(*args)

        os.replace = third
        write_files(torn, NEW)
    os.waitpid(child, 0)
    assert [(torn / name).read_bytes() for name in ("a.csv", "b.csv")] == [b"new a", OLD["b.csv"]]
    for nth in count(1):
        folder = tmp_path / str(nth) / "sheet"
        shutil.copytree(torn.parent, folder.parent)
        child = os.fork()
        if not child:
            with pytest.MonkeyPatch.context() as patch:
                Faulty(patch, nth, "kill")
                check_folder(folder)
            os._exit(0)
        done = os.waitpid(child, 0)[1] == 0
        check_folder(folder)
        assert content(folder) == OLD
        if done:
            break
    assert nth > 10


@pytest.fixture
def torn(tmp_path, monkeypatch):
    """Return a folder in which a.csv is new and b.csv is not, and nothing could be put back."""
    folder = tmp_path / "sheet"
    write_files(folder, OLD)
    replace, made = os.replace, []

    def no_more(*args):
        made.append(args)
        if len(made) > 2:
            raise OSError(errno.EIO, "Input/output error")
        replace(*args)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", no_more)
        with pytest.raises(OSError, match="Input/output"):
            write_files(folder, NEW)
    assert [(folder / name).read_bytes() for name in ("a.csv", "b.csv")] == [b"new a", OLD["b.csv"]]
    return folder


def test_the_next_run_puts_the_old_files_back(torn):
    check_folder(torn)
    assert content(torn) == OLD


def test_what_somebody_has_changed_since_is_not_put_back(torn):
    (torn / "a.csv").write_bytes(b"mended by hand")
    (torn / "c.csv").write_bytes(b"made by hand")
    check_folder(torn)
    assert content(torn) == {**OLD, "a.csv": b"mended by hand", "c.csv": b"made by hand"}


@pytest.mark.slow
def test_where_there_are_no_hard_links_the_old_are_copied(case, monkeypatch):
    def no_links(*_, **__):
        raise OSError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(os, "link", no_links)
    test_each_call_fails_in_turn(case, "once")


@posix
def test_a_link_is_put_back_as_a_link(torn):
    check_folder(torn)
    (torn / "b.csv").unlink()
    (torn / "b.csv").symlink_to("mine.txt")
    with pytest.MonkeyPatch.context() as patch:
        replace, made = os.replace, []

        def fail_at_c(*args):
            made.append(args)
            if len(made) == 4:
                raise OSError(errno.EIO, "Input/output error")
            replace(*args)

        patch.setattr(os, "replace", fail_at_c)
        with pytest.raises(OSError, match="Input/output"):
            write_files(torn, NEW)
    assert (torn / "b.csv").readlink() == Path("mine.txt")
    assert (torn / "mine.txt").read_bytes() == b"mine"


@pytest.mark.slow
@posix
@pytest.mark.skipif(not shutil.which("strace"), reason="strace is not installed")
@pytest.mark.parametrize("injected", ["error=EIO", "signal=KILL"])
def test_the_systems_own_calls_fail_in_turn(tmp_path, injected):
    script = "import sys; from evenbreak.files.store.folder import write_files\n"
    script += f"write_files(sys.argv[1], {NEW!r})"
    for nth in count(1):
        folder = tmp_path / str(nth) / "sheet"
        write_files(folder, OLD)
        inject = f"inject=rename,renameat,renameat2:{injected}:when={nth}"
        command = ["strace", "-f", "-o", str(tmp_path / "trace"), "-e", inject]
        done = subprocess.run(
            [*command, sys.executable, "-c", script, str(folder)], capture_output=True, text=True
        )
        if re.search("ptrace|PTRACE", done.stderr):
            pytest.skip("processes may not be traced here")
        if done.returncode == 0:
            break
        assert injected == "signal=KILL" or content(folder) == OLD
        assert done.returncode != -signal.SIGKILL or injected == "signal=KILL"
        check_folder(folder)
        assert content(folder) == OLD
    assert nth == 5  # the journal and the three files fail
    assert content(folder) == DONE
