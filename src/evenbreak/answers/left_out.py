"""What a fair-race sheet does not include, and why."""

from collections.abc import Iterator

import numpy as np

from evenbreak.answers.remarks import Remark
from evenbreak.answers.report_frames import count_groups
from evenbreak.answers.sheet import Sheet
from evenbreak.answers.wording import count_of
from evenbreak.ratings.fitted import Ratings

NOTHING_LEFT_OUT = "Nothing: every match in the file was used, and every player is on this sheet."


def left_out(
    sheet: Sheet, *, listed: int | None = None, in_table: int | None = None
) -> Iterator[Remark]:
    """Yield what the numbers do not include.

    Parameters
    ----------
    sheet
        the whole sheet.
    listed, in_table
        how many players the list of ratings and the table of races show; None: all.
    """
    if skipped := sheet.file.skipped:
        yield Remark(count_of(skipped, "bad row"), "left out, as --skip-bad asks")
    yield from _uncounted_matches(sheet.ratings)
    yield from _unlinked(sheet)
    yield from _not_shown(sheet, listed, in_table)


def _uncounted_matches(ratings: Ratings) -> Iterator[Remark]:
    if ratings.forfeits:
        yield Remark(
            count_of(ratings.forfeits, "forfeited match", "forfeited matches"),
            "no games were played",
        )
    if ratings.empty:
        yield Remark(
            count_of(ratings.empty, "match at 0-0", "matches at 0-0"), "no games were entered"
        )
    if ratings.later:
        yield Remark(
            count_of(ratings.later, "later match", "later matches"),
            f"the ratings are as of {ratings.as_of}",
        )


def _unlinked(sheet: Sheet) -> Iterator[Remark]:
    ratings = sheet.ratings
    idle = [name for name, none in zip(ratings.players, ratings.idle, strict=True) if none]
    if idle:
        yield Remark(
            f"{count_of(len(idle), 'player')} without a result",
            "rated as expected before any result",
            idle,
        )
    why = "no chain of opponents links them"
    if apart := int(sheet.paired["race_a"].isna().sum()):
        yield Remark(f"the races of {count_of(apart, 'pair')}", why)
    elif (groups := count_groups(ratings)) > 1:
        yield Remark(f"comparisons between {groups:,} groups of players", why)


def _not_shown(sheet: Sheet, listed: int | None, in_table: int | None) -> Iterator[Remark]:
    rated = len(sheet.rated)
    paired = len(np.unique([*sheet.paired["player_a"], *sheet.paired["player_b"]]))
    if listed is not None and listed < rated:
        yield Remark(
            f"{rated - listed:,} of {rated:,} rated players",
            f"the list ends with the {listed:,} strongest; ratings.csv has all",
        )
    if in_table is not None and in_table < paired:
        yield Remark(
            f"the races of {paired - in_table:,} of {paired:,} paired players",
            f"the table holds the {in_table:,} strongest; matchups.csv has all",
        )
    if paired < rated:
        yield Remark(
            f"the races of {count_of(rated - paired, 'rated player')}",
            "they were not chosen; ratings.csv has their ratings",
        )
