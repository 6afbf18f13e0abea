"""Writing several files at once: a reader finds either all the old ones or all the new ones.

The folder is created if needed, requests to stop wait until everything is written, and a second run
that wants to write to the folder waits for the first. The operating system holds the lock, which
ends with the process that held it, however that process ended: a lock file left by a killed run
blocks no one.

As in SQLite's rollback journal, a run creates a folder `.evenbreak-writing` in the folder it
changes, containing

    new-0, new-1 ...   the new files;
    old-0, old-1 ...   the files being replaced, as a second link or a copy;
    journal            which is which, written when the rest is safely on disk.

Then each new file is renamed into place. Removing the journal completes the change: as long as
there is a journal, the old files are put back, immediately after a failure, or by the next run
after a kill. Without a journal, the folder holds either all the old files or all the new ones, and
anything left in `.evenbreak-writing` is removed.

Source: SQLite, "Atomic Commit In SQLite", sections 3 and 4.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import json
import os
import re
import shutil
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import FrameType
from typing import Any, TypedDict, Union

PATIENCE = 10.0
"""How many seconds to wait for another run to finish writing."""

_PAUSE = 0.02


def check_folder(folder: str | Path) -> None:
    """Check, before a long computation, that `write_files` can write to a folder.

    Files that a killed run was replacing are put back. Nothing is left behind, and the folder isn't
    created. Raises OSError if no file could be written there.

    >>> check_folder(".")
    """
    _when_alone(Path(folder), lambda there: change(there, {}))


def write_files(folder: str | Path, files: Mapping[str, bytes | None]) -> None:
    """Write files to a folder, creating it if needed: all of them, or none.

    If the run is killed meanwhile, the next run that writes or checks there puts the old files
    back.

    Parameters
    ----------
    files
        each file's content by name, or None to remove the file; they are written in this order. A
        name may include a folder, as in data/a.csv, which is created if needed.

    Raises
    ------
    OSError
        if a file cannot be written; the folder is then as it was.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_files(f"{folder}/sheet", {"a.csv": b"1", "b.csv": b"2"})
    ...     sorted(path.name for path in Path(folder, "sheet").iterdir())
    ['a.csv', 'b.csv']
    """
    folder = Path(folder)

    def write(there: Path) -> None:
        missing = folder.absolute().relative_to(there.absolute()).parts
        entries: Tree = _nested(files) if missing else files
        for name in reversed(missing):
            entries = {name: entries}
        change(there, entries)

    _when_alone(folder, write)


def _nested(files: Mapping[str, bytes | None]) -> Tree:
    """Return files as a tree of folders, for a place where there is nothing to remove yet."""
    tree: dict[str, Any] = {}
    for name, content in files.items():
        *above, last = name.split("/")
        inside = tree
        for part in above:
            inside = inside.setdefault(part, {})
        if content is not None:
            inside[last] = content
    return tree


def _when_alone(folder: Path, write: Callable[[Path], None]) -> None:
    """Write to the folder, or its nearest existing parent, while no one else does.

    A request to stop waits until everything is written, but doesn't wait for another run to finish.
    """
    try:
        if folder.is_symlink() and not folder.exists():
            raise NotADirectoryError(
                errno.ENOTDIR, "a link to something that doesn't exist. Choose another."
            )
        end = time.monotonic() + PATIENCE
        while not _written(folder, write):
            if time.monotonic() > end:
                raise OSError(
                    errno.EBUSY, "another run is writing to it. Try again when that run is done."
                )
            time.sleep(_PAUSE)
    except OSError as error:
        # The system would name a temporary file, which means nothing to a person.
        raise OSError(error.errno, error.strerror, str(folder)) from error


def _written(folder: Path, write: Callable[[Path], None]) -> bool:
    """Write, unless another run is writing or has just created a folder nearer to the target."""
    there = _nearest(folder)
    with undisturbed():
        with sole_writer(there) as alone:
            ready = alone and _nearest(folder) == there
            if ready:
                write(there)
        if ready:
            _tidy_above(folder)
    return ready


def _tidy_above(folder: Path) -> None:
    """Remove what a run killed while creating the folder left above it."""
    for above in folder.absolute().parents:
        with contextlib.suppress(OSError):
            if any(os.path.lexists(above / name) for name in (WORK, LOCK)):
                with sole_writer(above) as alone:
                    if alone:
                        recover(above)


def _nearest(folder: Path) -> Path:
    """Return the folder, or its nearest existing parent."""
    above = next(above for above in (folder, *folder.parents) if above.exists())
    if not above.is_dir():
        what = "that" if above == folder else str(above)
        raise NotADirectoryError(
            errno.ENOTDIR, f"{what} is a file, so it can't hold a folder. Choose another."
        )
    return above


ENDINGS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]
"""The signals that ask a program to stop."""


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Hold back requests to stop until the block is done; only the main thread can do that.

    >>> before = signal.signal(signal.SIGINT, signal.default_int_handler)
    >>> try:
    ...     with undisturbed():
    ...         signal.raise_signal(signal.SIGINT)
    ...         print("done first")
    ... except KeyboardInterrupt:
    ...     print("then interrupted")
    done first
    then interrupted
    >>> _ = signal.signal(signal.SIGINT, before)
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []

    def note(number: int, _: FrameType | None) -> None:
        came.append(number)

    # A mask would not do: a signal may be delivered to any thread, such as those of a BLAS.
    before = [(number, signal.signal(number, note)) for number in ENDINGS]
    try:
        yield
    finally:
        for number, handler in before:
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
        for number in came:
            signal.raise_signal(number)


if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

LOCK = ".evenbreak.lock"
"""The file that a run holds while it writes to a folder, and then removes."""

_HELD = (errno.EAGAIN, errno.EACCES, errno.EDEADLK)
"""The system's error codes for a lock that another process holds."""


