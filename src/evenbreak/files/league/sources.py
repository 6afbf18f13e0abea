"""A league's results from all its files: one list of matches, and what was done to make it.

Each file is read with its own titles. Names joined by aliases belong to one player; names that only
look alike are listed for a person to decide. A match that appears in two files, whichever side
comes first, counts once. Rows that aren't matches, or can't be read, are left out and listed with
file, line and reason.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.league.league_file import LeagueFile
from evenbreak.files.results.aliases import AliasesFile
from evenbreak.files.results.results_file import ResultsFile, in_a_row, read_results, refuse_unfound
from evenbreak.files.tables.dates import DateOrder
from evenbreak.files.tables.problems import quoted, refusal, warning
from evenbreak.ratings.results import Results
from evenbreak.words import Sentence, say, say_count

Kind = Literal["renamed", "double", "left out", "doubt"]

_TURNED = {
    f"{what}_{side}": f"{what}_{other}"
    for what in ("player", "score", "race", "team", "level")
    for side, other in ("ab", "ba")
}
_MORE = (
    *("race_a", "race_b", "winner", "first_break", "break_format", "racks"),
    *("event", "team_a", "team_b", "division", "level_a", "level_b"),
)
"""What one file may state about a match when another doesn't."""

_NEARLY_ALL = 0.9


@dataclass(frozen=True)
class Change:
    """Something that was changed or left out, or that a person should look at.

    The kind is renamed, double, left out or doubt; line 0 is the whole file; `first` is the file
    where a double match appears first.
    """

    kind: Kind
    source: str
    line: int
    text: str
    first: str = ""


@dataclass(frozen=True)
class NameDoubt:
    """Names that may belong to one player, starting with the name that has the most matches."""

    names: tuple[str, ...]
    matches: tuple[int, ...]

    def alias_lines(self) -> list[str]:
        r"""Return the lines for `[aliases]` that make them one player.

        >>> print(*NameDoubt(("Al Lee", '"Big" Al'), (9, 2)).alias_lines())
        "\"Big\" Al" = "Al Lee"
        """
        return alias_lines(dict.fromkeys(self.names[1:], self.names[0]))


def alias_lines(means: Mapping[str, str]) -> list[str]:
    """Return lines for the `[aliases]` table of `league.toml`."""
    return [f"{_in_toml(name)} = {_in_toml(meant)}" for name, meant in means.items()]


