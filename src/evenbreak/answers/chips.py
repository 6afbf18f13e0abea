"""Chip tournaments: the odds, who a chip chart favors, and a fairer chart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import luck_words
from evenbreak.answers.kit.columns import column_of, columns_of, quantities_of, table_by_column
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.remarks import file_name
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.systems import LEVELS_DOUBLE, scale_of_list, with_starters
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.answers.tournament.odds import place_errors
from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.fields.question import refuse
from evenbreak.files.charts import chip_chart_of
from evenbreak.files.lists.entrants import read_entrants
from evenbreak.questions import chips as questions
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.tournaments.chips.chip_charts import ChipChart, ChipRow
from evenbreak.tournaments.chips.chip_fairness import ChipFairness, chip_fairness, fairest_chips
from evenbreak.tournaments.chips.endgame import heads_up, last_players
from evenbreak.tournaments.chips.play import play_chips, rack_chances
from evenbreak.tournaments.evening.format import MOST_PLAYERS
from evenbreak.tournaments.odds.fairness import upper_half

_FIELD = 16  # players of a made-up field
_EXACT = 4  # players at most whose chances are exact


@dataclass(frozen=True, eq=False)
class ChipField:
    """A chip tournament's players."""

    names: Sequence[str]
    ratings: Floats
    scale: Scale
    tables: int
    source: str

    @property
    def words(self) -> str:
        """The field, in words."""
        return (
            f"{count_of(len(self.names), 'player')} {self.source}, on "
            f"{count_of(self.tables, 'table')}; ratings {scale_words(self.scale)}"
        )


def spread_field(scale: Scale, tables: int) -> ChipField:
    """Return a field of 16 players, up to two doublings of the odds on either side of the middle.

    >>> from evenbreak.ratings import SCALES
    >>> spread_field(SCALES["fargo"], 4).ratings[[0, -1]]
    array([700., 300.])
    """
    reach = 2.0 * scale.points_per_doubling
    ratings = np.linspace(scale.center + reach, scale.center - reach, _FIELD).round()
    names = [f"{points:g}" for points in ratings.tolist()]
    source = f"rated from {ratings[-1]:g} to {ratings[0]:g}"
    return ChipField(names, ratings, scale, tables, source)


