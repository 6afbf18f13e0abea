"""Games shot by shot: which shot to take in one-ball, and straight pool matches."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import by_way
from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Quantities, Table
from evenbreak.answers.kit.wording import chance, count_of, percent
from evenbreak.chains.ways import Way
from evenbreak.matches.straight_pool import (
    Spot,
    StraightPool,
    StraightPoolOdds,
    even_spot,
    straight_pool_odds,
)
from evenbreak.practice.shots import (
    CHOICE_LOOK_AHEADS,
    RankedShot,
    ShotChoice,
    compare_shots,
    critical_p2,
)
from evenbreak.questions.games import OneBall, Straight
from evenbreak.stats.runs import shot_chance
from evenbreak.words import listed

SAME = 1e-12
"""Two chances that differ by less than this are the same except for rounding."""

_SUPPOSED = {
    "infinite": "if the two shots are repeated until one is made",
    "two shots": "if the game is even after two misses",
    "all shots": "if the game is even once all the shots given are missed",
}

_OF_LATER = {"later", "p_win_all_shots"}
"""The columns for shots after the first two."""

_COLUMNS = columns_of(
    "shot kind p1 p2 p_win_infinite p_win_two_shots later p_win_all_shots critical_p2 behind "
    "turning_p2"
)


def oneball_answer(
    shots: Sequence[ShotChoice], *, look_ahead: str = "infinite", via: Way | None = None
) -> Answer:
    """Return the shots that a player can choose from, best first, and which one to take."""
    ranked = compare_shots(shots, look_ahead=look_ahead, via=via)
    other = "two shots" if look_ahead == "infinite" else "infinite"
    otherwise = compare_shots(shots, look_ahead=other, via=via)
    shot = ranked[0].shot
    heading = (
        f"You make the shot with probability {shot.p1:g}; after a miss, the opponent makes theirs "
        f"with probability {shot.p2:g}"
    )
    words = "'Even at': the game is even if a miss leaves the opponent this chance."
    if len(ranked) > 1:
        heading = f"You shoot first and have {count_of(len(ranked), 'shot')} to choose from"
        words = (
            f"The shots are ranked by your chance {_SUPPOSED[look_ahead]}. {words} 'Best up to': "
            "the shot is the best one if a miss leaves the opponent less than this chance."
        )
    known = any(one.later for one in shots)
    columns = [column for column in _COLUMNS if known or column.name not in _OF_LATER]
    if known:
        words = (
            f"'Then': your chance of making the shot after these two, then the opponent's, and so "
            f"on. {words}"
        )
    return Answer(
        heading,
        [
            _advice(ranked, otherwise, look_ahead),
            Table("shots", columns, [_row(one, look_ahead, via, known=known) for one in ranked]),
            words,
            *by_way(
                via,
                (
                    (shot.win(ahead, via=via), shot.win(ahead))
                    for shot in shots
                    for ahead in CHOICE_LOOK_AHEADS
                ),
            ),
        ],
        data={"look_ahead": look_ahead},
    )


def _row(one: RankedShot, look_ahead: str, via: Way | None, *, known: bool) -> tuple[Any, ...]:
    shot = one.shot
    cells = {
        "shot": int(shot.name),
        "kind": shot.region,
        "p1": shot.p1,
        "p2": shot.p2,
        "p_win_infinite": shot.win(via=via),
        "p_win_two_shots": shot.win("two shots", via=via),
        "later": " ".join(map("{:g}".format, shot.later)),
        "p_win_all_shots": shot.win("all shots", via=via),
        "critical_p2": _even_at(shot, look_ahead),
        "behind": one.behind,
        "turning_p2": one.turning_p2,
    }
    return tuple(cell for name, cell in cells.items() if known or name not in _OF_LATER)


def _even_at(shot: ShotChoice, look_ahead: str) -> float | None:
    """Return the p2 that makes the game even; None if there is none."""
    if look_ahead == "all shots":
        return shot.break_even_p2(0.5, look_ahead)
    critical = critical_p2(shot.p1)
    return critical if critical <= 1.0 else None


def _advice(ranked: Sequence[RankedShot], otherwise: Sequence[RankedShot], look_ahead: str) -> str:
    """Return what to do, and what it depends on; `otherwise` uses another look-ahead."""
    best = ranked[0]
    wins = f"you win {percent(best.win)} of the time"
    if not any((best.shot.p1, best.shot.p2, *best.shot.later)) and best.win == 0.0:
        return "Neither of you ever makes a ball, so no one wins."
    if len(ranked) == 1:
        return f"{wins.capitalize()}.\n{_alone(best, look_ahead)}"
    equals = sorted((one.shot.name for one in ranked if one.behind < SAME), key=int)
    if len(equals) > 1:
        return f"Shots {listed(equals)} are equally good: {wins}."
    name, second = best.shot.name, ranked[1]
    text = (
        f"Take shot {name}: {wins}, compared with {percent(second.win)} with shot "
        f"{second.shot.name}.\nShot {name} is best "
    )
    if best.turning_p2 is None:
        text += "whatever chance a miss leaves your opponent."
    else:
        text += f"as long as a miss leaves your opponent a chance below {percent(best.turning_p2)}."
    if next(one for one in otherwise if one.shot is best.shot).behind > SAME:
        other = "two shots" if look_ahead == "infinite" else "infinite"
        text += f"\nBut {_SUPPOSED[other]}, shot {otherwise[0].shot.name} is better."
    return text


def _alone(one: RankedShot, look_ahead: str) -> str:
    critical = _even_at(one.shot, look_ahead)
    if critical is None:
        are = "are" if one.win > 0.5 else "are not"
        return f"You {are} the favorite, whatever chance a miss leaves your opponent."
    if critical == 0.0:
        return "You are not the favorite, whatever chance a miss leaves your opponent."
    if abs(critical - one.shot.p2) < SAME:
        return "The game is even: leave your opponent a little less, and you are the favorite."
    if one.shot.p2 < critical:
        return f"You are the favorite as long as a miss leaves a chance below {chance(critical)}."
    return f"You would be the favorite if a miss left a chance below {chance(critical)}."


def straight_answer(match: StraightPool, averages: tuple[float, float] | None = None) -> Answer:
    """Return the chances in a straight pool match, its length and its spot; player 1 is A.

    `averages` are the balls per inning that the chances come from, if any.
    """
    odds, spot = straight_pool_odds(match), even_spot(match)
    even_a = even_b = None
    if spot.points is not None:
        even_a, even_b = match.points_1, match.points_2
        even_a, even_b = (spot.points, even_b) if spot.weaker == 1 else (even_a, spot.points)
    return Answer(
        _heading(match, averages),
        [
            _in_words(match, odds, spot),
            Quantities(
                quantities_of(
                    {
                        "p_make_a": float(match.p1),
                        "p_make_b": float(match.p2),
                        "safety": float(match.safety_1),
                        "points_a": match.points_1,
                        "points_b": match.points_2,
                        "p_win_a": odds.p_win_1,
                        "p_win_b": odds.p_win_2,
                        "-p_never_ends": odds.p_never_ends,
                        "mean_innings": odds.mean_innings,
                        "sd_innings": odds.sd_innings,
                        "innings_p50": odds.innings_p50,
                        "innings_p90": odds.innings_p90,
                        "even_points_a": even_a,
                        "even_points_b": even_b,
                        "p_win_a_even": spot.p_win_1,
                    },
                    a="A",
                    b="B",
                )
            ),
        ],
    )


def _heading(match: StraightPool, averages: tuple[float, float] | None) -> str:
    if averages is not None:
        text = f"A averages {averages[0]:g} balls an inning and B averages {averages[1]:g}"
    else:
        text = f"A makes a shot with probability {match.p1:g} and B with probability {match.p2:g}"
    text += f"; {' AB'[match.first]} shoots first\n"
    if match.safety_1 != 1:
        text += (
            f"The first shot of an inning goes in {match.safety_1:g} times as often as the others\n"
        )
    return text + f"A plays to {match.points_1} points and B plays to {match.points_2}"


def _in_words(match: StraightPool, odds: StraightPoolOdds, spot: Spot) -> str:
    if odds.mean_innings is None:
        return "Neither player ever makes a ball, so the match never ends."
    name, p = ("A", odds.p_win_1) if odds.p_win_1 >= odds.p_win_2 else ("B", odds.p_win_2)
    text = (
        f"{name} wins the match {percent(p)} of the time. "
        f"The winner needs {odds.mean_innings:.1f} innings on average.\n"
    )
    if spot.points is None or spot.p_win_1 is None:
        return f"{text}No spot makes this match even."
    if spot.points == (match.points_1, match.points_2)[spot.weaker - 1]:
        return f"{text}No other spot brings it closer to even."
    return (
        f"{text}For an even match, {' AB'[spot.weaker]} should play to "
        f"{count_of(spot.points, 'point')}: A then wins {percent(spot.p_win_1)} of the time."
    )


def oneball(asked: OneBall) -> Answer:
    """Return the best shot."""
    shots = [
        ShotChoice(str(number), shot[0], shot[1], shot[2:])
        for number, shot in enumerate(asked.shots, start=1)
    ]
    return replace(oneball_answer(shots, look_ahead=asked.ahead, via=asked.via), drawn=shots)


def straight(asked: Straight) -> Answer:
    """Return the odds of a straight pool match."""
    safety, averages = asked.safety, asked.averages
    shots: list[Fraction | float] = (
        [shot_chance(average, safety) for average in averages]
        if averages
        else [asked.p1 or 0.0, asked.p2 or 0.0]
    )
    if asked.plot is not None and (not any(shots) or not safety):
        asked.refuse("no one ever makes a ball, so there's nothing to plot. Leave {plot} out.")
    match = StraightPool(
        *asked.points, *shots, safety_1=safety, safety_2=safety, first="ab".index(asked.first) + 1
    )
    answer = straight_answer(match, (averages[0], averages[1]) if averages else None)
    return replace(answer, drawn=match)
