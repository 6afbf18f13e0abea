"""Changing several files of a folder as one: all of them, or none, whatever happens.

As in SQLite's rollback journal, a run makes a folder `.evenbreak-writing` in the one it changes,
and in it

    new-0, new-1 ...   what is to take its place;
    old-0, old-1 ...   what is replaced, by a second link or a copy;
    journal            which is which, written when the rest is safely on disk.

Then each new file is renamed to its place. The change is made when the journal is removed: as long
as there is one, the old files are put back, after a failure at once, after a kill by the next run.
Without one the folder holds all the old files or all the new ones, and what is left of
`.evenbreak-writing` is removed.

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
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypedDict, Union

WORK = ".evenbreak-writing"
"""The folder in which a run prepares its changes."""

MADE_BY_US = "made-by-evenbreak"
"""The file in it without which it is taken as a person's own, and left alone."""

_JOURNAL, _UNFINISHED_JOURNAL = "journal", "journal.part"
_OURS = re.compile(r"(new|old)-\d+|journal(\.part)?", re.ASCII)

Tree = Mapping[str, Union[bytes, "Tree"]]
"""Files by name; a name may also hold a folder."""


class _Change(TypedDict):
    """A line of the journal: a name, the SHA-256 of its new content, and whether it was there."""

    name: str
    sha256: str
    existed: bool


def change(folder: Path, entries: Tree) -> None:
    """Put entries in their places in a folder: all of them, or none.

    A single entry takes its place in one step; only that may be a new folder with its files.
    Nobody else may write into the folder meanwhile (`sole_writer`).

    Raises
    ------
    OSError
        if that is not possible; the folder is then as it was.
    """
    recover(folder)
    work = folder / WORK
    try:
        work.mkdir()
        _write(work / MADE_BY_US, b"")
        for number, content in enumerate(entries.values()):
            _stage(work / f"new-{number}", content)
        if len(entries) == 1:
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
    """Put back what a change that was not finished has replaced, and remove what it left.

    Raises
    ------
    OSError
        if that is not possible, or if `.evenbreak-writing` holds what is not this program's.
    """
    work = folder / WORK
    if not os.path.lexists(work):
        return
    if work.is_dir() and not work.is_symlink():
        found = _names_in(work)
        if MADE_BY_US in found:
            if _JOURNAL in found:
                _put_back(folder)
            _remove(work)
        # Without the mark it was just made, and is empty, or it is not ours.
        with contextlib.suppress(OSError):
            work.rmdir()
    if os.path.lexists(work):
        raise OSError(errno.EEXIST, f"{WORK} in it was not made by this program; move it away")


def _keep_old(folder: Path, entries: Tree) -> list[_Change]:
    """Keep what is to be replaced, and write the journal."""
    work = folder / WORK
    changes: list[_Change] = []
    for number, (name, content) in enumerate(entries.items()):
        place = folder / name
        if place.is_dir() and not place.is_symlink():
            raise IsADirectoryError(errno.EISDIR, f"{name} in it is a folder")
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
        (work / f"new-{number}").replace(folder / change["name"])
    sync(folder)
    (work / _JOURNAL).unlink()
    sync(work)


def _put_back(folder: Path) -> None:
    """Put the old files back where the new ones have taken their places.

    A file that somebody has changed since is left alone.
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
    """Return whether a place holds the new content, or nothing."""
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
    """Force the folder's entries to disk, where the system lets a folder be opened."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
