"""Which shot to take in the one-ball game."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from evenbreak.answers.answer import Answer, Column, Table
from evenbreak.answers.wording import chance, count_of, listed, percent
from evenbreak.practice.shots import compare_shots, critical_p2

if TYPE_CHECKING:
    from evenbreak.practice.shots import RankedShot, ShotChoice

SAME = 1e-12
"""Two chances that differ by less are the same but for rounding."""

_SUPPOSED = {
    "infinite": "if the two shots are repeated until one is made",
    "two shots": "if the game is even after two misses",
}

_COLUMNS = (
    Column("shot", "shot", left=True),
    Column("kind", "kind", left=True),
    Column("p1", "you\nmake", "{:g}".format),
    Column("p2", "miss\nleaves", "{:g}".format),
    Column("p_win_infinite", "you win,\nrepeated", chance),
    Column("p_win_two_shots", "you win,\n2 shots", chance),
    Column("critical_p2", "even\nat", chance),
    Column("behind", "behind\nbest", chance),
    Column("turning_p2", "best\nup to", chance),
)


def oneball_answer(shots: Sequence[ShotChoice], *, look_ahead: str = "infinite") -> Answer:
    """Return the shots that a player may choose from, the best first, and which to take.

    Parameters
    ----------
    shots
        what the player may choose from, named by numbers.
    look_ahead
        as for `compare_shots`.

    >>> from evenbreak.practice import ShotChoice
    >>> print(oneball_answer([ShotChoice("1", 0.4, 0.8), ShotChoice("2", 0.3, 0.3)]).sentences[0])
    Take shot 2: you win 59 % of the time, against 45 % with shot 1.
    Shot 2 stays the best as long as it leaves the opponent a chance below 0.5143.
    """
    ranked = compare_shots(shots, look_ahead=look_ahead)
    (other,) = (name for name in _SUPPOSED if name != look_ahead)
    otherwise = compare_shots(shots, look_ahead=other)
    shot = ranked[0].shot
    heading = (
        f"You make the shot with probability {shot.p1:g}; if you miss, the opponent makes theirs "
        f"with {shot.p2:g}"
    )
    words = "'Even at': the chance left by a miss that makes the game even."
    if len(ranked) > 1:
        heading = f"You shoot first and have {count_of(len(ranked), 'shot')} to choose from"
        words = (
            f"Ranked by your chance {_SUPPOSED[look_ahead]}. {words} 'Best up to': the chance left "
            "by a miss below which the shot is the best."
        )
    return Answer(
        heading,
        [
            _advice(ranked, otherwise, _SUPPOSED[other]),
            Table("shots", _COLUMNS, [_row(one) for one in ranked]),
            words,
        ],
        data={"look_ahead": look_ahead},
    )


def _row(one: RankedShot) -> tuple[Any, ...]:
    shot, critical = one.shot, critical_p2(one.shot.p1)
    return (
        int(shot.name),
        shot.region,
        shot.p1,
        shot.p2,
        shot.win(),
        shot.win("two shots"),
        critical if critical <= 1.0 else None,
        one.behind,
        one.turning_p2,
    )


def _advice(ranked: Sequence[RankedShot], otherwise: Sequence[RankedShot], supposed: str) -> str:
    """Return what to do, and what it depends on.

    Parameters
    ----------
    ranked, otherwise, supposed
        the shots as asked; the shots by the other look-ahead, and what that one supposes.
    """
    best = ranked[0]
    wins = f"you win {percent(best.win)} of the time"
    if best.shot.p1 == best.shot.p2 == best.win == 0.0:
        return "Neither of you ever makes a ball, so nobody wins."
    if len(ranked) == 1:
        return f"{wins.capitalize()}.\n{_alone(best)}"
    equals = sorted((one.shot.name for one in ranked if one.behind < SAME), key=int)
    if len(equals) > 1:
        return f"Shots {listed(equals)} are equally good: {wins}."
    name, second = best.shot.name, ranked[1]
    text = (
        f"Take shot {name}: {wins}, against {percent(second.win)} with shot {second.shot.name}.\n"
        f"Shot {name} stays the best "
    )
    if best.turning_p2 is None:
        text += "whatever it leaves."
    else:
        text += f"as long as it leaves the opponent a chance below {chance(best.turning_p2)}."
    if next(one for one in otherwise if one.shot is best.shot).behind > SAME:
        text += f"\nBut {supposed}, shot {otherwise[0].shot.name} is better."
    return text


def _alone(one: RankedShot) -> str:
    critical = critical_p2(one.shot.p1)
    if critical == 0.0:
        return "You are not the favourite, whatever a miss leaves."
    if critical > 1.0:
        return "You are the favourite, whatever a miss leaves."
    if abs(critical - one.shot.p2) < SAME:
        return "The game is even: leave a little less, and you are the favourite."
    if one.shot.p2 < critical:
        return f"You are the favourite as long as a miss leaves a chance below {chance(critical)}."
    return f"You would be the favourite if a miss left a chance below {chance(critical)}."
