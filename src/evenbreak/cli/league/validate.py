"""`evenbreak validate`: how far a league's ratings can be trusted."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, refuse, wants_aliases, wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, aligned, csv_text, print_json, say, to_terminal
from evenbreak.cli.kit.plot import plot_option, write_plot

if TYPE_CHECKING:
    from evenbreak.files.results import ResultsFile
    from evenbreak.ratings.calibration import CalibrationBin, Estimate
    from evenbreak.ratings.scale import Scale
    from evenbreak.ratings.scored import Scored
    from evenbreak.ratings.validate import Validation

COLUMNS = ("part", "of", "item", "count", "expected", "value", "low", "high", "p_value")
WIDTH = 79

EXAMPLES = """\b
Examples:
  evenbreak validate season.csv
  evenbreak validate season.csv --plot calibration.png
  evenbreak validate season.csv --prior 20 --half-life 365
"""


def _positive(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None or (param.name == "prior" and value.strip().lower() == "best"):
        return None
    number = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if not 0.01 <= number <= 1e6:
        word = ", or best" if param.name == "prior" else ""
        message = f"{value!r}; give a number from 0.01 to 1,000,000{word}"
        raise click.BadParameter(message, ctx=ctx, param=param)
    return number


@click.command("validate", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv")
@click.option(
    "--prior",
    metavar="POINTS|best",
    callback=_positive,
    help="The prior's standard deviation in points; best: that which predicts best.  "
    "[default: best]",
)
@click.option(
    "--half-life",
    metavar="DAYS",
    callback=_positive,
    help="Let a game count half after so many days.  [default: games never age]",
)
@click.option(
    "--scale",
    "scale_name",
    default="npl",
    show_default=True,
    metavar="npl|fargo|elo|POINTS",
    help="The scale in whose points the prior is given and told.",
)
@click.option(
    "--seed",
    type=click.IntRange(0, 2**32 - 1),
    default=1,
    show_default=True,
    metavar="N",
    help="Seed of the intervals and tests that draw by chance.",
)
@wants_aliases
@plot_option
@wants_json
def command(
    results: str,
    prior: float | None,
    half_life: float | None,
    scale_name: str,
    seed: int,
    aliases: str | None,
    plot: str | None,
    as_json: bool,
) -> None:
    """Tell how far the ratings of a league can be trusted.

    RESULTS.csv is the file that `report` reads, with dates; - is stdin. Each date is
    predicted from the results of earlier dates, then learnt from.
    """
    from evenbreak.errors import DataError, InputError
    from evenbreak.files.results import read_results
    from evenbreak.ratings.scale import scale_of
    from evenbreak.ratings.validate import validate as validated

    scale = scale_of(scale_name)
    prior_sd = None if prior is None else prior / scale.points_per_log_odds
    if prior_sd is not None and not 1e-3 <= prior_sd <= 100.0:
        least, most = 1e-3 * scale.points_per_log_odds, 100.0 * scale.points_per_log_odds
        refuse(f"--prior is {prior:g} points; on this scale give {least:.2g} to {most:.4g}")
    file = read_results(results, aliases=aliases)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    try:
        found = validated(
            file.results, prior_sd=prior_sd, half_life=half_life, seed=seed, progress=say
        )
    except InputError as error:  # of the options nothing is wrong any more
        raise DataError([f"{file.source}: {error}"]) from None
    if as_json:
        print_json(_answer(found, scale, seed))
    elif to_terminal():
        _print(file, found, scale)
    else:
        click.echo(csv_text(COLUMNS, _rows(found)), nl=False)
    if plot is not None:
        from evenbreak.plots.calibration import calibration_figure

        write_plot(calibration_figure(found), plot)


def _print(file: ResultsFile, found: Validation, scale: Scale) -> None:
    import textwrap

    from evenbreak.answers.validate_verdict import verdict
    from evenbreak.answers.validate_words import findings
    from evenbreak.files.problems import printable

    def wrapped(text: str, mark: str = "") -> None:
        after = " " * len(mark)
        click.echo(textwrap.fill(text, WIDTH, initial_indent=mark, subsequent_indent=after))

    wrapped(printable(_heading(file, found)))
    click.echo()
    wrapped(verdict(found, scale))
    click.echo(
        "\nHow good predictions were, with 95 % intervals (a coin: 0.6931, 0.25);\n"
        f"the prior in points on the scale {scale.name}\n\n{_scored(found, scale)}"
    )
    for title, of, bins in (
        ("Games that the favourite won", "game", found.games),
        ("Matches that the favourite won", "match", found.matches),
    ):
        if bins:
            click.echo(f"{title}\n\n{_bins(bins)}{_no_favourite(found.toss_ups[of])}")
    if found.spots:
        click.echo(f"Matches that the player with the longer race won\n\n{_spots(found)}")
    for paragraph in findings(found, scale):
        wrapped(paragraph, "- ")


def _heading(file: ResultsFile, found: Validation) -> str:
    told = found.forecasts
    left = {
        "without a date": told.undated,
        "given away": told.forfeits,
        "at 0-0": told.empty,
        "without scores": told.unscored,
    }
    out = ", ".join(f"{count:,} {why}" for why, count in left.items() if count)
    return (
        f"{file.source}: {len(told):,} matches on {int(told.date_of[-1]) + 1:,} dates, each date "
        f"predicted from those before it{f' (left out: {out})' if out else ''}"
    )


def _no_favourite(count: int) -> str:
    """Return what the table leaves out."""
    if not count:
        return ""
    return f"  ({count:,} match{'es' * (count != 1)} without a favourite, at 0.5, left out)\n"


def _scored(found: Validation, scale: Scale) -> str:
    rows = [["what", "how", "prior", "log-loss", "", "Brier", "slope", ""]]
    for row in found.scored:
        slope = ["", ""] if row.slope is None else [f"{row.slope.value:.2f}", _span(row.slope, 2)]
        rows.append(
            [
                *(row.of, row.how, f"{row.prior_sd * scale.points_per_log_odds:.1f}"),
                *(f"{row.log_loss.value:.4f}", _span(row.log_loss, 4).replace(" to ", "-")),
                *(f"{row.brier.value:.3f}", *slope),
            ]
        )
    return aligned(rows, left=2)


def _span(estimate: Estimate, digits: int) -> str:
    return f"{estimate.low:.{digits}f} to {estimate.high:.{digits}f}"


def _bins(bins: tuple[CalibrationBin, ...]) -> str:
    rows = [["chance", "matches", "games", "said", "won", "95 % interval"]]
    rows += [
        [
            *(f"{row.p_from:.2f} to {row.p_to:.2f}", f"{row.matches:,}", f"{row.games:,}"),
            *(f"{row.predicted:.3f}", f"{row.seen:.3f}", f"{row.low:.3f} to {row.high:.3f}"),
        ]
        for row in bins
    ]
    if all(row.matches == row.games for row in bins):
        rows = [[*row[:2], *row[3:]] for row in rows]
    return aligned(rows)


def _spots(found: Validation) -> str:
    rows = [["games given", "matches", "won", "part", "95 % interval", "ratings say"]]
    rows += [
        [
            *("all" if row.spot is None else str(row.spot), f"{row.matches:,}", f"{row.won:,}"),
            *(f"{row.share:.3f}", f"{row.low:.3f} to {row.high:.3f}", f"{row.expected:.3f}"),
        ]
        for row in found.spots
    ]
    return aligned(rows)


def _rows(found: Validation) -> list[tuple[Any, ...]]:
    """Return everything that was found as rows of COLUMNS."""
    told = found.forecasts
    games, races = int(told.games.sum()), int((told.race_a > 0).sum())
    counts = {"game": games, "match": races}
    rows: list[tuple[Any, ...]] = [
        ("prior", "game", f"{sd:.6f}", games, None, loss, None, None, None)
        for sd, loss in found.priors
    ]
    for row in found.scored:
        head = (row.of, row.how, counts[row.of])
        rows.append(("prior_sd", *head, None, row.prior_sd, None, None, None))
        rows += _goodness(row, head)
        if row.as_it_went is not None:
            rows.append(("log_loss_as_it_went", *head, None, row.as_it_went, None, None, None))
    for row in found.usual:
        rows += _goodness(row, (row.of, "usual", counts[row.of]))
    rows += [
        ("gain", of, "integrated", counts[of], 0.0, *gain, None) for of, gain in found.gain.items()
    ]
    for part, of, bins in (
        ("calibration", "game", found.games),
        ("calibration", "match", found.matches),
        ("calibration_plug_in", "match", found.matches_plug_in),
    ):
        rows += [(part, of, f"{b.p_from:.2f}-{b.p_to:.2f}", *b[3:], None) for b in bins]
    rows += [("no_favourite", of, None, count, *[None] * 5) for of, count in found.toss_ups.items()]
    return rows + _tests(found, games)


def _goodness(row: Scored, head: tuple[str, str, int]) -> list[tuple[Any, ...]]:
    coin = {"log_loss": math.log(2.0), "brier": 0.25, "slope": 1.0}
    found = [(part, getattr(row, part), right) for part, right in coin.items()]
    return [
        (part, *head, right, *estimate, None)
        for part, estimate, right in found
        if estimate is not None
    ]


def _tests(found: Validation, games: int) -> list[tuple[Any, ...]]:
    from evenbreak.ratings.advantages import known_breaks

    rows: list[tuple[Any, ...]] = []
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None:
        told = (spread.races, spread.by_chance, spread.seen)
        rows.append(("dispersion", "match", "scores", *told, None, None, spread.p_value))
    if runs is not None:
        seen = (runs.matches, runs.expected, float(runs.runs))
        rows.append(("streaks", "match", "runs", *seen, None, None, runs.p_value))
    if first is not None:
        won = (first.matches, first.expected, float(first.won))
        rows.append(("first_break", "match", "won", *won, None, None, first.p_value))
    advantages = (
        ("side", found.side, games),
        ("breaker", found.breaker, known_breaks(found.forecasts)),
    )
    for name, estimate, count in advantages:
        if estimate is not None:
            rows.append((name, "game", "log_odds", count, 0.0, *estimate, None))
    for row in found.spots:
        spot = "all" if row.spot is None else row.spot
        told = (row.matches, row.expected, row.share)
        rows.append(("spot", "match", spot, *told, row.low, row.high, None))
    return rows


def _answer(found: Validation, scale: Scale, seed: int) -> dict[str, Any]:
    """Return what --json prints."""
    from evenbreak.answers.validate_verdict import verdict

    told = found.forecasts

    def plain(value: Any) -> Any:
        if not hasattr(value, "_asdict"):
            return value
        return {name: plain(part) for name, part in value._asdict().items()}

    bins = {name: [plain(row) for row in getattr(found, name)] for name in _LISTS}
    tests = {name: plain(getattr(found, name)) for name in _TESTS}
    return {
        "verdict": verdict(found, scale),
        "matches_read": len(told),
        "dates": int(told.date_of[-1]) + 1,
        **{name: getattr(told, name) for name in ("undated", "forfeits", "empty", "unscored")},
        "newcomers": int(told.new.sum()),
        "prior_sd": found.prior_sd,
        "prior_points": found.prior_sd * scale.points_per_log_odds,
        "half_life": told.half_life,
        "priors": [{"prior_sd": sd, "log_loss": loss} for sd, loss in found.priors],
        **bins,
        "gain": {of: plain(gain) for of, gain in found.gain.items()},
        "toss_ups": found.toss_ups,
        **tests,
        "drawn": found.drawn,
        "seed": seed,
        "schema_version": SCHEMA_VERSION,
    }


_LISTS = ("scored", "usual", "games", "matches", "matches_plug_in", "spots")
_TESTS = ("skill", "dispersion", "streaks", "side", "breaker", "first_breaks")
