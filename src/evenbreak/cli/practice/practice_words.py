"""What `evenbreak practice` calls its quantities, and how it prints them."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from evenbreak.cli.kit.output import chance_text, print_quantities, say, to_terminal

if TYPE_CHECKING:
    from evenbreak.stats.confidence import Luck

WIDTH = 79

SUMMARY_WORDS = {
    "mean": "mean",
    "sd": "standard deviation",
    "interval": "true mean, {share} interval by Student's t",
    "interval_normal": "the same by the normal law, too narrow",
    "slope_per_week": "change a week",
    "slope_interval": "its {share} interval",
    "p_slope": "a slope so steep by chance",
}

NEW_WORDS = {
    "mean": "mean of the {n} scores before",
    "sd": "their standard deviation",
    "units": "standard units by which {score} is off, by Student's t",
    "p_as_far": "so far off by chance, up or down",
    "p_as_high": "so high by chance",
    "p_as_low": "so low by chance",
    "p_as_high_by_rank": "so high among {more} scores of any law",
    "p_as_low_by_rank": "so low among {more} scores of any law",
    "units_normal": "standard units by the normal law, too sure",
    "p_as_far_normal": "so far off by chance, up or down",
    "units_cautious": "standard units from the near end of its {share} interval",
    "p_as_far_cautious": "so far off by chance, up or down",
}

VERSUS_WORDS = {
    "before": "before",
    "after": "after",
    "difference": "difference of the means",
    "interval": "its {share} interval",
    "p_welch": "Welch's t test: p-value",
    "g": "Hedges' g: difference in standard deviations",
    "g_interval": "its {share} interval",
    "p_after_higher": "pairs in which the one after is higher",
    "p_student": "beside it: Student's t",
    "p_anova": "analysis of variance",
    "p_variances": "F: are the spreads equal?",
    "p_mann_whitney": "Mann-Whitney, by ranks",
    "p_chi_squared": "chi-squared, above or below the median of all",
}


def luck_sentence(luck: Luck) -> str:
    """Return how far a new score is off, and how often chance alone does that."""
    from evenbreak.stats.compare_sentence import how_often

    away = luck.score - luck.mean
    if away == 0.0:
        return f"{luck.score:g} is the mean of the {many(luck.n)} before: no news."
    return (
        f"{luck.score:g} is {abs(away):.2f} {'above' if away > 0 else 'below'} the mean. "
        "If nothing has changed, a score so far off, up or down, comes "
        f"{how_often(luck.t.as_far)}. "
        "More scores like it would say more: compare them with --versus."
    )


def many(n: int) -> str:
    """Return how many scores there are, in words."""
    return f"{n} score{'s' if n != 1 else ''}"


def print_answer(
    answer: dict[str, Any],
    words: dict[str, str],
    sentence: str,
    notes: Sequence[str],
    *,
    as_json: bool,
) -> None:
    """Print quantities with a sentence and notes; a terminal has an interval in one line."""
    if as_json:
        answer = {**answer, "sentence": sentence, "notes": list(notes)}
    elif not to_terminal():
        for note in notes:
            say(f"Note: {note}")
    shown = {
        "share": f"{100 * answer['confidence']:g} %",
        "score": f"{answer.get('score', 0.0):g}",
        "n": answer.get("n"),
        "more": answer.get("n", 0) + 1,
    }
    told = [sentence, *(f"Note: {note}" for note in notes)]
    joined = _joined(answer) if to_terminal() and not as_json else {}
    print_quantities(
        {**answer, **joined},
        words={key: name.format(**shown) for key, name in words.items()},
        heading="\n".join(textwrap.fill(line, WIDTH) for line in told),
        text=_text,
        as_json=as_json,
    )


def _joined(answer: dict[str, Any]) -> dict[str, str | None]:
    """Return what a terminal shows of several quantities in one line."""
    ends = {
        "interval": ("low", "high"),
        "interval_normal": ("low_normal", "high_normal"),
        "slope_interval": ("slope_low", "slope_high"),
        "g_interval": ("g_low", "g_high"),
    }
    joined: dict[str, str | None] = {
        key: None if answer.get(low) is None else f"{answer[low]:.2f} to {answer[high]:.2f}"
        for key, (low, high) in ends.items()
    }
    for side in ("before", "after"):
        if f"mean_{side}" in answer:
            joined[side] = (
                f"{many(answer[f'n_{side}'])}, mean {answer[f'mean_{side}']:.2f}, "
                f"sd {answer[f'sd_{side}']:.2f}"
            )
    return joined


def _text(key: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    return chance_text(value) if key.startswith("p_") else f"{value:.2f}"
