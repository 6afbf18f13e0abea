"""What a simulated season says to whoever runs the league."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from evenbreak.answers.season_frames import (
    NEAR,
    fairness_frame,
    standings_frame,
    weeks_frame,
    weeks_with_players,
)
from evenbreak.answers.wording import count_of
from evenbreak.files.problems import printable

if TYPE_CHECKING:
    import pandas as pd

    from evenbreak.league.season import Season
    from evenbreak.league.tally import Tally

SHOWN = 12
"""Players of the table that a terminal shows: the first and the last half of them."""

MISTAKEN = 0.05
"""The chance, at most, that anybody is said to profit or to lose where nobody does either."""


def season_words(season: Season, tally: Tally) -> list[str]:
    """Return what came of a season, a paragraph each.

    >>> import numpy as np
    >>> from evenbreak.league import LeaguePlayers, Season, run_chunk
    >>> season = Season(LeaguePlayers.of([92, 80]), "npl", weeks=3)
    >>> season_words(season, run_chunk(season, 20, np.random.SeedSequence(1)))[0]
    '2 players, 3 weeks, 3 matches a season; system npl, chart npl_10; 20 seasons simulated.'
    """
    matches = float(tally.matches.sum() / 2 / tally.replicas.sum())
    if not matches:
        return ["No match was played: nobody was there whom the schedule had meet."]
    standings = standings_frame(season, tally)
    return [
        f"{len(season.players):,} players, {count_of(season.weeks, 'week', 'weeks')}, "
        f"{_count(matches)} matches a season; system {season.system.name}, chart "
        f"{season.chart.name}; {count_of(int(tally.replicas.sum()), 'season', 'seasons')} "
        "simulated.",
        _ratings(weeks_frame(tally)),
        _nights(fairness_frame(season, tally)),
        _profit(standings, len(tally.replicas)),
        _luck(standings),
    ]


def _ratings(weeks: pd.DataFrame) -> str:
    there = weeks_with_players(weeks)
    first, last = there.iloc[0], there.iloc[-1]
    near = f"p_within_{NEAR}"
    off = _with(last["error_sd"], last["error_sd_se"])
    start = "At the start" if first["week"] == 0 else f"After week {int(first['week'])}"
    return (
        f"How wrong are the ratings? {start} by {first['error_sd']:.1f} points (standard "
        f"deviation; mean {first['error_mean']:+.1f}), and {_percent(first[near])} are within "
        f"{NEAR}. After week {int(last['week'])} by {off} points (mean "
        f"{last['error_mean']:+.1f}), and {_percent(last[near])} are within {NEAR}; 9 of 10 are "
        f"between {last['error_p05']:+.0f} and {last['error_p95']:+.0f}.{_gone(weeks, there)}"
    )


def _gone(weeks: pd.DataFrame, there: pd.DataFrame) -> str:
    """Return the sentence on the weeks in which nobody is in the league."""
    many = count_of(len(weeks) - 1, "week", "weeks")
    count = int((weeks["players"][1:] == 0).sum())
    if not count:
        return ""
    first, last = int(there["week"].iloc[0]), int(there["week"].iloc[-1])
    return (
        f" In {count:,} of the {many} nobody is in the league: what is said of ratings is of weeks "
        f"{max(first, 1)} to {last}."
    )


def _nights(fairness: pd.DataFrame) -> str:
    every = fairness[fairness["group"] == "all"].iloc[0]
    fifths = fairness[fairness["group"] == "fifth"]
    text = (
        "How fair are the nights? The stronger player of the day wins "
        f"{_percent(every['p_win'], every['p_win_se'])} of his matches; 50 would be even. "
        f"{_percent(every['p_hill_hill'])} come down to the last game, "
        f"{_percent(every['p_shutout'])} are shutouts, and a match takes "
        f"{every['mean_games']:.1f} games."
    )
    if len(fifths) < 2:
        return text
    low, high = fifths.iloc[0], fifths.iloc[-1]
    return (
        f"{text} The weakest fifth of the players wins {_percent(low['p_win'], low['p_win_se'])}, "
        f"the strongest {_percent(high['p_win'], high['p_win_se'])}."
    )


def _profit(standings: pd.DataFrame, batches: int) -> str:
    """Return the sentence on who wins most and least of his matches, if that is no luck.

    Of many players some are off a half by luck: the more there are, the further one must be.
    """
    from scipy.special import stdtrit

    played = standings[standings["matches"] > 0]
    off = played["p_win"] - 0.5
    clear = -float(stdtrit(max(batches - 1, 1), MISTAKEN / 2 / len(played)))
    sure = off.abs() > clear * played["p_win_se"]  # never where there is no standard error
    above, below = played[sure & (off > 0)], played[sure & (off < 0)]

    def told(row: pd.Series[Any]) -> str:
        return (
            f"{printable(str(row['player']))}, rated {row['rating_start']:.0f} with a skill of "
            f"{row['skill_start']:.0f}, wins {_percent(row['p_win'], row['p_win_se'])}"
        )

    if above.empty and below.empty:
        return (
            "Who profits? Nobody that these seasons can tell: no player's part of matches won "
            "is clearly off a half."
        )
    best = "" if above.empty else told(above.iloc[above["p_win"].argmax()])
    worst = "" if below.empty else told(below.iloc[below["p_win"].argmin()])
    if not worst:
        return (
            f"Who profits? Most of all {best} of the matches; nobody clearly wins less than half."
        )
    if not best:
        return f"Who profits? Nobody clearly wins more than half of his matches; least {worst}."
    return f"Who profits? Most of all {best} of the matches; least {worst}."


def _luck(standings: pd.DataFrame) -> str:
    between = float(standings["points_mean"].std(ddof=0))
    luck = math.sqrt(float((standings["points_sd"] ** 2).mean()))
    if math.isnan(luck):
        return "How much of the table is luck? One season does not tell."
    part = between**2 / (between**2 + luck**2) if between or luck else 0.0
    return (
        f"How much of the table is luck? A player's matches won vary by {luck:.1f} from season to "
        f"season (standard deviation), the players' means by {between:.1f}: {_percent(part)} of "
        "what one table shows is who they are and how often they play, the rest is luck."
    )


def standings_rows(season: Season, tally: Tally) -> list[list[str]]:
    """Return the table as a terminal shows it, with its headings; of many the first and last."""
    frame = standings_frame(season, tally)
    rows = [["", "player", "rated", "matches", "won", "8 of 10 seasons", "chance", "rated then"]]
    half = SHOWN // 2
    for place, row in enumerate(frame.to_dict("records")):
        if len(frame) > SHOWN + 1 and half <= place < len(frame) - half:
            if place == half:
                rows.append(["...", *[""] * 7])
            continue
        # One season has no spread, and a large league's laws are not kept.
        known = not math.isnan(row["points_sd"]) and row["points_p10"] == row["points_p10"]
        rows.append(
            [
                str(place + 1),
                printable(str(row["player"])),
                f"{row['rating_start']:.0f}",
                f"{row['matches']:.1f}",
                f"{row['points_mean']:.1f}",
                f"{row['points_p10']:.0f} to {row['points_p90']:.0f}" if known else "",
                "" if math.isnan(row["p_win"]) else f"{row['p_win']:.3f}",
                f"{row['rating_mean']:.1f}",
            ]
        )
    return rows


def _count(mean: float) -> str:
    """Return a mean number of matches.

    >>> _count(12.0), _count(14.26), _count(12_345.6)
    ('12', '14.3', '12,346')
    """
    return f"{mean:,.0f}" if mean >= 1000.0 or mean == round(mean) else f"{mean:.1f}"


def _percent(p: float, error: float = math.nan) -> str:
    """Return a probability in percent, with its standard error where there is one."""
    return f"{_with(100 * p, 100 * error)} %"


def _with(value: float, error: float) -> str:
    """Return a value with its standard error, which never looks like none where there is one.

    >>> _with(6.551, 0.038), _with(53.29, 0.153), _with(7.1, math.nan), _with(50.0, 0.0)
    ('6.6 ± 0.04', '53.3 ± 0.2', '7.1', '50.0')
    """
    if math.isnan(error) or not error:
        return f"{value:.1f}"
    return f"{value:.1f} ± " + (f"{error:.1f}" if error >= 0.095 else f"{error:.1g}")
