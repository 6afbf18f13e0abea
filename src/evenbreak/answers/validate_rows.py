"""A validated season for files: one table with everything that was found."""

import math
from collections.abc import Iterator
from typing import Any

from evenbreak.answers.kit.parts import Column, Table
from evenbreak.answers.validate_handicaps import handicap_rows
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.advantages import known_breaks
from evenbreak.ratings.calibration import Scored
from evenbreak.ratings.validate import Validation

COLUMNS = ("part", "of", "item", "count", "expected", "value", "low", "high", "p_value")

_RIGHT = {"log_loss": math.log(2.0), "brier": 0.25, "slope": 1.0}
"""What a coin has, and the slope that is right."""


def findings_table(found: Validation, chart: LeagueChart | None = None) -> Table:
    """Return everything that was found, a figure a row."""
    forecasts = found.forecasts
    counts = {"game": int(forecasts.games.sum()), "match": int((forecasts.race_a > 0).sum())}
    rows: list[tuple[Any, ...]] = [*_prior(found)]
    for row in found.scored:
        head = (row.of, row.how, counts[row.of])
        rows.append(("prior_sd", *head, None, row.prior_sd, None, None, None))
        rows += _goodness(row, head)
    for row in found.usual:
        rows += _goodness(row, (row.of, "usual", counts[row.of]))
    rows += [
        ("gain", of, "integrated", counts[of], 0.0, *gain, None) for of, gain in found.gain.items()
    ]
    rows += [
        ("half_life", "game", f"{one.half_life:g}", counts["game"], 0.0, *one.gain, None)
        for one in found.half_lives
    ]
    for part, of, bins in (
        ("calibration", "game", found.games),
        ("calibration", "match", found.matches),
        ("calibration_plug_in", "match", found.matches_plug_in),
    ):
        rows += [(part, of, f"{b.p_from:.2f}-{b.p_to:.2f}", *b[3:], None) for b in bins]
    rows += [("no_favourite", of, None, count, *[None] * 5) for of, count in found.toss_ups.items()]
    rows += _tests(found, counts["game"])
    rows += handicap_rows(found, chart or LeagueChart())
    return Table("findings", [Column(name) for name in COLUMNS], rows)


def _prior(found: Validation) -> Iterator[tuple[Any, ...]]:
    """Yield how the prior was chosen, and what levels gain; nothing where it was given."""
    choice = found.choice
    if choice is None:
        return
    for sd, loss in zip(choice.tried, choice.log_loss, strict=True):
        yield ("prior", "game", f"{sd:.6f}", choice.predicted, None, loss, None, None, None)
    head = ("game", "plug-in", choice.predicted, None)
    yield ("prior_range", *head, found.prior_sd, choice.low, choice.high, None)
    yield ("log_loss_as_it_went", *head, choice.as_it_went, None, None, None)
    for one in choice.evidence:
        if one.of != "half_life":
            yield ("level", "game", one.of, choice.predicted, 0.0, *one.gain, None)


def _goodness(row: Scored, head: tuple[str, str, int]) -> list[tuple[Any, ...]]:
    estimates = [(part, getattr(row, part), right) for part, right in _RIGHT.items()]
    return [
        (part, *head, right, *estimate, None)
        for part, estimate, right in estimates
        if estimate is not None
    ]


def _tests(found: Validation, games: int) -> list[tuple[Any, ...]]:
    rows: list[tuple[Any, ...]] = []
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None:
        figures = (spread.races, spread.by_chance, spread.seen)
        rows.append(("dispersion", "match", "scores", *figures, None, None, spread.p_value))
    if found.form is not None:
        rows.append(("form", "game", "variance", found.form.races, 0.0, *found.form.variance, None))
        for shape in found.form.shapes:
            head = ("score", "match", shape.of, found.form.races)
            rows.append((*head, shape.said, *shape.seen, None))
            rows.append(("score_with_form", *head[1:], shape.said_with_form, *shape.seen, None))
    if runs is not None:
        figures = (runs.matches, runs.expected, float(runs.runs))
        rows.append(("streaks", "match", "runs", *figures, None, None, runs.p_value))
    if first is not None:
        figures = (first.matches, first.expected, float(first.won))
        rows.append(("first_break", "match", "won", *figures, None, None, first.p_value))
    column = found.first_column
    if column is not None:
        figures = (column.matches, column.expected, float(column.won))
        rows.append(("first_column", "match", "won", *figures, None, None, None))
        figures = (column.dates, column.dates_expected, float(column.dates_won))
        rows.append(("first_column_dates", "match", "won", *figures, None, None, None))
        head = ("first_column_varies", "match", "p", column.matches)
        rows.append((*head, None, None, None, None, column.varies))
    for name, estimate, count in (
        ("side", found.side, games),
        ("breaker", found.breaker, known_breaks(found.forecasts)),
    ):
        if estimate is not None:
            rows.append((name, "game", "log_odds", count, 0.0, *estimate, None))
    for row in found.spots:
        spot = "all" if row.spot is None else row.spot
        figures = (row.matches, row.expected, row.share)
        rows.append(("spot", "match", spot, *figures, row.low, row.high, None))
    for one in found.experience:
        before = f"{one.fewest}-{'' if one.most is None else one.most}"
        rows.append(("experience", "game", before, one.games, 0.0, *one.stronger, None))
    for half in found.lengths:
        figures = (half.matches, half.predicted, half.share)
        ends = f"{half.shortest}-{half.longest}"
        rows.append(("race_length", "match", ends, *figures, half.low, half.high, None))
    return rows
