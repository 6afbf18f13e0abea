"""Practice files: attempts at a drill, and drill scores."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.tables.dates import DateOrder, Day
from evenbreak.files.tables.header import missing_column
from evenbreak.files.tables.problems import quoted, warning
from evenbreak.files.tables.schema import Number, Schema, Text, Whole, YesNo
from evenbreak.files.tables.table import TextTable, Values
from evenbreak.practice.drill_log import MOST_LEVELS, DrillLog
from evenbreak.practice.single_shots import ShotLog
from evenbreak.ratings.results_frame import letters
from evenbreak.stats.confidence import LARGEST
from evenbreak.words import Parameter, joined, say, say_count

_DAY = "day, practiced on, played on"
_DRILL = Text("exercise, drill name", "the drill; if there are several, `--drill` names one")

WORDS = {
    **dict.fromkeys(("yes", "y", "true", "t", "1", "made", "make", "success", "hit"), True),
    **dict.fromkeys(
        ("no", "n", "false", "f", "0", "missed", "miss", "failed", "fail", "failure"), False
    ),
}
"""The words for success and for a miss."""

_MARKS = {"x": True, "-": False, "\N{EN DASH}": False}


class Outcome(YesNo):
    """Whether a shot was made: words, or if a column has only these marks, x for made and -."""

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column; an x mixed with words may mean a miss, so it is rejected."""
        return super(Outcome, self.as_in(table, name)).read(table, name)

    def as_in(self, table: TextTable, name: str) -> Self:
        """Return the column with the marks of a file, if it has no words."""
        texts = {text.casefold() for text in table.columns[name].distinct if text}
        return replace(self, values=_MARKS) if len(texts) > 1 and texts <= _MARKS.keys() else self

    def meaning(self, text: str) -> bool | None:
        """Return whether the shot was made."""
        return self.values.get(letters(text) or text)


DRILL_LOG = Schema(
    "attempts",
    level=Whole(
        "difficulty, step, balls",
        "the attempt's level",
        needed=True,
        filled=True,
        least=1,
        most=MOST_LEVELS,
    ),
    success=YesNo(
        "made, made it, succeeded, result, outcome",
        "whether the attempt succeeded; also `y`, `true`, `1`, `made`, `hit`, `success`, and "
        "`n`, `false`, `0`, `missed`, `miss`, `failed`, `fail`",
        needed=True,
        filled=True,
        values=WORDS,
        write=say("one of them, in one row per attempt"),
    ),
    session=Text("practice session, visit, evening"),
    date=Text(_DAY),
    drill=_DRILL,
)

SCORES = Schema(
    "scores",
    score=Number(
        "points, result, total, balls",
        "the score",
        needed=True,
        filled=True,
        least=-int(LARGEST),
        most=int(LARGEST),
        write=say("a score such as 48"),
    ),
    date=Day(_DAY, "the day of the score"),
    drill=_DRILL,
)

OUTCOME = Outcome(
    "made it, success, hit",
    "used instead of made and tried, in one row per try: `made` or `missed`, `yes` or `no`, `1` "
    "or `0`, `x` or `-`; also titled `result` or `made`",
    filled=True,
    values=WORDS,
    choices=say("made or missed"),
    write=say(
        "made or missed, in one row per try, or use the columns shot, made and tried, in one "
        "row per shot and day"
    ),
)

SHOTS = Schema(
    "shots",
    made=Whole(
        "makes, potted, in",
        "how often the shot was made",
        needed=True,
        filled=True,
        instead=("outcome",),
    ),
    tried=Whole(
        "tries, attempts, attempted, of",
        "how often the shot was tried",
        needed=True,
        filled=True,
        least=1,
        instead=("outcome",),
    ),
    outcome=OUTCOME,
    shot=Text(
        "name, exercise, shot name",
        "which shot it was; without this column, all rows are for the same shot",
    ),
    date=Day(_DAY, "the day"),
)
"""A log of single shots: a row for each shot on each day, or for each try."""

NAMED = 6
"""How many drills a message names."""


def rows_of_drill(
    table: TextTable, drill: str | None, *, as_above: bool = False
) -> NDArray[np.int64]:
    """Return the rows for one drill (None: the only one), noting unclear rows as problems.

    With `as_above`, an empty cell means the drill of the cell above it.
    """
    rows = np.arange(len(table))
    if "drill" not in table:
        if drill is not None:
            table.problems.add(
                None, "has no column 'drill'. Leave {drill} out.", drill=Parameter("drill")
            )
        return rows
    cells = table.cells("drill")
    if as_above:
        for row in range(1, len(cells)):
            cells[row] = cells[row] or cells[row - 1]
    if any(cells):
        for line, text in zip(table.lines.tolist(), cells, strict=True):
            if not text:
                table.problems.add(line, "drill is empty. Write which drill it was.")
    names: dict[str, str] = {}
    for text in filter(None, cells):
        names.setdefault(letters(text) or text, text)
    some = joined([quoted(name) for name in list(names.values())[:NAMED]], ", ")
    drills = say("{some}, ...", some=some) if len(names) > NAMED else some
    if drill is None:
        if len(names) > 1:
            table.problems.add(
                None,
                "has {n} drills ({drills}). Name one of them with {drill}.",
                n=len(names),
                drills=drills,
                drill=Parameter("drill"),
            )
        return rows
    asked = letters(drill) or drill
    if asked not in names:
        table.problems.add(
            None,
            "has no drill {drill}; it has {drills}",
            drill=quoted(drill),
            drills=drills or say("no names"),
        )
    return np.flatnonzero([(letters(text) or text) == asked for text in cells])


