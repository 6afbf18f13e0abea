"""What `evenbreak matchups` says: its table on a terminal, and when the evening ends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.answers.roster_matchups import NEW, RosterMatchups, roster_matchups
from evenbreak.cli.kit.old_players import scale_text
from evenbreak.cli.kit.output import WIDTH, aligned, chance_text, heading_lines, paragraphs
from evenbreak.files.problems import printable
from evenbreak.matches.evening import evening

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.answers.fair_pairs import RaceLimits
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.ratings.roster import Roster
    from evenbreak.ratings.scale import Scale

KINDS = {"chart": "By the chart", "best": "In the fairest races"}


@dataclass(frozen=True, eq=False)
class Told:
    """What was asked for, and how to say the answer."""

    roster: Roster
    scale: Scale
    chart: Chart | LevelChart | None
    limits: RaceLimits | None
    minutes: float | None

    def matchups(self, pairs: NDArray[Any]) -> RosterMatchups:
        """Return the races of pairs."""
        return roster_matchups(
            self.roster,
            pairs,
            scale=self.scale,
            chart=self.chart,
            limits=self.limits,
            minutes_per_game=self.minutes,
        )

    @property
    def heading(self) -> str:
        """What the table rests on, in lines that fit a terminal."""
        ways = [] if self.chart is None else [f"chart {self.chart.name}"]
        if self.limits is not None and self.limits.games is not None:
            ways.append("fairest races of {} to {} games".format(*self.limits.games))
        elif self.limits is not None:
            ways.append(f"fairest races to {self.limits.race_to}")
        text = printable(" and ".join(ways))
        scale = scale_text(self.scale)
        gap = " " if len(text) + len(scale) + 2 <= WIDTH else "\n"
        return f"{text[:1].upper()}{text[1:]},{gap}{scale}"

    @property
    def doubtful(self) -> bool:
        """Whether the error of any rating is stated."""
        return bool((self.roster.standard_error > 0.0).any())

    def text(self, answer: RosterMatchups) -> str:
        """Return the table for a terminal, with what is to be said of it below."""
        kinds = self._kinds()
        both = len(kinds) > 1
        names = list(answer.frame.columns)
        rows = [dict(zip(names, row, strict=True)) for row in answer.frame.itertuples(index=False)]
        headings = ["A", "B"]
        for name in kinds.values():
            headings += self._headings(name, both=both)
        cells = [
            [
                printable(row["player_a"]),
                printable(row["player_b"]),
                *(cell for prefix in kinds for cell in self._cells(prefix, row, both=both)),
            ]
            for row in rows
        ]
        table = aligned([*heading_lines(headings), *cells], left=2)
        parts = [self.heading, table.rstrip("\n")]
        if below := self._below(answer, rows):
            parts.append("\n".join(below))
        return "\n\n".join(parts) + "\n"

    def _kinds(self) -> dict[str, str]:
        """Return the prefix of the columns of each kind of race, and what to call it."""
        if self.chart is None:
            return {"": "fairest"}
        if self.limits is None:
            return {"chart_": "chart"}
        return {"chart_": "chart\nrace", "": "fair\nrace"}

    def _headings(self, name: str, *, both: bool) -> list[str]:
        if both:
            return [name, "A wins", "games" if self.minutes is None else "min"]
        length = "games" if self.minutes is None else "minutes"
        plug_in = ["as if\nsure"] if self.doubtful else []
        return [name, "A wins", *plug_in, length, "9 of 10\nwithin"]

    def _cells(self, prefix: str, row: dict[str, Any], *, both: bool) -> list[str]:
        names = self._headings("", both=both)
        if math.isnan(row["difference"]):
            return [""] * len(names)
        unit = "games" if self.minutes is None else "minutes"
        cells = [
            f"{row[f'{prefix}race_a']}:{row[f'{prefix}race_b']}",
            chance_text(row[f"{prefix}p_win_a"]),
        ]
        if self.doubtful and not both:
            cells.append(chance_text(row[f"{prefix}p_win_a_plug_in"]))
        mean = row[f"{prefix}mean_{unit}"]
        cells.append(f"{mean:.1f}" if self.minutes is None else f"{mean:.0f}")
        return cells if both else [*cells, f"{row[f'{prefix}{unit}_p90']:.0f}"]

    def _below(self, answer: RosterMatchups, rows: list[dict[str, Any]]) -> list[str]:
        """Return what is to be said of the pairs."""
        lines = [
            f"{printable(row['player_a'])} (A), {printable(row['player_b'])} (B): {note}"
            for row in rows
            for note in row["note"].split("; ")
            if note and note not in NEW
        ]
        if self.doubtful:
            tail = "" if len(self._kinds()) > 1 else "; as if sure: were they right"
            lines.append(f"A wins: averaged over how far ratings may be off{tail}.")
        if self.chart is not None and answer.linked.any():
            worst = rows[int(answer.frame["chart_unfairness"].argmax())]
            lines.append(
                f"The chart is least fair to {printable(_weaker(worst))}, with "
                f"{chance_text(0.5 - worst['chart_unfairness'])} against "
                f"{printable(_favoured(worst))}."
            )
        return list(map(paragraphs, lines))

    def evening(
        self, answer: RosterMatchups, pairs: NDArray[Any], tables: int, seed: int
    ) -> list[dict[str, Any]]:
        """Return when all matches that have a race are over, in minutes."""
        minutes = self.minutes or 1.0
        meets = [(int(a), int(b)) for a, b in pairs[answer.linked]]
        ends = []
        for kind, laws in (("chart", answer.chart_laws), ("best", answer.best_laws)):
            if laws:
                end = evening(laws, tables=tables, players=meets, rng=np.random.default_rng(seed))
                ends.append(
                    {
                        "races": kind,
                        "matches": len(laws),
                        "tables": tables,
                        "mean_minutes": end.mean * minutes,
                        "minutes_p90": end.p90 * minutes,
                        "exact": end.exact,
                        "runs": end.runs,
                        "mean_minutes_error": end.mean_error * minutes,
                    }
                )
        return ends

    def evening_lines(self, ends: list[dict[str, Any]]) -> list[str]:
        """Return when the evening ends, a line for each kind of race."""
        return [_evening_line(end) for end in ends]


def _evening_line(end: dict[str, Any]) -> str:
    tables = f"{end['tables']} table{'s' if end['tables'] > 1 else ''}"
    matches = f"{end['matches']:,} matches" if end["matches"] > 1 else "1 match"
    take = "take" if end["matches"] > 1 else "takes"
    text = (
        f"{KINDS[end['races']]}, {matches} on {tables} {take} "
        f"{_clock(end['mean_minutes'])} on average;\n9 evenings of 10 are over within "
        f"{_clock(end['minutes_p90'])}"
    )
    if end["exact"]:
        return f"{text}."
    return (
        f"{text}, by {end['runs']:,} evenings\nplayed out (standard error of the average "
        f"{_small(end['mean_minutes_error'])} minutes)."
    )


def _small(minutes: float) -> str:
    """Return an error in minutes, which is not told as nought unless it is.

    >>> _small(1.24), _small(0.0312), _small(0.0)
    ('1.2', '0.03', '0')
    """
    return f"{minutes:.1f}" if minutes >= 0.1 else f"{minutes:.1g}"


def _clock(minutes: float) -> str:
    """Return minutes as hours and minutes.

    >>> _clock(52.4), _clock(119.7), _clock(185.0)
    ('52 min', '2 h 00', '3 h 05')
    """
    whole = round(minutes)
    return f"{whole} min" if whole < 60 else f"{whole // 60} h {whole % 60:02d}"


def _weaker(row: dict[str, Any]) -> str:
    name: str = row["player_b"] if row["chart_p_win_a"] >= 0.5 else row["player_a"]
    return name


def _favoured(row: dict[str, Any]) -> str:
    name: str = row["player_a"] if row["chart_p_win_a"] >= 0.5 else row["player_b"]
    return name
