"""Guessing which columns of a results file are the players and scores if titles are unknown.

The guess is only used in a message: a --columns option to paste. People who paste it trust it, and
a wrong guess would turn every winner into a loser, or points into games. So the titles must say
which side is which, and the rows must fit only one reading; if two readings fit, both are shown and
neither is proposed.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from evenbreak.files.tables.sided_titles import order_of
from evenbreak.files.tables.titles import BYE, FORFEIT, NOT_GAMES, key_of
from evenbreak.matches.formats import BETWEEN
from evenbreak.words import Parameter, joined, say

_SCORE = re.compile(rf"(\d{{1,2}})\s*{BETWEEN}\s*(\d{{1,2}})", re.ASCII)
_CLOCK = re.compile(r"([01]?\d|2[0-3])[:.][0-5]\d", re.ASCII)
_COUNT = re.compile(r"\d{1,2}", re.ASCII)
_DATE = re.compile(r"\d{1,4}([-/.])\d{1,2}\1\d{1,4}( .*|T.*)?", re.ASCII)

_FEW = 0.02
"""The share of rows that may be exceptions: empty, or a match that ended level."""

_MANY_TIES = 0.4
"""Two columns that are equal in a larger share of rows are unlikely to be scores."""

_ENOUGH_ROWS = 10
"""With this many rows, some player has been on both sides, and the two scores overlap."""

_MOST_READINGS = 4
"""No more than this many are shown."""


@dataclass(frozen=True, eq=False)
class _Column:
    """A column in the file: its title and cells, and whether it still has no meaning."""

    title: str
    cells: list[str]
    free: bool

    def all_are(self, fits: Callable[[str], object]) -> bool:
        """Return whether all cells match; few are empty or say that nothing was played."""
        stated = [cell for cell in self.cells if cell and not _is_status(cell)]
        empty = len(self.cells) - len(stated)
        return bool(stated) and empty <= max(_FEW, 0.2) * len(self.cells) and all(map(fits, stated))

    def numbers(self) -> list[int]:
        """Return its numbers; -1 for cells without one."""
        return [int(cell) if _COUNT.fullmatch(cell) else -1 for cell in self.cells]


_Pair = tuple[_Column, _Column]
Reading = Mapping[str, str]


TEAMS = {"player_a": "home", "player_b": "away", "score_a": "home_score", "score_b": "away_score"}
"""What the columns are called in team results."""


def columns_hint(
    places: Mapping[str, int],
    titles: Sequence[str],
    rows: Sequence[Sequence[str]],
    called: Mapping[str, str] | None = None,
) -> str:
    """Return what to do about missing columns for players and scores.

    `places` are the places of columns with known names; `called` has the names that differ from
    those in player results.

    >>> print(columns_hint({}, ["Sp H", "Sp G", "S"], [["Ann", "Bo", "7-5"]]))
    If they have other names, add columns "player_a=Sp H,player_b=Sp G,score=S"
    """
    called = called or {}
    names = {name: own for own, name in called.items()}
    known = {names.get(name, name): place for name, place in places.items()}
    readings = [
        {called.get(name, name): title for name, title in reading.items()}
        for reading in readings_of(known, titles, rows)
    ]
    if not places and not readings:
        return say(
            "Is this the right file? Results have one match per row: {columns}.",
            columns=",".join(called.get(name, name) for name in TEAMS),
        )
    if not 0 < len(readings) <= _MOST_READINGS:
        return say(
            "Add them. A single score column, with cells such as 7-5, can replace the "
            "two score columns."
        )
    options = [_option(reading) for reading in readings]
    if len(options) == 1:
        return say(
            "If they have other names, add {columns} {titles}",
            columns=Parameter("columns"),
            titles=options[0],
        )
    return say(
        "They can be read in {n} ways. Look at a match that you know, and add {columns} "
        "with one of {titles}.",
        n=len(options),
        columns=Parameter("columns"),
        titles=joined(options, " "),
    )


def _option(reading: Reading) -> str:
    titles = ",".join(f"{name}={title.strip()}" for name, title in reading.items())
    quote = "'" if re.search(r'["$`\\!]', titles) else '"'
    return f"{quote}{titles}{quote}"


def readings_of(
    places: Mapping[str, int], titles: Sequence[str], rows: Sequence[Sequence[str]]
) -> list[Reading]:
    """Return every way of reading the file that its titles and rows allow."""
    names = {place: name for name, place in places.items()}
    known: dict[str, _Column] = {}
    free = []
    for k, title in enumerate(titles):
        column = _Column(title, ["".join(row[k : k + 1]).strip() for row in rows], k not in names)
        if k in names:
            known[names[k]] = column
        elif title.strip() and titles.count(title) == 1:
            free.append(column)
    scored = {"score", "racks"} & known.keys() or {"score_a", "score_b"} <= known.keys()
    found: dict[frozenset[tuple[str, str]], Reading] = {}
    for pair in _player_pairs(free, known):
        players = {f"player_{s}": c.title for s, c in zip("ab", pair, strict=True) if c.free}
        for score in [{}] if scored else _score_readings(free, known, pair):
            # Two players who change places together with their scores are the same reading.
            games = [score.get(f"score_{side}", side) for side in "ab"]
            sides = frozenset(zip((one.title for one in pair), games, strict=True))
            found.setdefault(
                sides | {*score.items()} if "score" in score else sides, {**players, **score}
            )
    days = [column for column in free if column.all_are(_DATE.fullmatch)]
    date = {"date": days[0].title} if len(days) == 1 and "date" not in known else {}
    return [{**reading, **date} for reading in found.values() if reading]


def _is_status(text: str) -> bool:
    return key_of(text) in FORFEIT | BYE


def _is_name(text: str) -> bool:
    return any(map(str.isalpha, text)) and not _DATE.fullmatch(text)


def _is_score(text: str) -> bool:
    return bool(_SCORE.fullmatch(text))


# Players.


def _player_pairs(free: Sequence[_Column], known: Mapping[str, _Column]) -> list[_Pair]:
    """Return the pairs of columns that can be the players; in both orders if titles don't say."""
    if {"winner", "loser"} <= known.keys():
        return [(known["winner"], known["loser"])]
    a, b = (known.get(f"player_{side}") for side in "ab")
    if a is not None and b is not None:
        return [(a, b)]
    names = [column for column in free if column.all_are(_is_name)]
    if a is not None or b is not None:
        return _finest([pair for one in names if _can_meet(pair := (a or one, b or one))])
    pairs = [pair for pair in combinations(names, 2) if _can_meet(pair)]
    if len(names) > 2 and len(names[0].cells) < _ENOUGH_ROWS and len(pairs) == 1:
        return []  # clubs may be on either side as often as players
    return [turned for pair in _finest(pairs) for turned in _turns(pair)]


