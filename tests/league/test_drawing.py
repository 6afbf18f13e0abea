"""Final scores come out the same whether they are drawn or played rack by rack."""

import numpy as np
import pytest
from scipy.special import chdtrc

from evenbreak.handicaps import chart, system_of
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.league.lookup import draw_scores, draw_winners, lookup_of, play_racks, random_bits

MATCHES = 40_000
LOOK = lookup_of(match_table(system_of("npl"), chart("npl_8"), widest=20), 30)


def p_value(counts: np.ndarray, chances: np.ndarray) -> float:
    """Return P(so large a chi-square | the chances are right)."""
    real = chances > 0
    assert counts[~real].sum() == 0
    expected = chances[real] * counts.sum()
    return float(chdtrc(real.sum() - 1, ((counts[real] - expected) ** 2 / expected).sum()))


@pytest.mark.parametrize("draw", [draw_scores, play_racks])
@pytest.mark.parametrize(("gap", "apart"), [(0, 0), (12, 7), (-20, 3), (5, -19)])
def test_scores_have_their_law(draw, gap: int, apart: int) -> None:
    rng = np.random.Generator(np.random.SFC64(7))
    row = np.full((4, 1), gap + LOOK.gap)
    place = np.full((4, MATCHES // 4), apart + LOOK.widest)
    counts = np.bincount(draw(LOOK, row, place, rng).ravel(), minlength=LOOK.outcomes)
    chances = LOOK.table.chances(LOOK.game[gap + LOOK.gap])[apart + LOOK.widest]
    assert p_value(counts, chances) > 1e-4


def test_a_wrong_law_is_seen() -> None:
    rng = np.random.Generator(np.random.SFC64(7))
    row, place = np.full((4, 1), LOOK.gap), np.full((4, MATCHES // 4), LOOK.widest)
    counts = np.bincount(play_racks(LOOK, row, place, rng).ravel(), minlength=LOOK.outcomes)
    wrong = LOOK.table.chances(LOOK.game[LOOK.gap + 2])[LOOK.widest]
    assert p_value(counts, wrong) < 1e-6


def test_winners_have_their_chance() -> None:
    rng = np.random.Generator(np.random.SFC64(7))
    cell = 2 * (10 + LOOK.gap) * LOOK.races + LOOK.twice_race[7]
    won = draw_winners(LOOK.wins, np.full((2, MATCHES), cell), rng)
    chance = LOOK.table.wins(LOOK.game[10 + LOOK.gap])[7 + LOOK.widest]
    error = np.sqrt(chance * (1 - chance) / won.size)
    assert abs(won.mean() - chance) < 4 * error


def test_random_bits_fill_all_32() -> None:
    bits = random_bits(np.random.default_rng(1), (101, 101))
    assert bits.shape == (101, 101)
    assert abs(bits.mean() / 2.0**32 - 0.5) < 5 / np.sqrt(12 * bits.size)
    shares = [((bits >> k) & 1).mean() for k in range(32)]
    assert np.abs(np.array(shares) - 0.5).max() < 5 * 0.5 / 101
