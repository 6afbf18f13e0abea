"""What fairness costs in length: the fairest charts for every length."""

from collections.abc import Sequence

from evenbreak.answers.chart_design import DesignTask
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Table
from evenbreak.answers.kit.wording import decimals, listed
from evenbreak.handicaps.charts.pareto import ParetoChart


def chart_pareto_answer(task: DesignTask, charts: Sequence[ParetoChart]) -> Answer:
    """Return the fairest charts for every length, as `evenbreak.handicaps.pareto` found them.

    >>> from evenbreak.answers.chart_design import DesignTask
    >>> from evenbreak.handicaps import MatchRules, RaceLimits, pareto
    >>> task = DesignTask(MatchRules("npl"), RaceLimits((5, 7), weaker_least=2))
    >>> print(chart_pareto_answer(task, pareto(task.rules, task.limits)).sentences[0])
    The fairest chart is 3.0 percentage points from even on average, with 4.81 games a match. The
    shortest one is 11.0 points from even, with 4.00 games.
    """
    rows = [
        (
            *(one.chart.name, one.measure.mean_unfairness, one.measure.worst_unfairness),
            *(one.measure.mean_games, one.measure.games_p90, len(one.chart.rows), one.beaten_by),
        )
        for one in charts
    ]
    columns = [
        Column("chart", "chart", left=True),
        Column("mean_unfairness", "unfair, on\naverage", decimals(4)),
        Column("worst_unfairness", "at worst", decimals(4)),
        Column("mean_games", "games, on\naverage", decimals(2)),
        Column("games_p90", "9 of 10\nwithin"),
        Column("races", "races"),
        # Without charts beside, nothing here is beaten.
        Column("beaten_by", "beaten by" if task.beside else None, left=True),
    ]
    up_to = charts[0].measure.up_to
    return Answer(
        task.heading(up_to),
        [
            " ".join([_ends(charts, task.rule, task.target), *_beaten(charts)]),
            "Each chart is named after the limit it was designed for: with games_p90 8, 9 out of "
            "10 matches end within 8 games; with mean_games 5, a match takes at most 5 games on "
            "average. 'Unfair' is how far the stronger player's chance is from the target.",
            Table("charts", columns, rows),
        ],
        data={"up_to": up_to},
    )


def _ends(charts: Sequence[ParetoChart], rule: str, target: float) -> str:
    """Return what the fairest and the shortest chart come to."""

    def unfair(one: ParetoChart) -> float:
        found: float = getattr(one.measure, f"{rule}_unfairness")
        return found

    fairest, shortest = min(charts, key=unfair), charts[-1]
    how = "on average" if rule == "mean" else "at worst"
    aim = "even" if target == 0.5 else "the target"
    return (
        f"The fairest chart is {100 * unfair(fairest):.1f} percentage points from {aim} {how}, "
        f"with {fairest.measure.mean_games:.2f} games a match. The shortest one is "
        f"{100 * unfair(shortest):.1f} points from {aim}, with {shortest.measure.mean_games:.2f} "
        "games."
    )


def _beaten(charts: Sequence[ParetoChart]) -> list[str]:
    beaten = [one.chart.name for one in charts if one.beaten_by is not None]
    if not beaten:
        return []
    return [f"{listed(beaten)} can be beaten: another chart is fairer and no longer."]
