"""How long the same seasons take one process, and dask workers of this machine.

python benchmarks/cluster_speed.py REPLICAS

The machine must have nothing else to do: workers that share their cores with other programs say
nothing about the division of the work.
"""

from __future__ import annotations

import pickle
import sys
import time
from dataclasses import fields
from typing import Any

import numpy as np
from distributed import Client, LocalCluster

from evenbreak.league import LeaguePlayers, RandomPairing, Season, simulate
from evenbreak.league.season import Tally
from evenbreak.league.simulate import _Work, batching_of

WORKERS = (1, 2)


def main(replicas: int) -> None:
    ratings = 40 + np.arange(1000) * 37 % 80
    players = LeaguePlayers.of(ratings, skill_sd=5, day_sd=3)
    season = Season(players, "npl", schedule=RandomPairing(), weeks=30)
    alone, seconds = timed(season, replicas)
    print(f"this process: {seconds:.1f} s")
    took = {}
    for workers in WORKERS:
        with (
            LocalCluster(
                n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None
            ) as cluster,
            Client(cluster) as client,
        ):
            tally, took[workers] = timed(season, replicas, executor=client)
        same = "the same bytes" if bytes_of(tally) == bytes_of(alone) else "DIFFERENT BYTES"
        print(f"dask, {workers} workers: {took[workers]:.1f} s, {same}")
    print(f"1 worker / 2 workers: {took[1] / took[2]:.2f}")
    work = _Work(season, replicas, batching_of(season, replicas), 1)
    parcels = work.parcels()
    print(
        f"sent once to each worker: {len(pickle.dumps(work)) / 1e3:.0f} kB; "
        f"with each of the {len(parcels)} parcels: {len(pickle.dumps(parcels[0]))} bytes; "
        f"back from each: {len(pickle.dumps(alone)) / 1e3:.0f} kB at most"
    )


def timed(season: Season, replicas: int, **workers: Any) -> tuple[Tally, float]:
    start = time.perf_counter()
    tally = simulate(season, replicas=replicas, seed=1, **workers)
    return tally, time.perf_counter() - start


def bytes_of(tally: Tally) -> list[bytes]:
    return [np.asarray(getattr(tally, field.name)).tobytes() for field in fields(tally)]


if __name__ == "__main__":
    main(int(sys.argv[1]))
