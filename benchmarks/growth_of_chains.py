"""How the time of a limit grows with the number of states, for each kind of graph.

export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONPATH=benchmarks
python benchmarks/growth_of_chains.py [NAME ...]

Each kind is solved at twice as many states, from a `Chain` of which nothing is known yet, until
that takes more than 10 s of processor time or its process more than 2 GB, arcs included. The
exponent is that of the last five doublings. NAME chooses kinds: see `KINDS`.
"""

from __future__ import annotations

import multiprocessing
import sys
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from resource import RLIMIT_AS, RUSAGE_SELF, getrusage, setrlimit
from typing import NamedTuple

import numpy as np
from bench_chains import fresh, grid_chain, small_blocks_chain, walk
from rows_of_chains import box, random_digraph, random_table

from evenbreak.chains import Chain, chain_of, stochastic_limit
from evenbreak.errors import EvenbreakError
from evenbreak.games import Race, Rack, winner_breaks

SECONDS, BYTES = 10.0, 2e9
WATCH = 40.0  # seconds of the clock that one size may take, its arcs included


class Kind(NamedTuple):
    """A kind of graph: its name, the route that it takes, and a chain of about n states."""

    name: str
    route: str
    chain: Callable[[int], Chain]
    least: int = 1_000


def race(n: int) -> Chain:
    games = round((n / 2) ** 0.5)
    return chain_of(Race(games, games, Rack(0.6, 0.55), breaks=winner_breaks))


def ladder(n: int) -> Chain:
    lead = np.linspace(-20, 20, n)
    up, down = 1.0 / (1.0 + 2.0**lead), 1.0 / (1.0 + 2.0**-lead)
    up[-1] = down[0] = 0.0
    return walk(up, down)


KINDS = {
    "race": Kind("without cycles: a race", "one forward sweep", race),
    "line": Kind("a line: a rating ladder", "scaled products", ladder),
    "blocks": Kind(
        "small classes: blocks of 3 states",
        "many classes at once",
        lambda n: small_blocks_chain(n // 3),
    ),
    "dense": Kind(
        "all arcs", "one dense array", lambda n: chain_of(random_table(n), rows="from"), 100
    ),
    "strip": Kind("a strip 4 states wide", "sparse factors, proved", lambda n: box(n // 4, 4)[0]),
    "grid": Kind(
        "a square grid", "sparse factors, proved", lambda n: box(*2 * [round(n ** (1 / 2))])[0]
    ),
    "hills": Kind(
        "a square grid, its law over 18 decades",
        "sparse factors, proved",
        lambda n: grid_chain(round(n**0.5))[0],
    ),
    "cube": Kind(
        "a cubic grid", "iterations, proved", lambda n: box(*3 * [round(n ** (1 / 3))])[0]
    ),
    "random": Kind("random, 3 arcs out of each state", "iterations, proved", random_digraph),
}


def solve(kind: Kind, n: int, report: Connection) -> None:
    setrlimit(RLIMIT_AS, (8 << 30, 8 << 30))
    try:
        chain = fresh(kind.chain(n))
        begin = time.process_time()
        stochastic_limit(chain, chain.states[0])
        taken = time.process_time() - begin
        report.send((len(chain), taken, getrusage(RUSAGE_SELF).ru_maxrss * 1024, ""))
    except Exception as problem:
        print(f"{kind.name}, {n:,} states: {problem}", file=sys.stderr)
        ours = isinstance(problem, EvenbreakError)
        report.send((n, 0.0, 0.0, "refused" if ours else "memory"))


def measured(kind: Kind, n: int) -> tuple[int, float, float, str]:
    """Return the states, the seconds, the bytes, and what went wrong, in a process of its own."""
    ours, theirs = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=solve, args=(kind, n, theirs))
    process.start()
    found: tuple[int, float, float, str] = (n, 0.0, 0.0, "time")
    if ours.poll(WATCH):
        found = ours.recv()
    process.kill()
    process.join()
    return found


def row(kind: Kind) -> str:
    n, sizes, times, why = kind.least, [], [], ""
    while not why:
        states, taken, used, why = measured(kind, n)
        if not why and taken > SECONDS:
            why = "time"
        elif not why and used > BYTES:
            why = "memory"
        if not why:
            sizes.append(states)
            times.append(taken)
        n *= 2
    exponent = np.polyfit(np.log(sizes[-6:]), np.log(times[-6:]), 1)[0]
    cells = kind.name, kind.route, f"{exponent:.1f}", f"{sizes[-1]:,}", f"{times[-1]:.2g}", why
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    print("| kind of graph | route | exponent | states in 10 s and 2 GB | seconds | what ends it |")
    print("|---|---|---|---|---|---|")
    for name in sys.argv[1:] or KINDS:
        print(row(KINDS[name]), flush=True)


if __name__ == "__main__":
    main()
