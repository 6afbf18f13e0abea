"""Make `practice_scores.csv` and `practice_scores_after.csv`: one drill, week by week.

    python data/make_practice.py         # writes both into data/
    python data/make_practice.py folder  # or into a folder of your choice

The first list is the ten weeks of a practice routine that the source text works with in
its problem 5.19. The second was made up: eight weeks of the same routine with another
stroke.
"""

import sys
from datetime import date, timedelta
from pathlib import Path

BEFORE = (50, 44, 46, 52, 47, 51, 49, 45, 48, 50)
AFTER = (53, 49, 52, 47, 54, 51, 53, 50)
FIRST_WEEK = date(2024, 9, 3)


def text_of(scores: tuple[int, ...], first: date) -> str:
    """Write scores as CSV text, one a week from a first day on."""
    rows = [f"{first + timedelta(weeks=week)},{score}\n" for week, score in enumerate(scores)]
    return "date,score\n" + "".join(rows)


def main(folder: str | None = None) -> None:
    """Write both files."""
    target = Path(folder) if folder else Path(__file__).parent
    after = FIRST_WEEK + timedelta(weeks=len(BEFORE))
    for name, scores, first in (
        ("practice_scores.csv", BEFORE, FIRST_WEEK),
        ("practice_scores_after.csv", AFTER, after),
    ):
        (target / name).write_bytes(text_of(scores, first).encode("ascii"))


if __name__ == "__main__":
    main(*sys.argv[1:])
