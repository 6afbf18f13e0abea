"""Match formats side by side, and break formats in the long run: which suits whom better."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import by_way
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import chance, count_of, percent
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.chains.ways import Way
from evenbreak.games.rack import Rack
from evenbreak.matches.crossings import Crossing, Crossings
from evenbreak.matches.formats import MatchFormat
from evenbreak.matches.odds import MatchOdds
from evenbreak.practice.breaks import BreakFormatValue, compare_break_formats
from evenbreak.questions.games import Breaks
from evenbreak.words import listed

SAME = 1e-12
"""Two chances that differ by less than this are the same except for rounding."""


class Compared(NamedTuple):
    """A format with its odds for the two players, and where it is even."""

    format: MatchFormat
    odds: MatchOdds
    even: tuple[Crossing, ...]


def compare_answer(
    players: TwoPlayers,
    compared: Sequence[Compared],
    pairs: Mapping[tuple[int, int], Crossings],
    *,
    hold: str | None = None,
) -> Answer:
    """Return match formats side by side.

    `pairs` has the points where two formats, by place, are worth the same; `hold` is what stays
    fixed as p1 varies if the break matters: p2 or the break.
    """
    names = [str(one.format) for one in compared]
    axis = "p1" if players.rack.break_matters else "p"
    formats = _formats(compared, players, axis)
    parts: list[Part] = [_advice(compared, players), formats]
    if len(compared) > 1:
        parts.append(_turns(names, pairs, players, _stays(axis, hold)))
    if players.taken_as_right:
        parts.append(players.taken_as_right)
    return Answer(
        players.description,
        parts,
        warnings=players.doubts,
        data={
            **players.named,
            "formats": [
                {**row, "even": [_point(point) for point in one.even]}
                for row, one in zip(formats.to_dicts(), compared, strict=True)
            ],
            "crossings": [
                {
                    "format_1": names[i],
                    "format_2": names[j],
                    "points": [_point(point) for point in found.points],
                    "better_for_a": [(None, names[i], names[j])[k] for k in found.better],
                    "exact": found.exact,
                }
                for (i, j), found in pairs.items()
            ],
        },
    )


def _point(point: Crossing) -> dict[str, float | None]:
    return {"p1": point.p1, "p2": point.p2, "p_win_a": point.p_win_1}


def _formats(compared: Sequence[Compared], players: TwoPlayers, axis: str) -> Table:
    columns = columns_of(
        "format wins_a from_even mean_games games_p90 even even_p1 even_places",
        a=players.names[0],
        axis=axis,
    )
    rows = []
    for one in compared:
        p, places = one.odds.p_win_1, [point.p1 for point in one.even]
        length = (one.odds.mean_games, one.odds.games_p90)
        even = listed(list(map(chance, places))) if places else "none"
        first = places[0] if places else None
        rows.append((str(one.format), p, p - 0.5, *length, even, first, len(places)))
    return Table("", columns, rows)


def _advice(compared: Sequence[Compared], players: TwoPlayers) -> str:
    """Return which format is better for whom, and which is closest to even."""
    a, b = players.names
    wins = [one.odds.p_win_1 for one in compared]
    names = [str(one.format) for one in compared]
    if len(compared) == 1:
        return f"{a} wins {names[0]} {percent(wins[0])} of the time."
    best = [name for name, win in zip(names, wins, strict=True) if win > max(wins) - SAME]
    if len(best) == len(compared):
        return f"All of these are worth the same to {a}, who wins {percent(wins[0])} of the time."
    worst = [name for name, win in zip(names, wins, strict=True) if win < min(wins) + SAME]
    nearest = min(abs(win - 0.5) for win in wins)
    fair = [name for name, win in zip(names, wins, strict=True) if abs(win - 0.5) < nearest + SAME]
    most = max(one.odds.p_win_2 for one in compared)
    return (
        f"{a} does best with {listed(best)}, winning {percent(max(wins))} of the time; {b} "
        f"does best with {listed(worst)}, winning {percent(most)}.\nClosest to even: "
        f"{listed(fair)}."
    )


def _stays(axis: str, hold: str | None) -> str:
    if axis == "p":
        return ""
    return " (the break advantage stays the same)" if hold == "break" else " (p2 stays)"


def _turns(
    names: Sequence[str],
    pairs: Mapping[tuple[int, int], Crossings],
    players: TwoPlayers,
    stays: str,
) -> Table:
    """Return which of each two formats is better for A, from weak to strong."""
    a = players.names[0]
    axis = "p1" if players.rack.break_matters else "p"
    rows = [
        (f"{names[i]} or {names[j]}", _turn(found, names[i], names[j]))
        for (i, j), found in pairs.items()
    ]
    columns = columns_of("formats better")
    return Table("", columns, rows, f"The better format for {a} as {axis} grows{stays}:")


def _turn(found: Crossings, one: str, two: str) -> str:
    names = {1: one, 2: two}
    if found.better == (0,):
        return "always worth the same"
    if not found.points:
        return f"always {names[found.better[0]]}"
    parts = [
        f"{names[better]} up to {chance(point.p1)}"
        for better, point in zip(found.better, found.points, strict=False)
    ]
    return ", ".join([*parts, f"then {names[found.better[-1]]}"])


USUAL = ("winner", "loser", "alternate")


def breaks_answer(
    rack: Rack[float],
    *,
    win: float = 1.0,
    lose: float = 1.0,
    first_breaker: int = 1,
    via: Way | None = None,
) -> Answer:
    """Return the break formats, with the best one for player 1 (A) first."""
    stakes: dict[str, Any] = {"win": win, "lose": lose, "first_breaker": first_breaker}
    values = compare_break_formats(rack, via=via, **stakes)
    kernel = {value.name: value.share for value in compare_break_formats(rack, **stakes)}
    usual = [value for value in values if value.name in USUAL]
    columns = columns_of(
        "breaks share_a points_per_rack sd_points fair_win first_break_racks memory"
    )
    return Answer(
        f"The breaker wins a rack with probability {rack.p1:g} (A) or "
        f"{rack.chance(2, breaker=2):g} (B)\nA wins {win:g} for each rack won and pays {lose:g} "
        "for each rack lost",
        [
            f"{_who_gains(usual)}\n{_in_a_session(usual[0])}",
            Table("formats", columns, [_breaks_row(value, lose) for value in values]),
            "'Even if a win pays': what A should get for each rack won to make the stakes fair. "
            "'First break': how many more racks A wins in a long session by breaking first.",
            *by_way(via, ((value.share, kernel[value.name]) for value in values)),
        ],
        [
            "'Spread of points': multiply it by the square root of N to get the standard "
            "deviation of "
            "A's points over N racks. 'Left after a rack': how much of the first break's effect is "
            "left one rack later (the second eigenvalue of the chain of breakers); if it is "
            "below 0, the advantage changes sides."
        ],
    )


def _breaks_row(value: BreakFormatValue, lose: float) -> tuple[Any, ...]:
    fair_win = value.fair_ratio * lose
    head_start = value.name in USUAL and math.isfinite(value.first_break)
    return (
        {"player 1": "a", "player 2": "b"}.get(value.name, value.name),
        value.share,
        value.points,
        value.sd_points,
        fair_win if math.isfinite(fair_win) else None,
        value.first_break if head_start else None,
        value.memory,
    )


def _who_gains(usual: Sequence[BreakFormatValue]) -> str:
    """Return which of the usual formats suits whom, and where that changes."""
    for value in usual:
        if math.isinf(value.first_break):
            return f"With {value.name} breaks, the player who breaks first breaks every rack."
    best, worst = usual[0], usual[-1]
    if best.share - worst.share < SAME:
        return "Winner, loser and alternate breaks are worth the same to both players."
    text = (
        f"A does best with {best.name} breaks, winning {percent(best.share)} of the racks; B does "
        f"best with {worst.name} breaks, winning {percent(1.0 - worst.share)}."
    )
    gains = [value.name for value in usual if value.points > SAME]
    losses = [value.name for value in usual if value.points < -SAME]
    if gains and losses:
        text += (
            f"\nAt these stakes A comes out ahead with {listed(gains)} breaks "
            f"and behind with {listed(losses)} breaks."
        )
    return text


def _in_a_session(best: BreakFormatValue) -> str:
    points = round(100 * best.points)
    ahead = f"{count_of(abs(points), 'point')} {'ahead' if points > 0 else 'behind'}"
    return (
        f"Over 100 racks with {best.name} breaks, A comes out {ahead if points else 'even'} on "
        f"average, ± {10 * best.sd_points:,.0f}."
    )


def breaks(asked: Breaks) -> Answer:
    """Return break formats side by side."""
    rack = Rack(asked.p1 or 0.0, asked.p2 or 0.0)
    first = "ab".index(asked.first_break) + 1
    answer = breaks_answer(rack, win=asked.win, lose=asked.lose, first_breaker=first, via=asked.via)
    return replace(answer, drawn=(rack, first))
