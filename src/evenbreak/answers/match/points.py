"""Two players and a match on a points chart, such as APA 9-ball."""

from __future__ import annotations

from evenbreak.answers.chart.audit import FEW, MANY
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities
from evenbreak.answers.kit.wording import percent
from evenbreak.handicaps.charts.level_audit import INNINGS
from evenbreak.handicaps.charts.level_chart import PointsChart
from evenbreak.handicaps.charts.points_odds import MATCH_POINTS, points_odds
from evenbreak.words import say, tally


def points_answer(
    chart: PointsChart,
    levels: tuple[int, int],
    names: tuple[str, str] = ("A", "B"),
    score: tuple[int, int] = (0, 0),
) -> Answer:
    r"""Return a match's chances on a points chart, starting from a score.

    >>> from evenbreak.handicaps import points_chart
    >>> answer = points_answer(points_chart("apa_9ball"), (5, 3))
    >>> print("\n".join(answer.sentences[:2]))
    B wins the match 50% of the time.
    On average A gets 9.9 of the 20 match points, and B gets 10.1.
    """
    odds = points_odds(chart, *levels, score=score)
    by_innings = [points_odds(chart, *levels, score=score, innings=n).p_win_1 for n in (FEW, MANY)]
    (a, b), (level_a, level_b), (need_a, need_b) = names, levels, odds.needs
    ours, theirs = odds.p_win_1, odds.p_win_2
    winner, p, other = (a, ours, theirs) if ours >= theirs else (b, theirs, ours)
    texts = [say("{name} wins the match {p} of the time.", name=winner, p=percent(p, other))]
    if odds.share_1 is not None and odds.share_2 is not None:
        texts.append(
            say(
                "On average {a} gets {x:.1f} of the {points} match points, and {b} gets {y:.1f}.",
                a=a,
                x=odds.share_1,
                points=MATCH_POINTS,
                b=b,
                y=odds.share_2,
            )
        )
    so_far = f", score {tally(score)}" if any(score) else ""
    low, high = (percent(chance) for chance in sorted(by_innings))
    values = {
        "p_win_a": ours,
        "p_win_b": theirs,
        "match_points_a": odds.share_1,
        "match_points_b": odds.share_2,
        "mean_innings": odds.mean_innings,
        "-needs_a": need_a,
        "-needs_b": need_b,
    }
    return Answer(
        f"{a} level {level_a}, {b} level {level_b} of {chart.name}\n"
        f"{need_a} points against {need_b}{so_far}",
        [
            *texts,
            Quantities(quantities_of(values, a=a, b=b)),
            say(
                "These chances assume that players of every level need about {innings:.0f} "
                "innings to reach their points, and that every shot in a match is equally "
                "hard; neither has been measured. If players need {few:.0f} to {many:.0f} "
                "innings, {a}'s chance is {low} to {high}.",
                innings=INNINGS,
                few=FEW,
                many=MANY,
                a=a,
                low=low,
                high=high,
            ),
        ],
        data={
            **({} if names == ("A", "B") else {"player_a": a, "player_b": b}),
            "level_a": level_a,
            "level_b": level_b,
            "score_a": score[0],
            "score_b": score[1],
            "p_win_a_range": sorted(by_innings),
        },
    )
