"""How a night changes a league's ratings under its own rule, and the list for next week."""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenbreak.answers.columns.shown import points_or_new
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files, table_by_column
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import count_of, some_of
from evenbreak.answers.league.sheet import places_in_list
from evenbreak.errors import DataError
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.files.tables.problems import Problems, quoted, quoted_list
from evenbreak.files.tables.similar_names import similar_names
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.night_table import SeasonSoFar, levels_alone, listed, published
from evenbreak.handicaps.systems.rating_changes import (
    MatchChange,
    RatingChanges,
    apply_results,
    night_problems,
)
from evenbreak.handicaps.systems.system import System
from evenbreak.league.sandbag_watch import PlayedNight, played_nights
from evenbreak.ratings.provisional import established_from
from evenbreak.ratings.results import Problem, Results
from evenbreak.ratings.roster import NOT_STATED, Roster
from evenbreak.words import Parameter, say

Races: TypeAlias = Chart | System
"""What sets races that the results don't state: a chart, or a system by its own rule."""

MOST_NAMES = 6
"""How many gainers, and how many losers, the first sentence names."""


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
    last, tonight
        the list before the night, and its results.
    chart
        the chart that set the races, if any.
    found_chart
        whether the chart wasn't given, but is the only one that fits the scores.
    """
    order = _order(moves)
    csv = _list_for_files(moves, order, None if last.scale is None else last.scale.text)
    parts: list[Part] = [_in_words(moves), _reasons_table(moves, order), _list_table(moves, order)]
    if found_chart and chart is not None:
        parts.insert(
            1,
            say(
                "The races come from {chart}, the system's only chart that fits all scores. Use "
                "{chart_option} for another chart.",
                chart=chart.name,
                chart_option=Parameter("chart"),
            ),
        )
    return Answer(
        _heading(moves, last, tonight),
        parts,
        warnings=[*last.warnings, *tonight.warnings, *_night_warnings(moves, tonight, chart)],
        data={
            "system": moves.system.name,
            "scale": None if moves.system.scale is None else moves.system.scale.name,
            "points_per_doubling": None
            if moves.system.scale is None
            else moves.system.scale.points_per_doubling,
            "chart": None if chart is None else chart.name,
            "forfeits_left_out": moves.forfeits,
            "empty_left_out": moves.empty,
            "rows_left_out": tonight.skipped,
            "matches": _matches(moves),
        },
        csv=csv,
    )


def _heading(moves: RatingChanges, last: RosterFile, tonight: ResultsFile) -> str:
    """Return the rule by which the list was changed, and what was left out."""
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
    """Return how newcomers move, if the list has any and the system has a rule for them."""
    if not isinstance(moves.system, StepSystem):
        return ""
    steps, before = moves.system.newcomer_steps, moves.before.matches
    first = sum(matches for matches, _ in steps)
    if not ((before != NOT_STATED) & (before < first)).any():
        return ""
    stages = [
        f"{factor} times as far in the next {matches}"
        if stage
        else f"{factor} times as far in their first {matches} matches"
        for stage, (matches, factor) in enumerate(steps)
    ]
    return f"; newcomers move {', and '.join(stages)}"


def _in_words(moves: RatingChanges) -> str:
    """Return who gained and who lost points, the largest changes first."""
    was, now = _numbers_of(moves)
    change = now - was
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
    return " ".join(sentences) or "No one's rating changed."


def _numbers_of(moves: RatingChanges) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what the system published before and after: ratings or levels."""
    return published(moves.system, moves.before), published(moves.system, moves.after)


def _order(moves: RatingChanges) -> list[int]:
    """Return the players in a list's order, unrated players last."""
    by_name = sorted(range(len(moves.after)), key=moves.after.players.__getitem__)
    order: list[int] = moves.after.strongest_first(by_name).tolist()
    return order


