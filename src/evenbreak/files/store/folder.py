"""Writing several files at once: a reader finds all the old ones or all the new ones.

`evenbreak.files.store.transaction` says how. Here a folder is found or made, requests to end wait
until all is written, and a second run that would write into the folder waits for the first. Its
lock is the operating system's and ends with the process that held it, however that ended: a lock
file left by a killed run blocks nobody.
"""

from __future__ import annotations

import contextlib
import errno
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import FrameType

from evenbreak.files.store.transaction import WORK, Tree, change, recover

PATIENCE = 10.0
"""Seconds to wait for another run to finish writing."""

_PAUSE = 0.02


def check_folder(folder: str | Path) -> None:
    """Check, before a long computation, that `write_files` can write into a folder.

    Files that a killed run had begun to replace are put back. Nothing is left behind, and the
    folder is not created.

    Raises
    ------
    OSError
        if no file could be written there.

    >>> check_folder(".")
    """
    _when_alone(Path(folder), lambda there: change(there, {}))


def write_files(folder: str | Path, files: Mapping[str, bytes]) -> None:
    """Write files into a folder, which is created if needed: all of them, or none.

    If the run is killed meanwhile, the next one that writes or checks there puts the old files
    back.

    Parameters
    ----------
    folder
        where to write.
    files
        the content of each file by name; they take their places in this order.

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
        entries: Tree = files
        for name in reversed(folder.absolute().relative_to(there.absolute()).parts):
            entries = {name: entries}
        change(there, entries)

    _when_alone(folder, write)


def _when_alone(folder: Path, write: Callable[[Path], None]) -> None:
    """Write into the folder, or the nearest one above it that exists, when nobody else does.

    A request to end waits until all is written, but not until another run has finished.
    """
    try:
        if folder.is_symlink() and not folder.exists():
            raise NotADirectoryError(
                errno.ENOTDIR, "a link to something that does not exist; name another"
            )
        end = time.monotonic() + PATIENCE
        while not _written(folder, write):
            if time.monotonic() > end:
                raise OSError(
                    errno.EBUSY, "another run is writing into it; try again when it is done"
                )
            time.sleep(_PAUSE)
    except OSError as error:
        # The system would name a temporary file, which means nothing to a person.
        raise OSError(error.errno, error.strerror, str(folder)) from error


def _written(folder: Path, write: Callable[[Path], None]) -> bool:
    """Write, unless another run does, or has just made a folder nearer to the one that is meant."""
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
    """Remove what a killed run left above the folder when it was about to make it."""
    for above in folder.absolute().parents:
        with contextlib.suppress(OSError):
            if any(os.path.lexists(above / name) for name in (WORK, LOCK)):
                with sole_writer(above) as alone:
                    if alone:
                        recover(above)


def _nearest(folder: Path) -> Path:
    """Return the folder, or the nearest one above it that exists."""
    above = next(above for above in (folder, *folder.parents) if above.exists())
    if not above.is_dir():
        what = "that" if above == folder else str(above)
        raise NotADirectoryError(
            errno.ENOTDIR, f"{what} is a file, so no folder can be in it; name another"
        )
    return above


ENDINGS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]
"""The signals by which a program is asked to end."""


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Hold back requests to end until the block is done; only the main thread can do that.

    >>> try:
    ...     with undisturbed():
    ...         signal.raise_signal(signal.SIGINT)
    ...         print("done first")
    ... except KeyboardInterrupt:
    ...     print("then interrupted")
    done first
    then interrupted
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
"""The file that a run holds while it writes into a folder, and then removes."""

_HELD = (errno.EAGAIN, errno.EACCES, errno.EDEADLK)
"""What the system says of a lock that another process holds."""


@contextlib.contextmanager
def sole_writer(folder: Path) -> Iterator[bool]:
    """Let no other run write into a folder until the block is done; yield False if one does now.

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
    """Return the handle of the lock file, locked, or None while another run has it."""
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
    """Remove the lock file and give up the lock; an open file cannot be removed on Windows."""
    try:
        with contextlib.suppress(OSError):
            path.unlink()
    finally:
        with contextlib.suppress(OSError):
            os.close(handle)
    if sys.platform == "win32":
        with contextlib.suppress(OSError):
            path.unlink()
