"""Make `demo_league_roster.csv` and `demo_schedule.csv`: a league to simulate, and its fixtures.

    python data/make_demo_season.py         # writes both into data/
    python data/make_demo_season.py folder  # or into a folder of your choice

16 invented players in two halves. In weeks 1 to 7 everybody meets the others of his half, in
weeks 8 to 15 those of the other half. The ratings are on the scale of the National Pool League;
their errors are what games against equal opponents leave of a prior with a standard deviation
of 30 points.
"""

import math
import sys
from pathlib import Path

POINTS = 30 / math.log(2)
"""Rating points for each unit of natural log-odds."""

COLUMNS = (
    *("player", "rating", "standard_error", "games", "matches"),
    *("skill", "day_sd", "drift", "joins", "leaves", "absence"),
)

# name, rating, games, matches, and what is known besides
NORTH = (
    ("Ines Valbrecht", 118, 205, 34, {}),
    ("Marguerite Oduya", 104, 226, 33, {}),
    ("Dario Pellengrino", 95, 211, 34, {"day_sd": 12}),
    ("Zoë Kestleman", 85, 311, 50, {}),
    ("Petra Nowicz-Hale", 79, 219, 33, {"absence": 0.2}),
    ("Odalys Ferrán", 64, 214, 33, {}),
    ("Noor Al-Beyrati", 52, 95, 15, {"drift": 0.5}),
    ("Bashir Quennell", 47, 223, 34, {}),
)
SOUTH = (
    ("Tomáš Havrlant", 111, 210, 33, {}),
    ("Søren Lindqvall", 99, 160, 26, {}),
    ("Keiko Amasuda", 92, 48, 8, {}),
    ("Raúl Entrecasas", 82, 220, 34, {"leaves": 10}),
    ("Winston Peake", 71, 205, 33, {}),
    ("Otto Birnhuber", 60, 0, 0, {"skill": 90}),
    ("Liv Brandstätter", 64, 130, 21, {}),
    ("Pia Rautavuori", 38, 202, 32, {"joins": 4}),
)


def error(games: int) -> float:
    """Return the standard error of a rating in points; an equal game weighs a quarter."""
    precision = (POINTS / 30) ** 2 + games / 4
    return POINTS / math.sqrt(precision)


def roster() -> list[str]:
    """Return the lines of the roster."""
    lines = [",".join(COLUMNS)]
    for name, rating, games, matches, known in NORTH + SOUTH:
        cells = {
            "player": name,
            "rating": rating,
            "standard_error": f"{error(games):.1f}",
            "games": games,
            "matches": matches,
            **known,
        }
        lines.append(",".join(str(cells.get(column, "")) for column in COLUMNS))
    return lines


def fixtures() -> list[str]:
    """Return the lines of the schedule."""
    lines = ["week,player_a,player_b"]
    half = len(NORTH)
    for week in range(half - 1):
        seats = [0] + [1 + (i + week) % (half - 1) for i in range(half - 1)]
        for players in (NORTH, SOUTH):
            pairs = [(seats[i], seats[-1 - i]) for i in range(half // 2)]
            lines += [f"{week + 1},{players[a][0]},{players[b][0]}" for a, b in pairs]
    for week in range(half):
        lines += [f"{half + week},{NORTH[i][0]},{SOUTH[(i + week) % half][0]}" for i in range(half)]
    return lines


def main(folder: str | None = None) -> None:
    """Write both files."""
    target = Path(folder) if folder else Path(__file__).parent
    for name, lines in (("demo_league_roster.csv", roster()), ("demo_schedule.csv", fixtures())):
        (target / name).write_bytes("".join(f"{line}\n" for line in lines).encode("utf-8"))


if __name__ == "__main__":
    main(*sys.argv[1:])
