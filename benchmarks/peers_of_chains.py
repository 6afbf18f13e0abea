"""Chains of every size, beside the packages that answer the same question about them.

python -m pip install -e . pytest "quantecon==0.11.*" "stormpy==2.0.*" "PyDTMC==8.7.*"
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONPATH=benchmarks python benchmarks/peers_of_chains.py

A cell is the median processor time of a call in milliseconds, then the largest relative error
of the numbers it returns. All packages are called in turns. A package that is not installed has
an empty column, and the last lines say which are missing. To ask some of the questions only, add
their names to the command: dense, line, race, classes, fractions.
"""

from __future__ import annotations

import statistics
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np
from bench_chains import bare_stationary, blocks_chain, fresh, grid_chain, random_chain, walk
from scipy.linalg import solve_banded

from evenbreak.chains import Chain, chain_of, limit_matrix, steps_to_absorption, stochastic_limit
from evenbreak.games import Race, Rack, winner_breaks
from evenbreak.matches import match_length, win_probability

OURS, BARE, QUANTECON, STORM, PYDTMC = "evenbreak", "bare scipy", "QuantEcon", "Storm", "PyDTMC"
PACKAGES = {QUANTECON: "quantecon", STORM: "stormpy", PYDTMC: "pydtmc"}


@dataclass
class Question:
    """A row: what is asked, who answers it (name: call), and the right numbers if known."""

    name: str
    answers: dict[str, Callable[[], Any]]
    exact: Any = None
    rounds: int = 21
    slow: tuple[str, ...] = field(default=())  # these are called once


def installed() -> set[str]:
    found = set()
    for name, module in PACKAGES.items():
        try:
            import_module(module)
        except ImportError:
            continue
        found.add(name)
    return found


# Storm ---------------------------------------------------------------------------------


def storm_model(chain: Chain, labels: dict[str, Any], value: type = float) -> Any:
    """Return the chain as a model of Storm; a state labelled 'end' ends the count of steps."""
    from stormpy import Rational, datastructures, models

    number = (lambda p: Rational(str(Fraction(repr(p))))) if value is not float else float
    rows, n = chain.matrix.tocsr().T.tocsr().tocoo(), len(chain)
    builder = datastructures.SparseMatrixBuilder[value](n, n, rows.nnz)
    chances = [number(p) for p in rows.data.tolist()]
    builder.add_next_values(rows.row.tolist(), rows.col.tolist(), chances)
    labeling = models.StateLabeling(n)
    for label, states in {"init": [0], **labels}.items():
        labeling.add_label(label)
        for state in states:
            labeling.add_label_to_state(label, int(state))
    reward = models.SparseRewardModel[value](optional_state_reward_vector=[number(1.0)] * n)
    parts = models.SparseModelComponents[value](
        transition_matrix=builder.build(), state_labeling=labeling, reward_models={"steps": reward}
    )
    return models.SparseDtmc[value](parts)


def storm_environment(*, exact: bool = False) -> Any:
    import stormpy
    from stormpy import environments

    if exact:
        return environments.exact()
    environment = stormpy.Environment()
    kind = environments.EquationSolverType.EIGEN
    environment.solver().set_linear_equation_solver_type(kind)
    return environment


def storm_values(model: Any, asked: str, *, exact: bool = False) -> Callable[[], Any]:
    """Return a call of Storm for the value of a property from every state."""
    import stormpy

    environment, formula = storm_environment(exact=exact), stormpy.parse_properties(asked)[0]
    return lambda: stormpy.model_checking(model, formula, environment=environment)


def storm_law(model: Any, *, exact: bool = False) -> Callable[[], Any]:
    """Return a call of Storm for the long-run law."""
    import stormpy

    environment = storm_environment(exact=exact)
    return lambda: stormpy.analysis.compute_steady_state_distribution(
        model, environment=environment
    )


# Questions -----------------------------------------------------------------------------


def wide_law(P: np.ndarray) -> np.ndarray:
    """Return the law by elimination in long doubles."""
    A = P.astype(np.longdouble)
    n = len(A)
    for k in range(n - 1, 0, -1):
        A[:k, k] /= A[k, :k].sum()
        A[:k, :k] += np.outer(A[:k, k], A[k, :k])
    law = np.ones(n, dtype=np.longdouble)
    for k in range(1, n):
        law[k] = law[:k] @ A[:k, k]
    return law / law.sum()


