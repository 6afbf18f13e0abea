"""Random matches by the command, compared with fractions; extreme chances and long races too."""

from __future__ import annotations

import json
import math
import random
from fractions import Fraction
from functools import cache
from typing import Any

from click.testing import CliRunner

from evenbreak.cli.program import program
from tries import tries

MATCHES = tries("matches", 40)
CHANCES = (0.0, 1.0, 0.5, 1e-300, 5e-324, 1e-16, 1 - 2**-53, 0.999, 1e-3, 1 / 3, 0.55)
ONE = Fraction(1)


def chance(luck: random.Random) -> float:
    return luck.choice(CHANCES) if luck.random() < 0.4 else luck.random()


def race(p: Fraction, m: int, n: int) -> dict[str, Fraction]:
    """Return what is known of a race without breaks: who wins it, how long it is, how it ends."""
    q = 1 - p
    a = [math.comb(m - 1 + k, k) * p**m * q**k for k in range(n)]
    b = [math.comb(n - 1 + k, k) * q**n * p**k for k in range(m)]
    mean = sum((m + k) * one for k, one in enumerate(a)) + sum((n + k) * x for k, x in enumerate(b))
    hill = math.comb(m + n - 2, m - 1) * p ** (m - 1) * q ** (n - 1)
    found = {"p_win_a": sum(a), "p_win_b": sum(b), "mean_games": mean, "p_hill_hill": hill}
    return found | {"p_shutout_a": a[0], "p_shutout_b": b[0]}


def ahead(p: Fraction, m: int, n: int) -> dict[str, Fraction]:
    """Return who wins a match that ends when one player leads by enough."""
    q = 1 - p
    if p in (0, 1):
        return {"p_win_a": p, "p_win_b": q}
    down = sum(p**k * q ** (n - 1 - k) for k in range(n)) * p**m
    up = sum(q**k * p ** (m - 1 - k) for k in range(m)) * q**n
    return {"p_win_a": down / (down + up), "p_win_b": up / (down + up)}


def with_breaks(p1: Fraction, p2: Fraction, how: str, m: int, n: int) -> dict[str, Fraction]:
    """Return who wins a race in which it matters who breaks; A breaks first."""

    @cache
    def win(i: int, j: int, a_breaks: bool) -> Fraction:
        if i == m or j == n:
            return Fraction(int(i == m))
        p = p1 if a_breaks else 1 - p2
        after = {
            "winner": (True, False),
            "loser": (False, True),
            "alternate": (not a_breaks, not a_breaks),
            "a": (True, True),
        }[how]
        return p * win(i + 1, j, after[0]) + (1 - p) * win(i, j + 1, after[1])

    won = win(0, 0, True)
    return {"p_win_a": won, "p_win_b": 1 - won}


def asked(luck: random.Random) -> tuple[list[str], dict[str, Fraction]]:
    """Return a question, and its answer in fractions."""
    kind = luck.choice(("race", "race", "score", "ahead", "breaks"))
    p = chance(luck)
    if kind == "breaks":
        p2, how = chance(luck), luck.choice(("winner", "loser", "alternate", "a"))
        m, n = luck.randint(1, 9), luck.randint(1, 9)
        words = ["--p1", repr(p), "--p2", repr(p2), "--breaks", how, "--race", f"{m}:{n}"]
        return words, with_breaks(Fraction(p), Fraction(p2), how, m, n)
    if kind == "ahead":
        m, n = luck.randint(1, 30), luck.randint(1, 30)
        return ["--p", repr(p), "--ahead", f"{m}:{n}"], ahead(Fraction(p), m, n)
    most = luck.choice((3, 12, 40, 200))
    m, n = luck.randint(1, most), luck.randint(1, most)
    words = ["--p", repr(p), "--race", f"{m}:{n}"]
    if kind == "score":
        i, j = luck.randrange(m), luck.randrange(n)
        words += ["--score", f"{i}:{j}"]
        wins = race(Fraction(p), m - i, n - j)
        return words, {name: wins[name] for name in ("p_win_a", "p_win_b")}
    return words, race(Fraction(p), m, n)


def error(found: Any, exact: Fraction) -> float:
    """Return a relative error; what is less than any float may be 0."""
    if exact < Fraction(2) ** -1022:
        return 0.0 if 0 <= Fraction(found) < Fraction(2) ** -1021 else math.inf
    return float(abs(Fraction(found) / exact - 1))


def test_a_random_match_is_as_fractions_say() -> None:
    for seed in range(MATCHES):
        words, exact = asked(random.Random(seed))
        ran = CliRunner().invoke(program, ["odds", *words, "--json"], catch_exceptions=False)
        assert ran.exit_code == 0, (seed, words, ran.output)
        answer = json.loads(ran.stdout)
        for name, value in exact.items():
            assert error(answer[name], value) < 1e-11, (seed, words, name, answer[name])
