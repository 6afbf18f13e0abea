"""The statistics of a validated season: how good predictions were, and every test."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from evenbreak.answers.kit.parts import Column, Part, Table
from evenbreak.answers.kit.wording import count_of, decimals, percent, range_words
from evenbreak.answers.validate_handicaps import starts_table
from evenbreak.answers.validate_judgement import points_text
from evenbreak.ratings.advantages import ByExperience
from evenbreak.ratings.calibration import END_ERROR, REPLICAS, Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.stretches import STRETCHES
from evenbreak.ratings.validate import Validation
from evenbreak.ratings.within_matches import MatchForm

NEARLY_EVEN = 0.56
"""Favourites with less than this chance, on average, are hardly any."""

_EXPLAINED = (
    "How good the predictions were, with 95% intervals. Log-loss is the average of -ln(p), where "
    "p is the predicted chance of what happened; the Brier score is the mean squared error. Lower "
    "is better; tossing a coin scores 0.6931 and 0.25. The slope shows whether the chances are "
    "right: at 1 they are, below 1 they are too extreme, above 1 too cautious. 'Plug-in' takes "
    "the ratings at face value, 'integrated' averages over their uncertainty, and 'default' does "
    "so with the default prior. The prior, in points, is how far apart players are assumed to be "
    "before any result. The intervals come from "
    f"{REPLICAS:,} samples; other samples would move their ends by about "
    f"{percent(2.0 * END_ERROR)} of their length."
)
_TESTS_EXPLAINED = (
    "Whether play within matches agrees with the model. 'Spread of scores' compares their squared "
    "errors with those of known strengths: more than expected suggests good and bad days. Fewer "
    "'runs of racks' won by one player than expected mean streaks, which winner breaks cause too. "
    "p is how often luck alone makes so large a difference."
)


def details(found: Validation, scale: Scale) -> Iterator[Part]:
    """Yield the statistics, each table after what explains it."""
    yield _EXPLAINED
    yield _scored(found, scale)
    yield _prior(found, scale)
    yield _integrated(found)
    if found.half_lives:
        yield _half_lives(found)
    tests = list(_tests(found))
    if tests:
        yield _TESTS_EXPLAINED
        yield Table("", _TEST_COLUMNS, tests)
    if found.form is not None:
        yield _form(found.form, scale)
        yield _shapes(found.form)
    if found.lengths:
        yield _lengths(found)
    if found.matches:
        yield _matches(found)
        if found.spots:
            yield _evenness(found)
            yield _by_spot(found)
    if found.starts is not None:
        yield starts_table(found.starts, scale)
        if race := found.forecasts.levels.race:
            yield (
                f"The {found.starts.share.value:.2f} is what all results show. The {race:.2f} that "
                "is taken before any result is what predicts later games best; the players' own "
                "results then add to it."
            )
    if found.experience:
        yield _experience(found, scale)
    new = int(found.forecasts.new.sum())
    if new:
        yield f"In {count_of(new, 'match', 'matches')} one of the players had not played before."


def _evenness(found: Validation) -> str:
    """Return how many matches had a start, and how even that leaves the matches."""
    matches = np.array([row.matches for row in found.matches])
    favourite = float(matches @ [row.predicted for row in found.matches] / matches.sum())
    spots = found.spots[-1].matches / int((found.forecasts.race_a > 0).sum())
    text = (
        f"One player gave games in {percent(spots)} of the matches, and the ratings give their "
        f"favourite {percent(favourite)} on average"
    )
    if favourite > NEARLY_EVEN:
        return f"{text}, starts included."
    return (
        f"{text}: nearly even, so the favourite is picked mostly by the ratings' own errors, and "
        "predictions of matches are of little use."
    )


def _scored(found: Validation, scale: Scale) -> Table:
    columns = [
        Column("of", "what", left=True),
        Column("how", "how", left=True),
        Column("prior", "prior", decimals(1)),
        Column("log_loss", "log-loss", lambda one: _span(one, 4, "-")),
        Column("brier", "Brier", decimals(3)),
        Column("slope", "slope", lambda one: _span(one, 2, " to ")),
    ]
    named = [(row.how, row) for row in found.scored] + [("default", row) for row in found.usual]
    rows = [
        (
            *(row.of, how, row.prior_sd * scale.points_per_log_odds),
            *(row.log_loss, row.brier.value, row.slope),
        )
        for how, row in named
    ]
    return Table("", columns, rows)


def _span(estimate: Estimate, digits: int, to: str) -> str:
    value, low, high = (f"{part:.{digits}f}" for part in estimate)
    return f"{value}  {low}{to}{high}"


def _prior(found: Validation, scale: Scale) -> str:
    points = f"{points_text(found.prior_sd, scale)} points ({found.prior_sd:.2g} in log-odds)"
    choice = found.choice
    if choice is None:
        return f"The prior was given: {points}."
    if not choice.learnt:
        return f"There are too few results to choose a prior, so the default is used: {points}."
    least = min(choice.log_loss)
    cost = choice.log_loss[choice.tried.index(PRIOR_SD)] - least
    return (
        f"The prior of {points} predicts later games best, as rate --prior best finds: by ratings "
        f"at face value, in up to {STRETCHES} stretches of the season, its log-loss is "
        f"{least:.4f} a game. The default of {points_text(PRIOR_SD, scale)} points costs "
        f"{cost:.4f} more; with the prior chosen anew for each stretch, log-loss would have been "
        f"{choice.as_it_went:.4f}."
    )


def _half_lives(found: Validation) -> Table:
    """Return what it gains to let old games count less."""
    columns = [
        Column("half_life", "half-life", lambda days: f"{days:g} days"),
        Column("gain", "log-loss saved a game", lambda one: _span(one, 4, " to ")),
    ]
    title = "What it would gain to let old games count less; below 0, it predicts worse:"
    return Table("", columns, found.half_lives, title)


def _integrated(found: Validation) -> str:
    # Under handicaps chances of matches are mostly noise, so games are used.
    of = "match" if "match" in found.gain and not found.spots else "game"
    gain = found.gain[of]
    effect = "makes no clear difference"
    if gain.low > 0.0 or gain.high < 0.0:
        effect = f"predicts {'better' if gain.low > 0.0 else 'worse'}"
    return (
        f"Averaging over the uncertainty of the ratings {effect}: log-loss falls by "
        f"{gain.value:z.4f} a {of} ({gain.low:z.4f} to {gain.high:z.4f})."
    )


def _range(ends: tuple[float, float]) -> str:
    return f"{ends[0]:.3f} to {ends[1]:.3f}"


_TEST_COLUMNS = (
    Column("test", "", left=True),
    Column("matches", "matches"),
    Column("seen", "seen"),
    Column("expected", "expected"),
    Column("range", "95% interval", _range),
    Column("p_value", "p", lambda p: f"{p:.2g}" if p >= 1e-4 else "< 0.0001"),
)


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
            yield (
                f"even games won by {name}",
                None,
                f"{p:.3f}",
                "0.500",
                (low, high),
                None,
            )


def _form(form: MatchForm, scale: Scale) -> str:
    v, low, high = form.variance
    points = scale.points_per_log_odds
    end = "This is established." if form.established else "This may be luck."
    return (
        f"Form of the day: the difference between two players varies from match to match with a "
        f"standard deviation of {points * form.sd:.0f} points (variance {v:.3f} in squared "
        f"log-odds, {low:z.3f} to {high:z.3f}), besides the uncertainty of the ratings. {end} It "
        f"is estimated from {count_of(form.races, 'match', 'matches')} to two games or more, "
        "without those of the first date."
    )


def _shapes(form: MatchForm) -> Table:
    """Return deciders, sweeps and lengths, seen and expected."""
    columns = [
        Column("of", "", left=True),
        Column("seen", "seen", lambda one: _span(one, 3, " to ")),
        Column("said", "expected", decimals(3)),
        Column("said_with_form", "with form", decimals(3)),
    ]
    title = "Scores, with 95% intervals, beside what the ratings expect without and with form:"
    return Table("", columns, form.shapes, title)


def _lengths(found: Validation) -> Table:
    """Return how often favourites won short and long races."""
    columns = [
        Column("length", "race to"),
        Column("matches", "matches"),
        Column("predicted", "predicted", decimals(3)),
        Column("share", "won", decimals(3)),
        Column("range", "95% interval", _range),
    ]
    rows = [
        (
            range_words(half.shortest, half.longest),
            *(half.matches, half.predicted, half.share, (half.low, half.high)),
        )
        for half in found.lengths
    ]
    title = "Matches with a favourite that the favourite won, by the length of the race:"
    return Table("", columns, rows, title)


def _experience(found: Validation, scale: Scale) -> Table:
    """Return how the less experienced player of a match fared, by the games played before."""
    points = scale.points_per_log_odds

    def off(one: Estimate) -> str:
        return f"{points * one.value:+.1f}  {points * one.low:+.1f} to {points * one.high:+.1f}"

    columns = [
        Column("before", "games\nbefore"),
        Column("matches", "matches"),
        Column("predicted", "predicted", percent),
        Column("seen", "won", percent),
        Column("stronger", "points off,\n95% interval", off),
        Column("spread", "spread of\nscores", decimals(2)),
    ]
    rows = [
        (
            _games_before(one),
            *(one.matches, one.predicted, one.seen, one.stronger, one.spread),
        )
        for one in found.experience
    ]
    title = (
        "Games won by the less experienced player of a match, by the games that they had played "
        "before; below 0 points they are overrated compared with their opponents:"
    )
    return Table("", columns, rows, title)


def _games_before(one: ByExperience) -> str:
    if one.most is None:
        return f"{one.fewest} or more"
    return "none" if one.most == 0 else f"{one.fewest} to {one.most}"


def _matches(found: Validation) -> Table:
    """Return how often favourites won matches."""
    columns = [
        Column("predicted", "predicted", decimals(3)),
        Column("matches", "matches"),
        Column("seen", "won", decimals(3)),
        Column("range", "95% interval", _range),
    ]
    rows = [(row.predicted, row.matches, row.seen, (row.low, row.high)) for row in found.matches]
    return Table("", columns, rows, "Matches that the favourite won:")


def _by_spot(found: Validation) -> Table:
    """Return how often players who gave games won, by how many they gave."""
    columns = [
        Column("spot", "games given"),
        Column("matches", "matches"),
        Column("won", "won"),
        Column("share", "share", decimals(3)),
        Column("range", "95% interval", _range),
        Column("expected", "predicted", decimals(3)),
    ]
    rows = [
        (row.spot or "all", row.matches, row.won, row.share, (row.low, row.high), row.expected)
        for row in found.spots
    ]
    return Table("", columns, rows, "Matches that the player who gave games won:")