def source_of(table: TextTable, drill: str | None) -> str:
    """Return what messages call a drill's rows."""
    return table.source if drill is None else f"{table.source}, drill {quoted(drill)}"


@dataclass(frozen=True, eq=False)
class DrillLogFile:
    """The content of a file of drill attempts.

    Parameters
    ----------
    log
        in file order.
    source
        the file's name in messages.
    warnings
        one per line; the file can be used anyway.
    """

    log: DrillLog
    source: str
    warnings: tuple[str, ...]


def read_drill_log(
    path: str | Path, *, levels: int | None = None, drill: str | None = None
) -> DrillLogFile:
    r"""Read the attempts of a progressive drill from a CSV file; '-' is standard input.

    Encoding, separator and header are handled by `evenbreak.files.tables.table`; the columns are
    those of `DRILL_LOG`, with one row per attempt, in the order they were made. A new session
    starts wherever the session, date or drill differs from the row above; an empty cell repeats the
    cell above. A row that breaks the drill's rule within a session counts as a new start, with a
    warning.

    Parameters
    ----------
    levels
        the drill's levels; None: the highest level in the file.
    drill
        needed if the file has several drills.

    Raises
    ------
    DataError
        listing every problem in the file, one per line.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "drill.csv"
    ...     _ = path.write_text("Level;Made it\n1;yes\n2;no\n1;yes\n", encoding="utf-8")
    ...     file = read_drill_log(path)
    >>> file.log.attempts, file.log.successes
    (array([2, 1]), array([2, 0]))
    """
    schema = DRILL_LOG
    if levels is not None:
        write = say("1, 2, 3, ..., or give the drill more levels")
        schema = schema.but(level={"most": levels, "write": write})
    table = schema.read(path)
    rows = rows_of_drill(table, drill, as_above=True)
    table.problems.raise_any()
    log = DrillLog(
        table["level"][rows], table["success"][rows], session=_sessions(table)[rows], levels=levels
    )
    warnings = (*table.warnings, *_jump_warning(table, log, rows))
    return DrillLogFile(log, source_of(table, drill), warnings)


def _sessions(table: TextTable) -> NDArray[np.int64]:
    """Return a number for each row, which changes whenever the session or the date does."""
    changes = np.zeros(len(table), dtype=bool)
    for name in ("session", "date", "drill"):
        codes, stated = table.columns[name].codes, table.read[name].stated
        # The last row with something in the cell: an empty cell means the same as that one.
        said = np.maximum.accumulate(np.where(stated, np.arange(len(table)), 0))
        changes[1:] |= codes[said][1:] != codes[said][:-1]
    return changes.cumsum()


def _jump_warning(table: TextTable, log: DrillLog, rows: NDArray[np.int64]) -> list[str]:
    if not len(log.jumps):
        return []
    row = int(log.jumps[0])
    step = 1 if log.success[row - 1] else -1
    problem = say(
        "level {level} follows a {outcome} at level {before}, which should lead to level "
        "{by_rule}; {count}. Keep the rows in the order of the attempts; a session or date "
        "column shows where a session starts",
        level=log.level[row],
        outcome=say("success") if step > 0 else say("miss"),
        before=log.level[row - 1],
        by_rule=min(max(int(log.level[row - 1]) + step, 1), len(log.attempts)),
        count=say_count(
            "this row counts as a new start", "{n:,} such rows count as new starts", len(log.jumps)
        ),
    )
    return [warning(table.source, table.lines[rows[row]], problem)]


class ScoresFile(NamedTuple):
    """A file's scores, in row order.

    `dates` has each score's date; it is None unless every score has one.
    """

    scores: NDArray[np.float64]
    dates: NDArray[np.datetime64] | None
    source: str
    warnings: tuple[str, ...]


class ShotsFile(NamedTuple):
    """A file's log of single shots, the file's name, and anything to check in it."""

    log: ShotLog
    source: str
    warnings: tuple[str, ...]


