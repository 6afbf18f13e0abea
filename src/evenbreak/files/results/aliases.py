"""Reading a file of aliases: which names mean which player."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from evenbreak.files.tables.names import clean_name, hidden_letter_warnings
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.table import TextTable, read_table

REQUIRED = {
    "name": ("alias", "written", "as written", "nickname", "from"),
    "means": ("player", "real name", "right name", "stands for", "to"),
}
"""The columns that a file of aliases must have, with their other names."""


@dataclass(frozen=True, eq=False)
class AliasesFile:
    """The contents of a file of aliases.

    Parameters
    ----------
    means
        from a name as it is written to the name that is meant, which is never itself an alias.
    source
        what the file is called in messages.
    warnings
        what to check although the file can be used, a line each.
    """

    means: dict[str, str]
    source: str
    warnings: tuple[str, ...]


def read_aliases(path: str | Path) -> AliasesFile:
    r"""Read which names mean the same player from a CSV file; '-' is standard input.

    Names are cleaned as those of results are. A name that means itself changes nothing.

    Raises
    ------
    DataError
        with everything that is wrong in the file: missing columns, no rows, empty cells, a
        name that means two players, an alias that means another alias.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "aliases.csv"
    ...     _ = path.write_text("name,means\nBobby,Bob Smith\nBob  S.,Bob Smith\n")
    ...     read_aliases(path).means
    {'Bobby': 'Bob Smith', 'Bob S.': 'Bob Smith'}
    """
    table = read_table(path, REQUIRED, rows="names")
    pairs = zip(_names(table, "name"), _names(table, "means"), table.lines.tolist(), strict=True)
    means: dict[str, str] = {}
    line_of: dict[str, int] = {}
    for name, meant, line in pairs:
        if not name or not meant:
            continue
        if means.setdefault(name, meant) != meant:
            table.problems.add(
                line,
                f"{quoted(name)} means {quoted(meant)} here, but {quoted(means[name])} in line "
                f"{line_of[name]}; keep one of the two",
            )
        line_of.setdefault(name, line)
    for name, meant in means.items():
        if name != meant and means.get(meant, meant) != meant:
            table.problems.add(
                line_of[name],
                f"{quoted(name)} means {quoted(meant)}, which means {quoted(means[meant])} in line "
                f"{line_of[meant]}; write the player's real name in both lines, and keep only one "
                "of two names that mean each other",
            )
    table.problems.raise_any()
    means = {name: meant for name, meant in means.items() if name != meant}
    hidden = hidden_letter_warnings(table, ["means"])
    return AliasesFile(means, table.source, (*table.warnings, *hidden))


def _names(table: TextTable, column: str) -> list[str]:
    """Return a column of names; empty ones are added to the problems."""
    names = [clean_name(text) for text in table.cells(column)]
    for name, line in zip(names, table.lines.tolist(), strict=True):
        if not name and column in table:
            table.problems.add(line, f"{column} is empty; write a name, or delete the line")
    return names
