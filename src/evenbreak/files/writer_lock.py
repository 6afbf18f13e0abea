"""One writer to a folder at a time.

The lock is the operating system's, so it ends with the process that held it, however that ended;
a lock file left by a killed run blocks nobody.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

LOCK = ".evenbreak.lock"
"""The file that a run holds while it writes into a folder, and then removes."""

PATIENCE = 10.0
"""Seconds to wait for another run to finish writing."""

_PAUSE = 0.02
_HELD = (errno.EAGAIN, errno.EACCES, errno.EDEADLK)
"""What the system says of a lock that another process holds."""


@contextlib.contextmanager
def sole_writer(folder: Path, *, patience: float | None = None) -> Iterator[None]:
    """Let no other run write into a folder until the block is done; wait for one that does.

    Parameters
    ----------
    folder
        where to write.
    patience
        seconds to wait; None: `PATIENCE`.

    Raises
    ------
    OSError
        if another run is still writing then.

    >>> with sole_writer(Path(".")):
    ...     Path(LOCK).exists()
    True
    >>> Path(LOCK).exists()
    False
    """
    path = folder / LOCK
    end = time.monotonic() + (PATIENCE if patience is None else patience)
    while (handle := _held(path)) is None:
        if time.monotonic() > end:
            raise OSError(errno.EBUSY, "another run is writing into it; try again when it is done")
        time.sleep(_PAUSE)
    try:
        yield
    finally:
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
