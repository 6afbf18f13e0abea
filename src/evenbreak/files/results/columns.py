"""The columns of results files: what each may be called, and which they are by other titles.

The latter is made only for a message: the option --columns to paste. Whoever pastes it trusts it,
so columns are proposed only if their cells can be nothing else, row by row; otherwise none are.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Collection, Sequence
from functools import partial
from itertools import combinations, pairwise

from evenbreak.files.tables.dates import Day
from evenbreak.files.tables.names import Name
from evenbreak.files.tables.schema import Schema, Text, Whole, Word, YesNo
from evenbreak.matches.formats import BETWEEN
from evenbreak.ratings.results_frame import FORFEIT_WORDS, FORMAT_WORDS, letters
from evenbreak.words import Parameter, say

NAMES = ("player_a", "player_b")

_SCORE_WITHOUT = (
    "race_a race_b winner",
    "race winner",
    "racks",
    "score",
    "winner_score loser_score winner loser",
    "winner_race loser_race winner loser",
)
_WINNER_AND_LOSER = ("winner loser",)
_GAMES = Whole(needed=True, instead=_SCORE_WITHOUT, empty=None)
_RACE = Whole(least=1, empty=None, write=say("1, 2, 3, ..., or leave both races empty"))
_NFC = Text(form=partial(unicodedata.normalize, "NFC"))


def _without_blanks(text: str) -> str:
    return "".join(text.casefold().split())


RESULTS = Schema(
    "matches",
    player_a=Name(
        "player 1, player a name, home, home player, a",
        "one of the two players; neither of them is assumed to have broken",
        needed=True,
        instead=_WINNER_AND_LOSER,
    ),
    player_b=Name(
        "player 2, player b name, away, away player, b",
        "the other",
        needed=True,
        instead=_WINNER_AND_LOSER,
    ),
    score_a=_GAMES.called(
        "score 1, games a, games 1, home score, frames a, racks won a", "the games that a won"
    ),
    score_b=_GAMES.called(
        "score 2, games b, games 2, away score, frames b, racks won b", "the games that b won"
    ),
    date=Day("day, match date, played, played on"),
    race_a=_RACE.called(
        "race 1, race to a, needs a, home race",
        "the games that player a needed. The winner is then the player who reached the race, "
        "whatever the scores",
    ),
    race_b=_RACE.called("race 2, race to b, needs b, away race", "the same of player b"),
    winner=Text(
        "won by, match winner, winning player, winner name",
        "the winner of the match: `a`, `b`, or a name; checked against scores and races",
    ),
    first_break=Text(
        "first breaker, breaks first, lag won by",
        "the player who broke first: `a`, `b`, or a name",
    ),
    break_format=Word(
        "who breaks, breaks next",
        "who breaks the next rack",
        values=FORMAT_WORDS,
        choices=say("winner, loser, alternate, a or b"),
    ),
    racks=Text(
        "rack winners, games in order",
        "the winner of each rack, in order: `abba`; checked against the scores",
        form=_without_blanks,
    ),
    event=_NFC.called("tournament, competition, league"),
    team_a=_NFC.called(
        "team 1, home team",
        "the team of player a; ratings use it if it "
        "[clearly helps](../explanation/ratings.md#what-the-file-knows)",
    ),
    team_b=_NFC.called("team 2, away team", "the team of player b"),
    division=_NFC.called(
        "class, flight", "the division or class in which the match was played; used like the team"
    ),
    level_a=_NFC.called(
        "level 1, skill level a, skill level 1, class a, class 1, rating a",
        "the class, skill level or rating by which the league handicapped player a that day: `B`, "
        "`5` or `87`; `validate` says what a class is worth, and which "
        "[chart](../how-to/can-i-trust-the-ratings.md#handicaps) the races come from",
    ),
    level_b=_NFC.called(
        "level 2, skill level b, skill level 2, class b, class 2, rating b", "that of player b"
    ),
    forfeit=YesNo(
        "walkover, forfeited, no show, w/o",
        "forfeits are left out of the ratings, and counted",
        values=FORFEIT_WORDS,
    ),
)
"""The columns of a results file in the layout to which all others are brought."""

LAYOUTS = Schema(
    loser=Name(
        "losing player, loser name, lost by",
        "with `winner`, in place of the two players: player a is then the winner",
    ),
    score=Text(
        "result, final score, match score", "both scores in one cell: `7-5`, `7:5` or `7/5`"
    ),
    winner_score=Text(
        "winner games, winners score, games won by winner",
        "with `winner` and `loser`, in place of the two scores",
    ),
    loser_score=Text("loser games, losers score, games won by loser", "the same of the loser"),
    race=Text(
        "race to, match race",
        "in place of `race_a` and `race_b`: `7`, `race to 7`, or `7-5` if the players need "
        "different numbers",
    ),
    winner_race=Text("winner needs, winners race", "the same, with `winner` and `loser`"),
    loser_race=Text("loser needs, losers race", "the same of the loser"),
    winner_team=Text("winners team", "the team of the winner"),
    loser_team=Text("losers team", "the team of the loser"),
    winner_level=Text(
        "winners level, winner class, winner rating",
        "the class, skill level or rating of the winner",
    ),
    loser_level=Text("losers level, loser class, loser rating", "the same of the loser"),
)
"""The columns that are brought to that layout."""

RESULTS_FILE = RESULTS | LAYOUTS

WALKOVERS = ("walkover", "wo", "forfeit", "forfeited", "ff", "bye", "noshow", "dq", "default")
"""What stands in place of the score of a match that was not played."""

_SCORE = re.compile(rf"\d{{1,3}}\s*{BETWEEN}\s*\d{{1,3}}", re.ASCII)
_CLOCK = re.compile(r"([01]?\d|2[0-3])[:.][0-5]\d", re.ASCII)
_COUNT = re.compile(r"\d{1,3}", re.ASCII)
_DATE = re.compile(r"\d{1,4}([-/.])\d{1,2}\1\d{1,4}( .*|T.*)?", re.ASCII)

_FEW = 0.02
"""The share of rows that may be unlike the others: empty, or a match that ended level."""

_BACKWARD = (("b", "a"), ("2", "1"))
"""What tells titles apart that stand in the other order than usual."""

_ENOUGH_ROWS = 10
"""In so many rows some player has been on either side."""

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
    if it has them by other names, add columns "player_a=Heim,player_b=Gast,score=S"
    """
    columns = [
        (title, ["".join(row[place : place + 1]).strip() for row in rows])
        for place, title in enumerate(titles)
        if title.strip() and titles.count(title) == 1
    ]
    meant: dict[str, str] = {}
    missing = set()
    if not ({"player_a", "player_b"} <= set(known) or {"winner", "loser"} <= set(known)):
        missing |= {"players"}
        meant |= _players(_of_kind(columns, _is_name), known)
    if not {*known} & {"score", "racks"} and not {"score_a", "score_b"} <= set(known):
        missing |= {"scores"}
        meant |= _scores(columns, known, [meant.get(f"player_{side}", side) for side in "ab"])
    days = _of_kind(columns, _DATE.fullmatch)
    if len(days) == 1 and "date" not in known:
        meant["date"] = days[0][0]
    kinds = {
        "players" if name.startswith("player") else "scores" for name in meant.keys() - {"date"}
    }
    if not meant or kinds != missing:
        return say("add them; one column score, with 7-5 in a cell, takes the place of two")
    titles_by_name = ",".join(f"{name}={title.strip()}" for name, title in meant.items())
    quote = "'" if re.search(r'["$`\\!]', titles_by_name) else '"'
    return say(
        "if it has them by other names, add {columns} {titles}",
        columns=Parameter("columns"),
        titles=f"{quote}{titles_by_name}{quote}",
    )


