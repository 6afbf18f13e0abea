"""How a night changes a league's ratings by its own rule, and the list for next week."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.answers.columns.shown import points_or_new
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import count_of, some_of
from evenbreak.answers.league.nights import count_dates
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.files.tables.problems import quoted
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.rating_changes import MatchChange, RatingChanges
from evenbreak.ratings.roster import NOT_STATED

MOST_NAMES = 6
"""How many players who gained, and who lost, the first sentence names."""


def rating_changes_answer(
    moves: RatingChanges,
    last: RosterFile,
    tonight: ResultsFile,
    *,
    chart: Chart | None = None,
    found_chart: bool = False,
) -> Answer:
    """Return a night's rating changes with their reasons, and the list after it.

    Parameters
    ----------
    moves
        the changes.
    last, tonight
        the list before the night, and its results.
    chart
        the chart that set the races, if any.
    found_chart
        whether it was not given, but the only one that fits the scores.
    """
    order = _order(moves)
    csv = _list_for_files(moves, order, None if last.scale is None else last.scale.text)
    parts: list[Part] = [_in_words(moves), _reasons_table(moves, order), _list_table(moves, order)]
    if found_chart and chart is not None:
        parts.insert(
            1,
            f"The races come from {chart.name}, the system's only chart that fits all scores; use "
            "--chart for another one.",
        )
    return Answer(
        _heading(moves, last, tonight),
        parts,
        warnings=[*last.warnings, *tonight.warnings, *_night_warnings(moves, tonight, chart)],
        data={
            "system": moves.system.name,
            "scale": moves.system.scale.name,
            "points_per_doubling": moves.system.scale.points_per_doubling,
            "chart": None if chart is None else chart.name,
            "forfeits_left_out": moves.forfeits,
            "empty_left_out": moves.empty,
            "rows_left_out": tonight.skipped,
            "matches": _matches(moves),
        },
        csv=csv,
    )


def _heading(moves: RatingChanges, last: RosterFile, tonight: ResultsFile) -> str:
    """Return by which rule the list was changed, and what was left out."""
    out = [count_of(tonight.skipped, "bad row")] if tonight.skipped else []
    out += [count_of(moves.forfeits, "forfeit")] if moves.forfeits else []
    out += [f"{moves.empty:,} at 0-0"] if moves.empty else []
    played = count_of(len(moves.matches), "match", "matches")
    left_out = f" (left out: {', '.join(out)})" if out else ""
    nights = count_dates(tonight.results)
    by_night = f"Night by night, on {nights:,} dates\n" if nights > 1 else ""
    return (
        f"{tonight.source}: {played}{left_out}; {count_of(len(moves.before), 'player')} on "
        f"{last.source}\n{by_night}"
        f"System {moves.system.name}: {moves.system.in_words}{_newcomers(moves)}"
    )


def _newcomers(moves: RatingChanges) -> str:
    """Return how newcomers move, where the list has some and the system a rule for them."""
    steps, before = moves.system.newcomer_steps, moves.before.matches
    first = sum(matches for matches, _ in steps)
    if not ((before != NOT_STATED) & (before < first)).any():
        return ""
    stages = [
        f"{factor} times in the next {matches}"
        if stage
        else f"{factor} times as far in their first {matches} matches"
        for stage, (matches, factor) in enumerate(steps)
    ]
    return f"; newcomers move {', '.join(stages)}"


def _in_words(moves: RatingChanges) -> str:
    """Return who gained and who lost points, the largest changes first."""
    change = moves.after.rating - moves.before.rating
    order = sorted(range(len(change)), key=lambda k: (-abs(change[k]), moves.before.players[k]))
    sentences = []
    for verb, sign in (("Up", 1), ("Down", -1)):
        names = [
            f"{moves.before.players[k]} by {points_or_new(abs(change[k]))}"
            for k in order
            if sign * change[k] > 0
        ]
        if names:
            sentences.append(f"{verb}: {some_of(names, MOST_NAMES)}.")
    played = (moves.won + moves.lost > 0) & (change == 0)
    if played.any():
        sentences.append(f"Unchanged: {count_of(int(played.sum()), 'player')} who played.")
    return " ".join(sentences) or "Nobody's rating changed."


def _order(moves: RatingChanges) -> list[int]:
    """Return the places of the players, the strongest first, those without a rating last."""
    after = moves.after

    def key(place: int) -> tuple[bool, float, str]:
        rating = float(after.rating[place])
        new = math.isnan(rating)
        return new, 0.0 if new else -rating, after.players[place]

    return sorted(range(len(after)), key=key)


def _list_for_files(moves: RatingChanges, order: Sequence[int], scale: str | None) -> Table:
    """Return the list after a night as files hold it, a roster with more columns."""
    before, after = moves.before, moves.after
    why = _reasons(moves)
    columns: dict[str, list[Any]] = {
        "player": list(after.players),
        "rating": _numbers(after.rating),
        "standard_error": _stated(after.standard_error),
        "games": _stated(after.games),
        "component": [one or None for one in after.component.tolist()],
        "matches": _stated(after.matches),
        "rating_before": _numbers(before.rating),
        "change": _numbers(after.rating - before.rating),
        "matches_won": moves.won.tolist(),
        "matches_lost": moves.lost.tolist(),
        "why": ["; ".join(why.get(place, ())) for place in range(len(after))],
        "scale": [scale] * len(after),
    }
    rows = [[values[place] for values in columns.values()] for place in order]
    return Table("players", in_files(columns), rows)


def _stated(values: NDArray[Any]) -> list[Any]:
    return [None if one == NOT_STATED or one != one else one for one in values.tolist()]


def _numbers(values: NDArray[np.float64]) -> list[float | int | None]:
    """Return points: whole ones as ints where all are whole, as leagues print them."""
    known = values[~np.isnan(values)]
    whole = bool((known == np.floor(known)).all())
    return [None if math.isnan(one) else int(one) if whole else one for one in values.tolist()]


def _reasons_table(moves: RatingChanges, order: Sequence[int]) -> Table:
    """Return who played, how their ratings changed and why, a line a match."""
    why = _reasons(moves)
    rows: list[tuple[Any, ...]] = []
    for place in order:
        was, now = float(moves.before.rating[place]), float(moves.after.rating[place])
        for number, reason in enumerate(why.get(place, ())):
            name = moves.after.players[place]
            rows.append((*((None,) * 4 if number else (name, was, now, now - was)), reason))
    columns = columns_of("player rating_before rating_now change why")
    return Table("", columns, rows)


def _list_table(moves: RatingChanges, order: Sequence[int]) -> Table:
    games = _stated(moves.after.games)
    rows = [
        (rank, moves.after.players[place], float(moves.after.rating[place]), games[place])
        for rank, place in enumerate(order, 1)
    ]
    columns = columns_of("rank player rating games", show={"rating": points_or_new})
    return Table("", columns, rows, "The new list:")


def _reasons(moves: RatingChanges) -> dict[int, list[str]]:
    """Return for the place of each player who played what each of their matches was."""
    players = moves.before.players
    reasons: dict[int, list[str]] = {}
    for match in moves.matches:
        won, lost = _score(match, 1), _score(match, -1)
        reasons.setdefault(match.winner, []).append(f"beat {players[match.loser]}{won}")
        reasons.setdefault(match.loser, []).append(f"lost to {players[match.winner]}{lost}")
    return reasons


def _score(match: MatchChange, turn: int) -> str:
    """Return the score and race of a match, the winner's first (1) or the loser's (-1)."""
    text = ""
    if match.games is not None:
        mine, other = match.games[::turn]
        text += f" {mine}-{other}"
    if match.race is not None:
        mine, other = match.race[::turn]
        text += f" (race {mine}:{other})"
    return text


def _matches(moves: RatingChanges) -> list[dict[str, Any]]:
    players = moves.before.players
    return [
        {
            "winner": players[match.winner],
            "loser": players[match.loser],
            "games": match.games,
            "race": match.race,
            "race_by_chart": match.by_chart,
            "points": match.points,
        }
        for match in moves.matches
    ]


def _night_warnings(
    moves: RatingChanges, tonight: ResultsFile, chart: Chart | None
) -> Iterator[str]:
    """Yield the races that the chart does not have."""
    if chart is None:
        return
    players = moves.before.players
    for match in moves.matches:
        if match.race is None or match.race == match.by_chart or match.by_chart is None:
            continue
        winner, loser = match.winner, match.loser
        yield (
            f"{tonight.source}:{tonight.lines[match.row]}: {quoted(players[winner])} - "
            f"{quoted(players[loser])} played a race {match.race[0]}:{match.race[1]}, but the "
            f"chart {chart.name} has {match.by_chart[0]}:{match.by_chart[1]} for "
            f"{match.ratings[0]:g} and {match.ratings[1]:g}"
        )
