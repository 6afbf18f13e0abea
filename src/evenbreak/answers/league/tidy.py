"""A league's results as one list: what was merged, changed and left out, and what is doubtful."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.files.league.sources import Change, LeagueResults, alias_lines
from evenbreak.files.tables.names import KnownNames
from evenbreak.files.tables.problems import source_of_form
from evenbreak.ratings.results_frame import FORMATS
from evenbreak.words import listed

if TYPE_CHECKING:
    import pandas as pd

    from evenbreak.ratings.results import Results

MOST_SHOWN = 20
"""How many changes are shown; a file or JSON has all."""

_SIDES = np.array(["", "a", "b"], dtype=object)
_ORDER = (
    *("date", "event", "division", "team_a", "player_a", "level_a", "team_b", "player_b"),
    *("level_b", "race_a", "race_b", "score_a", "score_b", "winner", "first_break"),
    *("break_format", "racks", "forfeit"),
)


def tidy_answer(
    found: LeagueResults, *, answers: Mapping[str, str] | None = None, roster: Sequence[str] = ()
) -> Answer:
    """Return what was done to a league's results.

    `answers` are the names just confirmed, with what they mean: lines to keep.
    """
    changes: Counter[str] = Counter(change.kind for change in found.changes)
    matches = count_of(len(found.results), "match", "matches")
    sources = listed([f"{n:,} from {source}" for source, n in found.sources])
    played = np.unique([found.results.player_a, found.results.player_b])
    said = f"{matches} between {count_of(len(played), 'player')}: {sources}."
    left = [
        count_of(changes[kind], one, several)
        for kind, one, several in (
            ("double", "duplicate match", "duplicate matches"),
            (
                "left out",
                "row that isn't a match or can't be read",
                "rows that aren't matches or can't be read",
            ),
        )
        if changes[kind]
    ]
    parts: list[Part] = [said + (f" Left out: {listed(left)}." if left else "")]
    forfeits = found.results.given_away
    if many := int(forfeits.sum()):
        unknown = (
            many
            if found.results.winner is None
            else int((found.results.winner[forfeits] == 0).sum())
        )
        text = f"{count_of(many, 'forfeit')} among them; ratings don't count forfeits"
        if unknown:
            text += (
                f". The winner isn't given for {count_of(unknown, 'forfeit')}, so the table "
                f"leaves {'it' if unknown == 1 else 'them'} out. Add a winner column to the file"
            )
        parts.append(text + ".")
    if changes["doubt"]:
        parts.append(
            f"{count_of(changes['doubt'], 'match', 'matches')} may be in two files, with "
            f"different scores or without a date; both entries count until you correct a file."
        )
    if answers:
        parts += [
            "Put these lines below [aliases] in league.toml, so that you are not asked again:",
            Table("answers", columns_of("alias_line"), [(line,) for line in alias_lines(answers)]),
        ]
    doubts = [
        (doubt.names[0], doubt.matches[0], name, many)
        for doubt in found.name_doubts
        for name, many in zip(doubt.names[1:], doubt.matches[1:], strict=True)
    ]
    if doubts:
        lines = [(line,) for doubt in found.name_doubts for line in doubt.alias_lines()]
        parts += [
            "In each of these pairs, both names may be the same player; they were kept apart:",
            Table(
                "name_doubts", columns_of("tidy_name tidy_matches other_name other_matches"), doubts
            ),
            "If two names are the same player, put their line below [aliases] in league.toml. "
            'If they are two players, write "Name" = "Name" there for one of them.',
            Table("aliases", columns_of("alias_line"), lines),
        ]
    if roster and (strangers := _not_listed(found.results, roster)):
        parts += [
            "These players in the results aren't on the roster; next to each is the closest "
            "name there:",
            Table("not_on_roster", columns_of("tidy_name tidy_matches nearest_name"), strangers),
        ]
        if near := {name: other for name, _, other in strangers if other is not None}:
            parts += [
                "If two names are the same player, put their line below [aliases] in league.toml.",
                Table(
                    "roster_aliases", columns_of("alias_line"), [(x,) for x in alias_lines(near)]
                ),
            ]
    columns = columns_of("change_kind change_file change_line change_text")
    every = [(one.kind, one.source, one.line or None, str(one.text)) for one in found.changes]
    done = Table("changes", columns, every, most=MOST_SHOWN)
    short = list(_in_short(found.changes))
    is_short = len(short) < len(every)
    if every:
        parts.append(
            "What was changed or left out:"
            if len(short) <= MOST_SHOWN
            else f"The first {MOST_SHOWN} of {len(short):,} changes; --csv has all of them:"
        )
        parts.append(Table("", columns, short, most=MOST_SHOWN) if is_short else done)
    return Answer(
        f"{matches} from {count_of(len(found.sources), 'file')}",
        parts,
        details=[replace(done, title="Each of them:", most=None)] if is_short else [],
        csv=done,
        warnings=[*filter(source_of_form, found.file.warnings), *found.file.ties],
        data={"sources": [{"file": name, "matches": n} for name, n in found.sources]},
    )


def _in_short(changes: Sequence[Change]) -> Iterator[tuple[str, str, int | None, str]]:
    """Yield the changes for display, with the double matches of two files as one."""
    alike = Counter((one.source, one.first) for one in changes if one.kind == "double")
    said = set()
    for one in changes:
        files = one.source, one.first
        if one.kind != "double" or alike[files] == 1:
            yield one.kind, one.source, one.line or None, str(one.text)
        elif files not in said:
            said.add(files)
            where = "in this file again" if one.source == one.first else f"in {one.first} too"
            yield one.kind, one.source, None, f"{alike[files]:,} matches are {where}"


def _not_listed(results: Results, roster: Sequence[str]) -> list[tuple[str, int, str | None]]:
    """Return players who aren't on the list: name, matches, most similar name."""
    known = KnownNames(roster)
    sides = np.concatenate([results.player_a, results.player_b])
    played = np.bincount(sides, minlength=len(results.players))
    every = zip(results.players, played.tolist(), strict=True)
    return [
        (name, many, known.nearest(name))
        for name, many in every
        if many and known.place(name) is None
    ]


