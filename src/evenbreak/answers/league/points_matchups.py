"""The points of each pair tonight by a chart of points, such as APA 9-ball, and who wins."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.remarks import file_name
from evenbreak.arrays import Ints
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps.charts.level_audit import INNINGS
from evenbreak.handicaps.charts.level_chart import PointsChart
from evenbreak.handicaps.charts.points_odds import PointsOdds, points_odds


def points_matchups_answer(
    file: RosterFile, pairs: Ints, chart: PointsChart, *, warnings: Sequence[str] = ()
) -> Answer:
    """Return the points that the players of each pair need, and each player's chance.

    Parameters
    ----------
    file
        a list whose levels are all on the chart.
    pairs
        places in its roster, shape (k, 2).
    chart
        the chart.
    """
    roster = file.roster
    known: dict[tuple[int, int], PointsOdds] = {}
    rows = []
    for a, b in pairs.tolist():
        levels = int(roster.level[a]), int(roster.level[b])
        if levels not in known:
            known[levels] = points_odds(chart, *levels)
        odds = known[levels]
        names = roster.players[a], roster.players[b]
        rows.append((*names, odds.needs, odds.p_win_1, odds.share_1, odds.share_2))
    shared = bool(rows) and rows[0][-1] is not None
    keys = "player_a player_b needs_pair p_win_a_pair"
    keys += " mean_match_points_a mean_match_points_b" if shared else ""
    table = Table("pairs", columns_of(keys), rows if shared else [row[:-2] for row in rows])
    return Answer(
        f"Points for {file_name(file)}\nSkill levels of {chart.name}",
        [
            f"The points come from the chart {chart.name}.",
            table,
            "The chances are an assumption, not a measurement: that players of every level need "
            f"about {INNINGS:.0f} innings to reach their points, and make each shot with the same "
            "chance.",
        ],
        warnings=[*file.warnings, *warnings],
        data={"chart": chart.name, "innings": INNINGS},
        csv=table,
    )
