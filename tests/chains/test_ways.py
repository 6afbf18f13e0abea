"""Every way to the limit gives the same numbers, or says why it cannot and which way can."""

import pytest

from evenbreak.chains import chain_of, limit_matrix, spectrum, stochastic_limit
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.games import Ahead, OneBall, Race, Rack


@pytest.mark.parametrize("via", ["elimination", "eigen"])
def test_a_density_as_the_start(via) -> None:
    chain = chain_of(OneBall(0.3, 0.6))
    half = {"S1": 0.5, "S2": 0.5}
    expected = limit_matrix(chain) @ chain.density(half)
    assert stochastic_limit(chain, half, via=via).probability == pytest.approx(expected, rel=1e-14)
    with pytest.raises(ChainError, match="probability vector"):
        stochastic_limit(chain_of(Ahead(3, 3, Rack(0.5))), {(0, 0): 1.0}, via="kernel")


def test_a_race_has_too_few_eigenvectors_but_all_of_eigenvalue_1() -> None:
    chain = chain_of(Race(9, 9, Rack(0.6)))
    with pytest.raises(AccuracyError, match="defective"):
        spectrum(chain)
    found = stochastic_limit(chain, via="eigen")
    assert found.probability == pytest.approx(stochastic_limit(chain).probability, abs=1e-14)


@pytest.mark.parametrize("e", [1e-9, 1e-12, 1e-17])
def test_eigenvectors_beside_a_close_eigenvalue(e) -> None:
    """They are right, or refused where a factorization in floats does not see the difference."""
    arcs = [(b + j, b + i, (1 - e) / 3) for b in (0, 3) for j in range(3) for i in range(3)]
    chain = chain_of(arcs + [(j, (j + 3) % 6, e) for j in range(6)], start=0)
    if e > 1e-16:
        assert stochastic_limit(chain, via="eigen").probability == pytest.approx(1 / 6, rel=1e-14)
        return
    with pytest.raises(AccuracyError, match="Use elimination"):
        stochastic_limit(chain, via="eigen")


def test_an_unknown_way() -> None:
    with pytest.raises(
        InputError, match="via must be 'kernel', 'elimination' or 'eigen'; you gave 'power'"
    ):
        stochastic_limit(chain_of(OneBall(0.3, 0.6)), via="power")
