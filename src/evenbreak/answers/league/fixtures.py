"""A league's fixtures: who plays who, where and when, or which are still to be played."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.league.tables.fixtures import Fixture


def fixtures_answer(
    listed: Sequence[Fixture],
    *,
    who: str = "player",
    played: int | None = None,
    only: str = "",
    warnings: Sequence[str] = (),
) -> Answer:
    """Return fixtures, played by `who`, 'player' or 'team'; `only` is whose, '' for everyone's.

    >>> from evenbreak.league.tables.fixtures import fixtures
    >>> print(fixtures_answer(fixtures(["Ann", "Bo", "Cy", "Di"])).sentences[0])
    Each of the 4 players plays 3 matches, 1 or 2 of them at home.
    """
    table = fixtures_table(listed)
    days = sorted({one.date for one in listed if one.date is not None})
    rounds = sorted({one.round for one in listed})
    heading = f"{count_of(len(listed), 'match', 'matches')} in {count_of(len(rounds), 'round')}"
    if days:
        heading += f", {days[0]:%a} {days[0]} to {days[-1]:%a} {days[-1]}"
    parts: list[Part] = [_in_words(listed, who, played, only), table]
    return Answer(
        heading,
        parts,
        details=[byes] if (byes := _byes(listed)).rows else [],
        data={} if played is None else {"played": played},
        warnings=warnings,
        csv=table,
    )


def fixtures_table(listed: Sequence[Fixture]) -> Table:
    """Return rows for fixtures; in files, with all the columns that fixture lists have."""
    shown = {
        "fixture_date": any(one.date for one in listed),
        "venue": any(one.venue for one in listed),
        "table": any(one.table for one in listed),
        "turn": any(one.turn > 1 for one in listed),
    }
    keys = ["round", "fixture_date", "home", "away", "venue", "table", "turn"]
    columns = [column_of(("" if shown.get(key, True) else "-") + key) for key in keys]
    rows = [
        [one.round, one.date, one.home, one.away, one.venue, one.table or None, one.turn]
        for one in listed
    ]
    return Table("fixtures", columns, rows)


def _in_words(listed: Sequence[Fixture], who: str, played: int | None, only: str) -> str:
    names = {name for one in listed for name in (one.home, one.away)}
    if played is not None:
        if not listed:
            return f"{count_of(played, 'match', 'matches')} played; none are left."
        left = Counter(name for one in listed for name in (one.home, one.away))
        most = max(left.values())
        last = [name for name, many in left.items() if many == most]
        return (
            f"{count_of(played, 'match', 'matches')} played, {len(listed)} left; "
            + (f"{last[0]} has" if len(last) == 1 else f"{len(last)} {who}s have")
            + f" the most to play: {most}."
        )
    home = Counter(one.home for one in listed)
    if only:
        matches = count_of(len(listed), "match", "matches")
        return f"{only} plays {matches}, {home[only]} of them at home."
    all_of = Counter(name for one in listed for name in (one.home, one.away))
    return (
        f"Each of the {len(names)} {who}s plays {_range(all_of, names)} matches, "
        f"{_range(home, names)} of them at home."
    )


def _range(counts: Counter[str], names: set[str]) -> str:
    low, high = min(counts[name] for name in names), max(counts[name] for name in names)
    return f"{low}" if low == high else f"{low} or {high}"


def _byes(listed: Sequence[Fixture]) -> Table:
    names = sorted({name for one in listed for name in (one.home, one.away)})
    busy: defaultdict[int, set[str]] = defaultdict(set)
    for one in listed:
        busy[one.round] |= {one.home, one.away}
    rows = [[week, name] for week in sorted(busy) for name in names if name not in busy[week]]
    return Table("byes", columns_of("round name"), rows, title="Byes")