def _of_kind(columns: Sequence[Column], fits: Callable[[str], object]) -> list[Column]:
    """Return the columns all of whose cells fit; hardly any is empty."""
    return [
        (title, cells)
        for title, cells in columns
        if all(map(fits, filter(None, cells))) and cells.count("") <= _FEW * len(cells) and cells
    ]


def _is_name(text: str) -> bool:
    return any(map(str.isalpha, text)) and not _DATE.fullmatch(text)


def _is_score(text: str) -> bool:
    return bool(_SCORE.fullmatch(text)) or letters(text) in WALKOVERS


def _players(columns: Sequence[Column], known: Collection[str]) -> dict[str, str]:
    """Return the two columns that share the most cells: players are on either side."""
    missing = [name for name in ("player_a", "player_b") if name not in known]
    if len(missing) == 1:
        return {missing[0]: columns[0][0]} if len(columns) == 1 else {}
    shared = [
        (len({*a[1]} & {*b[1]}), a[0], b[0])
        for a, b in combinations(columns, 2)
        if not any(pair == other for pair, other in zip(a[1], b[1], strict=True))
    ]
    most = max((pair[0] for pair in shared), default=0)
    best = [pair for pair in shared if pair[0] == most]
    if len(best) != 1:
        return {}
    _, a, b = best[0]
    cells = {title: {*each} for title, each in columns}
    if len(columns[0][1]) < _ENOUGH_ROWS:  # clubs may be on either side as often as players
        sure = len(columns) == 2 or cells[a] == cells[b]
    else:
        sure = most > 0
    if not sure or len(cells[a] | cells[b]) < max(map(len, cells.values())):
        return {}
    return (
        {"player_a": b, "player_b": a}
        if _marks(a, b) in _BACKWARD
        else {"player_a": a, "player_b": b}
    )


