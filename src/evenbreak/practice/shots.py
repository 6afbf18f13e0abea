"""Which shot to take: the chance to win the one-ball game from what a shot makes and leaves.

Player 1 shoots first and makes the ball with p1; after his miss player 2 makes it with p2.
With q = 1 - p, P(player 1 wins) is

    infinite look-ahead:   p1 / (1 - q1 q2) = p1 / (p1 + q1 p2)    the shots repeat for ever
    two-shot look-ahead:   p1 + q1 q2 / 2                          after two misses it is even

Both are 1/2 on one curve, p2 = p1 / (1 - p1) (P5.20 and P5.21).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.checks import number_probability, one_of, plain, probability, together
from evenbreak.errors import InputError
from evenbreak.games.one_ball import OneBallLookAhead

LOOK_AHEADS = ("infinite", "two shots")
"""What is supposed of the shots after the first two: the same for ever, or an even game."""


@overload
def one_ball_win(p1: float, p2: float, *, look_ahead: str = "infinite") -> float: ...
@overload
def one_ball_win(
    p1: ArrayLike, p2: ArrayLike, *, look_ahead: str = "infinite"
) -> NDArray[np.float64]: ...
def one_ball_win(p1: Any, p2: Any, *, look_ahead: str = "infinite") -> Any:
    """Return P(player 1 wins the one-ball game), given that he shoots first; elementwise.

    Parameters
    ----------
    p1
        P(player 1 makes the ball | he shoots).
    p2
        P(player 2 makes the ball | he shoots after player 1's miss): how good he is, and how
        easy the shot that is left. The two are broadcast together.
    look_ahead
        "infinite": all later shots are as the first two; "two shots": after two misses each
        player wins with 1/2.

    Returns
    -------
    float or numpy.ndarray
        a float for plain numbers. With infinite look-ahead and p1 = p2 = 0 it is 0: nobody
        ever wins, and any value between 0 and 1 is met nearby.

    Raises
    ------
    InputError
        if p1 or p2 is not a probability, their shapes do not broadcast, or the look-ahead is
        another.

    Notes
    -----
    Source: problems P5.20 and P5.21, Fig. 5.3.

    >>> one_ball_win(0.9, 0.1)
    0.989010989010989
    >>> one_ball_win([0.4, 0.3], [0.8, 0.3], look_ahead="two shots").round(3)
    array([0.46 , 0.545])
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    make, leave = _pair(p1, p2)
    if look_ahead == "two shots":
        return plain(make + (1.0 - make) * (1.0 - leave) / 2.0)
    someone = make + (1.0 - make) * leave  # 1 - q1 q2 without its subtraction
    win = np.divide(make, someone, out=np.zeros_like(someone), where=someone > 0.0)
    return plain(win)


def look_ahead_win(game: OneBallLookAhead) -> float:
    """Return P(player 1 wins), given the chances of the next n shots and of what follows.

    Notes
    -----
    Source: the n-shot look-ahead of P5.21.

    >>> round(look_ahead_win(OneBallLookAhead([0.4, 0.8, 0.5])), 6)
    0.49
    """
    win = game.after
    for shot in range(len(game.shots), 0, -1):
        made = game.shots[shot - 1]
        win = (made if shot % 2 else 0.0) + (1.0 - made) * win
    return win


@overload
def critical_p2(p1: float) -> float: ...
@overload
def critical_p2(p1: ArrayLike) -> NDArray[np.float64]: ...
def critical_p2(p1: Any) -> Any:
    """Return the p2 above which player 2 is the favourite, p1 / (1 - p1); elementwise.

    The curve is the same for both look-aheads. Where p1 > 1/2 it is above 1 (infinity for
    p1 = 1): no p2 is high enough, player 1 is the favourite whatever he leaves.

    Raises
    ------
    InputError
        if p1 is not a probability.

    Notes
    -----
    Source: problems P5.20 and P5.21.

    >>> critical_p2([0.2, 0.5, 0.75, 1])
    array([0.25, 1.  , 3.  ,  inf])
    """
    make = np.asarray(probability(p1, "p1"), dtype=float)
    miss = 1.0 - make
    critical = np.divide(make, miss, out=np.full_like(miss, math.inf), where=miss > 0.0)
    return plain(critical)


def break_even_p2(p1: float, win: float, *, look_ahead: str = "infinite") -> float | None:
    """Return the p2 with which a shot wins the game with chance `win`, given its p1.

    None if there is no such p2, or if every p2 is one. With win = 1/2 it is `critical_p2`,
    where that is not above 1.

    Raises
    ------
    InputError
        if p1 or win is not a probability, or the look-ahead is another.

    Notes
    -----
    The equations of P5.20 and P5.21 solved for p2.

    >>> round(break_even_p2(0.2, 0.5), 6)
    0.25
    >>> break_even_p2(0.8, 0.5) is None
    True
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    make, target = number_probability(p1, "p1"), number_probability(win, "win")
    miss = 1.0 - make
    if miss == 0.0:
        return None
    if look_ahead == "two shots":
        left = 1.0 - 2.0 * (target - make) / miss
    elif 0.0 in (make, target):
        return None
    else:
        left = (make / miss) * ((1.0 - target) / target)
    return left if 0.0 <= left <= 1.0 else None


@dataclass(frozen=True)
class ShotChoice:
    """A shot that player 1 may choose: what it makes, and what it leaves.

    Parameters
    ----------
    name
        what to call it.
    p1
        P(player 1 makes it | he takes it).
    p2
        P(player 2 makes the shot that is left | player 1 missed).

    Raises
    ------
    InputError
        if p1 or p2 is not a probability.

    >>> ShotChoice("bank", 0.4, 0.8).region
    'sell-out'
    """

    name: str
    p1: float
    p2: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "p1", number_probability(self.p1, "p1"))
        object.__setattr__(self, "p2", number_probability(self.p2, "p2"))

    @property
    def region(self) -> str:
        """Which kind of shot it is: the corner of Fig. 5.3, split at one half both ways.

        "two-way shot": makes much, leaves little; "must-make": makes much, leaves much;
        "safety": makes little, leaves little; "sell-out": makes little, leaves much.
        """
        if self.p1 >= 0.5:
            return "must-make" if self.p2 >= 0.5 else "two-way shot"
        return "sell-out" if self.p2 >= 0.5 else "safety"

    def win(self, look_ahead: str = "infinite") -> float:
        """Return P(player 1 wins the game | he takes this shot), see `one_ball_win`."""
        return float(one_ball_win(self.p1, self.p2, look_ahead=look_ahead))


class RankedShot(NamedTuple):
    """A shot among the others that player 1 may choose."""

    shot: ShotChoice
    win: float
    """P(player 1 wins the game | he takes this shot)."""
    behind: float
    """How much less than the best shot wins."""
    turning_p2: float | None
    """The p2 with which it would be exactly as good as the best of the other shots, all else
    being right: the best shot is the best below it, another becomes the best below it. None if
    there is no such p2, or no other shot."""


def compare_shots(
    shots: Iterable[ShotChoice], *, look_ahead: str = "infinite"
) -> tuple[RankedShot, ...]:
    """Return the shots by the chance to win the game with each, the best first.

    Of equally good ones (to 1e-12) the first named comes first.

    Parameters
    ----------
    shots
        what player 1 may choose from: one or more.
    look_ahead
        as in `one_ball_win`. With infinite look-ahead the best shot is also the best for a
        player who may choose anew after every miss: by the same fixed chances, what is best
        once is best each time.

    Raises
    ------
    InputError
        if there is no shot, or the look-ahead is another.

    Notes
    -----
    Source: P5.22, where the shot that makes less wins more.

    >>> best, other = compare_shots([ShotChoice("bank", 0.4, 0.8), ShotChoice("safety", 0.3, 0.3)])
    >>> best.shot.name, round(best.win, 4), round(other.behind, 4)
    ('safety', 0.5882, 0.1337)
    >>> round(best.turning_p2, 4), round(other.turning_p2, 4)
    (0.5143, 0.4667)
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    ranked = sorted(shots, key=lambda shot: -round(shot.win(look_ahead), 12))
    if not ranked:
        raise InputError("shots is empty; give one ShotChoice or more")
    wins = [shot.win(look_ahead) for shot in ranked]
    best = max(wins)
    rivals = [wins[1] if len(wins) > 1 else None] + [wins[0]] * (len(wins) - 1)
    return tuple(
        RankedShot(
            shot,
            win,
            best - win,
            None if rival is None else break_even_p2(shot.p1, rival, look_ahead=look_ahead),
        )
        for shot, win, rival in zip(ranked, wins, rivals, strict=True)
    )


def _pair(p1: Any, p2: Any) -> tuple[Any, Any]:
    make, leave = probability(p1, "p1"), probability(p2, "p2")
    together(p1=make, p2=leave)
    first, second = np.broadcast_arrays(make, leave)
    return first, second