def _turns(pair: _Pair) -> list[_Pair]:
    """Return a pair with the first side first; both orders if the titles don't say."""
    order = order_of(pair[0].title, pair[1].title)
    return [pair, pair[::-1]] if not order else [pair if order > 0 else pair[::-1]]


def _can_meet(pair: _Pair) -> bool:
    """Return whether two columns can be opponents: many players appear on both sides."""
    a, b = ([key_of(cell) for cell in column.cells] for column in pair)
    if any(one == other != "" for one, other in zip(a, b, strict=True)):
        return False
    either = min(len({*a}), len({*b}))
    return len(a) < _ENOUGH_ROWS or len({*a} & {*b}) > 0.2 * either


def _finest(pairs: Sequence[_Pair]) -> list[_Pair]:
    """Return the pairs, except those that only give the teams of another pair's players."""
    return [
        pair for pair in pairs if not any(_belong(other, pair) for other in pairs if other != pair)
    ]


def _belong(players: _Pair, teams: _Pair) -> bool:
    """Return whether each player is on one team, and most teams have several players."""
    team_of: dict[str, str] = {}
    squads = defaultdict(set)
    for column, teams_column in zip(players, teams, strict=True):
        for player, team in zip(column.cells, teams_column.cells, strict=True):
            if team_of.setdefault(player, team) != team or key_of(team) in key_of(player):
                return False
            squads[team].add(player)
    several = sum(len(squad) > 1 for squad in squads.values())
    return len(players[0].cells) >= _ENOUGH_ROWS and several > 0.5 * len(squads)


