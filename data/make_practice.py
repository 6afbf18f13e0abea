"""Make `practice_scores.csv` and `practice_scores_after.csv`: one drill, week by week.

And `practice_shots.csv`: five shots, tried ten times each on eight evenings.

    python data/make_practice.py         # writes them into data/
    python data/make_practice.py folder  # or into a folder of your choice

The first list is the ten weeks of a practice routine that the source text works with in
its problem 5.19. The second was made up: eight weeks of the same routine with another
stroke. The shots were made up too.
"""

import sys
from datetime import date, timedelta
from pathlib import Path

BEFORE = (50, 44, 46, 52, 47, 51, 49, 45, 48, 50)
AFTER = (53, 49, 52, 47, 54, 51, 53, 50)
SHOTS = {
    "stop shot": (8, 7, 9, 8, 9, 8, 9, 10),
    "long cut": (4, 5, 3, 5, 6, 5, 5, 7),
    "bank": (3, 2, 4, 3, 4, 3, 5, 4),
    "thin cut": (5, 4, 6, 4, 5, 7, 6, 6),
    "jump": (1, 0),
}
"""Made of ten tries each; the jump was tried on the last two evenings, four times."""
FIRST_WEEK = date(2024, 9, 3)


def text_of(scores: tuple[int, ...], first: date) -> str:
    """Write scores as CSV text, one a week from a first day on."""
    rows = [f"{first + timedelta(weeks=week)},{score}\n" for week, score in enumerate(scores)]
    return "date,score\n" + "".join(rows)


def shots() -> str:
    """Write the shots as CSV text."""
    rows = []
    for week in range(8):
        day = FIRST_WEEK + timedelta(weeks=week)
        for shot, made in SHOTS.items():
            first = 8 - len(made)
            if week >= first:
                tried = 4 if shot == "jump" else 10
                rows.append(f"{day},{shot},{made[week - first]},{tried}\n")
    return "date,shot,made,tried\n" + "".join(rows)


def main(folder: str | None = None) -> None:
    """Write the files."""
    target = Path(folder) if folder else Path(__file__).parent
    after = FIRST_WEEK + timedelta(weeks=len(BEFORE))
    for name, scores, first in (
        ("practice_scores.csv", BEFORE, FIRST_WEEK),
        ("practice_scores_after.csv", AFTER, after),
    ):
        (target / name).write_bytes(text_of(scores, first).encode("ascii"))
    (target / "practice_shots.csv").write_bytes(shots().encode("ascii"))


if __name__ == "__main__":
    main(*sys.argv[1:])
