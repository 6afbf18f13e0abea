"""What losing on purpose pays under a system without points by match: exact or played."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.answers.sandbag.pay import PayQuestion, stakes_in_words
from evenbreak.handicaps.ladders.level_ladder import Dumping
from evenbreak.handicaps.systems.system import System

_COLUMNS = "dumped given_away p_first p_in_a_row extra_wins extra_wins_error pays_from profit"


def numbers_dumped(most: int) -> list[int]:
    """Return for how many matches dumped a system is played: a few numbers up to the most.

    >>> numbers_dumped(12), numbers_dumped(30)
    ([0, 1, 2, 3, 4, 6, 8, 12], [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 30])
    """
    usual = [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64]
    return sorted({number for number in usual if number < most} | {most})


def dumping_answer(
    system: System, rows: Sequence[Dumping], question: PayQuestion, leagues: int
) -> Answer:
    """Return what dumping pays, in files a row for each number of matches.

    Parameters
    ----------
    system
        the system.
    rows
        by the number of matches dumped, the first for none.
    question
        the stakes.
    leagues
        how many were played for each number; 0 where nothing was drawn.
    """
    honest = rows[0].p_in_a_row

    def profit(row: Dumping) -> float:
        return row.profit(question.stake, question.dumped_stake, question.prize, honest)

    cells: list[tuple[Any, ...]] = [
        (
            row.dumped,
            row.given_away,
            row.p_first,
            row.p_in_a_row,
            row.extra_wins,
            row.error,
            row.given_away / row.extra_wins if row.extra_wins > 1e-9 else None,
            profit(row),
        )
        for row in rows
    ]
    best = max(rows, key=lambda row: (profit(row), -row.dumped))
    error = f", give or take {question.stake * best.error:.2f}" if leagues else ""
    first = (
        "Sandbagging pays at these stakes, most of all with "
        f"{count_of(best.dumped, 'match', 'matches')} dumped: a profit of "
        f"{profit(best):.2f}{error}."
        if best.dumped and profit(best) > 2.0 * question.stake * best.error
        else "Sandbagging does not pay at these stakes, however many matches are dumped."
        if not leagues
        else "Sandbagging was not found to pay at these stakes."
    )
    how = (
        f"Played in {leagues:,} leagues for each number of matches dumped, all with the same "
        "random numbers; 'give or take' is one standard error."
        if leagues
        else "Exact: nothing is simulated."
    )
    columns = columns_of(_COLUMNS, wins=question.in_a_row, matches=question.earnest)
    names = in_files(str(column.name) for column in columns)
    kind = "level" if system.publishes == "levels" else "rating"
    lower = rows[-1]
    return Answer(
        f"What losing on purpose pays: system {system.name}\n"
        f"{system.in_words[:1].upper()}{system.in_words[1:]}. Opponents are as good as the player "
        f"and stay correctly rated.\n{stakes_in_words(question)}",
        [
            first,
            f"After {count_of(lower.dumped, 'match', 'matches')} lost on purpose the {kind} is "
            + (
                f"{-lower.published:.3g} lower than an honest player's."
                if lower.published < 0.0
                else "no lower than an honest player's."
            ),
            Table("", columns, cells),
            how,
        ],
        data={"system": system.name, "leagues": leagues, "rows": list(rows)},
        csv=Table("rows", names, cells),
    )
