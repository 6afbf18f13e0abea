import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Rack


def test_the_break_does_not_matter() -> None:
    rack = Rack(0.6)
    assert not rack.break_matters
    assert [rack.chance(1, breaker) for breaker in (1, 2)] == [0.6, 0.6]
    assert [rack.chance(2, breaker) for breaker in (1, 2)] == [0.4, 0.4]


def test_the_break_matters() -> None:
    rack = Rack(0.75, 0.625)
    assert rack.break_matters
    assert [rack.chance(1, breaker) for breaker in (1, 2)] == [0.75, 0.375]
    assert [rack.chance(2, breaker) for breaker in (1, 2)] == [0.25, 0.625]


def test_small_chances_are_kept() -> None:
    assert Rack(1e-300).chance(1) == 1e-300
    assert Rack(0.5, 1e-300).chance(2, breaker=2) == 1e-300


def test_arrays_are_kept_as_arrays() -> None:
    assert Rack([0.25, 0.5]).chance(2).tolist() == [0.75, 0.5]
    assert isinstance(Rack(np.float64(0.5)).p1, float)


@pytest.mark.parametrize("p", [-0.1, 1.1, float("nan"), float("inf"), "half", None, [0.5, 2]])
def test_no_probability(p: object) -> None:
    with pytest.raises(InputError, match="p1"):
        Rack(p)
    if p is not None:
        with pytest.raises(InputError, match="p2"):
            Rack(0.5, p)


@pytest.mark.parametrize("who", [0, 3, None])
def test_no_player(who: object) -> None:
    with pytest.raises(InputError, match="player must"):
        Rack(0.5).chance(who)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="breaker must"):
        Rack(0.5).chance(1, who)  # type: ignore[arg-type]


def test_arrays_fit_together_or_are_refused() -> None:
    assert Rack([0.5, 0.6], [[0.1], [0.2]]).chance(1, 1).tolist() == [0.5, 0.6]
    with pytest.raises(InputError, match=r"p1 has shape \(2,\), p2 has shape \(3,\)"):
        Rack([0.5, 0.6], [0.1, 0.2, 0.3])


def test_a_later_change_to_the_array_changes_nothing() -> None:
    p, q = np.array([0.5, 0.75]), np.array([0.5, 0.25])
    rack = Rack(p, p, q1=q)
    p[0], q[0] = 7.0, 7.0
    assert rack.p1.tolist() == [0.5, 0.75]
    assert np.asarray(rack.p2).tolist() == [0.5, 0.75]
    assert rack.q1.tolist() == [0.5, 0.25]


def test_the_chance_of_losing_is_that_of_the_decimal() -> None:
    assert Rack(0.999999999).chance(2) == 1e-9
    assert Rack(0.5, [0.9, 1e-20]).chance(1, breaker=2).tolist() == [0.1, 1.0]


def test_a_chance_of_losing_below_the_digits_of_p_can_be_given() -> None:
    rack = Rack(1.0, q1=8.8e-17)
    assert rack.chance(2) == 8.8e-17
    assert Rack(0.5, 1.0, q2=1e-20).chance(1, breaker=2) == 1e-20


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"p1": 0.5, "q1": 0.4}, "p1 and q1"),
        ({"p1": 0.5, "q2": 0.5}, "q2"),
        ({"p1": 1, "q1": 2}, "q1"),
    ],
)
def test_chances_that_contradict_are_refused(given: dict[str, float], named: str) -> None:
    with pytest.raises(InputError, match=named):
        Rack(**given)
