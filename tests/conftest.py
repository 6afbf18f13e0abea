"""What holds for all tests."""

import gc
import os
import signal
from collections import Counter
from collections.abc import Generator
from functools import cache
from pathlib import Path

import pytest
from hypothesis import settings

from tiers import examples

# Tests run beside each other; threads of one would wait for those of another.
for library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

# A slow machine is no failure, and a failure must come again on the next machine.
settings.register_profile("evenbreak", deadline=None, derandomize=True, max_examples=examples(20))
settings.load_profile("evenbreak")

# A shell's background jobs ignore Ctrl-C, and so would every program that a test starts.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, None, None]:
    """Collect without looking for garbage: many tests are made, and all are kept."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave files unread that have no slow test, where only slow tests are run."""
    only_slow = config.option.markexpr == "slow and not thorough"
    tests = collection_path.name.startswith("test_") and collection_path.suffix == ".py"
    return True if only_slow and tests and not _names_slow(collection_path) else None


@cache
def _names_slow(path: Path) -> bool:
    return "slow" in path.read_text(encoding="utf-8")


@pytest.hookimpl(tryfirst=True)  # before marks select
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what follows from other marks, and what is drawn at random."""
    rows = Counter[tuple[str, str]]()
    for item in items:
        if item.get_closest_marker("thorough"):
            item.add_marker("slow")
        if not isinstance(item, pytest.Function):
            continue
        if hasattr(item.module, "tries") or getattr(item.obj, "is_hypothesis_test", False):
            item.add_marker("drawn")
        if mark := item.get_closest_marker("slow_after"):
            test = (item.parent.nodeid if item.parent else "", item.originalname)
            if rows[test] >= mark.args[0]:
                item.add_marker("slow")
            rows[test] += 1
        # Else nobody would run it: see above.
        only_slow = item.get_closest_marker("slow") and not item.get_closest_marker("thorough")
        assert not only_slow or _names_slow(item.path), item.nodeid
