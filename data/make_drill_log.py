"""Make `drill_log.csv`: twelve evenings of the progressive 9-ball drill, by nobody.

    python data/make_drill_log.py            # writes data/drill_log.csv
    python data/make_drill_log.py other.csv  # or a file of your choice

At level i the player throws i balls on the table, takes ball in hand and tries to run them
out: a success leads to one ball more, a miss to one ball less. Each Thursday begins at
level 1. The invented player runs i balls about as if each but the first took a shot of .86,
except for five balls: there it goes wrong far more often, as if five were a lot.

Only uniform numbers are drawn, each compared with a probability or scaled to a length, so
that the file comes out the same to the byte with every version of numpy.
"""

import sys
from datetime import date, timedelta
from pathlib import Path

import numpy as np

SEED = 20240905
FIRST_EVENING = date(2024, 9, 5)
EVENINGS = 12
ATTEMPTS = (32, 49)
"""The fewest and the most attempts of an evening."""

SUCCESS = (0.99, 0.86, 0.75, 0.65, 0.30, 0.50, 0.42, 0.36, 0.30)
"""P(success | an attempt at level i), i = 1 ... 9."""


def evenings() -> list[tuple[str, int, str]]:
    """Play all evenings and return their rows."""
    rng = np.random.Generator(np.random.PCG64(SEED))
    rows = []
    for evening in range(EVENINGS):
        day = (FIRST_EVENING + timedelta(weeks=evening)).isoformat()
        fewest, most = ATTEMPTS
        level = 1
        for _ in range(fewest + int((most - fewest + 1) * rng.random())):
            success = bool(rng.random() < SUCCESS[level - 1])
            rows.append((day, level, "yes" if success else "no"))
            level = min(level + 1, len(SUCCESS)) if success else max(level - 1, 1)
    return rows


def main(path: str | None = None) -> None:
    """Write the file."""
    target = Path(path) if path else Path(__file__).with_name("drill_log.csv")
    lines = ["date,level,success", *(f"{day},{level},{won}" for day, level, won in evenings())]
    target.write_bytes("".join(f"{line}\n" for line in lines).encode("utf-8"))


if __name__ == "__main__":
    main(*sys.argv[1:])
