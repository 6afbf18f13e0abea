import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.handicaps.charts.race_grid import (
    ends_within_grid,
    even_differences,
    games_quantiles,
    mean_games_grid,
    win_grid,
)
from evenbreak.matches import race_odds
from evenbreak.ratings import SCALES, scale_of

NPL = SCALES["npl"]
POINTS = np.array([-40, 0, 7, 100])
M, N = [5, 1, 4, 6], [3, 1, 4, 1]


@pytest.mark.parametrize("place", range(4))
def test_races_are_those_of_the_rack_by_rack_law(place):
    for column, points in enumerate(POINTS):
        law = race_odds(M[place], N[place], 1 / (1 + 2 ** (-points / 30)))
        assert win_grid(NPL, M, N, POINTS)[place, column] == pytest.approx(law.p_win_1, rel=1e-12)
        mean = mean_games_grid(NPL, M, N, POINTS)[place, column]
        assert mean == pytest.approx(law.mean, rel=1e-12)
        assert games_quantiles(NPL, M[place], N[place], POINTS, 0.9)[column] == law.quantile(0.9)
        for games in range(8):
            ended = sum(p for k, p in zip(law.games, law.probability, strict=True) if k <= games)
            within = ends_within_grid(NPL, M, N, POINTS, games)[place, column]
            assert within == pytest.approx(ended, abs=1e-13)


@pytest.mark.slow
@settings(max_examples=25, deadline=None)
@given(st.integers(1, 30), st.integers(1, 30), st.floats(1, 500))
def test_a_race_is_even_where_it_is_said_to_be(m, n, points):
    scale = scale_of(points)
    even = even_differences(scale, [m], [n])
    assert win_grid(scale, [m], [n], even)[0, 0] == pytest.approx(0.5, abs=1e-9)
    assert even[0] == pytest.approx(-even_differences(scale, [n], [m])[0], abs=1e-9 * points)
