"""Collisions beside bare numpy, and the import of the physics beside that of numpy."""

from __future__ import annotations

import math
import subprocess
import sys
import timeit
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from evenbreak.physics import collide

Beside = Callable[..., float]


def bare_collisions(cut: Any, topspin: Any, side: Any, speed: Any, mu: float) -> tuple[Any, ...]:
    """Return V_bx, V_by and V_bz by the same formulas; nothing checked, nothing slips nowhere."""
    sin, cos = np.sin(cut), np.cos(cut)
    left, up = sin + side, -topspin * cos
    length = np.sqrt(left * left + up * up)
    pull = mu * cos
    share_left = np.minimum(pull, length / 7.0) / length
    share_up = np.minimum(pull, length / 6.0) / length
    return speed * cos, speed * (left * share_left), speed * (up * share_up)


def test_a_million_collisions(beside: Beside) -> None:
    rng, count = np.random.default_rng(6), 10**6
    cut = rng.uniform(0.0, math.pi / 2.0, count)
    topspin, side = rng.uniform(-1.25, 1.25, (2, count))
    speed = rng.uniform(0.1, 8.0, count)
    mu = 4.0 / 72.0

    def ours() -> Any:
        return collide(cut, topspin, side, speed=speed, mu=mu)

    def bare() -> tuple[Any, ...]:
        return bare_collisions(cut, topspin, side, speed, mu)

    hit = ours()
    for mine, floor in zip((hit.ahead, hit.sideways, hit.upward), bare(), strict=True):
        assert mine == pytest.approx(floor, abs=1e-12)
    rates = [count / min(timeit.repeat(law, number=1, repeat=9)) / 1e6 for law in (ours, bare)]
    note = "at best {:.1f} and {:.1f} million/s".format(*rates)
    beside("10^6 collisions / bare numpy", ours, bare, rounds=21, note=note)


# The package itself loads a module when one of its names is first asked for.
@pytest.mark.parametrize(
    "line",
    [
        "import evenbreak.physics",
        "from evenbreak.physics import collide",
        "from evenbreak.physics import *",
    ],
)
def test_import(beside: Beside, line: str) -> None:
    def fresh(code: str) -> subprocess.CompletedProcess[bytes]:
        return subprocess.run([sys.executable, "-c", code], check=True)

    assert fresh(line).returncode == 0
    beside(
        f"`{line}` / import numpy", lambda: fresh(line), lambda: fresh("import numpy"), rounds=31
    )
