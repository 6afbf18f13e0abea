"""Make `demo_league.csv`: one season of a league that does not exist.

    python data/make_demo_league.py            # writes data/demo_league.csv
    python data/make_demo_league.py other.csv  # or a file of your choice

24 invented players meet on 34 Tuesdays, winner breaks. Each has a true skill and
a league rating, both on a scale where 30 points double the odds of a game. The
league rating starts a little off the true skill; Chart-10 of the National Pool
League turns the difference of the two league ratings into a race, the true skills
and the break decide the racks, and the league moves the winner's rating up one
point and the loser's down one. Now and then a player does not turn up: the other
wins by forfeit. Two matches were never played and stand at 0-0.

Only uniform numbers are drawn, each compared with a probability, so that the file
comes out the same to the byte with every version of numpy.
"""

import csv
import io
import sys
from dataclasses import dataclass
from datetime import date, timedelta
from pathlib import Path

import numpy as np

SEED = 20240903
FIRST_NIGHT = date(2024, 9, 3)
NIGHTS = 34
SPRING_STARTS_AT_NIGHT = 17
P_FORFEIT = 0.02
NEVER_PLAYED = {(11, 4), (29, 9)}
"""(night, table) of the matches that stand at 0-0."""

BREAK_POINTS = 8.0
"""What the break is worth, in rating points."""

# NPL Chart-10: from this difference on, the stronger and the weaker player need...
CHART = (
    (0, 5, 5),
    (6, 5, 4),
    (15, 6, 4),
    (22, 5, 3),
    (29, 6, 3),
    (37, 7, 3),
    (47, 6, 2),
    (57, 7, 2),
)

# name, true skill, how far the league's first rating is off
ROSTER = (
    ("Ines Valbrecht", 118, -6),
    ("Tomáš Havrlant", 111, 4),
    ("Marguerite Oduya", 104, 7),
    ("Søren Lindqvall", 99, -3),
    ("Dario Pellengrino", 95, 10),
    ("Keiko Amasuda", 92, 0),
    ("Finn O'Garrow", 88, -8),
    ("Zoë Kestleman", 85, 3),
    ("Raúl Entrecasas", 82, -2),
    ("Petra Nowicz-Hale", 79, 6),
    ("Abdou Sarrigny", 77, -11),
    ("Liv Brandstätter", 74, 1),
    ("Winston Peake", 71, 5),
    ("Chloé Marchandeau", 69, -4),
    ("Jarek Połomski", 66, 8),
    ("Odalys Ferrán", 64, -1),
    ("Hugh Tannahill", 61, 2),
    ("Noor Al-Beyrati", 58, -7),
    ("Émile Castagnier", 54, 9),
    ("Greta Vondersloot", 51, -5),
    ("Bashir Quennell", 47, 0),
    ("Yuki Tamashiro-Lund", 43, 12),
    ("Pia Rautavuori", 38, -3),
    ("Cosmo Dilworthy", 31, 6),
)

COLUMNS = (
    "date",
    "event",
    "player_a",
    "player_b",
    "race_a",
    "race_b",
    "score_a",
    "score_b",
    "break_format",
    "first_break",
    "forfeit",
)


@dataclass
class Player:
    """A name, the skill that decides racks and the rating that decides races."""

    name: str
    skill: float
    rating: int


def fixtures(players: int, night: int) -> list[tuple[int, int]]:
    """Pair everybody with somebody new each night (the circle method); home and away alternate."""
    wheel = [0] + [1 + (i + night) % (players - 1) for i in range(players - 1)]
    pairs = [(wheel[i], wheel[-1 - i]) for i in range(players // 2)]
    return [(b, a) if (night + i) % 2 else (a, b) for i, (a, b) in enumerate(pairs)]


def race(difference: int) -> tuple[int, int]:
    """Look up the games that player a and player b need; `difference` is a's rating less b's."""
    stronger, weaker = next(row[1:] for row in reversed(CHART) if abs(difference) >= row[0])
    return (stronger, weaker) if difference >= 0 else (weaker, stronger)


def play(
    rng: np.random.Generator, a: Player, b: Player, need_a: int, need_b: int
) -> tuple[int, int, str]:
    """Play a race with winner breaks; return both scores and who broke first."""
    a_breaks = first = bool(rng.random() < 0.5)
    score_a = score_b = 0
    while score_a < need_a and score_b < need_b:
        edge = a.skill - b.skill + (BREAK_POINTS if a_breaks else -BREAK_POINTS)
        a_breaks = bool(rng.random() < 1 / (1 + 2 ** (-edge / 30)))
        score_a += a_breaks
        score_b += not a_breaks
    return score_a, score_b, "a" if first else "b"


def season() -> list[tuple[object, ...]]:
    """Play the whole season and return its rows."""
    rng = np.random.Generator(np.random.PCG64(SEED))
    players = [Player(name, skill, skill + off) for name, skill, off in ROSTER]
    rows: list[tuple[object, ...]] = []
    for night in range(NIGHTS):
        day = FIRST_NIGHT + timedelta(weeks=night)
        event = "Autumn" if night < SPRING_STARTS_AT_NIGHT else "Spring"
        for table, (i, j) in enumerate(fixtures(len(players), night)):
            a, b = players[i], players[j]
            need_a, need_b = race(a.rating - b.rating)
            head = (day.isoformat(), event, a.name, b.name, need_a, need_b)
            if (night, table) in NEVER_PLAYED:
                rows.append((*head, 0, 0, "winner", "", ""))
                continue
            if rng.random() < P_FORFEIT:
                a_came = rng.random() < 0.5
                scores = (need_a, 0) if a_came else (0, need_b)
                rows.append((*head, *scores, "winner", "", "yes"))
                continue
            score_a, score_b, first = play(rng, a, b, need_a, need_b)
            change = 1 if score_a == need_a else -1
            a.rating += change
            b.rating -= change
            rows.append((*head, score_a, score_b, "winner", first, ""))
    return rows


def text_of(rows: list[tuple[object, ...]]) -> str:
    """Write rows as CSV text with a header and LF line ends."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerows(rows)
    return out.getvalue()


def main(path: str | None = None) -> None:
    """Write the file."""
    target = Path(path) if path else Path(__file__).with_name("demo_league.csv")
    target.write_bytes(text_of(season()).encode("utf-8"))


if __name__ == "__main__":
    main(*sys.argv[1:])
