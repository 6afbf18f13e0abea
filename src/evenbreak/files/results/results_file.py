"""Results files as `Results`: one file, or a league's consecutive seasons, with names resolved."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from itertools import compress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.arrays import array_values
from evenbreak.errors import InputError
from evenbreak.files.foreign.results import export_of
from evenbreak.files.results.aliases import AliasesFile, read_aliases
from evenbreak.files.results.columns import NAMES, RESULTS_FILE
from evenbreak.files.results.doubts import date_warnings, doubtful_score_warnings, without_bad_rows
from evenbreak.files.results.matches import one_layout, results_columns, results_rows
from evenbreak.files.results.proposals import columns_hint
from evenbreak.files.results.races_by_chart import races_by_chart
from evenbreak.files.results.statuses import LeftOut, played_matches
from evenbreak.files.tables.dates import DateOrder
from evenbreak.files.tables.header import UNREAD
from evenbreak.files.tables.names import PlayerNames, hidden_letter_warnings, same_name
from evenbreak.files.tables.problems import first_ones, form_warning, quoted, warning
from evenbreak.files.tables.similar_names import similar_name_warnings, similar_names
from evenbreak.files.tables.table import TextTable
from evenbreak.files.tables.titles import key_of
from evenbreak.ratings.results import Results
from evenbreak.words import FilePath, Parameter, joined, say, say_count

if TYPE_CHECKING:
    from numpy.typing import NDArray


_SAME_NAME = say("If so, use the same name throughout.")
MOST_RENAMED = 20
"""How many names changed by aliases are listed; the others are only counted."""


@array_values
@dataclass(frozen=True, eq=False)
class ResultsFile:
    """The content of a results file.

    Parameters
    ----------
    results
        in file order; players in the order of their names.
    source
        the file's name in messages.
    warnings
        one per line; the file can be used anyway.
    similar_names
        groups of names that may mean one player.
    sha256
        the fingerprint of the bytes read.
    lines
        the line where each match starts; empty if the matches didn't come from a file.
    ties
        a warning if matches have neither a winner nor a race; a chart may still say who won.
    skipped
        the number of rows left out because of `skip_bad`.
    left_out
        these rows, and the rows for byes and unplayed matches, each with the reason.
    renamed
        names as written, each with the name it is read as.
    read
        the name and fingerprint of each file read, if there are several.
    """

    results: Results
    source: str
    warnings: tuple[str, ...]
    similar_names: tuple[tuple[str, ...], ...]
    sha256: str
    lines: NDArray[np.int64] = field(
        default_factory=lambda: np.zeros(0, dtype=np.int64), repr=False
    )
    ties: tuple[str, ...] = ()
    skipped: int = 0
    left_out: tuple[LeftOut, ...] = ()
    renamed: tuple[tuple[str, str], ...] = ()
    titles: Mapping[str, str] = field(default_factory=dict)
    read: tuple[tuple[str, str], ...] = ()


def read_results(
    path: str | Path,
    *,
    aliases: str | Path | AliasesFile | None = None,
    columns: Mapping[str, str] | None = None,
    dates: DateOrder | None = None,
    skip_bad: bool = False,
    unplayed: bool = False,
    chart: str | Path | None = None,
    maybe: bool = False,
) -> ResultsFile:
    r"""Read match results from a CSV file or workbook; '-' is standard input.

    Format, separator and header are read as in `evenbreak.files.tables.table`; the columns are
    those of `RESULTS_FILE`. Extra spaces are removed from names, which are then normalized to
    Unicode NFC; names that differ only in case or spacing belong to one player. `winner` and
    `first_break` are a, b or the name of one of the two players. A forfeit may leave its scores
    empty; so may a match with its racks listed, or a match with only the race and the winner known.

    Parameters
    ----------
    aliases
        a file that says which names mean the same player, or the result of `read_aliases`.
    columns
        the file's titles for columns such as player_a, if they aren't known ones; a title for
        `autumn.csv:player_a` applies only to that file.
    maybe
        whether titles in `columns` that the file lacks are ignored.
    dates
        'mdy' or 'dmy': the order in dates such as 9/3/2024, if no date in the file shows it.
    skip_bad
        whether unreadable rows, and scores that are unlikely to be games, are left out and listed
        in the warnings; otherwise unreadable rows make the file invalid, and unlikely scores count.
    unplayed
        whether rows without a result are left out, as remaining matches.
    chart
        the name or file of the chart that set the races, for results that state both players'
        levels or ratings but no race.

    Raises
    ------
    DataError
        listing every problem in the file, one per line, except those that `skip_bad` leaves out;
        problems in the aliases file come first.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "results.csv"
    ...     _ = path.write_text("Date;Player A;Player B;Score A;Score B\n2024-09-03;Bo;Ann;5;7\n")
    ...     season = read_results(path)
    >>> season.results.players, season.results.score_b
    (('Ann', 'Bo'), array([7]))
    """
    by_alias = AliasesFile({}, "", ()) if aliases is None else aliases
    if not isinstance(by_alias, AliasesFile):
        by_alias = read_aliases(by_alias)
    table, left_out = played_matches(
        RESULTS_FILE.text(
            path,
            called=columns_of_file(_checked(columns or {}), path),
            maybe=maybe,
            hint=columns_hint,
            exported=export_of,
        ),
        (*NAMES, "winner", "loser"),
    )
    table = one_layout(table)

    if unplayed:
        table = _without_unplayed(table)

    def read(rows: TextTable) -> tuple[PlayerNames, Results]:
        names = PlayerNames(rows, NAMES, by_alias.means)
        return names, results_rows(rows, names, results_columns(rows, names, dates))

    skipped: list[str] = []
    bad: tuple[LeftOut, ...] = ()
    if skip_bad:
        table, skipped, bad = without_bad_rows(table, lambda rows: read(rows)[1])
    names, results = read(table)
    table.problems.raise_any()
    by_chart: list[str] = []
    if chart is not None:
        results, by_chart = races_by_chart(results, chart, table.lines, table.source)
    groups = tuple(similar_names(results.players, met_pairs(results)))
    warnings = [
        *by_alias.warnings,
        *table.warnings,
        *skipped,
        *by_chart,
        *doubtful_score_warnings(results, table.lines, table.source),
        *_repeated_rows(table),
        *([] if results.date is None else date_warnings(results.date, table.lines, table.source)),
        *hidden_letter_warnings(table, NAMES),
        *_merged(names.merged(), table.source),
        *_renamed(names.renamed(), table.source, by_alias.source),
        *similar_name_warnings(groups, table.source, _SAME_NAME),
    ]
    return ResultsFile(
        results,
        table.source,
        tuple(warnings),
        groups,
        table.sha256,
        table.lines,
        _tied(results, table),
        skipped=len(bad),
        left_out=(*left_out, *bad),
        titles=table.titles,
        renamed=tuple({**names.merged(), **names.renamed()}.items()),
    )


_NO_RESULT = {"", "no", "n", "false", "0"}
_OF_RESULT = ("score_a", "score_b", "winner", "racks", "forfeit")


def _without_unplayed(table: TextTable) -> TextTable:
    """Return the table without the rows that state no result."""
    rows = zip(*(table.cells(name) for name in _OF_RESULT), strict=True)
    states = (any(text.casefold() not in _NO_RESULT for text in row) for row in rows)
    return table.without(
        [k for k, one in zip(table.lines.tolist(), states, strict=True) if not one]
    )


def columns_of_file(columns: Mapping[str, str], path: str | Path) -> dict[str, str]:
    """Return a file's column titles: the titles for all files, and those for this file.

    >>> columns_of_file({"score": "Stand", "b.csv:score": "S", "c.csv:score": "T"}, "x/b.csv")
    {'score': 'S'}
    """
    own = {name: title for name, title in columns.items() if ":" not in name}
    for key, title in columns.items():
        file, _, name = key.rpartition(":")
        if file in (str(path), Path(path).name):
            own[name] = title
    return own


def refuse_unfound(
    columns: Mapping[str, str], paths: Sequence[str | Path], files: Sequence[ResultsFile]
) -> None:
    """Reject a title that no file has, or a file name that isn't one of the files."""
    for key, title in columns.items():
        file, _, name = key.rpartition(":")
        if file and not any(file in (str(path), Path(path).name) for path in paths):
            raise InputError(
                "{columns} has titles for {file}, which isn't one of the files. Correct its name.",
                columns=Parameter("columns"),
                file=quoted(file),
            )
        found = {key_of(one.titles[name]) for one in files if name in one.titles}
        if not file and title != UNREAD and key_of(title) not in found:
            raise InputError(
                "{columns} has {title}, which isn't a column in any of the files. Correct it.",
                columns=Parameter("columns"),
                title=quoted(title),
            )


