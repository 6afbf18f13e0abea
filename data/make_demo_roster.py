"""Make `demo_roster.csv` and `demo_pairs.csv`: a club that does not exist, and its match night.

    python data/make_demo_roster.py         # writes both into data/
    python data/make_demo_roster.py folder  # or into a folder of your choice

The ratings are on the scale of the National Pool League. The error of a rating is what
games against equal opponents leave of a prior with a standard deviation of 30 points.
"""

import math
import sys
from pathlib import Path

POINTS = 30 / math.log(2)
"""Rating points for each unit of natural log-odds."""

# name, rating, games; None: a new player
ROSTER = (
    ("Ines Valbrecht", 118, 205),
    ("Søren Lindqvall", 99, 160),
    ("Keiko Amasuda", 92, 48),
    ("Zoë Kestleman", 85, 311),
    ("Abdou Sarrigny", 71, 22),
    ("Liv Brandstätter", 64, 130),
    ("Noor Al-Beyrati", 52, 95),
    ("Otto Birnhuber", None, 0),
)
TONIGHT = ((0, 3), (1, 4), (2, 7), (5, 6))


def error(games: int) -> float:
    """Return the standard error of a rating in points; an equal game weighs a quarter."""
    precision = (POINTS / 30) ** 2 + games / 4
    return POINTS / math.sqrt(precision)


def main(folder: str | None = None) -> None:
    """Write both files."""
    target = Path(folder) if folder else Path(__file__).parent
    rows = ["player,rating,standard_error,games"]
    for name, rating, games in ROSTER:
        rows.append(
            f"{name},,,0" if rating is None else f"{name},{rating},{error(games):.1f},{games}"
        )
    pairs = ["player_a,player_b", *(f"{ROSTER[a][0]},{ROSTER[b][0]}" for a, b in TONIGHT)]
    for name, lines in (("demo_roster.csv", rows), ("demo_pairs.csv", pairs)):
        (target / name).write_bytes("".join(f"{line}\n" for line in lines).encode("utf-8"))


if __name__ == "__main__":
    main(*sys.argv[1:])
