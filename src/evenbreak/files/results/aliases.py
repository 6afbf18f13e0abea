"""Aliases: which names in the results mean the same player."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from evenbreak.files.league import is_league
from evenbreak.files.league.league_file import read_league
from evenbreak.files.tables.names import Name, hidden_letter_warnings
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.schema import Schema
from evenbreak.words import say

_WRITE = say("a name, or delete the line")

ALIASES = Schema(
    "names",
    name=Name(
        "alias, written, as written, nickname, from",
        "a name as it may appear in the results",
        needed=True,
        given_first=False,
        write=_WRITE,
    ),
    means=Name(
        "player, real name, right name, stands for, to",
        "the name of the player who is meant",
        needed=True,
        write=_WRITE,
    ),
)


@dataclass(frozen=True, eq=False)
class AliasesFile:
    """The content of an aliases file.

    Parameters
    ----------
    means
        maps a name as written to the name that is meant, which is never an alias itself.
    source
        the file's name in messages.
    warnings
        one per line; the file can be used anyway.
    """

    means: dict[str, str]
    source: str
    warnings: tuple[str, ...]


def read_aliases(path: str | Path) -> AliasesFile:
    r"""Read the names that mean the same player from a CSV file; '-' is standard input.

    A league's file has them in `[aliases]`.

    Names are cleaned as in results. An alias for itself changes nothing.

    Raises
    ------
    DataError
        listing every problem in the file: missing columns, no rows, empty cells, a name that means
        two players, an alias for another alias.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "aliases.csv"
    ...     _ = path.write_text("name,means\nBobby,Bob Smith\nBob  S.,Bob Smith\n")
    ...     read_aliases(path).means
    {'Bobby': 'Bob Smith', 'Bob S.': 'Bob Smith'}
    """
    if is_league(path):
        league = read_league(path, quickly=True)
        return AliasesFile(_others(league.aliases), str(league.path), ())
    table = ALIASES.read(path)
    means: dict[str, str] = {}
    line_of: dict[str, int] = {}
    for name, meant, line in zip(table["name"], table["means"], table.lines.tolist(), strict=True):
        if not name or not meant:
            continue
        if means.setdefault(name, meant) != meant:
            table.problems.add(
                line,
                "{name} means {meant} here, but {earlier} in line {line}. Keep one of the two.",
                name=quoted(name),
                meant=quoted(meant),
                earlier=quoted(means[name]),
                line=line_of[name],
            )
        line_of.setdefault(name, line)
    for name, meant in means.items():
        if name != meant and means.get(meant, meant) != meant:
            table.problems.add(
                line_of[name],
                "{name} means {meant}, which means {other} in line {line}. Write the "
                "player's real name in both lines, and keep only one of two names that "
                "mean each other.",
                name=quoted(name),
                meant=quoted(meant),
                other=quoted(means[meant]),
                line=line_of[meant],
            )
    table.problems.raise_any()
    hidden = hidden_letter_warnings(table, ["means"])
    return AliasesFile(_others(means), table.source, (*table.warnings, *hidden))


def _others(means: Mapping[str, str]) -> dict[str, str]:
    return {name: meant for name, meant in means.items() if name != meant}