def _list_for_files(moves: RatingChanges, order: Sequence[int], scale: str | None) -> Table:
    """Return the list after a night as written to files: a roster with more columns."""
    after, why = moves.after, _reasons(moves)
    was, now = _numbers_of(moves)
    columns: dict[str, list[Any]] = {
        "player": list(after.players),
        **({} if np.array_equal(after.rating, after.level) else {"rating": _numbers(after.rating)}),
        **({} if np.isnan(after.level).all() else {"level": _numbers(after.level)}),
        "standard_error": _stated(after.standard_error),
        "games": _stated(after.games),
        "component": [one or None for one in after.component.tolist()],
        **({"provisional": after.provisional.tolist()} if after.provisional.any() else {}),
        "matches": _stated(after.matches),
        "rating_before": _numbers(was),
        "change": _numbers(now - was),
        "matches_won": moves.won.tolist(),
        "matches_lost": moves.lost.tolist(),
        "why": ["; ".join(why.get(place, ())) for place in range(len(after))],
        "scale": [scale] * len(after),
    }
    named = dict(zip(in_files(columns), columns.values(), strict=True))
    return table_by_column("players", named, order=order)


def _stated(values: NDArray[Any]) -> list[Any]:
    return [None if one == NOT_STATED or one != one else one for one in values.tolist()]


def _numbers(values: NDArray[np.float64]) -> list[float | int | None]:
    """Return points as leagues print them: as ints if all are whole numbers."""
    known = values[~np.isnan(values)]
    whole = bool((known == np.floor(known)).all())
    return [None if math.isnan(one) else int(one) if whole else one for one in values.tolist()]


def _reasons_table(moves: RatingChanges, order: Sequence[int]) -> Table:
    """Return who played, how their ratings changed and why, one line per match."""
    why = _reasons(moves)
    rows: list[tuple[Any, ...]] = []
    for place in order:
        was, now = (float(numbers[place]) for numbers in _numbers_of(moves))
        for number, reason in enumerate(why.get(place, ())):
            name = moves.after.players[place]
            rows.append((*((None,) * 4 if number else (name, was, now, now - was)), reason))
    columns = columns_of("player rating_before rating_now change why")
    return Table("", columns, rows)


def _list_table(moves: RatingChanges, order: Sequence[int]) -> Table:
    games, (_, now) = _stated(moves.after.games), _numbers_of(moves)
    places = places_in_list(moves.after.provisional[order])
    rows = [
        (at, moves.after.players[place], float(now[place]), games[place])
        for at, place in zip(places, order, strict=True)
    ]
    columns = columns_of("rank player rating games", show={"rating": points_or_new})
    few = moves.after.provisional.any()
    least = count_of(established_from(moves.after.games), "game")
    title = f"The new list (P: provisional, fewer than {least}):" if few else "The new list:"
    return Table("", columns, rows, title)


def _reasons(moves: RatingChanges) -> dict[int, list[str]]:
    """Return descriptions of each player's matches, by player place."""
    players = moves.before.players
    reasons: dict[int, list[str]] = {}
    for match in moves.matches:
        won, lost = _score(match, 1), _score(match, -1)
        reasons.setdefault(match.winner, []).append(f"beat {players[match.loser]}{won}")
        reasons.setdefault(match.loser, []).append(f"lost to {players[match.winner]}{lost}")
    return reasons


def _score(match: MatchChange, turn: int) -> str:
    """Return a match's score and race, the winner's first (1) or the loser's (-1)."""
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
    moves: RatingChanges, tonight: ResultsFile, chart: Races | None
) -> Iterator[str]:
    """Yield the races that aren't in the chart."""
    if chart is None:
        return
    players = moves.before.players
    for match in moves.matches:
        if match.race is None or match.race == match.by_chart or match.by_chart is None:
            continue
        winner, loser = match.winner, match.loser
        yield (
            f"{_place(tonight, match.row)}: {quoted(players[winner])} - "
            f"{quoted(players[loser])} played a race {match.race[0]}:{match.race[1]}, but the "
            f"chart {chart.name} has {match.by_chart[0]}:{match.by_chart[1]} for "
            f"{match.ratings[0]:g} and {match.ratings[1]:g}"
        )