def _checked(columns: Mapping[str, str]) -> Mapping[str, str]:
    """Return titles by column, or reject columns that don't exist."""
    for name in columns:
        if name.rpartition(":")[2] not in RESULTS_FILE.columns:
            raise InputError(
                "{columns} has {name!r}, which isn't a results column. The columns are {names}.",
                columns=Parameter("columns"),
                name=name,
                names=", ".join(RESULTS_FILE.columns),
            )
    return columns


def _merged(names: dict[str, str], source: str) -> list[str]:
    """Return a warning for each name that is read as another spelling."""
    warnings = [
        warning(
            source,
            None,
            "{text} is read as {name}, because names that differ only in case or spaces mean "
            "the same player",
            text=quoted(text),
            name=quoted(name),
        )
        for text, name in names.items()
    ]
    return first_ones(
        warnings, MOST_RENAMED, source, lambda n: say("and {n:,} more names like these", n=n)
    )


def _renamed(names: dict[str, str], source: str, aliases: str) -> list[str]:
    """Return a warning listing the names that aliases have changed."""
    if not names:
        return []
    changed = [
        say("{name} as {meant}", name=quoted(name), meant=quoted(meant))
        for name, meant in names.items()
    ]
    more = len(changed) - MOST_RENAMED
    rest = [say("and {n:,} more", n=more)] if more > 0 else []
    text = say(
        "names changed by {aliases}: {names}",
        aliases=FilePath(aliases),
        names=joined([*changed[:MOST_RENAMED], *rest], ", "),
    )
    return [form_warning(source, None, text)]


