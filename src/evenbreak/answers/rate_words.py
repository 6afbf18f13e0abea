"""What `evenbreak rate` says of its ratings, and its tables as a terminal shows them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from evenbreak.answers.scale_words import like_scale_words
from evenbreak.answers.wording import count_of
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.prior import PriorChoice

if TYPE_CHECKING:
    import pandas as pd

SIZES = 6
"""How many groups of players are told by their sizes."""

HEADINGS = {
    "player": "player",
    "rating": "rating",
    "standard_error": "give or take",
    "games": "games",
    "won": "won",
    "lost": "lost",
    "races_won": "matches won",
    "races_lost": "matches lost",
    "component": "group",
}


def rate_words(ratings: Ratings, choice: PriorChoice | None = None) -> list[str]:
    """Return what the ratings rest on, a line each; `choice` if the prior was chosen by it."""
    games, races = int(ratings.won.sum()), int(ratings.races_won.sum())
    matches = count_of(ratings.matches, "match", "matches")
    made = [f"{matches} with {count_of(games, 'game', 'games')}"] if games else []
    if races:
        made.append(f"{count_of(races, 'match', 'matches')} known by the winner alone")
    left_out = [
        f"{count:,} {what}"
        for count, what in (
            (ratings.forfeits, "forfeit" if ratings.forfeits == 1 else "forfeits"),
            (ratings.empty, "at 0-0"),
            (ratings.later, f"after {ratings.as_of}"),
        )
        if count
    ]
    lines = [
        f"{int((~ratings.idle).sum()):,} players, {', of these '.join(made)}"
        + (f"; left out: {', '.join(left_out)}." if left_out else "."),
        f"On {like_scale_words(ratings.scale)}.",
        *prior_words(ratings, choice),
    ]
    if ratings.named:
        who = ", ".join(f"{name} {points:g}" for name, points in ratings.named)
        lines.append(f"Anchored at {who}" + (" on average." if len(ratings.named) > 1 else "."))
    if ratings.half_life is not None:
        what = " and ".join(["games"] * bool(games) + ["matches"] * bool(races))
        lines.append(
            f"A match counts half after {ratings.half_life:g} days: all that was played counts "
            f"as {ratings.weight:,.1f} new {what}."
        )
    if ratings.break_advantage is not None:
        error = ratings.break_error
        lines.append(
            f"The breaker plays {ratings.break_advantage:+.1f} points better"
            + (", as given." if error is None else f", give or take {error:.1f} (standard error).")
        )
    return lines


def prior_words(ratings: Ratings, choice: PriorChoice | None) -> list[str]:
    """Return how wide the prior was, and how that was chosen if it was, a line each."""
    points = ratings.scale.points(ratings.prior_sd)
    mean = "" if ratings.named else f"mean {ratings.anchor:g}, "
    lines = [f"Before any result: {mean}standard deviation {points:.1f} points."]
    if choice is not None:
        edge = " (the last tried)" if choice.prior_sd in (choice.tried[0], choice.tried[-1]) else ""
        lines.append(
            f"Of {len(choice.tried)} such deviations this one{edge} predicted "
            f"{choice.predicted:,} later results best."
        )
    return lines


def rate_rows(frame: pd.DataFrame) -> list[list[str]]:
    """Return the table of `rate_frame` as rows of text, without columns that tell nothing."""
    silent = {
        name
        for names in (("games", "won", "lost"), ("races_won", "races_lost"))
        for name in names
        if not frame[list(names)].any(axis=None)
    }
    if frame["component"].max() < 2:
        silent.add("component")
    shown = [name for name in HEADINGS if name not in silent]
    rows = [
        [f"{cell:.1f}" if isinstance(cell, float) else str(cell) for cell in row]
        for row in frame[shown].itertuples(index=False)
    ]
    return [[HEADINGS[name] for name in shown], *rows]


def pair_rows(frame: pd.DataFrame) -> list[list[str]]:
    """Return the table of `pairs_frame` as rows of text."""
    rows = [["A", "B", "A above B by", "give or take", "A wins a game"]]
    for a, b, difference, error, p, note in frame.itertuples(index=False):
        if isinstance(note, str):
            rows.append([a, b, "not linked", "", ""])
        else:
            rows.append([a, b, f"{difference:+.1f}", f"{error:.1f}", f"{p:.3f}"])
    return rows


def connection_words(ratings: Ratings) -> list[str]:
    """Return what there is to say of players whom no chain of opponents links, a line each.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["A", "C", "D"], ["B", "D", "E"], [7, 7, 7], [2, 3, 6])
    >>> connection_words(fit(season))[0]
    'Nothing links 2 groups of players, of 3 and 2: compare ratings within a group only.'
    """
    count = np.bincount(ratings.component)[1:]
    sizes = [int(size) for size in count if size > 1]
    words = []
    if len(sizes) > 1:
        shown = ", ".join(f"{size:,}" for size in sizes[:SIZES])
        last = f"{len(sizes) - SIZES:,} more" if len(sizes) > SIZES else f"{sizes[-1]:,}"
        if len(sizes) <= SIZES:
            shown = ", ".join(f"{size:,}" for size in sizes[:-1])
        words += [
            f"Nothing links {len(sizes):,} groups of players, of {shown} and {last}: compare "
            "ratings within a group only.",
            "That each group is centred at one rating is an assumption, not a comparison; a match "
            "or two between groups would link them.",
        ]
    if ratings.idle.any():
        players = (
            "1 player has"
            if ratings.idle.sum() == 1
            else f"{int(ratings.idle.sum()):,} players have"
        )
        words.append(f"{players} no games that count; the rating is the prior's.")
    return words