def nights_of_files(
    system: System,
    first: RosterFile,
    season: ResultsFile,
    *,
    chart: Races | None = None,
    stated: bool = False,
) -> list[PlayedNight]:
    """Return a season night by night, with the ratings after each night.

    The chart sets races that the results don't state; `stated` uses the results' levels instead of
    the system's. Raises DataError naming every line that keeps the results from moving ratings.
    """
    problems: dict[str, None] = {}
    first = replace(first, roster=listed(system, first.roster))
    so_far = SeasonSoFar(system, first.roster)

    def of_night(list_: Roster, rows: NDArray[np.int64]) -> RatingChanges:
        # The season goes on without a night that has problems, so that all are listed at once.
        kept = rows
        if stated:
            list_ = _with_levels(list_, season.results.select(rows))
        while True:
            night = replace(
                season, results=season.results.select(kept), lines=_some(season.lines, kept)
            )
            try:
                return rating_changes_of_files(
                    system, replace(first, roster=list_), night, chart=chart, so_far=so_far
                )
            except DataError as error:
                problems.update(dict.fromkeys(error.problems))
                kept = kept[:0]

    nights = played_nights(system, first.roster, season.results, chart=chart, apply=of_night)
    if problems:
        raise DataError(_once(problems))
    return nights


def _line(file: ResultsFile, row: int) -> int | None:
    """Return a match's line; None if several files were read, because lines are per file."""
    return int(file.lines[row]) if len(file.lines) else None


def _place(file: ResultsFile, row: int) -> str:
    line = _line(file, row)
    return file.source if line is None else f"{file.source}:{line}"


def _some(lines: NDArray[np.int64], rows: NDArray[np.int64]) -> NDArray[np.int64]:
    return lines[rows] if len(lines) else lines


def has_levels(system: System, results: Results) -> bool:
    """Return whether results state the levels that a system publishes, for every match."""
    return system.publishes == "levels" and all(
        texts is not None and all(_NUMBER.fullmatch(text) for text in texts)
        for texts in (results.level_a, results.level_b)
    )


_NUMBER = re.compile(r"\d{1,3}(\.\d+)?", re.ASCII)


def _with_levels(list_: Roster, night: Results) -> Roster:
    """Return a list with the levels stated in a night's results."""
    level, place = list_.level.copy(), {name: at for at, name in enumerate(list_.players)}
    for players, texts in ((night.player_a, night.level_a), (night.player_b, night.level_b)):
        for player, text in zip(players.tolist(), () if texts is None else texts, strict=True):
            if (at := place.get(night.players[player])) is not None:
                level[at] = float(text)
    rating = level if levels_alone(list_) else list_.rating
    return replace(list_, level=level, rating=rating)


def rating_changes_of_season(
    system: System, first: RosterFile, season: ResultsFile, *, chart: Races | None = None
) -> RatingChanges:
    """Return how the results on one or several dates change a list's ratings.

    The ratings after each date set the races on the next date. Without dates, everything is one
    night.

    Parameters
    ----------
    system, first, season, chart
        as for `nights_of_files`.

    Raises
    ------
    DataError
        as `nights_of_files` does.
    """
    first = replace(first, roster=listed(system, first.roster))
    if count_dates(season.results) < 2:
        return rating_changes_of_files(system, first, season, chart=chart)
    nights = nights_of_files(system, first, season, chart=chart)
    changes = [night.changes for night in nights]
    return RatingChanges(
        system,
        changes[0].before,
        changes[-1].after,
        tuple(
            match._replace(row=int(rows[match.row]))
            for rows, change in nights
            for match in change.matches
        ),
        np.sum([change.won for change in changes], axis=0),
        np.sum([change.lost for change in changes], axis=0),
        sum(change.forfeits for change in changes),
        sum(change.empty for change in changes),
    )