@contextlib.contextmanager
def sole_writer(folder: Path) -> Iterator[bool]:
    """Keep other runs from writing to a folder until the block is done; yield False if one is now.

    >>> with sole_writer(Path(".")) as alone, sole_writer(Path(".")) as also:
    ...     alone, also, Path(LOCK).exists()
    (True, False, True)
    >>> Path(LOCK).exists()
    False
    """
    path = folder / LOCK
    handle = _held(path)
    try:
        yield handle is not None
    finally:
        if handle is not None:
            _release(handle, path)


def _held(path: Path) -> int | None:
    """Return the locked lock file's handle, or None while another run has it."""
    handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
    try:
        # The run before may have removed the file between our opening and locking it.
        if _lock(handle) and _is_at(handle, path):
            return handle
    except BaseException:
        os.close(handle)
        raise
    os.close(handle)
    return None


def _lock(handle: int) -> bool:
    try:
        if sys.platform == "win32":
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        # Some network file systems have no locks: there each run takes itself for the only one.
        return error.errno not in _HELD
    return True


def _is_at(handle: int, path: Path) -> bool:
    with contextlib.suppress(FileNotFoundError):
        return os.path.samestat(os.fstat(handle), path.stat())
    return False


def _release(handle: int, path: Path) -> None:
    """Remove the lock file and release the lock; Windows can't remove an open file."""
    try:
        with contextlib.suppress(OSError):
            path.unlink()
    finally:
        with contextlib.suppress(OSError):
            os.close(handle)
    if sys.platform == "win32":
        with contextlib.suppress(OSError):
            path.unlink()


WORK = ".evenbreak-writing"
"""The folder where a run prepares its changes."""

MADE_BY_US = "made-by-evenbreak"
"""The file that marks it; without the mark, the folder is taken to be someone's own and left
alone."""

_JOURNAL, _UNFINISHED_JOURNAL = "journal", "journal.part"
_OURS = re.compile(r"(new|old)-\d+|journal(\.part)?", re.ASCII)

Tree = Mapping[str, Union[bytes, "Tree", None]]
"""Files by name, None for files to remove; a name may also hold a folder."""


class _Change(TypedDict):
    """A line in the journal: a name, the SHA-256 of its new content, and whether it existed."""

    name: str
    sha256: str
    existed: bool


def change(folder: Path, entries: Tree) -> None:
    """Put entries into place in a folder: all of them, or none (OSError).

    A single entry is moved into place in one step; only a single entry may be a new folder with its
    files. No one else may write to the folder meanwhile (`sole_writer`).
    """
    recover(folder)
    work = folder / WORK
    try:
        work.mkdir()
        _write(work / MADE_BY_US, b"")
        for number, content in enumerate(entries.values()):
            if content is not None:
                _stage(work / f"new-{number}", content)
        if len(entries) == 1 and not any("/" in name or entries[name] is None for name in entries):
            sync(work)
            (work / "new-0").replace(folder / next(iter(entries)))
            sync(folder)
        elif entries:
            _put_in_place(folder, _keep_old(folder, entries))
    finally:
        # What cannot be removed or put back now is left to the next run.
        with contextlib.suppress(OSError):
            recover(folder)