def dense(here: set[str]) -> Iterator[Question]:
    for n in (5, 30, 100):
        P = np.random.default_rng(1).random((n, n))
        P /= P.sum(axis=1, keepdims=True)
        chain = chain_of(P, rows="from")
        stochastic_limit(chain, 0)  # a built chain knows its classes
        built: dict[str, Callable[[], Any]] = {OURS: lambda c=chain: stochastic_limit(c, 0)}
        array: dict[str, Callable[[], Any]] = {
            OURS: lambda P=P: stochastic_limit(chain_of(P, rows="from"), 0)
        }
        if QUANTECON in here:
            from quantecon import MarkovChain as Discrete
            from quantecon.markov import gth_solve

            built[QUANTECON] = lambda P=P: gth_solve(P)
            array[QUANTECON] = lambda P=P: Discrete(P).stationary_distributions[0]
        if STORM in here:
            built[STORM] = storm_law(storm_model(chain, {}))
            array[STORM] = lambda P=P: storm_law(storm_model(chain_of(P, rows="from"), {}))()
        if PYDTMC in here:
            from pydtmc import MarkovChain

            array[PYDTMC] = lambda P=P: MarkovChain(P).steady_states[0]
        exact = wide_law(P)
        yield Question(f"law of {n} dense states, built", built, exact, 101)
        yield Question(f"law of {n} dense states, from the array", array, exact, 41)


def line(here: set[str]) -> Iterator[Question]:
    n, p = 10_001, 0.5001
    up, down = np.full(n, p), np.full(n, 1.0 - p)
    up[[0, -1]] = down[[0, -1]] = 0.0
    chain = walk(up, down)
    band = np.zeros((3, n - 2))
    band[0, 1:], band[1], band[2, :-1] = -p, 1.0, -(1.0 - p)
    arrive = np.zeros((n - 2, 2))
    arrive[0, 0], arrive[-1, 1] = 1.0 - p, p
    answers: dict[str, Callable[[], Any]] = {
        OURS: lambda: limit_matrix(fresh(chain)),
        BARE: lambda: solve_banded((1, 1), band, arrive)[:, 1],
    }
    if STORM in here:
        model = storm_model(chain, {"top": [n - 1]})
        answers[STORM] = storm_values(model, 'P=? [F "top"]')
    r = (np.longdouble(1) - np.longdouble(p)) / np.longdouble(p)
    stake = np.arange(n)
    exact = -np.expm1(stake * np.log(r)) / -np.expm1((n - 1) * np.log(r))
    yield Question("line of 10,001 states, ends from all states", answers, exact, 41)


def race(here: set[str]) -> Iterator[Question]:
    match = Race(50, 50, Rack(0.6, 0.55), breaks=winner_breaks)
    chain = chain_of(match)
    won = np.array([match.winner(state) == 1 for state in chain.states])
    over = [k for k, state in enumerate(chain.states) if match.winner(state)]

    def chance_from_all() -> np.ndarray:
        built = chain_of(match)
        part = built.transient
        return part.values((built.arcs.matrix().T @ won)[part.states])

    chance: dict[str, Callable[[], Any]] = {OURS: chance_from_all}
    mean: dict[str, Callable[[], Any]] = {OURS: lambda: steps_to_absorption(chain_of(match)).mean}
    if STORM in here:
        model = storm_model(chain, {"won": np.flatnonzero(won), "over": over})
        chance[STORM] = storm_values(model, 'P=? [F "won"]')
        mean[STORM] = storm_values(model, 'R{"steps"}=? [F "over"]')
    in_fractions = Race(50, 50, Rack(Fraction(0.6), Fraction(0.55)), breaks=winner_breaks)
    exact = float(win_probability(in_fractions, exact=True))
    length = match_length(match)
    yield Question("race 50:50, chance to win from all states", chance, exact, 41)
    yield Question("race 50:50, mean length", mean, length.mean, 41)
    yield Question(
        "race 50:50, distribution of the length",
        {OURS: lambda: steps_to_absorption(chain_of(match)).distribution()[0]},
        np.append(np.zeros(length.games[0]), length.probability),
        41,
    )