def count_dates(results: Results) -> int:
    """Return how many dates have matches; 0 without dates.

    >>> count_dates(Results.from_names(["A"] * 2, ["B"] * 2, [5] * 2, [4] * 2))
    0
    """
    dates = results.date
    return 0 if dates is None else len(np.unique(dates[~np.isnat(dates)]))


def _once(problems: Iterable[str]) -> list[str]:
    """Return problems, leaving out those that differ from an earlier one only in their line."""
    first: dict[str, str] = {}
    for problem in problems:
        first.setdefault(problem.split(": ", 1)[-1], problem)
    return list(first.values())


def rating_changes_of_files(
    system: System,
    last: RosterFile,
    tonight: ResultsFile,
    *,
    chart: Races | None = None,
    so_far: SeasonSoFar | None = None,
) -> RatingChanges:
    """Return how a night's results change a list's ratings.

    Raises DataError naming each line that prevents it: players not on the list, a match without a
    winner.
    """
    results = tonight.results
    found = night_problems(system, last.roster, results, chart=chart)
    strangers = set(results.players).difference(last.roster.players)
    alike = _alike(strangers, last.roster.players)
    found = _told_once(found, results, [name for name in strangers if not alike[name]])
    problems = Problems(tonight.source)
    open_rows = [problem.row for problem in found if _needs_chart(problem, results, chart)]
    for problem in found:
        message = problem.message
        if problem.row in open_rows[1:]:
            continue
        if problem.row in open_rows and len(open_rows) > 1:
            message += say(
                " ({n_open_rows:,} such matches; {chart} NAME settles them all)",
                n_open_rows=len(open_rows),
                chart=Parameter("chart"),
            )
        message += _suggestion(alike.get(_player_of(problem, results), ()))
        problems.add(_line(tonight, problem.row), message)
    problems.raise_any()
    return apply_results(system, last.roster, results, chart=chart, so_far=so_far)


def _player_of(problem: Problem, results: Results) -> str:
    """Return the player that a problem is about, '' if it isn't about a single player."""
    if problem.column not in ("player_a", "player_b"):
        return ""
    sides = {"player_a": results.player_a, "player_b": results.player_b}
    return str(results.players[sides[problem.column][problem.row]])


def _told_once(found: list[Problem], results: Results, unknown: Sequence[str]) -> list[Problem]:
    """Return problems, merging those about players not on the list into one at its first row."""
    which = [problem for problem in found if _player_of(problem, results) in unknown]
    if len(which) < 2:
        return found
    names = quoted_list([_player_of(problem, results) for problem in which])
    told = f"{names} aren't on the list. Add them with starting ratings, or correct the names."
    first = which[0]._replace(message=told)
    return [first if one is which[0] else one for one in found if one not in which[1:]]


def _needs_chart(problem: Problem, results: Results, chart: Races | None) -> bool:
    """Return whether neither a row nor a chart says who won."""
    stated = results.winner is not None and results.winner[problem.row] > 0
    return chart is None and problem.column == "winner" and not stated


def _alike(strangers: set[str], known: Iterable[str]) -> dict[str, list[str]]:
    """Return similar names on the list for each name that isn't on it."""
    if not strangers:
        return {}
    alike: dict[str, list[str]] = {name: [] for name in strangers}
    for group in similar_names([*strangers, *known]):
        on_list = [name for name in group if name not in strangers]
        for name in strangers.intersection(group):
            alike[name] += on_list
    return alike


def _suggestion(names: Iterable[str]) -> str:
    named = " or ".join(map(quoted, names))
    return (
        say(
            "; if {named} is meant, write that name, or add it to {aliases}",
            named=named,
            aliases=Parameter("aliases"),
        )
        if named
        else ""
    )
