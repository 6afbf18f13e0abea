import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.games import (
    Rack,
    Series,
    alternate_breaks,
    loser_breaks,
    player_2_breaks,
    winner_breaks,
)

OPEN = st.floats(0.001, 0.999)


@given(OPEN, OPEN)
def test_how_often_player_1_breaks(p1: float, p2: float) -> None:
    rack, q1, q2 = Rack(p1, p2), 1 - p1, 1 - p2
    for breaks, share in (
        (winner_breaks, q2 / (q1 + q2)),
        (loser_breaks, p2 / (p1 + p2)),
        (alternate_breaks, 0.5),
        (player_2_breaks, 0.0),
    ):
        limit = stochastic_limit(chain_of(Series(rack, breaks=breaks)))
        assert limit.to_dict().get(1, 0.0) == pytest.approx(share, rel=1e-12)


def test_alternate_breaks_go_round() -> None:
    series = Series(Rack(0.75, 0.5), breaks=alternate_breaks)
    assert series.moves(1) == {2: 1.0}
    assert stochastic_limit(chain_of(series)).is_cesaro


@pytest.mark.parametrize("breaker", [1, 2])
def test_nobody_wins_a_series(breaker: int) -> None:
    series = Series(Rack(1, 0), breaks=winner_breaks, first_breaker=breaker)
    assert series.start == breaker
    assert series.moves(breaker) == {1: 1.0}
    assert series.winner(breaker) is None


def test_what_a_series_cannot_be() -> None:
    with pytest.raises(
        InputError, match=r"rack must be a Rack\(p\) or a Rack\(p1, p2\); you gave 0\.5"
    ):
        Series(0.5, breaks=winner_breaks)  # type: ignore[arg-type]
    with pytest.raises(
        InputError, match="breaks must be a break format such as winner_breaks; you gave 'winner'"
    ):
        Series(Rack(0.5), breaks="winner")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="first_breaker must be 1 or 2; you gave 0"):
        Series(Rack(0.5, 0.5), breaks=winner_breaks, first_breaker=0)
