"""What `evenbreak ladder` says of a ladder in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.cli.ladder.ladder_answer import OPPONENTS
from evenbreak.handicaps.ladders.unfairness import CLEAR_FAVOURITE

if TYPE_CHECKING:
    from fractions import Fraction

    from evenbreak.cli.ladder.ladder_answer import LadderAnswer
    from evenbreak.stats.summary import Distribution

_FEW = 0.1
"""Rarer than this is told as one in so many."""
_ALL = 0.995


def title(found: LadderAnswer) -> str:
    """Return chart and system in short."""
    ladder = found.ladder
    return f"chart {ladder.chart.name}, system {ladder.system.name}"


def heading(found: LadderAnswer) -> str:
    """Return the question, and of what ladder it is asked."""
    ladder = found.ladder
    told = [
        f"How wrong are ratings on {title(found)}?",
        f"System {ladder.system.name}: {ladder.system.in_words}.",
        OPPONENTS[found.question.opponents],
    ]
    if ladder.day_sd:
        many = ladder.matches_a_night
        told.append(
            f"Everybody's form varies by {ladder.day_sd:g} points from night to night, "
            f"{matches(many)} a night."
        )
    if ladder.match_sd:
        told.append(f"Everybody's form varies by {ladder.match_sd:g} points from match to match.")
    if ladder.drift:
        way = "rises" if ladder.drift > 0.0 else "falls"
        told.append(f"The player's skill {way} by {abs(ladder.drift):g} points a match.")
    return "\n".join(told)


def ladder_sentences(found: LadderAnswer) -> list[str]:
    """Return the answer as paragraphs: how wrong, how unfair, how fast, how soon forgotten."""
    told = [_how_wrong(found), _how_unfair(found.favourite), _how_fast(found), _how_soon(found)]
    if abs(found.inflation) >= 0.005:
        told.append(_inflation(found.inflation))
    return [paragraph for paragraph in told if paragraph]


def _how_wrong(found: LadderAnswer) -> str:
    law, within = found.law, found.question.within
    more = [
        f"{of_100(found.off.at_least(many + 1))} by more than {many}"
        for many in dict.fromkeys((within, 2 * within))
    ]
    if abs(law.mean) < 0.05:
        text = f"In the long run a rating is off by {law.sd:.2f} points (standard deviation)"
    else:
        text = (
            f"In the long run a rating is {_too(law.mean, f'{abs(law.mean):.2f}')} on average, and "
            f"wanders about that by {law.sd:.2f} points (standard deviation)"
        )
    return (
        f"{text}. 9 ratings of 10 are off by {points(found.off.quantile(0.9))} or less, "
        f"{', '.join(more)}."
    )


def _how_unfair(favourite: Distribution) -> str:
    text = (
        "That makes favourites in matches that are meant to be even. On average the favourite "
        f"wins {100.0 * favourite.mean:.1f} % of such matches"
    )
    often = favourite.at_least(CLEAR_FAVOURITE)
    if often == 0.0:
        return f"{text}; no match has a favourite of {100 * CLEAR_FAVOURITE:g} % or more."
    verb = "has" if often < _FEW else "have"
    return (
        f"{text}; {_in_matches(often)} {verb} a favourite of {100 * CLEAR_FAVOURITE:g} % or more."
    )


def _how_fast(found: LadderAnswer) -> str:
    asked, settled = found.question, found.settling
    if settled is None:
        return ""
    if abs(asked.start) <= asked.within:
        return f"An error of {asked.start} counts as settled from the beginning."
    law = settled.matches
    who = f"A player rated {_too(asked.start, str(abs(asked.start)))}"
    if asked.newcomer:
        who += " who moves as newcomers do"
    text = (
        f"{who} comes within {asked.within} after {settled.mean:.1f} matches on average; half of "
        f"such players within {law.quantile(0.5)}, 9 of 10 within {matches(law.quantile(0.9))}."
    )
    return f"{text} {_who_pays(found)}" if asked.newcomer else text


def _how_soon(found: LadderAnswer) -> str:
    """Return gap and mixing in words."""
    import math

    if found.gap is None or found.mixing_matches is None:
        return ""
    half = math.log(0.5) / math.log1p(-found.gap)
    every = "with every match" if half < 1.5 else f"every {matches(half)}"
    start = found.question.start
    begun = f"began {_too(start, str(abs(start)))}" if start else "began right"
    return (
        f"In the end what is left of an old error fades by half {every} (spectral "
        f"gap {found.gap:.4f}). After {matches(found.mixing_matches)} a rating that {begun} can "
        "hardly be told from any other (total variation 0.25)."
    )


def _who_pays(found: LadderAnswer) -> str:
    """Return what a newcomer's settling does to the ratings of the others."""
    left = found.newcomer_inflation.left
    return (
        f"What his longer steps do not put right comes from the others: their ratings "
        f"{'lose' if left < 0 else 'gain'} {abs(left):.1f} points between them."
    )


def _inflation(added: float) -> str:
    verb, what = ("raises", "inflate") if added > 0 else ("lowers", "deflate")
    return (
        f"Each match {verb} the sum of the two ratings by {abs(added):.2f} points on average: "
        f"ratings {what}, and no match will ever tell."
    )


def _too(error: float, size: str) -> str:
    """Return how a rating is wrong, such as '30 points too low'."""
    return f"{size} point{'s' * (size != '1')} too {'high' if error > 0 else 'low'}"


def _in_matches(chance: float) -> str:
    if chance < _FEW:
        return f"1 match in {1.0 / chance:,.0f}"
    if chance > _ALL:
        return "nearly all matches"
    return f"{100.0 * chance:.0f} matches of 100"


def of_100(chance: float) -> str:
    """Return how often, in words.

    >>> of_100(0.2513), of_100(0.0142), of_100(0.0)
    ('25 of 100', '1 in 70', 'none')
    """
    if chance < 1e-9:
        return "none"
    if chance > _ALL:
        return "nearly all"
    return f"1 in {1.0 / chance:,.0f}" if chance < _FEW else f"{100.0 * chance:.0f} of 100"


def points(many: float | Fraction) -> str:
    """Return so many points, in words."""
    return f"{many:g} point{'s' * (many != 1)}"


def matches(many: float | Fraction) -> str:
    """Return so many matches, in words."""
    return f"{many:,.0f} match{'es' * (many != 1)}"