def recover(folder: Path) -> None:
    """Put back what an unfinished change has replaced, and remove what it left behind.

    Raises OSError if that's impossible, or if `.evenbreak-writing` holds something else.
    """
    work = folder / WORK
    if not os.path.lexists(work):
        return
    if work.is_dir() and not work.is_symlink():
        names = _names_in(work)
        if MADE_BY_US in names:
            if _JOURNAL in names:
                _put_back(folder)
            _remove(work)
        # Without the mark it was just made, and is empty, or it is not ours.
        with contextlib.suppress(OSError):
            work.rmdir()
    if os.path.lexists(work):
        raise OSError(errno.EEXIST, f"{WORK} in it isn't from this program. Move it elsewhere.")


def _keep_old(folder: Path, entries: Tree) -> list[_Change]:
    """Save what is to be replaced, and write the journal."""
    work = folder / WORK
    changes: list[_Change] = []
    for number, (name, content) in enumerate(entries.items()):
        place = folder / name
        if place.is_dir() and not place.is_symlink():
            raise IsADirectoryError(errno.EISDIR, f"{name} in it is a folder. Move it elsewhere.")
        place.parent.mkdir(parents=True, exist_ok=True)
        existed = os.path.lexists(place)
        if existed:
            _keep(place, work / f"old-{number}")
        digest = hashlib.sha256(content if isinstance(content, bytes) else b"").hexdigest()
        changes.append({"name": name, "sha256": digest, "existed": existed})
    _write(work / _UNFINISHED_JOURNAL, json.dumps(changes, indent=1).encode())
    sync(work)
    sync(folder)
    return changes


def _keep(place: Path, kept: Path) -> None:
    try:
        os.link(place, kept, follow_symlinks=False)
    except (OSError, NotImplementedError):  # as on a memory stick
        if place.is_symlink():
            kept.symlink_to(place.readlink())
        else:
            _write(kept, place.read_bytes())
            shutil.copystat(place, kept)


def _put_in_place(folder: Path, changes: list[_Change]) -> None:
    work = folder / WORK
    (work / _UNFINISHED_JOURNAL).replace(work / _JOURNAL)
    sync(work)
    for number, change in enumerate(changes):
        new, place = work / f"new-{number}", folder / change["name"]
        if new.exists():
            new.replace(place)
        else:
            place.unlink(missing_ok=True)
    for above in {(folder / change["name"]).parent for change in changes}:
        sync(above)
    (work / _JOURNAL).unlink()
    sync(work)


def _put_back(folder: Path) -> None:
    """Put the old files back in place of the new ones.

    A file that someone has changed since then is left alone.
    """
    work = folder / WORK
    changes: list[_Change] = json.loads((work / _JOURNAL).read_bytes())
    for number, change in enumerate(changes):
        place, old = folder / change["name"], work / f"old-{number}"
        if not _is_new(place, change["sha256"]):
            continue
        if not change["existed"]:
            place.unlink(missing_ok=True)
        elif os.path.lexists(old):
            old.replace(place)
    sync(folder)
    (work / _JOURNAL).unlink()
    sync(work)


def _is_new(place: Path, digest: str) -> bool:
    """Return whether a path holds the new content, or nothing."""
    if not os.path.lexists(place):
        return True
    plain = place.is_file() and not place.is_symlink()
    return plain and hashlib.sha256(place.read_bytes()).hexdigest() == digest


def _remove(work: Path) -> None:
    """Remove this program's own files from its folder, the mark last."""
    for name in _names_in(work):
        if not _OURS.fullmatch(name):
            continue
        if (work / name).is_dir() and not (work / name).is_symlink():
            shutil.rmtree(work / name)
        else:
            (work / name).unlink()
    if _names_in(work) == [MADE_BY_US]:
        (work / MADE_BY_US).unlink()


def _names_in(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir()]


def _stage(path: Path, content: bytes | Tree) -> None:
    if isinstance(content, bytes):
        _write(path, content)
        return
    path.mkdir()
    for name, inside in content.items():
        if inside is not None:
            _stage(path / name, inside)
    sync(path)


def _write(path: Path, content: bytes) -> None:
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    handle = os.open(path, flags, 0o666)
    try:
        for piece in _pieces(content):
            written = 0
            while written < len(piece):
                written += os.write(handle, piece[written:])
        os.fsync(handle)
    finally:
        os.close(handle)


def _pieces(content: bytes) -> Iterator[memoryview]:
    view = memoryview(content)
    return (view[start : start + 2**20] for start in range(0, len(view), 2**20))


def sync(folder: Path) -> None:
    """Force the folder's entries to disk, if the system lets a folder be opened."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
