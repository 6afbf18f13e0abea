"""Whether a league can trust its ratings."""

from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Part, Table
from evenbreak.answers.validate_details import details
from evenbreak.answers.validate_judgement import (
    UNLIKELY,
    any_winner_breaks,
    at_the_edge,
    clearly_off,
    points_text,
    share_of,
    wrong_chances,
)
from evenbreak.answers.validate_rows import findings_table
from evenbreak.answers.validate_verdict import verdict
from evenbreak.answers.wording import count_of, listed, percent
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.validate import Validation

WIDE = 0.4
"""The width from which the range of a share says nothing about it."""


def validate_answer(file: ResultsFile, found: Validation, scale: Scale, *, seed: int = 1) -> Answer:
    """Return whether a league can trust its ratings.

    Parameters
    ----------
    file, found
        the results, and what `validate` made of them.
    scale
        the scale in whose points priors are given.
    seed
        of the intervals and simulated seasons.

    >>> from evenbreak.files.results import ResultsFile
    >>> from evenbreak.ratings import Results, scale_of, validate
    >>> season = Results.from_names(["Ann"] * 3, ["Bo"] * 3, [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> file = ResultsFile(season, "r.csv", (), (), "")
    >>> print(validate_answer(file, validate(season), scale_of("npl")).sentences[0])
    There are too few matches to say whether these ratings can be trusted.
    """
    text = verdict(found, scale)
    remarks = [_handicaps(found), _spread(found), _prior(found, scale)]
    parts: list[Part] = [text, _games(found), *filter(None, remarks)]
    return Answer(
        _heading(file, found),
        parts,
        details=list(details(found, scale)),
        warnings=[*file.warnings, *file.ties],
        data={"verdict": text, **_figures(found, scale), "seed": seed},
        csv=findings_table(found),
    )


def _heading(file: ResultsFile, found: Validation) -> str:
    forecasts = found.forecasts
    left = {
        "without a date": forecasts.undated,
        "forfeits": forecasts.forfeits,
        "at 0-0": forecasts.empty,
        "without scores": forecasts.unscored,
    }
    out = ", ".join(f"{count:,} {why}" for why, count in left.items() if count)
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
        Column("range", "95% range", _percents),
    ]
    rows = [(row.predicted, row.games, row.seen, (row.low, row.high)) for row in found.games]
    title = (
        "How often favourites won single games. The ratings are right where the prediction lies in "
        "the range."
    )
    return Table("", columns, rows, title)


def _percents(ends: tuple[float, float]) -> str:
    return f"{100 * ends[0]:.0f} to {100 * ends[1]:.0f}%"


def _handicaps(found: Validation) -> str:
    """Return whether handicaps were fair, '' where there were none."""
    if not found.spots:
        return ""
    every = found.spots[-1]
    figures = (
        f"Players who gave games won {every.won:,} of {count_of(every.matches, 'match', 'matches')}"
        f" ({percent(every.share)}; {_percents((every.low, every.high))} allowing for luck)"
    )
    off = clearly_off(share_of(every), 0.5)
    if off > 0:
        return f"The handicaps give too little. {figures}; fair is 50%."
    if off < 0:
        return f"The handicaps give too much. {figures}; fair is 50%."
    if every.high - every.low > WIDE:
        return (
            f"There are too few handicap matches to say whether the handicaps are fair. {figures}."
        )
    if not every.low <= 0.5 <= every.high:
        more = "little" if every.low > 0.5 else "much"
        return (
            f"The handicaps may give too {more}. {figures}; fair is 50%, just outside that range."
        )
    way = clearly_off(share_of(every), every.expected)
    if way:
        under = "under" if way > 0 else "over"
        return (
            f"The handicaps look fair. {figures}. The ratings predicted {percent(every.expected)}: "
            f"they {under}rate players who give games, so do not use them to predict handicap "
            "matches."
        )
    return f"The handicaps look fair. {figures}."


def _spread(found: Validation) -> str:
    """Return why scores vary more than they should, '' where they do not."""
    test = found.dispersion
    if test is None or test.p_value >= UNLIKELY or test.seen <= test.by_chance:
        return ""
    more = 100.0 * (test.seen / test.by_chance - 1.0)
    others = []
    if any_winner_breaks(found):
        others.append("a strong break under winner breaks")
    if found.spots:
        others.append("handicaps based on more than these ratings know")
    also = listed(others, "or")
    return (
        f"Match scores vary {more:.0f}% more than expected, so favourites win fewer long races "
        "than predicted. Perhaps players have good and bad days, or the ratings lag behind."
        + (f" {also[0].upper()}{also[1:]} would have the same effect." if also else "")
    )


def _prior(found: Validation, scale: Scale) -> str:
    """Return whether the default prior will do, where the verdict does not say which to use."""
    if len(found.priors) == 1 or found.skill.low <= 0.0 or at_the_edge(found.prior_sd, found):
        return ""
    if wrong_chances(found.usual, found) or wrong_chances(found.scored, found):
        return ""
    return (
        f"A --prior of {points_text(found.prior_sd, scale)} would suit this league best; the "
        f"default of {points_text(PRIOR_SD, scale)} points will do too."
    )


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
        "priors": [{"prior_sd": sd, "log_loss": loss} for sd, loss in found.priors],
        **{name: getattr(found, name) for name in _AS_FOUND},
    }


_LEFT_OUT = ("undated", "forfeits", "empty", "unscored")
_AS_FOUND = (
    *("scored", "usual", "games", "matches", "matches_plug_in", "spots", "gain", "toss_ups"),
    *("skill", "dispersion", "streaks", "side", "breaker", "first_breaks", "drawn"),
)
