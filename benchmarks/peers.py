"""Stationary laws by other packages, beside the exact ones: who loses digits.

python -m pip install -e . quantecon pydtmc deeptime
PYTHONPATH=tests:benchmarks python benchmarks/peers.py

An entry is the largest relative error over all states, then the time of one call. Each
package gets the matrix in the form it likes best.
"""

from __future__ import annotations

import random
import time
import warnings
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from bench_chains import bare_stationary, grid_chain, ladder_law, walk

import oracle
from evenbreak.chains import Chain, chain_of, stochastic_limit


def random_class(size: int, decades: float, seed: int = 1) -> Chain:
    """Return a random closed class whose arcs span the given decades."""
    draw = random.Random(seed)
    triples = []
    for state in range(size):
        targets = sorted({(state + 1) % size, *draw.sample(range(size), 3)} - {state})
        weights = [10.0 ** -draw.uniform(0.0, decades) for _ in targets]
        triples += [(state, t, w / sum(weights)) for t, w in zip(targets, weights, strict=True)]
    return chain_of(triples)


def coupled(coupling: float) -> Chain:
    """Return two random blocks of twelve states with an arc of `coupling` each way."""
    arcs = []
    for block in (0, 12):
        part = random_class(12, 1.0, seed=block)
        for j, row in enumerate(oracle.columns_of(part)):
            out = coupling * (1 + block) if j == 0 else 0.0
            arcs += [(block + j, block + i, float(p) * (1.0 - out)) for i, p in row.items()]
        arcs.append((block, 12 - block, coupling * (1 + block)))
    return chain_of(arcs)


def exact_law(chain: Chain) -> list[Fraction]:
    return oracle.limit(oracle.columns_of(chain), {0: Fraction(1)})


def questions() -> Iterator[tuple[str, Chain, list[Fraction]]]:
    for decades in (1.0, 14.0):
        chain = random_class(30, decades)
        yield f"30 random states, arcs over {decades:.0f} decades", chain, exact_law(chain)
    for coupling in (1e-10, 1e-15):
        chain = coupled(coupling)
        yield f"two blocks coupled by {coupling:.0e}", chain, exact_law(chain)
    for n, p in ((60, 1e-3), (60, 1e-9), (501, 0.45)):
        up, down = np.full(n, p), np.full(n, 1.0 - p)
        up[-1] = down[0] = 0.0
        law = [Fraction(x) for x in ladder_law(up, down).tolist()]
        yield f"ladder of {n:,} states, up {p:g}", walk(up, down), law
    chain, heights = grid_chain(25)
    weights = [2 ** int(heights.max() - h) for h in heights]
    law = [Fraction(w, sum(weights)) for w in weights]
    yield "25 x 25 grid of hills", chain, law


def packages() -> dict[str, Callable[[Chain], Any]]:
    from deeptime.markov.tools.analysis import stationary_distribution
    from pydtmc import MarkovChain as PyDTMC
    from quantecon.markov import gth_solve

    def eigenvector(chain: Chain) -> Any:
        values, vectors = np.linalg.eig(chain.matrix.toarray())
        vector = vectors[:, np.argmin(abs(values - 1.0))].real
        return vector / vector.sum()

    return {
        "evenbreak": lambda chain: (
            stochastic_limit(Chain(chain.states, chain.matrix), chain.states[0]).probability
        ),
        "quantecon gth_solve": lambda chain: gth_solve(chain.matrix.toarray().T),
        "PyDTMC": lambda chain: PyDTMC(chain.matrix.toarray().T).steady_states[0],
        "deeptime": lambda chain: stationary_distribution(chain.matrix.toarray().T),
        "scipy splu": lambda chain: bare_stationary(chain.matrix),
        "numpy eig": eigenvector,
    }


def cell(solve: Callable[[Chain], Any], chain: Chain, law: list[Fraction]) -> str:
    begin = time.perf_counter()
    try:
        found = np.asarray(solve(chain), dtype=float)
    except Exception as error:
        return type(error).__name__
    taken = time.perf_counter() - begin
    if len(found) != len(law):
        return "no answer"
    error = oracle.worst_relative_error(found.tolist(), law)
    if not np.isfinite(found).all():
        return "not finite"
    negative = ", negative" if (found < 0).any() else ""
    return f"{error:.0e}{negative} ({1e3 * taken:.3g} ms)"


def main() -> None:
    warnings.simplefilter("ignore")
    solvers = packages()
    print("| chain |", " | ".join(solvers), "|")
    print("|---" * (len(solvers) + 1) + "|")
    for name, chain, law in questions():
        for solve in solvers.values():  # what a package loads or compiles at first is not timed
            if len(chain) < 100:
                cell(solve, chain, law)
        print(
            f"| {name} |",
            " | ".join(cell(s, chain, law) for s in solvers.values()),
            "|",
            flush=True,
        )


if __name__ == "__main__":
    main()
