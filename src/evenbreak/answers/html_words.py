"""What the sheet for a screen says beyond the others: how sure it is, and what it leaves out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.answers.frames import count_groups, file_name
from evenbreak.answers.sheet_parts import SurePair
from evenbreak.answers.sheet_words import count_of, decimals_of
from evenbreak.files.results import ResultsFile
from evenbreak.files.roster import RosterFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd


class Remark(NamedTuple):
    """Something, and what there is to say of it."""

    what: str
    why: str


def how_sure(ratings: Ratings, pairs: Sequence[SurePair]) -> Iterator[str]:
    """Yield what the standard errors mean for a rating and for a race."""
    decimals = decimals_of(ratings.scale)
    yield (
        "A bar reaches two standard errors to either side of a rating. If the model below holds, "
        "a player's true strength is within the bar about 19 times in 20."
    )
    if pairs:
        middle = pairs[(len(pairs) - 1) // 2]
        whose = "For half of the pairs the" if len(pairs) > 1 else "The"
        better = " or better" if len(pairs) > 1 else ""
        yield (
            f"{whose} difference of the two ratings is known to within "
            f"{2 * middle.error:.{decimals}f} points (two standard errors){better}. So the "
            "chance of winning a race that is fair by the ratings may be another than they say:"
        )


def three_pairs(pairs: Sequence[SurePair]) -> list[tuple[str, SurePair]]:
    """Return the best known, the middling and the least known pair, each once."""
    if not pairs:
        return []
    if len(pairs) == 1:
        return [("", pairs[0])]
    named = {0: "best known", (len(pairs) - 1) // 2: "middling", len(pairs) - 1: "least known"}
    return [(name, pairs[k]) for k, name in sorted(named.items())]


def about_model(ratings: Ratings) -> str:
    """Return the model in a sentence or two, with the parameters that it was used with."""
    scale = ratings.scale
    prior = float(scale.points(ratings.prior_sd))
    ages = "early and late matches of the file alike"
    if ratings.half_life is not None:
        ages = f"a match that is {ratings.half_life:g} days old counting half"
    if ratings.as_of is not None:
        ages += f", as of {ratings.as_of}"
    races = ", and on the chance of a race where only its winner is known"
    if not ratings.races_won.any():
        races = ""
    breaks = "whoever breaks"
    if ratings.break_advantage is not None:
        breaks = f"who breaks playing {ratings.break_advantage:.3g} points better"
    return (
        f"Bradley\N{EN DASH}Terry on games{races}: {game_chance(scale)}, every game "
        f"independent of the others, {ages}, {breaks}. "
        f"Before any result a player is rated {ratings.anchor:g} ± {prior:.4g} (normal prior, one "
        "standard deviation)."
    )


def game_chance(scale: Scale) -> str:
    """Return what a rating difference means, as a formula."""
    return (
        "a player who is rated d points higher wins a game with the chance "
        f"1/(1 + 2^(\N{MINUS SIGN}d/{scale.points_per_doubling:.6g}))"
    )


def left_out_and_why(
    file: ResultsFile,
    ratings: Ratings,
    rated: pd.DataFrame,
    paired: pd.DataFrame,
    shown: tuple[int, int],
) -> Iterator[Remark]:
    """Yield what the numbers do not include, and what a person should look at.

    Parameters
    ----------
    file, ratings
        what the sheet is made of.
    rated, paired
        as `ratings_frame` and `matchups_frame` make them.
    shown
        how many players the list of ratings and the table of races show.
    """
    if ratings.forfeits:
        yield Remark(
            count_of(ratings.forfeits, "forfeited match", "forfeited matches"),
            "nobody played, so it says nothing of strength",
        )
    if ratings.empty:
        yield Remark(
            count_of(ratings.empty, "match at 0-0", "matches at 0-0"), "no game was entered"
        )
    if ratings.later:
        yield Remark(
            count_of(ratings.later, "later match", "later matches"),
            f"the ratings are as of {ratings.as_of}",
        )
    idle = [name for name, none in zip(ratings.players, ratings.idle, strict=True) if none]
    if idle:
        yield Remark(
            f"{count_of(len(idle), 'player', 'players')} without a result: {some_names(idle)}",
            "rated in the middle for want of knowledge",
        )
    apart = int(paired["race_a"].isna().sum())
    if apart:
        yield Remark(
            f"the races of {count_of(apart, 'pair', 'pairs')}",
            "no chain of opponents links the two players",
        )
    elif (groups := count_groups(ratings)) > 1:
        yield Remark(
            f"comparisons between {groups:,} groups of players",
            "no chain of opponents links them; ratings compare only within a group",
        )
    yield from _not_shown(rated, paired, shown)
    yield from warnings_of(file)


def warnings_of(file: ResultsFile | RosterFile) -> Iterator[Remark]:
    """Yield what a person should look at in a file, without the file's folder."""
    for warning in file.warnings:
        # Where the file lay on somebody's disk is nobody else's business.
        if not warning.startswith(f"{file.source}:"):
            yield Remark("a warning", warning)
            continue
        told = warning.removeprefix(f"{file.source}:")
        # After the name comes a blank, or the number of a line.
        told = told.lstrip() if told.startswith(" ") else f"line {told}"
        yield Remark(f"a warning on {file_name(file)}", told)


def _not_shown(
    rated: pd.DataFrame, paired: pd.DataFrame, shown: tuple[int, int]
) -> Iterator[Remark]:
    in_list, in_table = shown
    players = len(np.unique([*paired["player_a"], *paired["player_b"]]))
    if in_list < len(rated):
        yield Remark(
            f"{len(rated) - in_list:,} of {len(rated):,} rated players",
            f"the list ends with the {in_list:,} strongest; ratings.csv has all",
        )
    if in_table < players:
        yield Remark(
            f"the races of {players - in_table:,} of {players:,} paired players",
            f"the table holds the {in_table:,} strongest; matchups.csv has all",
        )
    if players < len(rated):
        yield Remark(
            f"the races of {count_of(len(rated) - players, 'rated player', 'rated players')}",
            "not chosen to be paired",
        )


def some_names(names: Sequence[str]) -> str:
    """Return a few names of many."""
    # Isolated, so that a name from right to left leaves the sentence as it is.
    told = ", ".join(
        f"\N{FIRST STRONG ISOLATE}{name}\N{POP DIRECTIONAL ISOLATE}" for name in names[:5]
    )
    return told if len(names) <= 5 else f"{told} and {len(names) - 5:,} more"
