"""Make the teams of a league that does not exist: two squads, results and a schedule.

    python data/make_demo_teams.py         # writes five files into data/
    python data/make_demo_teams.py folder  # or into a folder of your choice

`demo_team.csv` and `demo_opponents.csv` are two squads on the Fargo scale, with skill levels;
`demo_team_results.csv` and `demo_team_schedule.csv` are the matches played and to come of a season
of eight teams: five sets a match, a round robin home and away. `demo_team_rosters.csv` has all
players of another league, of six teams.
"""

import sys
from pathlib import Path

import numpy as np

HEADER = "player,rating,standard_error,level,scale"

# name, rating, standard error, skill level
TEAM = (
    ("Ines Valbrecht", 655, 12, 7),
    ("Dario Pellengrino", 612, 15, 6),
    ("Zoë Kestleman", 540, 14, 5),
    ("Abdou Sarrigny", 505, 20, 4),
    ("Liv Brandstätter", 470, 18, 4),
    ("Noor Al-Beyrati", 430, 30, 3),
)
OPPONENTS = (
    ("Tomáš Havrlant", 640, 14, 7),
    ("Marguerite Oduya", 580, 12, 5),
    ("Raúl Entrecasas", 520, 16, 5),
    ("Winston Peake", 450, 22, 3),
    ("Pia Rautavuori", 400, 25, 2),
)

# P(the team wins a set against an average one)
TEAMS = {
    "Chalk & Awe": 0.66,
    "Rack Pack": 0.61,
    "Corner Office": 0.58,
    "Side Pocket": 0.54,
    "Kiss Shots": 0.50,
    "Bank Managers": 0.46,
    "Cue Tips": 0.40,
    "Scratch Club": 0.33,
}
# The ratings of the teams of another league; skill levels go by ratings.
ROSTERS = {
    "Eight Ballers": (668, 631, 588, 552, 470, 431),
    "Nine Lives": (701, 645, 522, 480, 455, 402),
    "Break Room": (605, 590, 566, 541, 519, 498),
    "Long Rail": (630, 572, 540, 471, 433, 380),
    "Side Spin": (560, 545, 502, 466, 421, 377),
    "Late Shift": (575, 498, 462, 450, 390, 361),
}
FIRST = [
    "Ada",
    "Bruno",
    "Carla",
    "Denis",
    "Elif",
    "Femi",
    "Greta",
    "Hugo",
    "Ines",
    "Jonas",
    "Kaja",
    "Luis",
    "Mona",
    "Nils",
    "Otto",
    "Piet",
    "Rosa",
    "Sami",
    "Tara",
    "Umut",
    "Vera",
    "Wim",
    "Xenia",
    "Yann",
    "Zofia",
    "Arne",
    "Bela",
    "Cleo",
    "Dora",
    "Emil",
    "Fina",
    "Goran",
    "Hana",
    "Ivo",
    "Jule",
    "Karl",
]
SETS = 5
PLAYED = 9  # rounds; five are to come


def rounds(teams: list[str]) -> list[list[tuple[str, str]]]:
    """Return a round robin home and away, by the circle method."""
    first, *circle = teams
    found = []
    for week in range(len(teams) - 1):
        turned = circle[week:] + circle[:week]
        seats = [first, *turned]
        pairs = [(seats[k], seats[-1 - k]) for k in range(len(seats) // 2)]
        found.append([pair[::-1] if (week + k) % 2 else pair for k, pair in enumerate(pairs)])
    return found + [[pair[::-1] for pair in pairs] for pairs in found]


def score(home: str, away: str, luck: np.random.Generator) -> int:
    """Return the sets that the home team wins."""
    one, other = TEAMS[home], TEAMS[away]
    p = one * (1 - other) / (one * (1 - other) + other * (1 - one))
    return int(luck.binomial(SETS, p))


def squad(players: tuple[tuple[str, int, int, int], ...]) -> list[str]:
    """Return the lines of a squad."""
    return [HEADER, *(f"{name},{r},{error},{level},fargo" for name, r, error, level in players)]


def rosters() -> list[str]:
    """Return the lines of the file of all teams."""
    names = iter(FIRST)
    lines = ["team,player,rating,level,scale"]
    for team, ratings in ROSTERS.items():
        for rating in ratings:
            level = min(7, max(2, round((rating - 300) / 55)))
            lines.append(f"{team},{next(names)},{rating},{level},fargo")
    return lines


def main(folder: str | None = None) -> None:
    """Write all files."""
    target = Path(folder) if folder else Path(__file__).parent
    luck = np.random.default_rng(5)
    results, schedule = ["home,away,home_score,away_score"], ["round,home,away"]
    for number, pairs in enumerate(rounds(list(TEAMS)), start=1):
        for home, away in pairs:
            if number <= PLAYED:
                won = score(home, away, luck)
                results.append(f"{home},{away},{won},{SETS - won}")
            else:
                schedule.append(f"{number},{home},{away}")
    for name, lines in {
        "demo_team.csv": squad(TEAM),
        "demo_opponents.csv": squad(OPPONENTS),
        "demo_team_rosters.csv": rosters(),
        "demo_team_results.csv": results,
        "demo_team_schedule.csv": schedule,
    }.items():
        (target / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:2])
