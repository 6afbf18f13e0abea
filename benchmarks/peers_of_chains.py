"""Chains of every kind and size, beside the packages or the bare code that answer the same.

python -m pip install -e . pytest "quantecon==0.11.*" "stormpy==2.0.*" python-flint evalica
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONPATH=benchmarks
python benchmarks/peers_of_chains.py [--limit SECONDS] [NAME ...]

A time is the median processor time of a call in milliseconds, with one BLAS thread; ours and the
peers are called in turns, and each row has a process of its own. The last column and the brackets
hold the largest relative error of the numbers returned. The ratio is ours to the first peer.
NAME chooses rows (`--help` lists them). A row says so if a call takes longer than the limit, and
the last lines say which goals are missed and which packages are not installed.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import statistics
import time
import warnings
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import closing
from importlib.metadata import PackageNotFoundError, version
from multiprocessing.connection import Connection
from typing import Any

import numpy as np
from rows_of_chains import CHAIN_ROWS, OURS, Question
from rows_of_matches import MATCH_ROWS

ROWS = CHAIN_ROWS | MATCH_ROWS
PACKAGES = ("numpy", "scipy", "networkx", "quantecon", "stormpy", "python-flint", "evalica")
MOST_TURNS, PATIENCE, SLOW = 51, 2.0, 5.0  # what takes longer than SLOW seconds is called once
MEMORY = 8 << 30


# One row, in a process of its own --------------------------------------------------------


def clock() -> float:
    """Return the processor time of this process and of those that it has waited for."""
    try:
        from resource import RUSAGE_CHILDREN, getrusage
    except ImportError:  # not on Windows
        return time.process_time()
    children = getrusage(RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def seconds(call: Callable[[], Any], calls: int) -> float:
    begin = clock()
    for _ in range(calls):
        result = call()
    taken = clock() - begin
    del result
    return taken / calls


def findings(row: Question) -> Iterator[tuple[str, str, Any]]:
    """Call everybody once, then in turns: (what is found, whose, the number)."""
    often = {}
    for name, answer in {**row.peers, **row.ours}.items():
        begin = clock()
        found = answer()
        first = clock() - begin
        yield "first", name, first
        yield "error", name, error(row, found)
        if first < SLOW:
            begin = clock()
            answer()  # the first call pays for what is loaded or compiled
            often[name] = answer, max(1, math.ceil(2e-3 / max(clock() - begin, 1e-7)))
    begin = time.perf_counter()
    for turn in range(MOST_TURNS):
        if turn >= 3 and time.perf_counter() - begin > PATIENCE:
            break
        for name, (answer, calls) in often.items():
            yield "time", name, seconds(answer, calls)


def error(row: Question, found: Any) -> float | None:
    if row.error is not None:
        return row.error(found)
    if row.exact is None:
        return None
    right = np.asarray(row.exact)
    got = np.asarray(getattr(found, "probability", found))
    normal = np.abs(right) >= np.finfo(float).tiny
    return float(np.max(np.abs(got.reshape(right.shape)[normal] / right[normal] - 1)))


def send_findings(name: str, place: int, pipe: Connection) -> None:
    warnings.simplefilter("ignore")
    try:
        from resource import RLIMIT_AS, setrlimit

        setrlimit(RLIMIT_AS, (MEMORY, MEMORY))
    except ImportError:
        pass
    try:
        row = ROWS[name][place]()
        pipe.send(("row", "", (row.work, row.goal, list(row.ours), list(row.peers))))
        for finding in findings(row):
            pipe.send(finding)
    except Exception as problem:
        pipe.send(("failed", "", f"{type(problem).__name__}: {problem}"))
    pipe.send(("end", "", None))


# The table -----------------------------------------------------------------------------


class Row:
    """What is known of a row, by its process or by the clock."""

    def __init__(self, name: str, place: int, limit: float) -> None:
        self.goal: Any = None
        self.work, self.ours, self.peers, self.failed = f"{name} {place + 1}", [OURS], [], ""
        self.first: dict[str, float] = {}
        self.error: dict[str, float | None] = {}
        self.times: dict[str, list[float]] = defaultdict(list)
        ours, theirs = multiprocessing.Pipe(duplex=False)
        process = multiprocessing.Process(target=send_findings, args=(name, place, theirs))
        process.start()
        with closing(ours):
            self.listen(ours, process, limit)
            process.kill()
            process.join()

    def listen(self, pipe: Connection, process: Any, limit: float) -> None:
        """Note what comes through the pipe, until nothing has for longer than the limit."""
        heard = time.monotonic()
        while not self.failed:
            if pipe.poll(0.1):
                kind, name, value = pipe.recv()
                heard = time.monotonic()
                if kind == "end":
                    return
                self.note(kind, name, value)
            elif time.monotonic() > heard + limit:
                self.failed = f"no answer in {limit:g} s"
            elif not process.is_alive():
                self.failed = "its process ended without an answer"

    def note(self, kind: str, name: str, value: Any) -> None:
        if kind == "row":
            self.work, self.goal, self.ours, self.peers = value
        elif kind == "failed":
            self.failed = value
        elif kind == "time":
            self.times[name].append(value)
        else:
            getattr(self, kind)[name] = value

    def taken(self, name: str) -> float | None:
        times = self.times[name] or [self.first[name]] if name in self.first else []
        return statistics.median(times) if times else None

    @property
    def measure(self) -> float | None:
        """What the goal speaks of: a ratio, seconds, or the exponent of growth."""
        ours = [taken for name in self.ours if (taken := self.taken(name)) is not None]
        if self.goal is None or not ours:
            return None
        if self.goal.kind == "exponent":
            sizes = [float(name.replace(",", "")) for name in self.ours][: len(ours)]
            return float(np.polyfit(np.log(sizes), np.log(ours), 1)[0]) if sizes[1:] else None
        if self.goal.kind == "seconds":
            return ours[0]
        peer = self.taken(self.peers[0]) if self.peers else None
        return ours[0] / peer if peer else None

    @property
    def missed(self) -> bool:
        measure = self.measure
        return bool(self.failed) or (measure is not None and measure > self.goal.at_most)

    def cell(self, name: str, *, bare: bool = False) -> str:
        taken = self.taken(name)
        if taken is None:
            return ""
        worst = self.error.get(name)
        shown = f"{1e3 * taken:,.3g}" if taken < 1 else f"{1e3 * taken:,.0f}"
        return shown if bare or worst is None else f"{shown} ({worst:.0e})"

    def __str__(self) -> str:
        ours = " / ".join(cell for name in self.ours if (cell := self.cell(name, bare=True)))
        peers = "; ".join(f"{name} {cell}" for name in self.peers if (cell := self.cell(name)))
        errors = [worst for name in self.ours if (worst := self.error.get(name)) is not None]
        measure, goal = self.measure, self.goal
        cells = (
            self.work,
            " / ".join(part for part in (ours, self.failed) if part),
            peers,
            "" if measure is None else goal.shown(measure),
            "" if goal is None else str(goal),
            f"{max(errors):.0e}" if errors else "",
        )
        return "| " + " | ".join(cells) + " |"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--limit", type=float, default=60.0, help="seconds a call may take")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(ROWS))
    chosen = parser.parse_args()
    if unknown := set(chosen.names) - ROWS.keys():
        parser.error(f"no row {', '.join(sorted(unknown))}; there are {', '.join(ROWS)}")
    print("| work | ours, ms | best peer or floor, ms | ratio | goal | worst error |")
    print("|---|---|---|---|---|---|")
    missed = []
    for name in chosen.names or ROWS:
        for place in range(len(ROWS[name])):
            row = Row(name, place, chosen.limit)
            print(row, flush=True)
            missed += [row.work] if row.missed else []
    here, away = [], []
    for package in PACKAGES:
        try:
            here.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            away.append(package)
    print(f"goals missed: {'; '.join(missed) or 'none'}")
    print(", ".join(here), *(f"{package} is not installed" for package in away), sep="\n")


if __name__ == "__main__":
    main()