def _in_toml(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


@dataclass(frozen=True, eq=False)
class LeagueResults:
    """A league's results as one file, and what happened to them on the way.

    Names in `name_doubts` may belong to one player, but are kept apart; `sources` has each file's
    match count.
    """

    file: ResultsFile
    changes: tuple[Change, ...]
    name_doubts: tuple[NameDoubt, ...]
    sources: tuple[tuple[str, int], ...]

    @property
    def results(self) -> Results:
        """The matches, in the order of the files."""
        return self.file.results


def league_results(
    league: LeagueFile,
    *,
    aliases: AliasesFile | None = None,
    columns: Mapping[str, str] | None = None,
    dates: DateOrder | None = None,
    skip_bad: bool = True,
    **reading: Any,
) -> LeagueResults:
    """Return a league's results from all the files that it names.

    `aliases`, `columns` and `dates` replace the league's. With `skip_bad`, rows that can't be read
    are left out and listed. Raises DataError if the league names no results, or one of the files
    can't be read.
    """
    if not league.results:
        raise refusal(
            str(league.path),
            'lists no results. Add a [[results]] line, with file = "..." below it.',
        )
    if aliases is None:
        aliases = AliasesFile(dict(league.aliases), str(league.path), ())
    known = replace(aliases, means={k: v for k, v in aliases.means.items() if k != v})
    paths = [league.place(one.file) for one in league.results]
    files = [
        read_results(
            path,
            aliases=known,
            columns=columns or one.columns,
            maybe=bool(columns) and len(paths) > 1,
            dates=dates or one.dates,  # type: ignore[arg-type]  # one of the two, as its field says
            skip_bad=skip_bad,
            **reading,
        )
        for path, one in zip(paths, league.results, strict=True)
    ]
    refuse_unfound(columns or {}, paths, files)
    names = [one.file for one in league.results]
    every = in_a_row(files, doubles=True)
    rows = _Rows.of(every.results, files, names)
    doubles = rows.doubles()
    kept = np.ones(len(every.results), dtype=bool)
    kept[list(doubles)] = False
    played = _filled(every.results, doubles).select(kept)
    counted = [
        warning(
            league.place(names[k]),
            None,
            say_count(
                "{n} match is a repeat (same players, score and day) and counts only once",
                "{n:,} matches are repeats (same players, score and day) and count only once",
                n,
            ),
        )
        for k, n in sorted(Counter(rows.source[list(doubles)].tolist()).items())
    ]
    gave = Counter(rows.source[kept].tolist())
    return LeagueResults(
        replace(
            every,
            results=played,
            warnings=(*every.warnings, *counted),
            lines=every.lines[kept] if len(every.lines) else every.lines,
        ),
        tuple(_changes(files, rows, doubles)),
        _name_doubts(every.similar_names, played, aliases.means),
        tuple((name, gave[k]) for k, name in enumerate(names)),
    )


def _changes(
    files: Sequence[ResultsFile], rows: _Rows, doubles: Mapping[int, int]
) -> Iterator[Change]:
    """Yield what was done, by file and line."""
    doubts = rows.doubts(doubles)
    for k, (name, file) in enumerate(zip(rows.names, files, strict=True)):
        for written, meant in file.renamed:
            text = say("{written} is read as {meant}", written=quoted(written), meant=quoted(meant))
            yield Change("renamed", name, 0, text)
        own = [Change("left out", name, line, why) for line, why in file.left_out]
        own += [
            Change(
                "double",
                name,
                int(rows.line[row]),
                _again(rows, first),
                rows.names[rows.source[first]],
            )
            for row, first in doubles.items()
            if rows.source[row] == k
        ]
        own += [doubt for doubt in doubts if doubt.source == name]
        yield from sorted(own, key=lambda change: change.line)


def _again(rows: _Rows, first: int) -> Sentence:
    return say(
        "this match is also in {source}, line {line}",
        source=rows.names[rows.source[first]],
        line=int(rows.line[first]),
    )


@dataclass(frozen=True, eq=False)
class _Rows:
    """All files' matches, each with its place and a key for recognizing duplicates."""

    results: Results
    names: Sequence[str]
    source: NDArray[np.int64]
    line: NDArray[np.int64]
    turned: NDArray[np.bool_]
    keys: list[tuple[Any, ...]]

    @classmethod
    def of(cls, results: Results, files: Sequence[ResultsFile], names: Sequence[str]) -> _Rows:
        many = [len(file.results) for file in files]
        turned = results.player_a > results.player_b
        pairs = [
            np.where(turned, *(getattr(results, f"{what}_{side}") for side in order))
            for what in ("player", "score")
            for order in ("ba", "ab")
        ]
        days = (
            np.full(len(results), "NaT", dtype="datetime64[D]")
            if results.date is None
            else results.date
        )
        winner = np.zeros(len(results), np.int8) if results.winner is None else results.winner
        won = np.where(turned & (winner > 0), 3 - winner, winner)
        # Who won is part of a match only where its score does not say it.
        won = np.where(results.score_a == results.score_b, won, 0)
        columns = [days.astype(str), *pairs, won, results.given_away]
        return cls(
            results,
            names,
            np.repeat(np.arange(len(files)), many),
            np.concatenate([file.lines for file in files]),
            turned,
            list(zip(*(column.tolist() for column in columns), strict=True)),
        )

    def doubles(self) -> dict[int, int]:
        """Return each dated match that appears again, with the row where it appeared first.

        Within a file, repeats count only as mirror images, and only if every match has one.
        """
        first: dict[tuple[Any, ...], list[int]] = defaultdict(list)
        doubles: dict[int, int] = {}
        for k in range(len(self.names)):
            own: dict[tuple[Any, ...], list[int]] = defaultdict(list)
            mirrored = self._mirrored(k)
            for row in np.flatnonzero(self.source == k).tolist():
                if row not in mirrored and self.keys[row][0] != "NaT":
                    own[self.keys[row]].append(row)
            for key, rows in own.items():
                doubles |= dict(zip(rows, first[key], strict=False))
                first[key] += rows[len(first[key]) :]
            doubles |= {row: doubles.get(other, other) for row, other in mirrored.items()}
        return doubles

    def _mirrored(self, source: int) -> dict[int, int]:
        """Return the second row of each match that a file lists from both sides, with the first."""
        waiting: dict[tuple[Any, ...], list[int]] = defaultdict(list)
        pairs: dict[int, int] = {}
        every = np.flatnonzero(self.source == source).tolist()
        for row in every:
            key, side = self.keys[row], bool(self.turned[row])
            if waiting[(*key, not side)]:
                pairs[row] = waiting[(*key, not side)].pop(0)
            else:
                waiting[(*key, side)].append(row)
        return pairs if len(pairs) > 1 and 2 * len(pairs) >= _NEARLY_ALL * len(every) else {}

    def doubts(self, doubles: Mapping[int, int]) -> list[Change]:
        """Return matches in two files that may be the same one: with another score, or no date."""
        met: dict[tuple[Any, ...], list[int]] = defaultdict(list)
        alike: dict[tuple[Any, ...], list[int]] = defaultdict(list)
        for row, key in enumerate(self.keys):
            if row in doubles:
                continue
            if key[0] != "NaT":
                met[key[:3]].append(row)
            alike[key[1:]].append(row)
        doubts: list[Change] = []
        for rows in met.values():
            if len(rows) == 2 and self.keys[rows[0]] != self.keys[rows[1]]:
                doubts += self._between(
                    rows, say("the score differs from {source}, line {line}; both matches count")
                )
        for rows in alike.values():
            undated = [row for row in rows if self.keys[row][0] == "NaT"]
            others = [row for row in rows if row not in undated]
            if len(undated) == 1 == len(others):
                text = say(
                    "the same match, without a date, is in {source}, line {line}; both count"
                )
                doubts += self._between([others[0], undated[0]], text)
        return doubts

    def _between(self, rows: Sequence[int], text: Sentence) -> Iterator[Change]:
        one, other = rows
        if self.source[one] != self.source[other]:
            place = {"source": self.names[self.source[one]], "line": int(self.line[one])}
            said = say(text.template, **place)
            yield Change("doubt", self.names[self.source[other]], int(self.line[other]), said)


def _filled(results: Results, doubles: Mapping[int, int]) -> Results:
    """Return the results, filling in what a match's first row lacks and a repeat states."""
    columns = {
        name: values.copy() for name in _MORE if (values := getattr(results, name)) is not None
    }
    for name in list(columns):  # a team of player a may be that of player b in another file
        empty = np.full_like(columns[name], "" if columns[name].dtype == object else 0)
        columns.setdefault(_TURNED.get(name, name), empty)
    stated = {name: values.copy() for name, values in columns.items()}
    for row, first in doubles.items():
        other_way = results.player_a[row] != results.player_a[first]
        for name, values in columns.items():
            value = stated[_TURNED.get(name, name) if other_way else name][row]
            if not values[first] and value:
                values[first] = _seen(name, value) if other_way else value
    return replace(results, **columns)


def _seen(name: str, value: Any) -> Any:
    """Return a value as seen from the other side of the match."""
    if name in ("winner", "first_break"):
        return 3 - value
    if name == "break_format":
        return {4: 5, 5: 4}.get(int(value), value)
    return value.translate(str.maketrans("ab", "ba")) if name == "racks" else value


def _name_doubts(
    groups: Sequence[tuple[str, ...]], played: Results, means: Mapping[str, str]
) -> tuple[NameDoubt, ...]:
    """Return names that may belong to one player; an alias for itself belongs to no one else."""
    many = len(played.players)
    counts = np.bincount(np.concatenate([played.player_a, played.player_b]), minlength=many)
    matches = dict(zip(played.players, counts.tolist(), strict=True))
    apart = {name for name, meant in means.items() if name == meant}
    doubts = []
    for group in groups:
        names = sorted({*group} - apart, key=lambda name: (-matches[name], '"' in name, name))
        if len(names) > 1:
            doubts.append(NameDoubt(tuple(names), tuple(matches[name] for name in names)))
    return tuple(doubts)