# Scores.


def _score_readings(
    free: Sequence[_Column], known: Mapping[str, _Column], players: _Pair
) -> Iterator[Reading]:
    """Yield the columns that can be the players' scores: one, or two."""
    for side, other in ("ab", "ba"):
        if f"score_{side}" in known:
            counts = [column for column in free if column.all_are(_COUNT.fullmatch)]
            for column in counts:
                both = {side: known[f"score_{side}"], other: column}
                if _are_scores((both["a"], both["b"]), known, players):
                    yield {f"score_{other}": column.title}
            return
    one_cell = [column for column in free if _is_score_column(column, known, players)]
    counts = [column for column in free if column.all_are(_COUNT.fullmatch)]
    counts = [column for column in counts if key_of(column.title) not in NOT_GAMES]
    if len(players[0].cells) >= _ENOUGH_ROWS:  # in fewer rows scores may rise by chance
        counts = [column for column in counts if not _is_running(column)]
    pairs = [*combinations(counts, 2)]
    named = [pair for pair in pairs if order_of(pair[0].title, pair[1].title)]
    good = [pair for pair in named if _are_scores(pair, known, players)]
    if not good and len(counts) == 2 and not one_cell:
        good = [pair for pair in pairs if _are_scores(pair, known, players)]
    if one_cell or good:  # none is sure as long as others are not ruled out
        good += [
            pair
            for pair in pairs
            if pair not in good
            and (pair in named or all({*pair}.isdisjoint(other) for other in named))
            and _may_be_scores(pair, players)
        ]
    for column in one_cell:
        yield {"score": column.title}
    for pair in good:
        for a, b in _orders(pair, known, players):
            yield {"score_a": a.title, "score_b": b.title}


def _orders(pair: _Pair, known: Mapping[str, _Column], players: _Pair) -> list[_Pair]:
    """Return two columns of games in the players' order; both orders if nothing says which."""
    won = [_agreement(turn, known, players) for turn in (pair, pair[::-1])]
    order = order_of(pair[0].title, pair[1].title)
    turned = pair if order >= 0 else pair[::-1]
    if max(won) > 0.9 and min(won) < 0.1:
        by_winner = pair if won[0] > won[1] else pair[::-1]
        return [by_winner] if not order or by_winner == turned else []
    # Players whose order is open come both ways already.
    sided = not all(column.free for column in players) or order_of(
        players[0].title, players[1].title
    )
    return [turned] if order or not sided else [pair, pair[::-1]]


def _is_running(column: _Column) -> bool:
    """Return whether numbers never fall, or never rise, like match numbers and weeks."""
    numbers = [int(cell) for cell in column.cells if _COUNT.fullmatch(cell)]
    if len(numbers) < 3:
        return False
    steps = [b - a for a, b in pairwise(numbers)]
    least = int(len(numbers) < _ENOUGH_ROWS)
    return min(steps) >= least or max(steps) <= -least