def chip_odds_answer(
    field: ChipField,
    chart: ChipChart | None = None,
    left: Mapping[str, int] | None = None,
    *,
    seed: int = 0,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return each player's chance of winning a chip tournament.

    `chart` sets the starting chips; or `left` has the last players, at one table, and their chips:
    the first is at the table, the second is the challenger, and the others are waiting in line.
    """
    rng = np.random.default_rng(seed)
    if left is None:
        if chart is None:
            raise InputError("give a chip chart, or the chips that are left")
        names, ratings = list(field.names), field.ratings
        chips = chart.chips(ratings).tolist()
    else:
        names, chips = list(left), list(left.values())
        unknown = [name for name in names if name not in field.names]
        if unknown:
            raise InputError("{unknown!r} isn't {source}", unknown=unknown[0], source=field.source)
        ratings = np.array([field.ratings[list(field.names).index(name)] for name in names])
    racks = rack_chances(ratings, scale=field.scale)
    exact = left is not None and len(names) <= _EXACT
    error: Floats | None = None
    if left is not None and exact:
        p_place = last_players(chips, racks).p_place
        how = "The odds are exact, if the ratings are right."
    else:
        line = None if left is None else range(len(names))
        tables = field.tables if left is None else 1
        played = play_chips(chips, racks, tables=tables, line=line, rng=rng)
        p_place, error = played.p_place, played.error
        how = _luck_words(played.runs, error[:, 0])
        if left is None:
            how += " The players come to the tables in a new random order each time."
    order = np.argsort(-p_place[:, 0], kind="stable").tolist()
    values: dict[Any, Any] = {"name": names, "rating": ratings, "chips": chips}
    every = [("p_title", "title"), ("p_second", "second"), ("p_third", "third")]
    places = dict(every[: len(names)])
    for k, (key, words) in enumerate(places.items()):
        values[column_of("p_place", name=key, place=words)] = p_place[:, k]
    if error is not None:
        values |= place_errors(places, error[:, : len(places)])
    best = order[0]
    words = f"{names[best]} is the favorite and wins {percent(p_place[best, 0])} of the time."
    if left is None:
        words += f" An equal share would be {percent(1.0 / len(names))}."
    table = table_by_column("players", values, order=order)
    heading = f"Chip tournament: {field.words}"
    if left is not None:
        heading = f"The last {len(names)} of a chip tournament; ratings {scale_words(field.scale)}"
    elif chart is not None:
        heading += f"\nChips from the chart {chart.name}"
    parts: list[Part] = [words, Quantities(quantities_of({"exact": exact})), table, how]
    return Answer(heading, parts, warnings=list(warnings), csv=table)


def chip_audit(asked: questions.ChipAudit) -> Answer:
    """Return who a chip chart favors: over a tournament, and between the last two players."""
    field, warnings = _field_of(asked, asked.entrants)
    chart = chip_chart_of(asked.chart)
    found = chip_fairness(
        field.ratings, chart, scale=field.scale, tables=field.tables, seed=asked.seed
    )
    by_row = _row_table(chart, found)
    between = _heads_up_table(chart, field.scale)
    parts: list[Part] = [_favor_words(field, found), _fairness(found), by_row, between]
    parts.append(_luck_words(found.odds.runs, found.odds.error[:, 0]))
    if chart.source:
        parts.append(f"Chart: {chart.source}.")
    return Answer(f"{chart.name}: {field.words}", parts, warnings=warnings, csv=by_row)


def chip_design(asked: questions.ChipDesign) -> Answer:
    """Return the chip chart that makes a tournament as even as a search can make it."""
    field, warnings = _field_of(asked, asked.entrants)
    starts = _bands(field) if asked.bands is None else sorted(asked.bands)
    found = fairest_chips(
        field.ratings,
        bands=starts,
        fewest=asked.fewest,
        most=asked.most,
        scale=field.scale,
        tables=field.tables,
        seed=asked.seed,
    )
    chart = _chart_of(field.ratings, found, starts)
    rows = [[_start(row), row.chips] for row in chart.rows]
    columns = columns_of("rating_from chips")
    table = Table("chart", columns, rows, title="The chart")
    parts: list[Part] = [_favor_words(field, found), _fairness(found), table]
    parts += [_row_table(chart, found), _luck_words(found.odds.runs, found.odds.error[:, 0])]
    return Answer(f"A fairer chip chart: {field.words}", parts, warnings=warnings, csv=table)


def _start(row: ChipRow) -> float | None:
    """Return where a chart's row starts; None for the weakest players' row."""
    return None if np.isinf(row.rating_from) else row.rating_from


def _bands(field: ChipField) -> list[float]:
    """Return the ratings that are whole multiples of half a doubling from the middle."""
    step = field.scale.points_per_doubling / 2.0
    low, high = (
        int(np.floor((end - field.scale.center) / step) + 1)
        for end in (field.ratings.min(), field.ratings.max())
    )
    return [field.scale.center + k * step for k in range(low, high)]


def _chart_of(ratings: Floats, found: ChipFairness, starts: Sequence[float]) -> ChipChart:
    """Return the chart for designed chips; a row without players is merged with the row above."""
    rows: list[ChipRow] = []
    place = np.searchsorted(starts, ratings, side="right")
    for k, start in enumerate([-np.inf, *starts]):
        there = found.chips[place == k]
        if there.size and (not rows or rows[-1].chips != there[0]):
            rows.append(ChipRow(start if rows else -np.inf, int(there[0])))
    return ChipChart("designed", rows)


def _favor_words(field: ChipField, found: ChipFairness) -> str:
    title, order = found.odds.title, np.argsort(-field.ratings, kind="stable")
    upper = upper_half(field.ratings, title)
    if abs(upper - 0.5) < 0.03:
        verdict = "favors neither the stronger nor the weaker half of the field"
    else:
        verdict = f"favors the {'stronger' if upper > 0.5 else 'weaker'} half of the field"
    top = order[0]
    times = float(len(title) * title[top])
    return (
        f"The chart {verdict}: the stronger half wins the tournament {percent(upper)} of the time, "
        f"and 50% would be even.\nThe strongest player wins {percent(title[top])} of the time, "
        f"{times:.1f} times an equal share."
    )


def _fairness(found: ChipFairness) -> Quantities:
    return Quantities(quantities_of({"spread": found.spread, "racks_mean": found.odds.racks_mean}))


def _row_table(chart: ChipChart, found: ChipFairness) -> Table:
    """Return how often the players in each row of a chart win."""
    starts = [row.rating_from for row in chart.rows]
    place = np.searchsorted(starts, found.ratings, side="right") - 1
    rows: list[list[Any]] = []
    for k, row in reversed(list(enumerate(chart.rows))):
        there = place == k
        title = float(found.odds.title[there].mean()) if there.any() else None
        times = None if title is None else len(place) * title
        rows.append([_start(row), row.chips, int(there.sum()), title, times])
    columns = columns_of("band_from chips players p_title times_equal_share")
    return Table("rows", columns, rows, title="Title odds by row of the chart")


def _heads_up_table(chart: ChipChart, scale: Scale) -> Table:
    steps = (1.5, 0.5, -0.5, -1.5)
    ratings = [scale.center + step * scale.points_per_doubling for step in steps]
    rows = []
    for stronger, weaker in combinations(ratings, 2):
        a, b = chart.chips([stronger, weaker]).tolist()
        p = heads_up(float(scale.win_probability(stronger - weaker)), a, b)
        rows.append([stronger, weaker, (a, b), p])
    columns = columns_of("stronger weaker chips_pair p_stronger")
    return Table("heads_up", columns, rows, title="If the last two players have all their chips")


def _luck_words(runs: int, error: Floats) -> str:
    return f"{runs:,} tournaments were played out; {luck_words(error.tolist(), 'title odds')}."


def chip_odds(asked: questions.ChipOdds) -> Answer:
    """Return each player's odds."""
    field, warnings = _field_of(asked, asked.entrants)
    chart = None if asked.chips is None else chip_chart_of(asked.chips)
    return chip_odds_answer(field, chart, asked.left, seed=asked.seed, warnings=warnings)


def _field_of(asked: questions.ChipField, entrants: str | None) -> tuple[ChipField, list[str]]:
    """Return the players, made up if no file names them, and warnings about them."""
    if entrants is None:
        return spread_field(asked.scale or SCALES["fargo"], asked.tables), []
    file = read_entrants(entrants)
    scale = scale_of_list(file, asked.scale, LEVELS_DOUBLE)
    roster = with_starters(file.roster, scale, asked.starter, asked.starter_sd)
    if not 2 <= len(roster) <= MOST_PLAYERS:
        refuse(
            "{file} has {n:,} entrants; a tournament takes 2 to {most}",
            file=entrants,
            n=len(roster),
            most=MOST_PLAYERS,
        )
    field = ChipField(roster.players, roster.rating, scale, asked.tables, f"in {file_name(file)}")
    return field, list(file.warnings)
