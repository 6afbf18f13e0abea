"""A validated season in figures: a table for files, and the statistics as details."""

import math
from collections.abc import Iterator
from typing import Any

from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.league.validate_handicaps import (
    handicap_rows,
    points_text,
    span_of,
    starts_table,
)
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.estimates import END_ERROR, REPLICAS, Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.stretches import STRETCHES
from evenbreak.ratings.validation.advantages import ByExperience, known_breaks
from evenbreak.ratings.validation.calibration import Scored
from evenbreak.ratings.validation.validate import Validation
from evenbreak.words import say

COLUMNS = ("part", "of", "item", "count", "expected", "value", "low", "high", "p_value")

_RIGHT = {"log_loss": math.log(2.0), "brier": 0.25, "slope": 1.0}
"""A coin's log-loss, and the ideal slope."""


def findings_table(found: Validation, chart: LeagueChart | None = None) -> Table:
    """Return all findings, one figure per row."""
    forecasts = found.forecasts
    counts = {"game": int(forecasts.games.sum()), "match": int((forecasts.race_a > 0).sum())}
    rows: list[tuple[Any, ...]] = [*_prior_rows(found)]
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
    rows += [("no_favorite", of, None, count, *[None] * 5) for of, count in found.toss_ups.items()]
    rows += _test_rows(found, counts["game"])
    rows += handicap_rows(found, chart or LeagueChart())
    return Table("findings", in_files(COLUMNS), rows)


def _prior_rows(found: Validation) -> Iterator[tuple[Any, ...]]:
    """Yield how the prior was chosen, and what levels gain; nothing if the prior was given."""
    choice = found.choice
    if choice is None:
        return
    for sd, loss in zip(choice.tried, choice.log_loss, strict=True):
        yield ("prior", "game", f"{sd:.6f}", choice.predicted, None, loss, None, None, None)
    head = ("game", "integrated", choice.predicted, None)
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


def _test_rows(found: Validation, games: int) -> list[tuple[Any, ...]]:
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


# The details: how good predictions were, and every test.

_EXPLAINED = (
    "How good the predictions were, with 95% intervals. Log-loss is the average of -ln(p), where "
    "p is the predicted chance of what happened; the Brier score is the mean squared error. Lower "
    "is better; tossing a coin scores 0.6931 and 0.25. The slope shows whether the chances are "
    "right: at 1 they are, below 1 they are too extreme, above 1 they are too cautious. 'Plug-in' "
    "takes the ratings at face value, 'integrated' averages over their uncertainty, and "
    "'default' does "
    "so with the default prior. The prior, in points, is how far apart players are assumed to be "
    "before any result. The intervals come from "
    f"{REPLICAS:,} samples; other samples would move their ends by about "
    f"{percent(2.0 * END_ERROR)} of the intervals' length."
)
_TESTS_EXPLAINED = (
    "Whether play within matches agrees with the model. 'Spread of scores' compares the squared "
    "errors of scores with what known strengths would give: more than expected suggests good "
    "and bad days, beyond any day-to-day form that is allowed for. Fewer 'runs of racks' than "
    "expected mean that games are won in streaks, which winner breaks also cause. p is how "
    "often luck alone makes a difference this large."
)


def details(found: Validation, scale: Scale) -> Iterator[Part]:
    """Yield the statistics, each table after its explanation."""
    yield _EXPLAINED
    yield _scored(found, scale)
    yield _prior(found, scale)
    tests = list(_tests(found))
    if tests:
        yield _TESTS_EXPLAINED
        yield Table("", _TEST_COLUMNS, tests)
    if found.spots:
        yield _by_spot(found)
    if found.lengths:
        yield _by_length(found)
    if found.starts is not None:
        yield starts_table(found.starts, scale)
    if found.experience:
        yield _experience(found, scale)


def _scored(found: Validation, scale: Scale) -> Table:
    columns = columns_of("of how prior log_loss brier slope")
    named = [(row.how, row) for row in found.scored] + [("default", row) for row in found.usual]
    rows = [
        (
            *(row.of, how, row.prior_sd * scale.points_per_log_odds),
            *(row.log_loss, row.brier.value, row.slope),
        )
        for how, row in named
    ]
    return Table("", columns, rows)


