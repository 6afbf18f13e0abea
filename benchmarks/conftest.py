"""Each benchmark stands beside a bare floor: both are timed in turns, in one run."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import Any

import pytest

_ROWS: list[tuple[str, float, float, str]] = []


def seconds(action: Callable[[], Any]) -> float:
    """Return how long one call takes; its result is thrown away after the clock is read."""
    begin = time.perf_counter()
    result = action()
    taken = time.perf_counter() - begin
    del result
    return taken


@pytest.fixture
def beside(benchmark: Any) -> Callable[..., float]:
    """Return a function that times `ours` and `bare` in turns and notes the ratio of medians.

    Garbage collection stays on in both. Pytest-benchmark's own table then shows `ours`.
    """

    def measure(
        question: str,
        ours: Callable[[], Any],
        bare: Callable[[], Any],
        *,
        rounds: int = 11,
        note: str = "",
    ) -> float:
        if rounds > 1:
            ours(), bare()  # the first call pays for imports and cold caches
        pairs = [(seconds(ours), seconds(bare)) for _ in range(rounds)]
        mine, floor = (statistics.median(column) for column in zip(*pairs, strict=True))
        benchmark.group = question
        benchmark.extra_info.update(ours=mine, bare=floor, ratio=mine / floor, note=note)
        benchmark.pedantic(ours, rounds=min(rounds, 3))
        _ROWS.append((question, mine, floor, note))
        return mine / floor

    return measure


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print the table of ratios, ready for README.md."""
    if not _ROWS:
        return
    terminalreporter.section("ours beside the bare floor (medians)")
    terminalreporter.line("| question | ours, ms | bare, ms | ratio | note |")
    terminalreporter.line("|---|---|---|---|---|")
    for question, mine, floor, note in _ROWS:
        terminalreporter.line(
            f"| {question} | {1e3 * mine:.3g} | {1e3 * floor:.3g} | {mine / floor:.2f} | {note} |"
        )