def read_practice(
    path: str | Path, *, drill: str | None = None, dates: DateOrder | None = None
) -> ScoresFile | ShotsFile:
    """Read practice scores, or a log of single shots with the columns made and tried.

    A log of shots has no drills. Raises DataError listing every problem in the file.
    """
    shots, scores = (
        schema.but(
            date={"order": dates},
            **{
                name: {"needed": False, "instead": ()}
                for name, one in schema.columns.items()
                if one.needed
            },
        )
        for schema in (SHOTS, SCORES)
    )
    table = (scores | shots).text(path)
    if (title := _outcomes_in(table)) is not None:
        return _shots(_counted(table, title, shots), drill)
    if "score" in table or not {"made", "tried"} <= table.found:
        if not table.found:
            table.problems.add(1, "no line names the columns. Write score above the scores.")
        elif "score" not in table:
            of_shots = [name for name in ("made", "tried") if name not in table]
            lacks = of_shots if len(of_shots) == 1 else ["score"]
            for name in lacks:
                table.problems.add(None, missing_column(name, (scores | shots)[name].aliases))
        return _scores(scores.of(table), drill)
    return _shots(shots.of(table), drill)


def _outcomes_in(table: TextTable) -> str | None:
    """Return the column that says whether each try was made; None if the file isn't such a log."""
    for name in () if {"made", "tried"} <= table.found else ("score", "outcome", "made"):
        if name not in table:
            continue
        texts = set(filter(None, table.columns[name].distinct))
        words = {text for text in texts if SCORES["score"].meaning(text) is None}
        if texts - words - {"0", "1"}:  # numbers
            return None
        outcome = OUTCOME.as_in(table, name)
        known = any(outcome.meaning(text) is not None for text in words)
        if name != "score" or known or (texts and "shot" in table):
            return name
    return None


def _counted(table: TextTable, name: str, schema: Schema) -> TextTable:
    """Return a table with a row per try as a table of shots made and tried."""
    title = table.titles[name]
    table = replace(table, columns={**table.columns, title: table.columns[name]})
    made = OUTCOME.read(replace(table, found=table.found | {title}), title)
    read = schema.only("date").of(table).read
    numbers = {"made": made.values.astype(np.int64), "tried": np.ones(len(table), dtype=np.int64)}
    more = {name: Values(values, made.good, made.stated) for name, values in numbers.items()}
    return replace(table, read={**read, **more})


def _shots(table: TextTable, drill: str | None) -> ShotsFile:
    if drill is not None:
        table.problems.add(
            None,
            "is a log of single shots, which has no drills. Leave {drill} out.",
            drill=Parameter("drill"),
        )
    made, tried = table["made"], table["tried"]
    good = table.read["made"].good & table.read["tried"].good
    table.note(
        good & (made > tried),
        "{made} made out of {tried} tried can't be right. Correct one of them.",
        made=made,
        tried=tried,
    )
    cells = table.cells("shot" if "shot" in table else "drill")
    names: dict[str, str] = {}
    for text in cells:
        names.setdefault(letters(text) or text, text)
    table.problems.raise_any()
    places = {key: place for place, key in enumerate(names)}
    shot = np.array([places[letters(text) or text] for text in cells], dtype=np.int64)
    days = table["date"]
    undated = np.flatnonzero(np.isnat(days))
    log = ShotLog(tuple(names.values()), shot, made, tried, None if undated.size else days)
    more = _undated(table, undated, len(cells)) if undated.size else []
    return ShotsFile(log, table.source, (*table.warnings, *more))


def read_scores(
    path: str | Path, *, drill: str | None = None, dates: DateOrder | None = None
) -> ScoresFile:
    """Read practice scores from a CSV file, one score per row; '-' is standard input.

    `drill` chooses one drill if there are several; `dates`, 'mdy' or 'dmy', gives the order in
    dates such as 9/3/2024 if no date in the file shows it. Raises DataError listing every problem
    in the file.
    """
    return _scores(SCORES.but(date={"order": dates}).read(path), drill)


def _scores(table: TextTable, drill: str | None) -> ScoresFile:
    """Return a table's scores, or raise all the problems found in it."""
    scores, days = table["score"], table["date"]
    rows = rows_of_drill(table, drill)
    table.problems.raise_any()
    undated = rows[np.isnat(days[rows])]
    dated = not undated.size
    return ScoresFile(
        scores[rows],
        days[rows] if dated else None,
        source_of(table, drill),
        (*table.warnings, *([] if dated else _undated(table, undated, len(rows)))),
    )


def _undated(table: TextTable, rows: NDArray[np.int64], scores: int) -> list[str]:
    """Return a warning if some scores have a date and others, in `rows`, don't."""
    if "date" not in table or rows.size == scores:
        return []
    missing = say_count(
        "the date is missing, so no dates are used",
        "{n} dates are missing, so no dates are used",
        rows.size,
    )
    return [warning(table.source, table.lines[rows[0]], missing)]
