"""Tournaments saved from other programs as JSON, known by their content, as rows of results.

CueScore's tournaments, Challonge's (version 1 of its interface) and those of brackets-manager.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Mapping

from evenbreak.errors import DataError
from evenbreak.files.foreign import brackets_manager, challonge, cuescore
from evenbreak.files.foreign.saved import (
    MISSHAPEN,
    TITLES,
    ExportError,
    Remark,
    SavedTournament,
    misshapen,
)
from evenbreak.files.tables.problems import refusal, warning
from evenbreak.files.tables.rows import Export, Sheet, text_of
from evenbreak.words import joined, say, say_count

PROGRAMS = "CueScore, Challonge or brackets-manager"

_JSON = re.compile(rb'(?:\xef\xbb\xbf)?\s*(?:\{\s*["}]|\[\s*[\[{\]])')


def saved_in(content: bytes, source: str) -> tuple[SavedTournament, list[str]] | None:
    """Return the tournament in another program's file, with warnings; None where there is none.

    Raises
    ------
    DataError
        if a file is JSON, but damaged or of no known program.
    """
    if not _JSON.match(content) and not _is_utf16_json(content):
        return None
    text = text_of(content, source)
    try:
        data = json.loads(text.read())
    except (ValueError, RecursionError) as error:
        damage = say("is damaged JSON from here on; save it again in the other program")
        raise refusal(source, damage, getattr(error, "lineno", 1)) from None
    for program in (cuescore, challonge, brackets_manager):
        if not program.is_one(data):
            continue
        try:
            return program.tournament(data), text.warnings
        except ExportError as error:
            raise refusal(source, error.sentence) from None
        except MISSHAPEN:
            raise refusal(source, misshapen()) from None
    raise refusal(source, "is JSON, but not a tournament saved from {programs}", programs=PROGRAMS)


def export_of(content: bytes, source: str) -> Export | None:
    """Return the matches of another program's file; None where a file is none.

    Raises
    ------
    DataError
        as `saved_in` does, or if the file has no match that was played, or matches that
        contradict themselves.
    """
    parsed = saved_in(content, source)
    if parsed is None:
        return None
    saved, warnings = parsed
    problems = [
        warning(source, number, match_problem(number, match.problem))
        for number, match in enumerate(saved.matches, 1)
        if match.problem
    ]
    if problems:
        raise DataError(problems)
    played = [
        (number, part) for number, match in enumerate(saved.matches, 1) for part in match.played
    ]
    left_out = Counter(match.left_out for match in saved.matches if match.left_out)
    remarks = Counter(remark for _, part in played for remark in part.remarks)
    noted = _counted(left_out, remarks)
    if not played:
        raise refusal(source, "has no match that was played{noted}", noted=noted)
    rows = [list(TITLES), *(part.row() for _, part in played)]
    if noted:
        read = say_count(
            "read {n} match{noted}", "read {n:,} matches{noted}", len(played), noted=noted
        )
        warnings = [*warnings, warning(source, None, read)]
    return Export(Sheet(source, [0, *(number for number, _ in played)], rows), warnings)


def match_problem(number: int, problem: str) -> str:
    """Return what is wrong with the match that has a number in its file."""
    return say("match {number} {problem}", number=number, problem=problem)


def _is_utf16_json(content: bytes) -> bool:
    return content[:4] in (b"\xff\xfe{\0", b"\xff\xfe[\0", b"\xfe\xff\0{", b"\xfe\xff\0[")


def _counted(left_out: Mapping[Remark, int], remarks: Mapping[Remark, int]) -> str:
    """Return in words what was left out and what was changed, or nothing."""
    left = [remark.counted(left_out[remark]) for remark in Remark if remark in left_out]
    parts: list[str] = [say("left out: {matches}", matches=joined(left, ", "))] if left else []
    parts += [remark.counted(remarks[remark]) for remark in Remark if remark in remarks]
    return joined([say("; {part}", part=part) for part in parts], "")
