"""Make demo_sandbag.csv and demo_sandbag_roster.csv: a season in which one player dumps matches.

Ten players meet on league nights and in cup matches, every week one of each, by chart 10 of
the National Pool League, a point a match. Nine of them always play their best. Vito Drago
plays seven of ten league nights 80 points below his skill. All names are made up.

    python data/make_demo_sandbag.py [FOLDER]
"""

import csv
import datetime as dt
import sys
from pathlib import Path

import numpy as np

from evenbreak.handicaps import chart
from evenbreak.ratings.scale import SCALES

PLAYERS = {
    "Ada Brandvold": 104,
    "Boris Halloran": 96,
    "Celine Okafor": 91,
    "Dmitri Vance": 86,
    "Vito Drago": 82,
    "Esme Farrow": 79,
    "Gus Lindahl": 74,
    "Hana Petrosyan": 68,
    "Iggy Mercado": 61,
    "Jo Stanhope": 55,
}
"""The players with their ratings before the season."""
WEEKS, FIRST = 26, dt.date(2025, 9, 2)
SANDBAGGER, SHARE, BELOW = "Vito Drago", 0.7, 80
HERE = Path(__file__).parent


def season(seed: int) -> list[tuple[str, ...]]:
    """Play the season and return its lines."""
    rng = np.random.default_rng(seed)
    names = list(PLAYERS)
    rating = np.array(list(PLAYERS.values()))
    skill = rating + np.round(rng.normal(0.0, 4.0, len(names)))
    ten, lines = chart("npl_10"), []
    for week in range(WEEKS):
        for event, day in (("League night", 0), ("Cup", 3)):
            date = FIRST + dt.timedelta(days=7 * week + day)
            change = np.zeros_like(rating)
            for a, b in rng.permutation(len(names)).reshape(-1, 2):
                needs = ten.race(int(rating[a] - rating[b]))
                today = skill.copy()
                if event == "League night" and rng.random() < SHARE:
                    today[names.index(SANDBAGGER)] -= BELOW
                p = SCALES["npl"].win_probability(today[a] - today[b])
                won = [0, 0]
                while won[0] < needs[0] and won[1] < needs[1]:
                    won[int(rng.random() >= p)] += 1
                up = 1 if won[0] == needs[0] else -1
                change[a] += up
                change[b] -= up
                row = (date, event, names[a], names[b], *needs, *won)
                lines.append(tuple(map(str, row)))
            rating = rating + change
    return lines


def main(folder: Path) -> None:
    """Write the two files."""
    heads = ("date", "event", "player_a", "player_b", "race_a", "race_b", "score_a", "score_b")
    files = {
        "demo_sandbag.csv": [heads, *season(26)],
        "demo_sandbag_roster.csv": [("player", "rating"), *PLAYERS.items()],
    }
    for name, rows in files.items():
        with (folder / name).open("w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
