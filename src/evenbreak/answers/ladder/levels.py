"""The levels that players of known strength have in the long run under a skill-level system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import percent
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.handicaps.ladders.level_ladder import LevelLadder
from evenbreak.handicaps.systems.markov import MarkovSystem

_COLUMNS = (
    "strong_as published_mean p_right_level p_one_off p_win_right p_win_long_run matches_to_level"
)


def level_ladder_answer(
    system: MarkovSystem,
    weights: Sequence[float] | None,
    newcomer: int,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return a level system's long run, with a row for players as strong as each level.

    `weights` are the numbers of opponents at each level; None: everyone meets their equals.

    >>> from evenbreak.handicaps import system_of
    >>> answer = level_ladder_answer(system_of("level-steps"), None, 3)
    >>> print(answer.sentences[0])
    In the long run players are at the level that fits their strength 76% of the time, and they \
are one level off 24% of the time.
    """
    chart: Any = system.chart
    skills = level_skills(chart)
    many = len(skills.levels)
    met = [
        tuple(float(place == k) for place in range(many)) if weights is None else tuple(weights)
        for k in range(many)
    ]
    ladders = [
        LevelLadder(system, float(points), of_level, skills, newcomer)
        for points, of_level in zip(skills.points, met, strict=True)
    ]
    rows = [_row(ladder) for ladder in ladders]
    share = [1.0] * many if weights is None else list(weights)
    data = {
        "system": system.name,
        "chart": chart.name,
        "strength_source": skills.source,
        "levels": [
            {"level": ladder.level, "shares": {str(k): v for k, v in ladder.shares.items()}}
            for ladder in ladders
        ],
    }
    who = "their equals" if weights is None else "the league's players"
    return Answer(
        f"Skill levels in the long run: chart {chart.name}, system {system.name}\n"
        f"{system.in_words[:1].upper()}{system.in_words[1:]}. Opponents are {who}, each at the "
        "right level.",
        [
            *_in_words(rows, share),
            Table("levels", columns_of(_COLUMNS), rows),
            "'Wins at that level': the chance of winning a match while the level is right. "
            "'Matches "
            f"to get there': how many a newcomer who starts at level {newcomer} needs on average.",
            skills.why,
        ],
        warnings=list(warnings),
        data=data,
    )


def _row(ladder: LevelLadder) -> tuple[float, ...]:
    shares, level = ladder.shares, ladder.level
    right = int(ladder.system.first_state(level))
    mean = sum(one * share for one, share in shares.items())
    near = shares.get(level - 1, 0.0) + shares.get(level + 1, 0.0)
    at_right, long_run = float(ladder.wins[right]), ladder.long_run_wins
    return level, mean, shares[level], near, at_right, long_run, ladder.matches_to_level()


def _in_words(rows: Sequence[tuple[float, ...]], share: Sequence[float]) -> Iterator[str]:
    right, near = (
        sum(row[k] * weight for row, weight in zip(rows, share, strict=True)) / sum(share)
        for k in (2, 3)
    )
    yield (
        f"In the long run players are at the level that fits their strength {percent(right)} "
        f"of the time, and they are one level off {percent(near)} of the time."
    )
    worst = max(rows, key=lambda row: abs(row[5] - 0.5))
    if abs(worst[5] - 0.5) > 0.05:
        up = worst[5] > 0.5
        yield (
            f"A player as strong as a level {worst[0]:g} wins {percent(worst[5])} of their matches "
            f"in the long run: {'more' if up else 'less'} than half, because there is no "
            f"level further {'up' if up else 'down'}."
        )
