"""How soon the watch flags a sandbagger, and how often it flags honest players."""

from collections.abc import Sequence
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.sandbag_watch import HONEST_PLAYER, evidence
from evenbreak.answers.simulated import luck_words
from evenbreak.answers.wording import decimals, percent
from evenbreak.league.sandbag_power import WatchPower


def sandbag_power_answer(
    found: Sequence[WatchPower],
    chart: str,
    *,
    alpha: float,
    honest: str,
    marked: float | None = None,
    warnings: Sequence[str] = (),
    **asked: Any,
) -> Answer:
    """Return how often players of each kind are flagged, by quarters of the matches.

    Parameters
    ----------
    found
        what `watch_power` returned for each kind of player, honest players first.
    chart
        the name of the chart.
    alpha, honest, marked
        as of `watch_power`.
    warnings
        what may be wrong with what was given.
    asked
        what else the simulation was asked, for JSON.
    """
    matches = len(found[0].flagged)
    within = sorted({max(1, round(matches * part / 4)) for part in (1, 2, 3, 4)})
    files = Table(
        "within",
        [*map(Column, ("share", "points", "matches", "flagged", "se", "rating_error", "p_win"))],
        [
            (
                *(one.share, one.points, n, float(one.flagged[n - 1]), float(one.se[n - 1])),
                *(float(one.rating_error[n - 1]), one.p_win),
            )
            for one in found
            for n in within
        ],
    )
    known = "" if marked is None else f" of the {100 * marked:g}% of the matches that are marked"
    return Answer(
        f"How soon the watch flags a sandbagger: chart {chart}\n{found[0].replicas:,} simulated "
        f"players of each kind, who dump a share{known}; a player is flagged when the evidence "
        f"reaches {evidence(1.0 / alpha)}",
        [
            _in_words(found, matches, "their" if marked is None else "their marked"),
            _kinds(found, within),
            "'Rating error': how far the ratings are above the skill at the end, in points, on "
            "average. 'Won in earnest': per cent of the matches that are not dumped.",
            f"The chance that {HONEST_PLAYER[honest]} is ever flagged is at most {percent(alpha)}.",
            f"With {found[0].replicas:,} players of each kind, "
            f"{luck_words(float(one.se.max()) for one in found)}.",
        ],
        warnings=warnings,
        data={
            "chart": chart,
            "alpha": alpha,
            "honest": honest,
            "marked": marked,
            **asked,
            "kinds": [one._asdict() for one in found],
        },
        csv=files,
    )


def _in_words(found: Sequence[WatchPower], matches: int, which: str) -> str:
    """Return how many are flagged of the kinds that are easiest and hardest to see."""
    honest, *others = found
    false = f"{percent(float(honest.flagged[-1]))} of honest players"
    if not others:
        return f"Within {matches} matches, the watch flags {false}."
    order = sorted(others, key=lambda one: -float(one.flagged[-1]))
    kinds = [order[0], order[-1]] if len(order) > 1 else order
    said = [
        f"{percent(float(one.flagged[-1]))} of players who {_kind(one, which)}" for one in kinds
    ]
    return f"Within {matches} matches, the watch flags {', '.join(said)}, and {false}."


def _kind(one: WatchPower, which: str) -> str:
    how = "losing them" if one.points is None else f"played {one.points} points below their skill"
    return f"dump {100 * one.share:g}% of {which} matches ({how})"


def _kinds(found: Sequence[WatchPower], within: Sequence[int]) -> Table:
    def per_cent(p: float) -> str:
        return f"{100 * p:.1f}"

    columns = [
        Column("share", "dump", left=True),
        Column("points", "play them", left=True),
        *(Column(f"flagged_{n}", f"in {n}", per_cent) for n in within),
        Column("se", "±", per_cent, detail=True),
        Column("rating_error", "rating\nerror", decimals(1)),
        Column("p_win", "won in\nearnest", per_cent),
    ]
    rows = [
        (
            f"{100 * one.share:g}%" if one.share else "honest",
            None if not one.share else "to lose" if one.points is None else f"{one.points} below",
            *(float(one.flagged[n - 1]) for n in within),
            float(one.se.max()),
            float(one.rating_error[-1]),
            one.p_win,
        )
        for one in found
    ]
    return Table("", columns, rows, "Per cent of the players flagged within the first matches:")
