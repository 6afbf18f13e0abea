"""Proved solves: every entry within its bound of the fraction, or no answer at all."""

from fractions import Fraction
from itertools import count

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import certified
from evenbreak.chains.certified import CertifiedSolve, NotCertifiedError, spread
from evenbreak.chains.elimination import Elimination
from tries import tries

KINDS = ("expander", "drift", "two parts", "round", "rare arcs")
BOTH = pytest.mark.parametrize("factored", [False, True])


def graph(kind, seed):
    """Return the arcs of a strongly connected graph, shape (n, n), and what leaves state 0."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(6, 40))
    T = np.zeros((n, n))
    T[(np.arange(n) + 1) % n, np.arange(n)] = rng.random(n)
    if kind != "round":
        for j in range(n):
            T[rng.integers(0, n, 3), j] = rng.random(3)
    if kind == "drift":
        T[np.arange(n - 1), np.arange(1, n)] = rng.random(n - 1)
        T *= np.where(np.arange(n)[:, None] > np.arange(n), 10.0 ** -(150.0 / n), 1.0)
        T[np.abs(np.subtract.outer(np.arange(n), np.arange(n))) > 1] = 0.0
    if kind == "two parts":
        apart = np.add.outer(np.arange(n) < n // 2, np.arange(n) < n // 2) == 1
        T[apart] *= 1e-7
    if kind == "rare arcs":
        T *= np.where(rng.random((n, n)) < 0.2, 10.0 ** -rng.uniform(0, 60, (n, n)), 1.0)
    np.fill_diagonal(T, 0.0)
    leak = np.zeros(n)
    leak[0] = 0.1
    return T * (0.9 / T.sum(axis=0).max()), leak


def exact(T, leak, b, *, transposed):
    arcs = [{i: Fraction(x) for i, x in enumerate(column.tolist()) if x} for column in T.T]
    factor = Elimination(arcs, [Fraction(x) for x in leak.tolist()])
    right = [Fraction(x) for x in b.tolist()]
    return factor.values(right) if transposed else factor.visits(right)


def error(found, right):
    """Return the largest relative error of the entries that are normal floats."""
    pairs = [(x, y) for x, y in zip(found.tolist(), right, strict=True) if y > 2.0**-1020]
    return max(float(abs(Fraction(x) / y - 1)) for x, y in pairs)


@pytest.mark.slow
@BOTH
def test_every_entry_is_within_its_bound(factored):
    refused, least = 0, 1.0
    for seed in range(tries("proved solves", 15)):
        kind = KINDS[seed % len(KINDS)]
        T, leak = graph(kind, seed)
        b = np.eye(len(T))[0] if seed % 2 else np.random.default_rng(seed).random(len(T))
        for transposed in (False, True):
            try:
                solve = CertifiedSolve(csc_array(T), leak, factored=factored)
                x = solve.values(b[:, None]) if transposed else solve.visits(b[:, None])
            except NotCertifiedError:
                refused += 1
                continue
            right = exact(T, leak, b, transposed=transposed)
            least = min(least, float(min(right)))
            assert error(x[:, 0], right) <= solve.error < 1e-15, (kind, seed)
    assert least < 1e-100
    assert refused <= 1 + seed // 10


@BOTH
def test_a_wrong_answer_is_never_within_its_bound(monkeypatch, factored):
    """Whatever the approximation does, what is returned is right or nothing is."""
    T, leak = graph("expander", 3)
    b = np.eye(len(T), 1)
    right = exact(T, leak, b[:, 0], transposed=False)
    rng = np.random.default_rng(0)
    approximate = certified._Scaled.solved
    for spoil in (
        lambda y: y * 0.0,
        lambda y: y * rng.uniform(0.0, 2.0, len(y)),
        lambda y: y + np.abs(y).max() * rng.standard_normal(len(y)),
        lambda y: y * np.nan,
        lambda y: -y,
    ):
        with monkeypatch.context() as patch:
            patch.setattr(
                certified._Scaled, "solved", lambda *given, f=spoil: f(approximate(*given))
            )
            solve = CertifiedSolve(csc_array(T), leak, factored=factored)
            try:
                x = solve.visits(b)
            except NotCertifiedError:
                continue
            assert error(x[:, 0], right) <= solve.error


@pytest.mark.slow_after(13)
@BOTH
@pytest.mark.parametrize("good", range(1, 9))
def test_a_correction_that_makes_an_answer_worse_is_not_returned(monkeypatch, factored, good):
    """What is returned is what has been proved, not what came after it."""
    T, leak = graph("expander", 3)
    b = np.eye(len(T), 1)
    calls, approximate = count(), certified._Scaled.solved
    monkeypatch.setattr(certified, "_SHARP", 0.0)
    monkeypatch.setattr(
        certified._Scaled,
        "solved",
        lambda *given: approximate(*given) + (1e-3 if next(calls) >= good else 0.0),
    )
    solve = CertifiedSolve(csc_array(T), leak, factored=factored)
    try:
        x = solve.visits(b)
    except NotCertifiedError:
        assert good < 5
    else:
        assert error(x[:, 0], exact(T, leak, b[:, 0], transposed=False)) <= solve.error


@BOTH
@pytest.mark.parametrize("chance", [1e-19, 1e-200])
def test_nothing_is_claimed_where_a_class_is_hardly_left(factored, chance):
    T, leak = graph("expander", 5)
    with pytest.raises(NotCertifiedError):
        CertifiedSolve(csc_array(T), leak * chance, factored=factored).values(np.ones((len(T), 1)))


def test_several_columns_and_none():
    T, leak = graph("expander", 7)
    solve = CertifiedSolve(csc_array(T), leak, factored=True)
    b = np.eye(len(T))[:, :3]
    b[:, 1] = 0.0
    x = solve.visits(b)
    assert not x[:, 1].any()
    for k in (0, 2):
        assert error(x[:, k], exact(T, leak, b[:, k], transposed=False)) <= solve.error


def test_time_is_spent_downhill():
    T, _ = graph("drift", 1)
    assert spread(csc_array(T), T.sum(axis=0)).argmax() == 0


def test_ten_thousand_states_that_nothing_cuts_apart():
    """Each state is left to 3 at random; elimination would make 3 * 10^7 arcs."""
    rng = np.random.default_rng(9)
    n = 10_000
    sources, targets = np.repeat(np.arange(n), 3), rng.integers(0, n, 3 * n)
    targets[::3] = (np.arange(n) + 1) % n
    T = csc_array((np.full(3 * n, 0.3), (targets, sources)), shape=(n, n))
    T.setdiag(0.0)
    T.eliminate_zeros()
    leak = np.full(n, 1e-6)
    solve = CertifiedSolve(T, leak, factored=False)
    x = solve.visits(np.ones((n, 1)))
    assert solve.error < 1e-15
    # All that comes in goes out.
    assert (x[:, 0] * leak).sum() == pytest.approx(n, rel=1e-14)


def test_parts_joined_by_rare_arcs_alone_are_refused_at_once(monkeypatch):
    """No time is lost on what cannot be proved."""
    T = np.kron(np.eye(2), np.ones((3, 3)) / 4.0)
    T[5, 0], T[0, 5] = 1e-18, 1e-18
    np.fill_diagonal(T, 0.0)
    monkeypatch.setattr(certified.Equations, "solve", None)
    with pytest.raises(NotCertifiedError):
        CertifiedSolve(csc_array(T), np.eye(6)[0] / 4.0, factored=True)