def _prior(found: Validation, scale: Scale) -> str:
    points = f"{points_text(found.prior_sd, scale)} points ({found.prior_sd:.2g} in log-odds)"
    choice = found.choice
    if choice is None:
        return f"The prior was given: {points}."
    if not choice.learned:
        return f"There are too few results to choose a prior, so the default is used: {points}."
    least = min(choice.log_loss)
    cost = choice.log_loss[choice.tried.index(PRIOR_SD)] - least
    return say(
        "The prior that predicts later scores best is {points} (the one that rate {prior} best "
        "finds). Over up to {stretches} stretches of the season, its average log-loss is "
        "{least:.4f} a game, with rating uncertainty allowed for. The default of {default} "
        "points costs {cost:.4f} more; if the prior had been chosen anew for each stretch, the "
        "log-loss would have been {as_it_went:.4f}.",
        points=points,
        stretches=STRETCHES,
        least=least,
        default=points_text(PRIOR_SD, scale),
        cost=cost,
        as_it_went=choice.as_it_went,
    )


_TEST_COLUMNS = columns_of("test matches seen expected range p_value")


def _tests(found: Validation) -> Iterator[tuple[Any, ...]]:
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None:
        figures = f"{spread.seen:.2f}", f"{spread.by_chance:.2f}"
        yield ("spread of scores", spread.races, *figures, None, spread.p_value)
    if runs is not None:
        figures = f"{runs.runs:,}", f"{runs.expected:,.0f}"
        yield ("runs of racks", runs.matches, *figures, None, runs.p_value)
    if first is not None:
        figures = f"{first.won:,}", f"{first.expected:,.1f}"
        yield ("won by the first breaker", first.matches, *figures, None, first.p_value)
    column = found.first_column
    if column is not None:
        figures = f"{column.won:,}", f"{column.expected:,.1f}"
        yield ("won by player_a", column.matches, *figures, None, None)
    for name, estimate in (("the breaker", found.breaker), ("player_a", found.side)):
        if estimate is not None:
            p, low, high = (1.0 / (1.0 + math.exp(-b)) for b in estimate)
            yield (f"even games won by {name}", None, f"{p:.3f}", "0.500", (low, high), None)


def _experience(found: Validation, scale: Scale) -> Table:
    """Return the less experienced players' results, by number of earlier games."""
    points = scale.points_per_log_odds

    def off(one: Estimate) -> str:
        return f"{points * one.value:+.1f}  {points * one.low:+.1f} to {points * one.high:+.1f}"

    columns = columns_of(
        "before matches predicted seen_percent points_off score_spread", show={"points_off": off}
    )
    rows = [
        (_games_before(one), *(one.matches, one.predicted, one.seen, one.stronger, one.spread))
        for one in found.experience
    ]
    title = (
        "Games won by the less experienced player in a match, by how many games they had played "
        "before; below 0 points, they are overrated compared with their opponents:"
    )
    return Table("", columns, rows, title)


def _games_before(one: ByExperience) -> str:
    if one.most is None:
        return f"{one.fewest} or more"
    return "none" if one.most == 0 else f"{one.fewest} to {one.most}"


def _by_spot(found: Validation) -> Table:
    """Return how often players who gave games won, by the number of games given."""
    columns = columns_of("spot matches won share_of_matches range expected_share")
    rows = [
        (row.spot or "all", row.matches, row.won, row.share, (row.low, row.high), row.expected)
        for row in found.spots
    ]
    return Table("", columns, rows, "Matches won by the player who gave games:")


def _by_length(found: Validation) -> Table:
    """Return how often favorites won even races, by the races' length."""
    columns = columns_of("races_to matches won share_of_matches range expected_share")
    rows = [
        (span_of(row), row.matches, row.won, row.share, (row.low, row.high), row.predicted)
        for row in found.lengths
    ]
    return Table("", columns, rows, "Even races won by the favorite, by the games needed:")
