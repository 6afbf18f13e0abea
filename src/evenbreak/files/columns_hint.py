"""Which columns of a results file probably are the ones that a reader does not find.

It is a guess from the cells, made only for a message: the option --columns to paste.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from itertools import combinations

from evenbreak.matches.formats import BETWEEN

_SCORE = re.compile(rf"\d{{1,3}}\s*{BETWEEN}\s*\d{{1,3}}", re.ASCII)
_COUNT = re.compile(r"\d{1,3}", re.ASCII)
_DATE = re.compile(r"\d{1,4}([-/.])\d{1,2}\1\d{1,4}( .*|T.*)?", re.ASCII)

Column = tuple[str, list[str]]


def columns_hint(
    known: Collection[str], titles: Sequence[str], rows: Sequence[Sequence[str]]
) -> str:
    """Return what to do about missing columns of players and scores.

    Parameters
    ----------
    known
        the columns that the file has by names that are known.
    titles
        the other titles.
    rows
        the cells below them, row by row.

    >>> print(columns_hint((), ["Heim", "Gast", "S"], [["Ann", "Bo", "7-5"]]))
    if it has them by other names, add --columns "player_a=Heim,player_b=Gast,score=S"
    """
    columns = [
        (title, [text for row in rows if (text := "".join(row[place : place + 1]).strip())])
        for place, title in enumerate(titles)
        if title.strip() and titles.count(title) == 1
    ]
    found: dict[str, str] = {}
    if not ({"player_a", "player_b"} <= set(known) or {"winner", "loser"} <= set(known)):
        found |= _players(_of_kind(columns, _is_name), known)
    if not {*known} & {"score", "racks"} and not {"score_a", "score_b"} <= set(known):
        found |= _scores(columns, known)
    days = _of_kind(columns, _DATE.fullmatch)
    if days and "date" not in known:
        found["date"] = days[0][0]
    if not found or len(found) == ("date" in found):
        return "add them; one column score, with 7-5 in a cell, takes the place of two"
    listed = ",".join(f"{name}={title.strip()}" for name, title in found.items())
    quote = "'" if re.search(r'["$`\\!]', listed) else '"'
    return f"if it has them by other names, add --columns {quote}{listed}{quote}"


def _of_kind(columns: Sequence[Column], fits: Callable[[str], object]) -> list[Column]:
    return [(title, cells) for title, cells in columns if cells and all(map(fits, cells))]


def _is_name(text: str) -> bool:
    return any(map(str.isalpha, text)) and not _DATE.fullmatch(text)


def _players(columns: Sequence[Column], known: Collection[str]) -> dict[str, str]:
    """Return the two columns that share the most cells: players are on either side."""
    missing = [name for name in ("player_a", "player_b") if name not in known]
    if len(columns) < len(missing):
        return {}
    if len(missing) == 1:
        return {missing[0]: columns[0][0]}
    a, b = max(combinations(columns, 2), key=lambda pair: len({*pair[0][1]} & {*pair[1][1]}))
    return {"player_a": a[0], "player_b": b[0]}


def _scores(columns: Sequence[Column], known: Collection[str]) -> dict[str, str]:
    """Return the column of scores, or the two columns of games won."""
    scores = _of_kind(columns, _SCORE.fullmatch)
    if scores:
        return {"score": scores[0][0]}
    missing = [name for name in ("score_a", "score_b") if name not in known]
    counts = _of_kind(columns, _COUNT.fullmatch)
    pairs = zip(missing, counts, strict=False) if len(counts) >= len(missing) else ()
    return {name: title for name, (title, _) in pairs}
