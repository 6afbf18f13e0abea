"""Whether a league can trust its ratings."""

from dataclasses import replace
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Part, Table
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.answers.league.prior import evidence_rows, levels_data
from evenbreak.answers.validate_details import details
from evenbreak.answers.validate_judgement import percents
from evenbreak.answers.validate_remarks import remarks
from evenbreak.answers.validate_rows import findings_table
from evenbreak.answers.validate_verdict import verdict
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.validate import Validation


def validate_answer(
    file: ResultsFile,
    found: Validation,
    scale: Scale,
    *,
    seed: int = 1,
    chart: LeagueChart | None = None,
) -> Answer:
    """Return whether a league can trust its ratings.

    Parameters
    ----------
    file, found
        the results, and what `validate` made of them.
    scale
        the scale in whose points priors are given.
    seed
        of the intervals and simulated seasons.
    chart
        what `league_chart` found in the same results.

    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, scale_of, validate
    >>> season = Results.from_names(["Ann"] * 3, ["Bo"] * 3, [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> file = ResultsFile(season, "r.csv", (), (), "")
    >>> print(validate_answer(file, validate(season), scale_of("npl")).sentences[0])
    There are too few matches to say whether these ratings can be trusted.
    """
    chart = chart or LeagueChart()
    text = verdict(found, scale, chart)
    parts: list[Part] = [text, _games(found), *remarks(found, scale, chart)]
    return Answer(
        _heading(file, found),
        parts,
        details=list(details(found, scale)),
        warnings=[*file.warnings, *file.ties],
        data={
            "verdict": text,
            "rows_left_out": file.skipped,
            **_figures(found, scale),
            **_chart(chart),
            "seed": seed,
        },
        csv=findings_table(found, chart),
    )


def _heading(file: ResultsFile, found: Validation) -> str:
    forecasts = found.forecasts
    forfeits = count_of(forecasts.forfeits, "forfeit")
    left = {
        f"{forecasts.undated:,} without a date": forecasts.undated,
        forfeits: forecasts.forfeits,
        f"{forecasts.empty:,} at 0-0": forecasts.empty,
        f"{forecasts.unscored:,} without scores": forecasts.unscored,
        count_of(file.skipped, "bad row"): file.skipped,
    }
    out = ", ".join(words for words, count in left.items() if count)
    return (
        f"{file.source}: {count_of(len(forecasts), 'match', 'matches')} on "
        f"{count_of(_dates(found), 'date')}, each date predicted from the earlier ones"
        + (f" (left out: {out})" if out else "")
    )


def _dates(found: Validation) -> int:
    return int(found.forecasts.date_of[-1]) + 1


def _games(found: Validation) -> Table:
    """Return how often favourites won games, beside the chances that they had been given."""
    columns = [
        Column("predicted", "predicted", percent),
        Column("games", "games"),
        Column("seen", "won", percent),
        Column("range", "95% range", percents),
    ]
    rows = [(row.predicted, row.games, row.seen, (row.low, row.high)) for row in found.games]
    title = (
        "How often favourites won single games. The ratings are right where the prediction lies in "
        "the range."
    )
    return Table("", columns, rows, title)


def _figures(found: Validation, scale: Scale) -> dict[str, Any]:
    """Return what JSON holds besides the findings."""
    forecasts = found.forecasts
    return {
        "matches_read": len(forecasts),
        "dates": _dates(found),
        **{name: getattr(forecasts, name) for name in _LEFT_OUT},
        "newcomers": int(forecasts.new.sum()),
        "prior_sd": found.prior_sd,
        "prior_points": found.prior_sd * scale.points_per_log_odds,
        "half_life": forecasts.half_life,
        **_choice(found),
        "levels": levels_data(replace(found.ratings, scale=scale), found.choice),
        "evidence": evidence_rows(found.choice),
        **{name: getattr(found, name) for name in _AS_FOUND},
    }


def _choice(found: Validation) -> dict[str, Any]:
    """Return how the prior was chosen, None for each figure where it was given."""
    choice = found.choice
    if choice is None:
        return {"priors": [], **dict.fromkeys(_OF_CHOICE)}
    tried = zip(choice.tried, choice.log_loss, strict=True)
    figures = choice.learnt, [choice.low, choice.high], choice.as_it_went
    return {
        "priors": [{"prior_sd": sd, "log_loss": loss} for sd, loss in tried],
        **dict(zip(_OF_CHOICE, figures, strict=True)),
    }


def _chart(chart: LeagueChart) -> dict[str, Any]:
    """Return which chart the races come from, and the scale that fits the results."""
    return {"chart": chart.nearest, "fair_scale": chart.scale}


_OF_CHOICE = ("prior_learnt", "prior_range", "log_loss_as_it_went")
_LEFT_OUT = ("undated", "forfeits", "empty", "unscored")
_AS_FOUND = (
    *("scored", "usual", "games", "matches", "matches_plug_in", "spots", "gain", "toss_ups"),
    *("skill", "form", "dispersion", "streaks", "side", "first_column", "breaker", "first_breaks"),
    *("half_lives", "lengths", "experience", "starts", "drawn"),
)