def _scores(
    columns: Sequence[Column], known: Collection[str], players: Sequence[str]
) -> dict[str, str]:
    """Return the only column of scores, or the only two columns of games won by either."""
    scores = [
        column
        for column in _of_kind(columns, _is_score)
        if any(map(_SCORE.fullmatch, column[1])) and not _of_kind([column], _CLOCK.fullmatch)
    ]
    missing = [name for name in ("score_a", "score_b") if name not in known]
    if scores or len(missing) == 1:
        return {"score": scores[0][0]} if len(scores) == 1 and len(missing) == 2 else {}
    counts = [
        column for column in _of_kind(columns, _COUNT.fullmatch) if not _is_running(column[1])
    ]
    # Two others that could be scores too, such as the races, leave it open which are.
    pairs = [(a, b) for a, b in combinations(counts, 2) if _can_be_scores(a, b)]
    named = [pair for pair in pairs if _have_titles_of_one_form(*pair)]
    if len(named) != 1 or any({a[0], b[0]}.isdisjoint({*dict(named[0])}) for a, b in pairs):
        return {}
    a, b = (title for title, _ in named[0])
    if _turned(_marks(a, b), _marks(*players)):
        a, b = b, a
    return {"score_a": a, "score_b": b}


def _is_running(cells: Sequence[str]) -> bool:
    """Return whether each cell is more than the one above, as in a column of numbers of matches."""
    numbers = [int(cell) for cell in cells if cell]
    return len(numbers) > 2 and all(a < b for a, b in pairwise(numbers))


def _have_titles_of_one_form(a: Column, b: Column) -> bool:
    """Return whether two titles are alike but for a part of each, as Punkte A and Punkte B are."""
    marks = _marks(a[0], b[0])
    shared = len(a[0].strip()) - len(marks[0])
    return all(marks) and max(map(len, marks)) <= shared


def _can_be_scores(a: Column, b: Column) -> bool:
    """Return whether hardly a match would end level with these scores."""
    level = sum(one == other for one, other in zip(a[1], b[1], strict=True))
    return level <= _FEW * len(a[1])


def _marks(a: str, b: str) -> tuple[str, str]:
    """Return what tells two titles apart: a and b of Punkte A and Punkte B."""
    one, other = a.casefold().strip(), b.casefold().strip()
    front = _alike(one, other)
    back = _alike(one[front:][::-1], other[front:][::-1])
    return one[front : len(one) - back], other[front : len(other) - back]


def _alike(one: str, other: str) -> int:
    """Return with how many letters both begin."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((k for k, (x, y) in pairs if x != y), min(len(one), len(other)))


def _turned(scores: tuple[str, str], players: tuple[str, str]) -> bool:
    """Return whether the scores stand the other way around than the players."""

    def alike(k: int, n: int) -> bool:
        one, other = scores[k].strip(), players[n].strip()
        return bool(one and other) and (one.startswith(other) or other.startswith(one))

    if alike(0, 0) or alike(1, 1):
        return False
    if alike(0, 1) or alike(1, 0):
        return True
    return scores in _BACKWARD
