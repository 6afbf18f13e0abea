"""Score sheets with a row for each player of a match, as they are typed from paper."""

from __future__ import annotations

import csv
import re
from collections import defaultdict

from evenbreak.files.tables.rows import Export, Sheet, head_of, text_of
from evenbreak.files.tables.titles import PLAYERS, key_of

_MATCH = {"match", "matchnumber", "matchno", "matchid", "set", "begegnung", "rencontre"}
_DAY = {"date", "day", "matchdate", "week", "round", "datum", "fecha", "data", "division"}
_MAY_BE = re.compile(rb"(?i)match|begegnung|rencontre|set")


def paper_sheet(content: bytes, source: str) -> Export | None:
    r"""Return the matches of a table with two rows each, the first row's player as player a.

    The rows of a match have the same number, on the same day; a number that is only in the first
    row counts for the second too. None where a file is not so.

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
