"""Tournaments saved from other programs as JSON, known by their content, as rows of results.

CueScore's tournaments, Challonge's (version 1 of its interface) and those of brackets-manager.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Mapping
from typing import Any

from evenbreak.errors import DataError
from evenbreak.files.foreign import brackets_manager as export_brackets_manager
from evenbreak.files.foreign import challonge as export_challonge
from evenbreak.files.foreign import cuescore as export_cuescore
from evenbreak.files.foreign.match import (
    BYE,
    NO_SCORE,
    TITLES,
    UNFINISHED,
    ExportError,
    Found,
    Match,
    Remark,
)
from evenbreak.files.tables.rows import Export, Sheet, text_of

PROGRAMS = "CueScore, Challonge or brackets-manager"

_JSON = re.compile(rb'(?:\xef\xbb\xbf)?\s*(?:\{\s*["}]|\[\s*[\[{\]])')


def export_of(content: bytes, source: str) -> Export | None:
    """Return the matches of another program's file; None where a file is none.

    Raises
    ------
    DataError
        if a file is JSON, but damaged or of no known program, or holds matches that
        contradict themselves.
    """
    if not _JSON.match(content) and not _is_utf16_json(content):
        return None
    body, encoding, warnings = text_of(content, source)
    try:
        data = json.loads(body.decode(encoding))
    except (ValueError, RecursionError) as error:
        line = getattr(error, "lineno", 1)
        raise DataError(
            [f"{source}:{line}: is damaged JSON from here on; save it again in the other program"]
        ) from None
    found = _found(data, source)
    played = [(number, one) for number, one in found if isinstance(one, Match)]
    noted = _counted(found)
    if not played:
        raise DataError([f"{source}: has no match that was played{noted}"])
    rows = [list(TITLES), *(one.row() for _, one in played)]
    if noted:
        read = "1 match" if len(played) == 1 else f"{len(played):,} matches"
        warnings = [*warnings, f"{source}: read {read}{noted}"]
    return Export(Sheet(source, [0, *(number for number, _ in played)], rows), warnings)


def _found(data: Any, source: str) -> list[tuple[int, Found]]:
    """Return what each match is, with its number from 1; one in sets is several."""
    readers = (export_cuescore, export_challonge, export_brackets_manager)
    read = next((one.matches for one in readers if one.is_one(data)), None)
    if read is None:
        raise DataError([f"{source}: is JSON, but not a tournament saved from {PROGRAMS}"])
    problems: list[str] = []
    found: list[tuple[int, Found]] = []
    try:
        for number, match in enumerate(read(data), 1):
            try:
                found += [(number, one) for one in match()]
            except ExportError as error:
                problems.append(f"{source}:{number}: match {number} {error}")
    except ExportError as error:
        raise DataError([f"{source}: {error}"]) from None
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError):
        raise DataError(
            [f"{source}: is not built as expected; save it again in the other program"]
        ) from None
    if problems:
        raise DataError(problems)
    return found


def _is_utf16_json(content: bytes) -> bool:
    return content[:4] in (b"\xff\xfe{\0", b"\xff\xfe[\0", b"\xfe\xff\0{", b"\xfe\xff\0[")


def _counted(found: list[tuple[int, Found]]) -> str:
    """Return in words what was left out and what was changed, or nothing."""
    counts = Counter(one for _, one in found if not isinstance(one, Match))
    remarks = Counter(
        one for _, match in found if isinstance(match, Match) for one in match.remarks
    )
    left = [_words(counts, why) for why in (BYE, UNFINISHED, NO_SCORE) if counts[why]]
    parts = [f"left out: {', '.join(left)}"] if left else []
    parts += [_words(remarks, remark) for remark in sorted(remarks)]
    return "".join(f"; {part}" for part in parts)


def _words(counts: Mapping[Remark, int], remark: Remark) -> str:
    one, several = remark
    return f"{counts[remark]:,} {one if counts[remark] == 1 else several}"
