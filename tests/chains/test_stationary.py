"""Stationary laws of closed classes, over any number of decades, against exact arithmetic."""

import random
from decimal import Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array

import oracle
from evenbreak.chains import (
    Chain,
    chain_of,
    first_passage,
    kemeny_constant,
    mean_first_passages,
    stationary,
    stationary_laws,
    stochastic_limit,
)
from evenbreak.chains.stationary import laws_of
from evenbreak.errors import AccuracyError, ChainError
from evenbreak.games import OneBall, Race, Rack
from tries import tries


def test_laws_of_all_closed_classes_stand_side_by_side():
    matrix = np.array([[0.5, 0.25, 0], [0.5, 0.75, 0], [0, 0, 1.0]])
    chain = Chain(range(3), csc_array(matrix))
    assert stationary_laws(chain) == pytest.approx([1 / 3, 2 / 3, 1.0])


def two_step_walk(n, up, down, shuffle):
    """Return a walk by one and two steps, not a line, its states shuffled; one closed class."""
    matrix = np.zeros((n, n))
    i = np.arange(n)
    for step, share in ((1, 0.6), (2, 0.4)):
        matrix[i[step:], i[:-step]] = share * up[:-step]
        matrix[i[:-step], i[step:]] = share * down[step:]
    place = np.random.default_rng(shuffle).permutation(n)
    matrix = oracle.with_loops(csc_array(matrix[place][:, place]))
    return Chain(range(n), matrix, 0), np.argsort(place)


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("shuffle", range(4))
@pytest.mark.parametrize("shape", ["slope", "hill", "valley", "cliffs"])
def test_laws_over_more_decades_than_floats(monkeypatch, shape, shuffle, plain):
    if not plain:
        monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
    n = 22
    up, down = np.full(n, 0.4), np.full(n, 1e-40)
    if shape == "slope":
        up, down = down, up
    elif shape == "hill":
        up[n // 2 :], down[n // 2 :] = 1e-40, 0.4
    elif shape == "valley":
        up[: n // 2], down[: n // 2] = 1e-40, 0.4
    else:
        up[::3], down[1::3] = 1e-120, 1e-60
    chain, _ = two_step_walk(n, up, down, shuffle)
    exact = oracle.limit(oracle.columns_of(chain), {0: Fraction(1)})
    assert min(x for x in exact if x) < Fraction(1, 10**100)
    assert oracle.worst_relative_error(stochastic_limit(chain).probability, exact) < 1e-14


def test_a_long_law_over_a_thousand_decades():
    n = 700
    chain, order = two_step_walk(n, np.full(n, 0.004), np.full(n, 0.5), 1)
    law = stochastic_limit(chain).probability[order]
    assert law.sum() == pytest.approx(1.0, rel=1e-14)
    matrix = csc_array(chain.matrix[:, order])[order].toarray()
    flow = np.minimum(law, 1)[None, :] * matrix
    # In a line of cuts, as much goes up as comes down; each entry above 1e-290 shows in one.
    for cut in range(1, 100):
        assert flow[cut:, :cut].sum() == pytest.approx(flow[:cut, cut:].sum(), rel=1e-12)
    assert law[-1] == 0.0


def test_a_law_too_wide_and_too_large_is_refused(monkeypatch):
    monkeypatch.setattr("evenbreak.chains.elimination.MOST_ARCS", 100)
    n = 60
    chain, _ = two_step_walk(n, np.full(n, 1e-30), np.full(n, 0.5), 2)
    with pytest.raises(AccuracyError, match="span more orders of magnitude than floats"):
        stochastic_limit(chain)


def test_a_shuffled_line_is_known_for_a_line():
    n = 3_000
    place = np.random.default_rng(3).permutation(n)
    up, down = np.full(n - 1, 0.002), np.full(n - 1, 0.5)
    i = np.arange(n - 1)
    rows, columns = np.concatenate((i + 1, i)), np.concatenate((i, i + 1))
    matrix = csc_array((np.concatenate((up, down)), (place[rows], place[columns])), (n, n))
    law = stochastic_limit(Chain(range(n), oracle.with_loops(matrix)), 0).probability[place]
    for k in (0, 1, 60, 120):
        exact = Fraction(0.002) ** k / Fraction(0.5) ** k * (1 - Fraction(0.002) / Fraction(0.5))
        assert law[k] == pytest.approx(float(exact), rel=1e-13)


def test_two_blocks_that_hardly_meet():
    """The odds between the blocks are those of the two arcs that join them."""
    rng = np.random.default_rng(9)
    size, there, back = 80, 1e-10, 3e-10
    matrix = np.zeros((2 * size, 2 * size))
    matrix[:size, :size], matrix[size:, size:] = rng.random((2, size, size))
    np.fill_diagonal(matrix, 0.0)
    matrix /= matrix.sum(axis=0)
    matrix[size, 0], matrix[5, 2 * size - 1] = there, back
    limit = stochastic_limit(Chain(range(2 * size), csc_array(matrix), 0)).probability
    assert limit[0] * there == pytest.approx(limit[-1] * back, rel=1e-13)
    inflow = matrix @ limit
    outflow = matrix.sum(axis=0) * limit
    assert inflow == pytest.approx(outflow, rel=1e-12)


def test_only_the_classes_that_are_asked_for():
    chain = Chain(range(2), csc_array(np.eye(2)))
    law, bound = laws_of(chain, np.array([False, True]))
    assert law.sum() == 1.0
    assert law[chain.structure.label == 1].tolist() == [1.0]
    assert bound is None


@pytest.mark.parametrize("depth", [30.0, 300.0])
def test_a_cyclic_grid_of_hills_has_its_law_to_the_last_digits(depth):
    """Up with 2^-climb, down with 1/8 at each side: the law is 2^-height, down to 1e-180."""
    side = 40
    turn = 2.0 * np.pi * np.arange(side) / side
    height = np.round(depth * (np.sin(turn)[:, None] * np.cos(2.0 * turn) + 1.0)).ravel()
    place = np.arange(side * side).reshape(side, side)
    near = [np.roll(place, step, axis).ravel() for step in (1, -1) for axis in (0, 1)]
    sources, targets = np.tile(place.ravel(), 4), np.concatenate(near)
    chances = 2.0 ** np.minimum(height[sources] - height[targets], 0.0) / 8.0
    chain = Chain(range(side**2), oracle.with_loops(csc_array((chances, (targets, sources)))), 0)
    limit = stochastic_limit(chain)
    exact = 2.0**-height
    assert (limit.bound or 0.0) < 1e-15
    assert limit.probability == pytest.approx(exact / exact.sum(), rel=1e-13, abs=0.0)


# Mean passage times between all states, against fractions and against one target at a time.


TRIES = tries("mean passages", 60)
LARGEST_FLOAT = Fraction(np.finfo(float).max)

OZ = Chain(
    ["rain", "nice", "snow"], np.array([[0.5, 0.5, 0.25], [0.25, 0, 0.25], [0.25, 0.5, 0.5]])
)


def test_the_land_of_oz() -> None:
    """Kemeny and Snell 1960, section 4.4; there the diagonal has the times of return."""
    exact = [[0, 8 / 3, 10 / 3], [4, 0, 4], [10 / 3, 8 / 3, 0]]
    assert np.asarray(mean_first_passages(OZ)) == pytest.approx(np.array(exact), rel=1e-15)
    assert kemeny_constant(OZ) == pytest.approx(32 / 15, rel=1e-15)


def drawn_arcs(draw: random.Random, most: int) -> list[tuple[int, int, float]]:
    """Return the arcs of a chain: any graph, short steps, a ring, a line or rare changes."""
    n, stiffness = draw.randint(1, most), draw.choice([0.5, 3, 12, 60, 200])
    kind = draw.choice(["any", "any", "near", "ring", "line", "blocks"])
    arcs = []
    for j in range(n):
        near = range(max(0, j - 2), min(n, j + 3))
        targets = {
            "any": {*draw.choices(range(n), k=draw.randint(1, 3))},
            "near": {*draw.choices(near, k=draw.randint(1, 3))},
            "ring": {(j + 1) % n, (j + draw.choice([1, -2])) % n},
            "line": {max(0, j - 1), min(n - 1, j + 1)} if draw.random() < 0.9 else {j},
            "blocks": {*(k for k in range(n) if k // 3 == j // 3), draw.randrange(n)},
        }[kind]
        rare = 10.0 ** -draw.choice([0, 100, 200]) if kind == "blocks" else 1.0
        weights = {
            i: 10.0 ** -draw.uniform(0, stiffness) * (1.0 if i // 3 == j // 3 else rare)
            for i in sorted(targets)
        }
        total = sum(weights.values())
        arcs += [(j, i, weight / total) for i, weight in weights.items()]
    return arcs


def exact_means(columns: oracle.Columns, target: int) -> list[Fraction | None]:
    """Return the mean from each state, None where the target may never be reached."""
    cut = [arcs if j != target else {} for j, arcs in enumerate(columns)]
    reached = [oracle.reach(cut, j) for j in range(len(cut))]
    hopeless = {j for j, states in enumerate(reached) if target not in states}
    certain = [j for j, states in enumerate(reached) if j != target and not states & hopeless]
    rows = [
        [sum(cut[j].values()) if i == j else -cut[j].get(i, Fraction(0)) for i in certain]
        for j in certain
    ]
    means = oracle.solve(rows, [Fraction(1)] * len(rows)) if rows else []
    found = {target: Fraction(0), **dict(zip(certain, means, strict=True))}
    return [found.get(j) for j in range(len(columns))]


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("few", [1, 2, 3, 16])
def test_random_chains_against_fractions(few: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Rare steps, blocks that hardly mix, periods, several ends; halved down to `few` states."""
    monkeypatch.setattr(stationary, "_FEW", few)
    worst, overflows = 0.0, 0
    for seed in range(TRIES):
        chain = chain_of(drawn_arcs(random.Random(seed), most=9))
        columns = oracle.columns_of(chain)
        exact = [exact_means(columns, target) for target in range(len(chain))]
        if max(mean for means in exact for mean in means if mean is not None) > LARGEST_FLOAT:
            overflows += 1
            with pytest.raises(AccuracyError, match="too large for a float"):
                mean_first_passages(chain)
            continue
        found = np.asarray(mean_first_passages(chain))
        for target, means in enumerate(exact):
            finite = [j for j, mean in enumerate(means) if mean is not None]
            assert np.flatnonzero(np.isfinite(found[target])).tolist() == finite, seed
            sure = [mean for mean in means if mean is not None]
            worst = max(worst, oracle.worst_relative_error(found[target, finite], sure))
        if chain.structure.closed.sum() == 1:
            law = stationary_laws(chain)
            inside = np.flatnonzero(law)
            from_each = law[inside] @ found[np.ix_(inside, inside)]
            assert kemeny_constant(chain) == pytest.approx(from_each, rel=1e-14), seed
    assert worst <= 2e-15
    assert overflows < TRIES / 10


def test_one_target_at_a_time_gives_the_same() -> None:
    for seed in range(TRIES // 4):
        draw = random.Random(seed)
        chain = chain_of(drawn_arcs(draw, most=90))
        try:
            means = np.asarray(mean_first_passages(chain))
        except AccuracyError:
            continue
        for target in draw.sample(range(len(chain)), min(3, len(chain))):
            for start in draw.sample(range(len(chain)), min(3, len(chain))):
                one = first_passage(chain, chain.states[start], chain.states[target]).mean
                expected = np.inf if one is None else one
                assert means[target, start] == pytest.approx(expected, rel=3e-15), seed


def test_no_target_needs_a_solve_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stationary, "TransientPart", lambda *_: pytest.fail("a solve"))
    rare = [(0, 1, 1e-200), (0, 0, 1.0), *((k, (k + 1) % 60, 1.0) for k in range(1, 60))]
    assert mean_first_passages(chain_of(rare)).loc[59, 0] == pytest.approx(1e200, rel=1e-14)


def test_from_states_that_all_roads_pass() -> None:
    """From 'a' to the door, and on to the end that the door chooses."""
    arcs = [("a", "b", 0.5), ("a", "door", 0.5), ("b", "a", 1.0), ("door", "won", 0.5)]
    chain = chain_of([*arcs, ("door", "a", 0.25), ("door", "lost", 0.25)])
    means, never = mean_first_passages(chain), np.inf
    assert means.loc["door"].tolist() == [3.0, 4.0, 0.0, never, never]
    assert means.loc["a"].tolist() == [0.0, 1.0, never, never, never]
    assert means.loc["won"].tolist() == [never, never, never, 0.0, never]


@pytest.mark.parametrize("n", [100, 700])
def test_a_long_line_of_states_alike(n: int) -> None:
    """Up from k takes u_k = (1 + q u_k-1) / p steps, in numbers of the platform's own digits."""
    p, q = 0.4625, 0.4875
    arcs = diags_array([np.full(n - 1, p), np.full(n - 1, q)], offsets=[-1, 1])
    means = mean_first_passages(chain_of(oracle.with_loops(arcs.tocsc()), rows="to"))
    with localcontext(prec=60):
        up = Decimal(1) / Decimal(p)
        total = up
        for _ in range(n - 2):
            up = (1 + Decimal(q) * up) / Decimal(p)
            total += up
    assert means.loc[n - 1, 0] == pytest.approx(float(total), rel=5e-15)


def test_kemeny_constant_by_eigenvalues() -> None:
    """The sum of 1 / (1 - eigenvalue) over the eigenvalues other than 1."""
    draw = np.random.default_rng(4).random((30, 30))
    chain = chain_of(draw / draw.sum(axis=0), rows="to")
    values = np.sort_complex(np.linalg.eigvals(chain.matrix.toarray()))[:-1]
    assert kemeny_constant(chain) == pytest.approx(np.sum(1 / (1 - values)).real, rel=1e-12)


def test_means_near_the_largest_float() -> None:
    rare = [("a", "a", 1.0), ("a", "b", 1e-300), ("b", "a", 1.0 - 2e-8), ("b", "door", 2e-8)]
    ends = [("door", "won", 0.5), ("door", "a", 0.25), ("door", "lost", 0.25)]
    means = mean_first_passages(chain_of([*rare, *ends]))
    assert means.loc["b", "a"] == pytest.approx(1e300, rel=1e-15)
    assert means.loc["door", "a"] == pytest.approx(5e307, rel=1e-7)
    assert means.loc["a"].tolist() == [0.0, *[np.inf] * 4]
    with pytest.raises(AccuracyError, match="too large for a float"):
        mean_first_passages(chain_of([*rare[:2], ("b", "a", 1.0), ("b", "door", 1e-10), *ends]))


def test_rare_steps_lose_no_digits() -> None:
    chain = chain_of([("a", "a", 1.0), ("a", "b", 1e-200), ("b", "b", 1.0), ("b", "a", 3e-200)])
    assert mean_first_passages(chain).loc["b", "a"] == pytest.approx(1e200, rel=1e-15)
    assert kemeny_constant(chain) == pytest.approx(0.25e200, rel=1e-15)


def test_states_that_may_never_be_reached() -> None:
    means = mean_first_passages(chain_of(Race(2, 2, Rack(0.5))))
    never = np.full(means.shape, np.inf)
    np.fill_diagonal(never, 0.0)
    assert (means == never).all(axis=None)


def test_means_have_the_labels_of_the_matrix() -> None:
    assert mean_first_passages(OZ).index.equals(OZ.to_frame().index)
    assert mean_first_passages(OZ).columns.equals(OZ.to_frame().columns)
    scores = chain_of([((0, 1), (1, 0), 1.0), ((1, 0), (0, 1), 1.0)])
    assert mean_first_passages(scores)[(0, 1)].loc[[(1, 0)]].tolist() == [1.0]


def test_refusals() -> None:
    with pytest.raises(ChainError, match="2 closed classes"):
        kemeny_constant(chain_of(OneBall(0.5, 0.5)))
    large = chain_of([(k, (k + 1) % 4001, 1.0) for k in range(4001)])
    with pytest.raises(ChainError, match="4000 states"):
        mean_first_passages(large)
    with pytest.raises(ChainError, match="4000 states"):
        kemeny_constant(large)
