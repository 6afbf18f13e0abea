"""Which shot to take in the one-ball game, given its chance of success and what a miss leaves.

Player 1 shoots first and makes the ball with probability p1; after a miss player 2 makes it
with p2. If q = 1 - p, P(player 1 wins) is

    infinite look-ahead:   p1 / (1 - q1 q2) = p1 / (p1 + q1 p2)    the shots repeat forever
    two-shot look-ahead:   p1 + q1 q2 / 2                          even after two misses

Both are 1/2 on one curve, p2 = p1 / (1 - p1) (P5.20 and P5.21). If the chances p3, p4, ... of later
shots are known too, there is an n-shot look-ahead, after which the game is even:

    p1 + q1 q2 p3 + q1 q2 q3 q4 p5 + ... + q1 q2 ... qn / 2
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import number_probability, one_of, plain, probability, together
from evenbreak.errors import InputError
from evenbreak.game import Game
from evenbreak.games.one_ball import OneBall, OneBallLookAhead

LOOK_AHEADS = ("infinite", "two shots")
"""What is assumed after the first two shots: the same two forever, or an even game."""

CHOICE_LOOK_AHEADS = (*LOOK_AHEADS, "all shots")
"""The options for a `ShotChoice`, which also include its later shots in turn, then an even game."""


def one_ball_win(
    p1: FloatOrArray, p2: FloatOrArray, *, look_ahead: str = "infinite", via: Way | None = None
) -> FloatOrArray:
    """Return P(player 1 wins the one-ball game), given that player 1 shoots first; elementwise.

    Parameters
    ----------
    p1
        P(player 1 makes the ball | player 1 shoots).
    p2
        P(player 2 makes the ball | player 2 shoots after player 1's miss); it depends on the player
        and on how easy the shot left is. p1 and p2 are broadcast together.
    look_ahead
        "infinite": the first two shots are repeated until one is made; "two shots": after two
        misses each player wins with probability 1/2.
    via
        the method: the formula ('kernel', or None), or the stochastic limit of the game's graph by
        'elimination' or 'eigen' (see `evenbreak.chains.limit_of`), for plain numbers.

    Returns
    -------
    float or numpy.ndarray
        a float for plain numbers. With infinite look-ahead and p1 = p2 = 0, it is 0, as no one ever
        wins; near that point it takes any value between 0 and 1.

    Raises
    ------
    InputError
        if p1 or p2 is not a probability, their shapes do not broadcast, or `look_ahead` or `via` is
        unknown.

    Notes
    -----
    Source: problems P5.20 and P5.21, Fig. 5.3.

    >>> one_ball_win(0.9, 0.1)
    0.989010989010989
    >>> one_ball_win([0.4, 0.3], [0.8, 0.3], look_ahead="two shots").round(3)
    array([0.46 , 0.545])
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    if (way := way_of_limit(via)) is not None:
        endless = look_ahead == "infinite"
        return _win_by_limit(OneBall(p1, p2) if endless else OneBallLookAhead([p1, p2]), way)
    first, second = probability(p1, "p1"), probability(p2, "p2")
    together(p1=first, p2=second)
    make, leave = np.broadcast_arrays(first, second)
    if look_ahead == "two shots":
        return plain(make + (1.0 - make) * (1.0 - leave) / 2.0)
    someone = make + (1.0 - make) * leave  # 1 - q1 q2 without the subtraction
    win = np.divide(make, someone, out=np.zeros_like(someone), where=someone > 0.0)
    return plain(win)


def _win_by_limit(game: Game, via: Way) -> float:
    from evenbreak.matches.by_limit import odds_by_limit  # the formulas do without scipy

    return odds_by_limit(game, via).p_win(1)


def look_ahead_win(game: OneBallLookAhead, *, via: Way | None = None) -> float:
    """Return P(player 1 wins), given the chances of the next n shots and the chance after them.

    Notes
    -----
    Source: the n-shot look-ahead of P5.21.

    >>> round(look_ahead_win(OneBallLookAhead([0.4, 0.8, 0.5])), 6)
    0.49
    """
    if (way := way_of_limit(via)) is not None:
        return _win_by_limit(game, way)
    win = game.after
    for shot in range(len(game.shots), 0, -1):
        made = game.shots[shot - 1]
        win = (made if shot % 2 else 0.0) + (1.0 - made) * win
    return win


def critical_p2(p1: FloatOrArray) -> FloatOrArray:
    """Return the p2 above which player 2 is the favorite, p1 / (1 - p1); elementwise.

    The curve is the same for both look-aheads. For p1 > 1/2 it is above 1 (infinity for
    p1 = 1): no p2 is high enough, so player 1 is the favorite no matter what a miss leaves.

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
    """Return the p2 for which a shot wins the game with chance `win`, given its p1.

    None if there is no such p2, or every p2 gives that chance. For win = 1/2 it is
    `critical_p2`, if that is not above 1.

    Raises
    ------
    InputError
        if p1 or win is not a probability, or `look_ahead` is unknown.

    Notes
    -----
    The equations of P5.20 and P5.21 solved for p2.

    >>> round(break_even_p2(0.2, 0.5), 6)
    0.25
    >>> break_even_p2(0.8, 0.5) is None
    True
    """
    one_of(look_ahead, "look_ahead", LOOK_AHEADS)
    return _break_even(p1, win, after=0.5 if look_ahead == "two shots" else None)


def _break_even(p1: float, win: float, *, after: float | None) -> float | None:
    """Return the p2 for which a shot wins with chance `win`.

    `after` is the chance after two misses; None if the two shots are then repeated.
    """
    make, target = number_probability(p1, "p1"), number_probability(win, "win")
    miss = 1.0 - make
    if miss == 0.0 or after == 0.0:
        return None
    if after is not None:
        left = 1.0 - (target - make) / (miss * after)
    elif 0.0 in (make, target):
        return None
    else:
        left = (make / miss) * ((1.0 - target) / target)
    return left if 0.0 <= left <= 1.0 else None


@dataclass(frozen=True)
class ShotChoice:
    """A shot that player 1 may choose: its chance of success, and what a miss leaves.

    Parameters
    ----------
    p1
        P(player 1 makes it | player 1 takes it).
    p2
        P(player 2 makes the shot that is left | player 1 missed).
    later
        the chances p3, p4, ... of the shots after these two, each if all before it were missed:
        player 1's, player 2's, and so on. They count for the look-ahead "all shots" only.

    Raises
    ------
    InputError
        if a value is not a probability.

    >>> ShotChoice("bank", 0.4, 0.8).region
    'sell-out'
    >>> round(ShotChoice("bank", 0.4, 0.8, (0.5, 0.2)).win("all shots"), 3)
    0.484
    """

    name: str
    p1: float
    p2: float
    later: Sequence[float] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "p1", number_probability(self.p1, "p1"))
        object.__setattr__(self, "p2", number_probability(self.p2, "p2"))
        later = tuple(number_probability(p, f"later[{k}]") for k, p in enumerate(self.later))
        object.__setattr__(self, "later", later)

    @property
    def region(self) -> str:
        """The kind of shot, by its quarter of Fig. 5.3.

        "two-way shot": often made, leaves little; "must-make": often made, leaves much;
        "safety": seldom made, leaves little; "sell-out": seldom made, leaves much.
        """
        if self.p1 >= 0.5:
            return "must-make" if self.p2 >= 0.5 else "two-way shot"
        return "sell-out" if self.p2 >= 0.5 else "safety"

    def win(self, look_ahead: str = "infinite", *, via: Way | None = None) -> float:
        """Return P(player 1 wins the game | player 1 takes this shot); see `one_ball_win`.

        With "all shots", the shots of `later` follow, and the game is even after the last.
        """
        one_of(look_ahead, "look_ahead", CHOICE_LOOK_AHEADS)
        if look_ahead == "all shots":
            return look_ahead_win(OneBallLookAhead([self.p1, self.p2, *self.later]), via=via)
        return float(one_ball_win(self.p1, self.p2, look_ahead=look_ahead, via=via))

    def break_even_p2(self, win: float, look_ahead: str = "infinite") -> float | None:
        """Return the p2 for which this shot wins with chance `win`, as `break_even_p2` does."""
        one_of(look_ahead, "look_ahead", CHOICE_LOOK_AHEADS)
        if look_ahead != "all shots":
            return break_even_p2(self.p1, win, look_ahead=look_ahead)
        after = look_ahead_win(OneBallLookAhead(self.later)) if self.later else 0.5
        return _break_even(self.p1, win, after=after)


class RankedShot(NamedTuple):
    """A shot, compared with the others that player 1 may choose."""

    shot: ShotChoice
    win: float
    """P(player 1 wins the game | player 1 takes this shot)."""
    behind: float
    """How much smaller its chance is than the best shot's."""
    turning_p2: float | None
    """The p2 at which it would be exactly as good as the best other shot. Below it, this shot is
    the best. None if there is no such p2, or no other shot."""


def compare_shots(
    shots: Iterable[ShotChoice], *, look_ahead: str = "infinite", via: Way | None = None
) -> tuple[RankedShot, ...]:
    """Return the shots sorted by the chance of winning the game, best first.

    Shots that are equally good (within 1e-12) keep their order.

    Parameters
    ----------
    shots
        at least one.
    look_ahead
        as for `ShotChoice.win`. With infinite look-ahead, the best shot is also the best for a
        player who may choose again after every miss, since the chances stay the same.
    via
        the method for the chances of winning, as in `one_ball_win`.

    Raises
    ------
    InputError
        if there is no shot, or `look_ahead` or `via` is unknown.

    Notes
    -----
    Source: P5.22, where the shot that makes less wins more.

    >>> best, other = compare_shots([ShotChoice("bank", 0.4, 0.8), ShotChoice("safety", 0.3, 0.3)])
    >>> best.shot.name, round(best.win, 4), round(other.behind, 4)
    ('safety', 0.5882, 0.1337)
    >>> round(best.turning_p2, 4), round(other.turning_p2, 4)
    (0.5143, 0.4667)
    """
    shots = tuple(shots)
    for shot in shots:
        if not isinstance(shot, ShotChoice):
            raise InputError(
                "a shot must be ShotChoice(name, p1, p2); you gave {shot!r}", shot=shot
            )
    by_win = [(shot, shot.win(look_ahead, via=via)) for shot in shots]
    by_win.sort(key=lambda by_score: -round(by_score[1], 12))
    ranked = [shot for shot, _ in by_win]
    if not ranked:
        raise InputError("shots must have at least one ShotChoice")
    wins = [win for _, win in by_win]
    best = max(wins)
    rivals = [wins[1] if len(wins) > 1 else None] + [wins[0]] * (len(wins) - 1)
    return tuple(
        RankedShot(
            shot,
            win,
            best - win,
            None if rival is None else shot.break_even_p2(rival, look_ahead),
        )
        for shot, win, rival in zip(ranked, wins, rivals, strict=True)
    )
