"""Tournaments saved as JSON by other programs, recognized by content, as rows of results.

The programs are CueScore, Challonge (version 1 of its API) and brackets-manager.
"""

from __future__ import annotations

import csv
import json
import re
from collections import Counter, defaultdict
from collections.abc import Mapping
from typing import Any

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
from evenbreak.files.tables.rows import Export, Sheet, head_of, text_of
from evenbreak.files.tables.titles import PLAYERS, key_of
from evenbreak.words import joined, say, say_count

PROGRAMS = "CueScore, Challonge or brackets-manager"

_FEWEST_TITLES = 3
_PROGRAMS = (cuescore, challonge, brackets_manager)
_JSON = re.compile(rb'(?:\xef\xbb\xbf)?\s*(?:\{\s*["}]|\[\s*[\[{\]])')


def saved_in(content: bytes, source: str) -> tuple[SavedTournament, list[str]] | None:
    """Return the tournament in another program's file, with warnings; None if it has none.

    Raises DataError if the file is JSON, but damaged or from an unknown program.
    """
    parsed = _json_in(content, source)
    if parsed is None:
        return None
    data, warnings = parsed
    for program in _PROGRAMS:
        if not program.is_one(data):
            continue
        try:
            return program.tournament(data), warnings
        except ExportError as error:
            raise refusal(source, error.sentence) from None
        except MISSHAPEN:
            raise refusal(source, misshapen()) from None
    raise refusal(source, "is JSON, but not a tournament saved from {programs}", programs=PROGRAMS)


def _json_in(content: bytes, source: str) -> tuple[Any, list[str]] | None:
    """Return a JSON file's content, with warnings; None if the file isn't JSON."""
    if not _JSON.match(content) and not _is_utf16_json(content):
        return None
    text = text_of(content, source)
    try:
        return json.loads(text.read()), text.warnings
    except (ValueError, RecursionError) as error:
        damage = say("is damaged JSON from here on. Save it again in the other program.")
        raise refusal(source, damage, getattr(error, "lineno", 1)) from None


def _records(data: Any) -> list[list[str]]:
    """Return a list of records as titles and rows; nothing if it isn't a list of records.

    A record is a JSON object of strings and numbers; a nested object counts as its name.

    >>> _records({"matches": [{"home": {"id": 7, "name": "Ann"}, "homeScore": 7}, {"away": "Bo"}]})
    [['home', 'homeScore', 'away'], ['Ann', '7', ''], ['', '', 'Bo']]
    """
    lists = [data] if isinstance(data, list) else []
    if isinstance(data, Mapping):
        lists = [one for one in data.values() if isinstance(one, list) and one]
    if len(lists) != 1 or not all(isinstance(one, Mapping) for one in lists[0]):
        return []
    records = [{str(key): _cell(value) for key, value in one.items()} for one in lists[0]]
    titles = list(dict.fromkeys(title for record in records for title in record))
    if len(titles) < _FEWEST_TITLES:
        return []
    return [titles, *([record.get(title, "") for title in titles] for record in records)]


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Mapping):
        return _cell(value.get("name"))
    return "" if value is None or isinstance(value, list) else str(value)


def export_of(content: bytes, source: str) -> Export | None:
    """Return the matches in another program's file; None if it isn't such a file.

    Raises DataError as for `saved_in`, or if no match was played or matches contradict each other.
    """
    json_data = _json_in(content, source)
    if json_data is None:
        return paper_sheet(content, source)
    if not any(program.is_one(json_data[0]) for program in _PROGRAMS):
        rows = _records(json_data[0])
        if rows:
            return Export(Sheet(source, list(range(len(rows))), rows), json_data[1])
    saved, warnings = saved_in(content, source) or (SavedTournament(()), [])
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
        raise refusal(source, "has no matches that were played{noted}", noted=noted)
    rows = [list(TITLES), *(part.row() for _, part in played)]
    if noted:
        read = say_count(
            "read {n} match{noted}", "read {n:,} matches{noted}", len(played), noted=noted
        )
        warnings = [*warnings, warning(source, None, read)]
    return Export(Sheet(source, [0, *(number for number, _ in played)], rows), warnings)


def match_problem(number: int, problem: str) -> str:
    """Return a problem with a match, identified by its number in the file."""
    return say("match {number} {problem}", number=number, problem=problem)


def _is_utf16_json(content: bytes) -> bool:
    return content[:4] in (b"\xff\xfe{\0", b"\xff\xfe[\0", b"\xfe\xff\0{", b"\xfe\xff\0[")


def _counted(left_out: Mapping[Remark, int], remarks: Mapping[Remark, int]) -> str:
    """Return what was left out and what was changed, in words, or nothing."""
    left = [remark.counted(left_out[remark]) for remark in Remark if remark in left_out]
    parts: list[str] = [say("left out: {matches}", matches=joined(left, ", "))] if left else []
    parts += [remark.counted(remarks[remark]) for remark in Remark if remark in remarks]
    return joined([say("; {part}", part=part) for part in parts], "")


_MATCH = {"match", "matchnumber", "matchno", "matchid", "set", "begegnung", "rencontre"}
_DAY = {"date", "day", "matchdate", "week", "round", "datum", "fecha", "data", "division"}
_MAY_BE = re.compile(rb"(?i)match|begegnung|rencontre|set")


def paper_sheet(content: bytes, source: str) -> Export | None:
    r"""Return the matches in a table with two rows per match; the first row is player a.

    A match's two rows have the same number and the same day; a number that is only in the first row
    counts for the second too. None if the file isn't laid out like that.

    >>> text = "Match,Team,Player,GTW,Wins\n1,Caps,Ann,5,5\n1,Aces,Bo,3,2\n"
    >>> for row in paper_sheet(text.encode(), "sheet.csv").sheet.rows:
    ...     print(",".join(row))
    Match,Team A,Player A,GTW A,Wins A,Team B,Player B,GTW B,Wins B
    1,Caps,Ann,5,5,Aces,Bo,3,2
    """
    if not _MAY_BE.search(head_of(content).partition(b"\n")[0]):
        return None
    text = text_of(content, source)
    lines = text.read().splitlines()
    separator = max(",;\t", key=lines[0].count)
    try:
        titles, *rows = csv.reader(lines, delimiter=separator)
    except csv.Error:  # for the reader of all tables to say
        return None
    keys = [*map(key_of, titles)]
    number = next((k for k, key in enumerate(keys) if key in _MATCH), None)
    if number is None or sum(key in PLAYERS for key in keys) != 1 or len({*keys}) < len(keys):
        return None
    days = [k for k, key in enumerate(keys) if key in _DAY]
    rows = [row for row in rows if "".join(row).strip()]
    if any(len(row) != len(titles) for row in rows):
        return None
    matches = defaultdict(list)
    last = [""] * len(titles)
    for line, row in enumerate(rows, 2):
        filled = [
            cell.strip() or (last[k] if k == number or k in days else "")
            for k, cell in enumerate(row)
        ]
        matches[tuple(filled[k] for k in (number, *days))].append((line, filled))
        last = filled
    if not matches or any(len(both) != 2 for both in matches.values()):
        return None
    shared = [number, *days]
    own = [k for k in range(len(titles)) if k not in shared]
    made = [[titles[k] for k in shared] + [f"{titles[k]} {side}" for side in "AB" for k in own]]
    for (_, one), (_, other) in matches.values():
        made.append([one[k] for k in shared] + [row[k] for row in (one, other) for k in own])
    return Export(
        Sheet(source, [1, *(both[0][0] for both in matches.values())], made), text.warnings
    )
