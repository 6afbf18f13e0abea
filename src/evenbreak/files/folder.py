"""Writing several files at once: a reader finds all the old ones or all the new ones.

`evenbreak.files.transaction` says how; here a folder is found or made, and a second run that
would write into it waits for the first.
"""

from __future__ import annotations

import contextlib
import errno
import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path

from evenbreak.files.transaction import WORK, Tree, change, recover
from evenbreak.files.undisturbed import undisturbed
from evenbreak.files.writer_lock import LOCK, sole_writer

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
