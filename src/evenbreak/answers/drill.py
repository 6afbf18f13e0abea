"""Where a progressive drill settles, and which level to practise."""

from evenbreak.answers.answer import Answer
from evenbreak.answers.by_way import by_way
from evenbreak.answers.parts import Column, Part, Quantities, Quantity, Table
from evenbreak.answers.wording import chance, decimals
from evenbreak.chains.ways import Way
from evenbreak.practice.drills import DrillStatistics, drill_statistics
from evenbreak.practice.levels import MORE
from evenbreak.stats.summary import Distribution

MUCH = 1e6
"""From here on a gain is shown with three digits."""


def drill_answer(
    statistics: DrillStatistics, description: str, *, via: Way | None = None
) -> Answer:
    """Return where a drill settles in the long run, and what to practise.

    Parameters
    ----------
    statistics
        of the drill.
    description
        which drill it is, in a line.
    via
        the way by which the statistics were found.

    >>> from evenbreak.games import Drill
    >>> from evenbreak.practice import drill_statistics
    >>> drill = drill_statistics(Drill.progressive(0.8))
    >>> print(drill_answer(drill, "80% of shots").sentences[0])
    Practise level 4: five more successes in 100 there raise your average level by 0.11, more than
    at any other level. For now you settle at an average level of 4.35.
    """
    law = statistics.distribution
    success = statistics.drill.success
    rows = zip(law.values, success, law.probability, statistics.gain, statistics.lift, strict=True)
    parts: list[Part] = [f"{_advice(statistics)} {_settled(law)}"]
    if statistics.period > 1:
        parts.append(
            "Odd-numbered and even-numbered attempts are at different levels for ever; the long "
            "run is the average of both."
        )
    columns = [
        Column("level", "level", left=True),
        Column("p_success", "success", chance),
        Column("long_run", "share of attempts\nin the long run", chance),
        Column("gain", "gain", amount, detail=True),
        Column("lift", "five more in 100\nraise the average by", amount),
    ]
    return Answer(
        description,
        [*parts, Table("levels", columns, list(rows)), *_way(via, statistics)],
        details=[
            Quantities([Quantity("mean", law.mean, "average level", decimals(3)), *spread(law)]),
            GAIN_WORDS,
        ],
        data={"practise_next": statistics.practise_next, "period": statistics.period},
    )


def _way(via: Way | None, statistics: DrillStatistics) -> list[Part]:
    if via is None:
        return []
    kernel = drill_statistics(statistics.drill).distribution.probability
    return by_way(via, zip(statistics.distribution.probability, kernel, strict=True))


def _advice(statistics: DrillStatistics) -> str:
    level = statistics.practise_next
    if level is None:
        return "More success at any level would not raise your average level."
    lift = statistics.lift[level - 1]
    return (
        f"Practise level {level}: {better(statistics.drill.success[level - 1])} there raise your "
        f"average level by {lift:.2f}, more than at any other level."
    )


def _settled(law: Distribution) -> str:
    return f"For now you settle at an average level of {law.mean:.2f}."


GAIN_WORDS = (
    "'Gain' is how fast the average level rises with the chance of success at that level (the "
    "slope)."
)


def spread(law: Distribution) -> list[Quantity]:
    """Return the summary of the level in the long run, without its mean."""
    return [
        Quantity("median", law.median, "median: half of the attempts are at this or below"),
        Quantity("mode", law.mode, "mode: the most frequent level"),
        Quantity("sd", law.sd, "standard deviation", decimals(3)),
    ]


def better(p: float) -> str:
    """Return the improvement by which levels are compared, from a chance p."""
    return "five more successes in 100" if p <= 1.0 - MORE else "successes without a miss"


def amount(value: float) -> str:
    """Return a gain or a lift with three decimals, or three digits if it is huge.

    >>> amount(2.3014), amount(5.56e299), amount(float("inf"))
    ('2.301', '5.56e+299', 'inf')
    """
    return f"{value:.3f}" if value < MUCH else f"{value:.3g}"
