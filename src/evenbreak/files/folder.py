"""Writing several files at once: a reader finds all the old ones or all the new ones.

All files are written under temporary names and forced to disk before any takes its place. A
new folder takes its place with all its files in one step (POSIX rename). In an existing folder
each file takes its place in one step, one after the other within a fraction of a millisecond,
and requests to end are held back meanwhile. Only an end that cannot be held back (SIGKILL, a
power cut) at that very moment leaves a mixture: whole files, some old and some new.
"""

from __future__ import annotations

import contextlib
import errno
import glob
import os
import secrets
import shutil
import signal
import threading
import time
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import FrameType

LITTER_AGE = 3600.0
"""Seconds after which a temporary file is taken as a leftover from a killed run."""

ENDINGS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]


def check_folder(folder: str | Path) -> None:
    """Check, before a long computation, that `write_files` can write into a folder.

    Leaves nothing behind, and does not create the folder.

    Raises
    ------
    OSError
        if no file could be written there.

    >>> check_folder(".")
    """
    folder = Path(folder)
    try:
        if folder.is_symlink() and not folder.exists():
            raise NotADirectoryError(
                errno.ENOTDIR, "a link to something that does not exist; name another"
            )
        there = folder if folder.exists() else _folder_above(folder)
        probe = _temporary(there / "probe")
        try:
            _write(probe, b"")
        finally:
            probe.unlink(missing_ok=True)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(folder)) from error


def _folder_above(folder: Path) -> Path:
    """Return the nearest folder above that exists."""
    above = next(above for above in folder.parents if above.exists())
    if not above.is_dir():
        raise NotADirectoryError(
            errno.ENOTDIR, f"{above} is a file, so no folder can be in it; name another"
        )
    return above


def write_files(folder: str | Path, files: Mapping[str, bytes]) -> None:
    """Write files into a folder, which is created if needed: all of them, or none.

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
    try:
        if folder.exists():
            _write_into(folder, files)
        else:
            _write_new(folder, files)
    except OSError as error:
        # The system would name a temporary file, which means nothing to a person.
        raise OSError(error.errno, error.strerror, str(folder)) from error
    _sync(folder)
    _sweep(folder, files)
    _sweep(folder.parent, [folder.name])


def _write_new(folder: Path, files: Mapping[str, bytes]) -> None:
    _folder_above(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    staged = _temporary(folder)
    try:
        staged.mkdir()
        for name, content in files.items():
            _write(staged / name, content)
        _sync(staged)
        staged.rename(folder)
    finally:
        shutil.rmtree(staged, ignore_errors=True)
    _sync(folder.parent)


def _write_into(folder: Path, files: Mapping[str, bytes]) -> None:
    staged: dict[Path, Path] = {}
    try:
        for name, content in files.items():
            place = folder / name
            if place.is_dir():
                raise IsADirectoryError(errno.EISDIR, f"{name} in it is a folder")
            temporary = _temporary(place)
            staged[temporary] = place
            _write(temporary, content)
        with _undisturbed():
            for temporary, place in staged.items():
                temporary.replace(place)
    finally:
        for temporary in staged:
            temporary.unlink(missing_ok=True)


def _temporary(place: Path) -> Path:
    return place.with_name(f".{place.name}.{secrets.token_hex(8)}.tmp")


def _write(path: Path, content: bytes) -> None:
    with path.open("xb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())


@contextlib.contextmanager
def _undisturbed() -> Iterator[None]:
    """Hold back requests to end until the block is done; only the main thread can do that."""
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


def _sync(folder: Path) -> None:
    """Force the folder's new entries to disk, where the system lets a folder be opened."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _sweep(folder: Path, names: Iterable[str]) -> None:
    """Remove temporary files that killed runs left behind, but none that may be in use."""
    for name in names:
        for path in folder.glob(f".{glob.escape(name)}.*.tmp"):
            with contextlib.suppress(OSError):
                if time.time() - path.stat().st_mtime < LITTER_AGE:
                    continue
                if path.is_dir():
                    shutil.rmtree(path)
                else:
                    path.unlink()