def _repeated_rows(table: TextTable) -> list[str]:
    """Return a warning if whole blocks of rows are repeated: they may have been pasted twice."""
    if "date" not in table:
        return []  # the same two players often play to the same score on another day
    # The sets of a match in another program's file stand in one line.
    again = np.flatnonzero(table.repeated() & (np.diff(table.lines, prepend=-1) > 0))
    if not len(again):
        return []
    text = say_count(
        "{n} row is identical to an earlier one, including the date; both are counted, so "
        "delete one if the match was entered twice",
        "{n:,} rows are identical to earlier ones, including the date; all are counted, so "
        "delete any that were entered twice",
        len(again),
    )
    return [warning(table.source, table.lines[again[0]], text)]


def _tied(results: Results, table: TextTable) -> tuple[str, ...]:
    """Return a warning if matches have no winner."""
    played = (results.score_a > 0) & (results.score_a == results.score_b) & ~results.given_away
    race_a, race_b = results.races
    tied = np.flatnonzero(played & (race_a == 0) & (race_b == 0))
    if not len(tied):
        return ()
    row = tied[0]
    text = say_count(
        "the score is tied ({a}-{b}), and no race is given; this match is counted game by game, "
        "without a winner",
        "the score is tied ({a}-{b}), and no race is given; this match and {more:,} more like "
        "it are counted game by game, without a winner",
        len(tied),
        a=results.score_a[row],
        b=results.score_b[row],
        more=len(tied) - 1,
    )
    return (warning(table.source, table.lines[row], text),)


def met_pairs(results: Results) -> Iterator[tuple[str, str]]:
    """Yield the names that played each other, each pair once in each order."""
    many = max(len(results.players), 1)
    ends = np.divmod(np.unique(results.player_a * many + results.player_b), many)
    for a, b in zip(*(end.tolist() for end in ends), strict=True):
        yield results.players[a], results.players[b]


def in_a_row(files: Sequence[ResultsFile], *, doubles: bool = False) -> ResultsFile:
    """Return several files of results as one; see `evenbreak.files.results.seasons`.

    With `doubles`, there is no warning about matches that appear in two files.
    """
    if len(files) == 1:
        return files[0]
    prints = [file.sha256 for file in files]
    for k, file in enumerate(files):
        if file.sha256 in prints[:k]:
            raise InputError(
                "{first} and {second} hold the same results. Give only one of them.",
                first=FilePath(files[prints.index(file.sha256)].source),
                second=FilePath(file.source),
            )
    results = _joined([file.results for file in files])
    groups = tuple(similar_names(results.players, met_pairs(results)))
    source = " and ".join(file.source for file in files)
    in_one_file = {group for file in files for group in file.similar_names}
    across = [group for group in groups if group not in in_one_file]
    return ResultsFile(
        results,
        source,
        (
            *(text for file in files for text in file.warnings),
            *similar_name_warnings(across, source, _SAME_NAME),
            *(() if doubles else _in_two_files(files, results)),
        ),
        groups,
        hashlib.sha256("".join(prints).encode()).hexdigest(),
        ties=tuple(text for file in files for text in file.ties),
        skipped=sum(file.skipped for file in files),
        read=tuple((file.source, file.sha256) for file in files),
    )


def _in_two_files(files: Sequence[ResultsFile], results: Results) -> Iterator[str]:
    """Yield how many of a file's dated matches are in an earlier file, with the same score."""
    if results.date is None:
        return
    columns = (results.player_a, results.player_b, results.score_a, results.score_b)
    days = results.date.astype("datetime64[D]").astype(np.int64)
    rows = list(zip(days.tolist(), *(column.tolist() for column in columns), strict=True))
    dated = (~np.isnat(results.date)).tolist()
    seen: set[tuple[int, ...]] = set()
    start = 0
    for file in files:
        end = start + len(file.results)
        own = list(compress(rows[start:end], dated[start:end]))
        again = sum(row in seen for row in own)
        if again:
            yield warning(
                file.source,
                None,
                say_count(
                    "{n} match is also in an earlier file, with the same players, score and "
                    "day. Leave it out of one of the files, or it will count twice.",
                    "{n:,} matches are also in an earlier file, with the same players, score "
                    "and day. Leave them out of one of the files, or they will count twice.",
                    again,
                ),
            )
        seen.update(own)
        start = end


def _joined(seasons: Sequence[Results]) -> Results:
    """Return the matches of all seasons, with one list of players."""
    spelling: dict[str, str] = {}
    for season in seasons:
        for name in season.players:
            spelling.setdefault(same_name(name), name)
    players = tuple(sorted(spelling.values()))
    position = {name: k for k, name in enumerate(players)}
    renumbered = []
    for season in seasons:
        places = [position[spelling[same_name(name)]] for name in season.players]
        place = np.array(places, dtype=np.int64)
        a, b = place[season.player_a], place[season.player_b]
        renumbered.append(replace(season, players=players, player_a=a, player_b=b))
    return reduce(Results.joined, renumbered)