def classes(here: set[str]) -> Iterator[Question]:
    for name, make in (
        ("70 x 70 grid", grid_chain),
        ("50 blocks of 100", blocks_chain),
        ("5,000 random states", random_chain),
    ):
        chain, heights = make()
        exact = 2.0 ** -(heights - heights.min())
        answers: dict[str, Callable[[], Any]] = {
            OURS: lambda c=chain: stochastic_limit(fresh(c), 0),
            BARE: lambda c=chain: bare_stationary(c.matrix),
        }
        if QUANTECON in here:
            from quantecon.markov import gth_solve

            answers[QUANTECON] = lambda c=chain: gth_solve(c.matrix.toarray().T)
        if STORM in here:
            answers[STORM] = storm_law(storm_model(chain, {}))
        slow = (QUANTECON, *((BARE, STORM, OURS) if name.startswith("5,000") else ()))
        yield Question(f"law of {name}", answers, exact / exact.sum(), 5, slow)


def fractions(here: set[str]) -> Iterator[Question]:
    n, up, down = 201, Fraction(9, 20), Fraction(1, 2)
    rows = {
        i: {k: p for k, p in ((i - 1, down), (i + 1, up)) if 0 <= k < n} | {i: Fraction(1, 20)}
        for i in range(n)
    }
    rows[0][0], rows[n - 1][n - 1] = 1 - up, 1 - down
    ladder = chain_of(rows)
    match = Race(50, 50, Rack(0.6))
    chain = chain_of(match)
    law: dict[str, Callable[[], Any]] = {OURS: lambda: stochastic_limit(ladder, 0, exact=True)}
    chance: dict[str, Callable[[], Any]] = {OURS: lambda: win_probability(match, exact=True)}
    if STORM in here:
        from stormpy import Rational

        law[STORM] = storm_law(storm_model(ladder, {}, Rational), exact=True)
        won = [k for k, state in enumerate(chain.states) if match.winner(state) == 1]
        model = storm_model(chain, {"won": won}, Rational)
        chance[STORM] = storm_values(model, 'P=? [F "won"]', exact=True)
    yield Question("ladder of 201 states, in fractions", law, None, 5, (STORM,))
    yield Question("race 50:50, in fractions", chance, None, 5, (STORM,))


# The table -----------------------------------------------------------------------------


def numbers(found: Any, exact: np.ndarray) -> np.ndarray:
    """Return the numbers of an answer that stand beside `exact`."""
    if hasattr(found, "get_value_vector"):
        found = found.get_value_vector()
    elif hasattr(found, "tocsr") and getattr(found, "ndim", 0) == 2:
        found = found.tocsr()[[found.shape[0] - 1], :].toarray()[0]
    array = np.asarray(found, dtype=np.float64).ravel()
    if array.size == exact.size - 2:  # a banded solve leaves out the two ends
        array = np.concatenate(([0.0], array, [1.0]))
    return array[:1] if exact.size == 1 else array


def error(found: Any, exact: Any) -> str:
    if exact is None:
        return ""
    right = np.atleast_1d(exact).astype(np.longdouble)
    got = numbers(found, right)
    if len(got) != len(right):
        return " (other numbers)"
    normal = right >= np.finfo(float).tiny
    worst = float(np.max(np.abs(got[normal] / right[normal] - 1.0)))
    return f" ({worst:.0e})"


def row(asked: Question) -> dict[str, str]:
    found, times = {}, {}
    for name, answer in asked.answers.items():  # the first call pays for what is loaded or compiled
        begin = time.process_time()
        found[name] = answer()
        times[name] = [time.process_time() - begin]
    repeated = [name for name in asked.answers if name not in asked.slow]
    for name in repeated:
        times[name].clear()
    for _ in range(asked.rounds):
        for name in repeated:
            begin = time.process_time()
            result = asked.answers[name]()
            times[name].append(time.process_time() - begin)
            del result
    return {
        name: f"{1e3 * statistics.median(times[name]):.3g}{error(found[name], asked.exact)}"
        for name in asked.answers
    }


def main() -> None:
    warnings.simplefilter("ignore")
    here, chosen = installed(), sys.argv[1:]
    columns = [OURS, BARE, QUANTECON, STORM, PYDTMC]
    print("| question |", " | ".join(columns), "|")
    print("|---" * (len(columns) + 1) + "|")
    for group in (dense, line, race, classes, fractions):
        if chosen and group.__name__ not in chosen:
            continue
        for asked in group(here):
            cells = row(asked)
            shown = [cells.get(name, "") for name in columns]
            print(f"| {asked.name} |", " | ".join(shown), "|", flush=True)
    print(", ".join(f"{PACKAGES[name]} {version(PACKAGES[name])}" for name in sorted(here)))
    for name in sorted(PACKAGES.keys() - here):
        print(f"{PACKAGES[name]} is not installed")


if __name__ == "__main__":
    main()
