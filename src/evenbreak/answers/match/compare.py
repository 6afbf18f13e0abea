"""Match formats side by side: which is better for whom, and at what strength that changes."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import chance, listed, percent
from evenbreak.answers.match.two_players import TwoPlayers
from evenbreak.matches.crossings import Crossing, Crossings
from evenbreak.matches.formats import MatchFormat
from evenbreak.matches.odds import MatchOdds

SAME = 1e-12
"""Two chances that differ by less are the same but for rounding."""


class Compared(NamedTuple):
    """A format with what it means for the two players.

    Parameters
    ----------
    format
        the format.
    odds
        its odds, as the two play now.
    even
        where it is even.
    """

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

    Parameters
    ----------
    players
        who plays.
    compared
        the formats.
    pairs
        where two of them, by their places in `compared`, are worth the same.
    hold
        what stays the same as p1 varies, where the break matters: p2 or break.
    """
    names = [str(one.format) for one in compared]
    axis = "p1" if players.rack.break_matters else "p"
    parts: list[Part] = [_advice(compared, players), _formats(compared, players, axis)]
    if len(compared) > 1:
        parts.append(_turns(names, pairs, players, _stays(axis, hold)))
    formats = Table("", in_files(_COLUMNS), [_row(one) for one in compared])
    if players.taken_as_right:
        parts.append(players.taken_as_right)
    return Answer(
        players.description,
        parts,
        warnings=players.doubts,
        data={
            **players.named,
            "formats": [
                {
                    **dict(zip(_COLUMNS, _row(one), strict=True)),
                    "format": name,
                    "even": [_point(point) for point in one.even],
                }
                for name, one in zip(names, compared, strict=True)
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
        csv=formats,
    )


_COLUMNS = ("format", "p_win_a", "from_even", "mean_games", "games_p90", "even_p1", "even_places")


def _row(one: Compared) -> tuple[Any, ...]:
    text = str(one.format)
    return (
        # A bare 9:5 is a time of day to a spreadsheet.
        f"race {text}" if text[0].isdigit() else text,
        one.odds.p_win_1,
        one.odds.p_win_1 - 0.5,
        one.odds.mean_games,
        one.odds.games_p90,
        one.even[0].p1 if one.even else None,
        len(one.even),
    )


def _point(point: Crossing) -> dict[str, float | None]:
    return {"p1": point.p1, "p2": point.p2, "p_win_a": point.p_win_1}


def _formats(compared: Sequence[Compared], players: TwoPlayers, axis: str) -> Table:
    a = players.names[0]
    columns = columns_of("format wins_a from_even mean_games games_p90 even", a=a, axis=axis)
    rows = [
        (
            str(one.format),
            *_row(one)[1:5],
            listed([chance(point.p1) for point in one.even]) if one.even else "none",
        )
        for one in compared
    ]
    return Table("", columns, rows)


def _advice(compared: Sequence[Compared], players: TwoPlayers) -> str:
    """Return which format is better for whom, and which is nearest to even."""
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
        f"{a} does best with {listed(best)}, winning {percent(max(wins))} of the time, and {b} "
        f"with {listed(worst)}, winning {percent(most)}.\nNearest to even: {listed(fair)}."
    )


def _stays(axis: str, hold: str | None) -> str:
    if axis == "p":
        return ""
    return " (the advantage of the break stays)" if hold == "break" else " (p2 stays)"


def _turns(
    names: Sequence[str],
    pairs: Mapping[tuple[int, int], Crossings],
    players: TwoPlayers,
    stays: str,
) -> Table:
    """Return for each two formats which is better for A, from weak to strong."""
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
