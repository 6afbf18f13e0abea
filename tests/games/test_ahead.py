import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.game import arcs_of
from evenbreak.games import Ahead, Rack, alternate_breaks


def chance(match: Ahead) -> float:
    limit = stochastic_limit(chain_of(match)).to_dict()
    return sum(p for state, p in limit.items() if match.winner(state) == 1)


def test_the_seven_states_of_three_ahead() -> None:
    match = Ahead(3, 3, Rack(0.6))
    states = arcs_of(match).states
    assert sorted(a - b for a, b in states) == [-3, -2, -1, 0, 1, 2, 3]
    assert match.moves((0, 0)) == {(1, 0): 0.6, (0, 1): 0.4}
    assert match.moves((2, 0)) == {(3, 0): 0.6, (1, 0): 0.4}
    assert match.moves((0, 2)) == {(0, 1): 0.6, (0, 3): 0.4}
    assert [match.winner(s) for s in ((3, 0), (0, 3), (2, 0))] == [1, 2, None]


@given(st.integers(1, 6), st.integers(1, 6), st.floats(0.01, 0.99))
def test_n_ahead_is_the_gamblers_ruin(m: int, n: int, p: float) -> None:
    # Player 1 starts n above ruin and needs m more: sum of r^i, i < n, over i < m+n, r = q/p.
    r = (1 - p) / p
    expected = sum(r**i for i in range(n)) / sum(r**i for i in range(m + n))
    assert chance(Ahead(m, n, Rack(p))) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("m", "n", "power"), [(1, 5, 1), (3, 3, 3), (5, 1, 5)])
def test_an_even_rack_shares_by_the_lead_needed(m: int, n: int, power: int) -> None:
    # P5.27 at p = 1/2: n / (m + n)
    assert chance(Ahead(m, n, Rack(0.5))) == pytest.approx((6 - power) / 6, rel=1e-14)


def test_a_lead_to_begin_with() -> None:
    assert Ahead(5, 3, Rack(0.6), score=(7, 5)).start == (2, 0)
    assert chance(Ahead(5, 3, Rack(0.6), score=(2, 0))) == pytest.approx(
        chance(Ahead(3, 5, Rack(0.6))), rel=1e-14
    )


def test_the_breaker_is_kept_with_the_lead() -> None:
    match = Ahead(2, 2, Rack(0.75, 0.5), breaks=alternate_breaks, first_breaker=2)
    assert match.moves((0, 0, 2)) == {(1, 0, 1): 0.5, (0, 1, 1): 0.5}
    assert match.moves((0, 1, 1)) == {(0, 0, 2): 0.75, (0, 2, 2): 0.25}


def test_alternate_breaks_two_ahead() -> None:
    # Over a pair of racks player 1 wins both with p1 q2, loses both with q1 p2.
    p1, p2 = 0.7, 0.4
    both, neither = p1 * (1 - p2), (1 - p1) * p2
    match = Ahead(2, 2, Rack(p1, p2), breaks=alternate_breaks)
    assert chance(match) == pytest.approx(both / (both + neither), rel=1e-14)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"m": 0}, "m must be a whole number, 1 or more; you gave 0"),
        (
            {"rack": None},
            (
                r"rack must be a Rack\(p\), a Rack\(p1, p2\), a match, or a game with start, "
                r"moves and winner; you gave None"
            ),
        ),
        ({"rack": Rack(0.5, 0.5)}, "breaks is missing"),
        ({"score": (4, 0)}, "score is 4-0, which can't be reached"),
    ],
)
def test_what_a_match_cannot_be(parameters: dict[str, object], words: str) -> None:
    given = {"m": 3, "n": 2, "rack": Rack(0.5)} | parameters
    with pytest.raises(InputError, match=words):
        Ahead(**given)  # type: ignore[arg-type]
