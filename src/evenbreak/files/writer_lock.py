"""One writer to a folder at a time.

The lock is the operating system's, so it ends with the process that held it, however that ended;
a lock file left by a killed run blocks nobody.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Iterator
from pathlib import Path

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