def _are_scores(pair: _Pair, known: Mapping[str, _Column], players: _Pair) -> bool:
    """Return whether two columns can be games won, judging by ties, races, winners and players."""
    a, b = (column.numbers() for column in pair)
    rows = [(m, n) for m, n in zip(a, b, strict=True) if m >= 0 and n >= 0]
    level = sum(m == n for m, n in rows)
    by_race = {"level_a", "level_b"} <= known.keys() or {"race_a", "race_b"} <= known.keys()
    few = _MANY_TIES if by_race else _FEW  # who needs fewer games wins at level scores
    if not rows or level > max(1, few * len(rows)) * (len(rows) > 3):
        return False
    shared_out = len({m + n for m, n in rows}) == 1
    if len(rows) > 4 and shared_out and (len({*map(max, rows)}) > 1 or 0 in map(min, rows)):
        return False  # points of a match, of which each is somebody's
    if "race_a" in known and "race_b" in known:
        races = zip(*(known[f"race_{side}"].numbers() for side in "ab"), strict=True)
        reached = [
            (m >= r) != (n >= s)
            for m, n, (r, s) in zip(a, b, races, strict=True)
            if min(m, n, r, s) >= 0
        ]
        if sum(reached) < (1 - _FEW) * len(reached):
            return False
    if "race" in known:
        goals = known["race"].numbers()
        over = [max(m, n) != r for m, n, r in zip(a, b, goals, strict=True) if min(m, n, r) >= 0]
        if sum(over) > _FEW * len(over):
            return False
    # Either way around: what rules out one order of the players must not leave the other.
    return not any(_is_of_player(column, player) for column in pair for player in players)


def _may_be_scores(pair: _Pair, players: _Pair) -> bool:
    """Return whether two columns may be scores: each side wins some."""
    a, b = (column.numbers() for column in pair)
    rows = [(m, n) for m, n in zip(a, b, strict=True) if m >= 0 and n >= 0]
    wins, losses = sum(m > n for m, n in rows), sum(m < n for m, n in rows)
    most, least = max(map(max, zip(*rows, strict=True))), min(map(max, zip(*rows, strict=True)))
    ties = len(rows) - wins - losses
    unlike = min(wins, losses) < 0.1 * len(rows) or most > 1.5 * least
    return not (
        ties > _MANY_TIES * len(rows)
        or (unlike and len(rows) >= _ENOUGH_ROWS)
        or all(_is_of_player(c, p) for c, p in zip(pair, players, strict=True))
    )


def _is_of_player(column: _Column, player: _Column) -> bool:
    """Return whether a number belongs to the player, like a level or rating."""
    values = defaultdict(list)
    for cell, name in zip(column.cells, player.cells, strict=True):
        values[name].append(cell)
    often = [cells for cells in values.values() if len(cells) > 2]
    return len(often) > 2 and sum(len({*cells}) == 1 for cells in often) > 0.8 * len(often)


def _is_score_column(column: _Column, known: Mapping[str, _Column], players: _Pair) -> bool:
    """Return whether a column has both scores in a cell, and isn't a time or a race."""
    if not column.all_are(_is_score) or column.all_are(_CLOCK.fullmatch):
        return False
    scores = [score for cell in column.cells if (score := _SCORE.fullmatch(cell))]
    pairs = [(int(score[1]), int(score[2])) for score in scores]
    if sum(m == n for m, n in pairs) > max(1, _FEW * len(pairs)):
        return False
    if "loser" in known and sum(m < n for m, n in pairs) > _FEW * len(pairs):
        return "race" in known
    meetings = defaultdict(list)
    for cell, *both in zip(column.cells, *(player.cells for player in players), strict=True):
        meetings[tuple(both)].append(cell)
    again = [cells for cells in meetings.values() if len(cells) > 1]
    return len(again) < 3 or any(len({*cells}) > 1 for cells in again)


def _agreement(pair: _Pair, known: Mapping[str, _Column], players: _Pair) -> float:
    """Return the share of rows in which the winner named in the file has more games."""
    if "winner" not in known:
        return 0.5
    fits = []
    rows = zip(
        known["winner"].cells,
        *(c.cells for c in players),
        *(c.numbers() for c in pair),
        strict=True,
    )
    for winner, a, b, m, n in rows:
        if winner in (a, b) and min(m, n) >= 0:
            fits.append((winner == a) == (m > n))
    return sum(fits) / len(fits) if fits else 0.5
