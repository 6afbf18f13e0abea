"""How much players vary from match to match, in words and numbers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:  # it loads an optimiser
    from evenbreak.ratings.day_form import DayForm


def form_words(form: DayForm | None, scale: Scale) -> Iterator[str]:
    """Yield what form of the day is worth, where it is established.

    >>> from evenbreak.ratings.calibration import Estimate
    >>> from evenbreak.ratings.day_form import DayForm
    >>> from evenbreak.ratings import SCALES
    >>> print(*form_words(DayForm(Estimate(0.12, 0.06, 0.18), 900), SCALES["npl"]))
    Form of the day: from match to match the strength difference of two players varies by 15
    points, give or take 2, so sweeps are likelier and hill-hill games rarer than ratings alone
    would say. This list of ratings states it (0.35 in log-odds), and odds, fair, live and
    matchups allow for it.
    """
    if form is None or not form.established:
        return
    points, error = scale.points(form.sd), scale.points(form.sd_error)
    yield (
        f"Form of the day: from match to match the strength difference of two players varies by "
        f"{points:.0f} points, give or take {error:.0f}, so sweeps are likelier and hill-hill "
        "games rarer than ratings alone would say. This list of ratings states it "
        f"({form.sd:.2f} in log-odds), and odds, fair, live and matchups allow for it."
    )


def form_details(form: DayForm | None, scale: Scale) -> Iterator[str]:
    """Yield what was found out about form of the day, with its interval."""
    if form is None:
        return
    v, low, high = form.variance
    end = "This is established." if form.established else "This may be luck, so nothing uses it."
    yield (
        f"Form of the day, estimated from {form.races:,} matches, each compared with the ratings "
        f"from all others: a standard deviation of {scale.points(form.sd):.1f} points (variance "
        f"{v:.3f} in squared log-odds, 95% interval {low:.3f} to {high:.3f}). {end}"
    )


def form_used_words(form: float, scale: Scale | None = None) -> str:
    """Return that an answer allows for form of the day; '' if there is none.

    >>> form_used_words(0.35)
    'Form of the day is allowed for: from match to match the log-odds of a game vary by 0.35.'
    """
    if not form:
        return ""
    if scale is None:
        return (
            "Form of the day is allowed for: from match to match the log-odds of a game vary by "
            f"{form:g}."
        )
    return (
        f"Form of the day is allowed for: from match to match the strength difference of two "
        f"players varies by {scale.points(form):.0f} points."
    )


def form_data(form: DayForm | None) -> dict[str, Any] | None:
    """Return form of the day for JSON, in log-odds."""
    if form is None:
        return None
    variance, low, high = form.variance
    return {
        "sd": form.sd,
        "sd_standard_error": form.sd_error if form.sd else None,
        "variance": variance,
        "variance_low": low,
        "variance_high": high,
        "matches": form.races,
        "established": form.established,
    }