def results_frame(results: Results) -> pd.DataFrame:
    """Return matches as a table that `read_results` can read, sorted by date, undated ones last.

    Empty columns are left out.

    >>> from evenbreak.ratings import Results
    >>> results_frame(Results.from_names(["Ann"], ["Bo"], [7], [5])).columns.tolist()
    ['player_a', 'player_b', 'score_a', 'score_b']
    """
    import pandas as pd

    known = results.counted | (results.score_a + results.score_b > 0)
    known &= True if results.unscored is None else ~results.unscored
    shown: dict[str, Callable[[Any], Any]] = {
        **dict.fromkeys(("player_a", "player_b"), np.array(results.players, dtype=object).take),
        **dict.fromkeys(("winner", "first_break"), _SIDES.take),
        "break_format": np.array(FORMATS, dtype=object).take,
        "date": lambda days: _or_empty(days.astype(str), ~np.isnat(days)),
        "forfeit": lambda forfeits: np.where(forfeits, "yes", ""),
        **dict.fromkeys(("race_a", "race_b"), lambda race: _or_empty(race, race > 0)),
        **dict.fromkeys(("score_a", "score_b"), lambda score: _or_empty(score, known)),
    }
    stated = {name: values for name in _ORDER if (values := getattr(results, name)) is not None}
    columns = {name: shown.get(name, np.asarray)(values) for name, values in stated.items()}
    columns = {
        name: cells
        for name, cells in columns.items()
        if name.startswith(("player", "score")) or (cells != "").any()
    }
    frame = pd.DataFrame(columns)
    if results.date is not None:
        frame = frame.take(np.argsort(results.date, kind="stable"))
    return frame.reset_index(drop=True)


def _or_empty(values: Any, stated: Any) -> Any:
    return np.where(stated, values.astype(object), "")
