"""A league's standings: who leads, and how ties on points are broken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.league.tables.rules import (
    DIFFERENCE,
    FORFEITS,
    HEAD_TO_HEAD,
    POINTS,
    SCORED,
    WIN_SHARE,
    WINS,
    TableRules,
)
from evenbreak.league.tables.table import LeagueTable
from evenbreak.words import listed

_SPLITS = {
    "apa_8ball": "3 points a set, as the APA splits them in 8-ball",
    "apa_9ball": "20 points a set, as the APA splits them in 9-ball",
}


def table_answer(
    table: LeagueTable,
    *,
    earlier: LeagueTable | None = None,
    who: str = "player",
    score: str = "games",
    about: str = "",
    warnings: Sequence[str] = (),
) -> Answer:
    """Return a league's standings, with changes in place if given those before the last day.

    `score` is 'games' or 'sets'; `about` is what is counted, such as 'Matches at home'.

    >>> from evenbreak.league import league_table, player_matches
    >>> from evenbreak.ratings import Results
    >>> season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [5, 5, 5], [3, 1, 4])
    >>> print(table_answer(league_table(player_matches(season))).sentences[0])
    Bo leads with 2 points from 2 matches, tied with Ann and Cy but ahead on games won minus lost.
    """
    rows = table_rows(table, earlier, who=who, score=score)
    return Answer(
        f"{count_of(len(table), who)}, {count_of(int(table.played.sum()) // 2, 'match', 'matches')}"
        f"{f' ({about})' if about else ''}\n{rules_words(table.rules, sets=score == 'sets')}",
        [_leader(table, score), rows],
        data={"rules": _rules_data(table.rules)},
        warnings=warnings,
        csv=rows,
    )


def table_rows(
    table: LeagueTable, earlier: LeagueTable | None = None, *, who: str, score: str
) -> Table:
    """Return the rows of the standings, first place at the top; see `table_answer`."""
    before = {} if earlier is None else dict(zip(earlier.names, earlier.place, strict=True))
    values: dict[str, Any] = {
        "table_place": table.place,
        "place_before": [before.get(name) for name in table.names],
        "side_of_table": table.names,
        "points": table.points,
        "played": table.played,
        "table_won": table.won,
        "drawn": table.drawn,
        "table_lost": table.lost,
        "scored_conceded": zip(table.scored.tolist(), table.conceded.tolist(), strict=True),
        "score_difference": table.difference,
        "forfeits": table.forfeits,
        "decided_by": [_DECIDED.get(rule, "").format(score=score) for rule in _ties(table)],
    }
    hidden = {
        "place_before": earlier is None,
        "drawn": not table.drawn.any(),
        "forfeits": not table.forfeits.any(),
        "decided_by": not any(_ties(table)),
    }
    columns = [
        column_of(("-" if hidden.get(key) else "") + key, who=who, what=score) for key in values
    ]
    lists = [_plain(one) for one in values.values()]
    return Table("table", columns, [list(row) for row in zip(*lists, strict=True)])


def _plain(values: Any) -> list[Any]:
    """Return a column as Python numbers; points are ints if all of them are whole."""
    if not isinstance(values, np.ndarray):
        return [one.item() if isinstance(one, np.generic) else one for one in values]
    if values.dtype == float and (values % 1.0 == 0.0).all():
        values = values.astype(np.int64)
    return list(values.tolist())


def _ties(table: LeagueTable) -> list[str]:
    """Return what puts each ahead of the next with equal points; '' if points decide."""
    rules = [*table.decided_by[1:], ""]
    return ["" if rule == POINTS else rule for rule in rules]


_DECIDED = {
    HEAD_TO_HEAD: "head to head",
    DIFFERENCE: "{score} won minus lost",
    SCORED: "{score} won",
    WINS: "matches won",
    WIN_SHARE: "share won",
    FORFEITS: "fewer forfeits",
    POINTS: "points",
}


def _leader(table: LeagueTable, score: str) -> str:
    first, points = table.names[0], table.points
    many = int(table.level[0])
    if not table.played.any():
        return "No match has been played yet."
    if many > 1:
        return (
            f"{listed(table.names[:many])} share first place with "
            f"{_number_of(points[0], 'point')}; no tiebreaker separates them."
        )
    text = (
        f"{first} leads with {_number_of(points[0], 'point')} from "
        f"{count_of(int(table.played[0]), 'match', 'matches')}"
    )
    equal = [
        name for name, own in zip(table.names[1:], points[1:], strict=True) if own == points[0]
    ]
    if equal:
        rule = table.decided_by[1]
        ahead = _DECIDED[rule].format(score=score)
        return f"{text}, tied with {listed(equal)} but ahead on {ahead}."
    if len(table) > 1 and points[0] > points[1]:
        return f"{text}, {points[0] - points[1]:g} ahead of {table.names[1]}."
    return f"{text}."


def _number_of(number: float, one: str) -> str:
    return f"{number:g} {one}{'' if number == 1.0 else 's'}"


def rules_words(
    rules: TableRules, *, sets: bool, level: str = "tied on points", last: str = "a shared rank"
) -> str:
    """Return the rules for the standings, in words.

    >>> rules_words(TableRules(3, 1, 0, ties=("head-to-head",)), sets=False)
    '3 points for a win, 1 for a draw, 0 for a loss; tied on points: the matches among those tied, a
    shared rank'
    """
    unit = "set" if sets else "game"
    text = f"{rules.win:g} points for a win, {rules.draw:g} for a draw, {rules.loss:g} for a loss"
    if rules.split:
        text = _SPLITS[rules.split]
    elif rules.win == 0.0:
        text = f"1 point for each {unit}" if rules.a_set == 1.0 else f"points for {unit}s"
    elif rules.a_set:
        text += f", {rules.a_set:g} for each {unit}"
    if rules.shutout:
        text += f", {rules.shutout:g} for a shutout"
    named = {
        **_DECIDED,
        HEAD_TO_HEAD: "the matches among those tied",
        WIN_SHARE: "the share of matches won",
    }
    ties = [named[tie].format(score=f"{unit}s") for tie in rules.ties]
    first = "ranked by" if POINTS in rules.ties else level
    return f"{text}; {first}: {', '.join([*ties, last])}"


def _rules_data(rules: TableRules) -> dict[str, Any]:
    return {
        "win": rules.win,
        "draw": rules.draw,
        "loss": rules.loss,
        "each_game_or_set": rules.a_set,
        "shutout": rules.shutout,
        "split": rules.split,
        "ties": list(rules.ties),
    }
