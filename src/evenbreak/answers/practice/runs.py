"""Runs in one inning, and scores over several innings."""

import math
from dataclasses import dataclass, replace

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of, quantity_of
from evenbreak.answers.kit.parts import Quantities
from evenbreak.answers.kit.wording import percent
from evenbreak.questions.practice import Runs
from evenbreak.stats.innings import InningsScore
from evenbreak.stats.runs import RunLength, shot_chance

FAIR = 0.005
"""A bet whose chance is this close to 1/2 is fair at even money."""


@dataclass(frozen=True)
class Asked:
    """Ranges of scores whose chances are requested: N or more, from-to (inclusive), over a bet."""

    at_least: int | None = None
    between: tuple[int, int] | None = None
    over: float | None = None

    @property
    def losing(self) -> int | None:
        """The largest score that loses a bet on the over."""
        return None if self.over is None else math.floor(self.over)

    @property
    def ranges(self) -> dict[str, tuple[str, int, int | None]]:
        """Each range by its chance's name: the words, and its smallest and largest score.

        >>> Asked(at_least=100, over=20.5).ranges
        {'p_at_least': ('100 or more', 100, None), 'p_over': ('over 20.5: 21 or more', 21, None)}
        """
        found: dict[str, tuple[str, int, int | None]] = {}
        if self.at_least is not None:
            found["p_at_least"] = (f"{self.at_least} or more", self.at_least, None)
        if self.between is not None:
            found["p_between"] = ("{} to {}".format(*self.between), *self.between)
        if self.losing is not None:
            fewest = self.losing + 1
            found["p_over"] = (f"over {self.over:.12g}: {fewest} or more", fewest, None)
        return found


def runs_answer(law: RunLength | InningsScore, asked: Asked) -> Answer:
    """Return how long a player's runs are, or what several innings bring, and requested chances.

    >>> print(runs_answer(RunLength(0.96), Asked(at_least=100)).sentences[0])
    A run of 100 or more happens 1.7% of the time, once in 59 innings. Half of the runs are 16
    balls or fewer, although the average is 24.
    """
    innings = law.innings if isinstance(law, InningsScore) else 1
    safety = float(law.safety)
    ranges, losing = asked.ranges, asked.losing
    chances = {
        key: law.at_least(low) if high is None else law.between(low, high)
        for key, (_, low, high) in ranges.items()
    }
    not_over = None if losing is None else law.cumulative(losing)
    values = {
        "p_make": float(law.p),
        "safety": safety,
        "innings": innings,
        "mean_run": law.mean,
        "median_run": law.median,
        "mode_run": law.mode,
        "sd": law.sd,
        "relative_sd": law.relative_sd,
        # With safety play blank innings stand apart, and the rule does not hold for several.
        "median_estimate": law.median_estimate if innings == 1 or safety == 1 else None,
    }
    quantities = quantities_of(values)
    for key in ("p_at_least", "p_between", "p_over"):
        words, *_ = ranges.get(key, ("",))
        quantities.append(quantity_of(key, chances.get(key), range=words))
    quantities.append(quantity_of("p_not_over", not_over, losing=losing))
    return Answer(
        _heading(law, innings),
        [
            " ".join([*_asked(asked, chances, innings), _middle(law, innings)]),
            Quantities(quantities),
        ],
    )


def _asked(asked: Asked, chances: dict[str, float], innings: int) -> list[str]:
    """Return the requested answers, one sentence each."""
    sentences = []
    for key, (words, _, _) in asked.ranges.items():
        if key == "p_over":
            p = chances[key]
            kind = "fair" if abs(p - 0.5) < FAIR else "good" if p > 0.5 else "bad"
            sentences.append(
                f"A bet on over {asked.over:.12g} wins {percent(p)} of the time, so at even money "
                f"it is a {kind} bet."
            )
            continue
        what = "run" if innings == 1 else "score"
        text = f"A {what} of {words} happens {percent(chances[key])} of the time"
        if innings == 1 and 0.0 < chances[key] < 0.1:
            text += _once_in(chances[key])
        sentences.append(f"{text}.")
    return sentences


def _once_in(chance: float) -> str:
    """Return how many innings it takes for something to happen; nothing if it never will."""
    innings = 1 / chance
    if innings > 1e300:
        return ""
    return f", once in {innings:{',.0f' if innings < 1e12 else '.2g'}} innings"


def _middle(law: RunLength | InningsScore, innings: int) -> str:
    what = "runs" if innings == 1 else "scores"
    link = "although the average is" if law.mean - law.median >= 1 else "and the average is"
    mean = f"{law.mean:,.2f}".rstrip("0").rstrip(".")
    if not law.median:
        return f"At least half of the {what} are 0, {link} {mean}."
    return f"Half of the {what} are {law.median:,} balls or fewer, {link} {mean}."


def _heading(law: RunLength | InningsScore, innings: int) -> str:
    safety = float(law.safety)
    first = float(law.p) * safety
    opening = "" if safety == 1 else f", but the first of an inning with probability {first:.4g}"
    played = "The run in one inning" if innings == 1 else f"The score of {innings} innings"
    return f"{played}, for a player who makes a shot with probability {float(law.p):.4g}{opening}"


def runs(asked: Runs) -> Answer:
    """Return how long runs get."""
    law, ranges = _law(asked), Asked(asked.at_least, asked.between, asked.over)
    return replace(runs_answer(law, ranges), drawn=(law, list(ranges.ranges.values())))


def _law(asked: Runs) -> RunLength | InningsScore:
    p, safety = asked.p, asked.safety
    chance = shot_chance(asked.mean or 0.0, safety) if p is None else p
    if asked.innings == 1:
        return RunLength(chance, safety)
    return InningsScore(chance, asked.innings, safety)
