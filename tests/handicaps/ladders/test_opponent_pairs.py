import numpy as np

from evenbreak.handicaps import (
    AUTOCORRELATED,
    EQUAL_SKILL,
    NATURAL,
    Ladder,
    Opponents,
    chart,
    opponents_of,
)
from evenbreak.handicaps.ladders.unfairness import opponent_pairs_of
from evenbreak.handicaps.systems.elo import elo_system
from evenbreak.handicaps.systems.step import margin_system, step_system
from evenbreak.stats import Distribution
from rows import each_of

SPREAD = Distribution((-20, 3, 10), (0.25, 0.5, 0.25))
ERROR = Distribution((-4, 0, 5), (0.25, 0.5, 0.25))
KINDS = {
    "natural": NATURAL,
    "A": AUTOCORRELATED,
    "B": EQUAL_SKILL,
    "given skill": Opponents(SPREAD, ERROR, "skill"),
    "given rating": Opponents(SPREAD, ERROR, "rating"),
    "given rating, own error": opponents_of([60, 75, 80, 102], 80),
}


@each_of("kind", KINDS)
@each_of("system", [step_system(1), margin_system(2)])
def test_pairs_give_the_ladders_own_chances(kind, system):
    # The ladder convolves; here every pair is added up.
    ladder = Ladder(system, opponents=KINDS[kind])
    pairs = opponent_pairs_of(ladder)
    wins = pairs.wins()[pairs.places(), pairs.ahead] @ pairs.chance
    np.testing.assert_allclose(wins, ladder.wins, atol=1e-11)
    moves = pairs.mean_of(pairs.table.moves[..., 0])
    np.testing.assert_allclose(moves, ladder.kernel @ ladder.steps, atol=1e-10)


@each_of("kind", ["natural", "B", "given rating"])
@each_of("forms", [{"day_sd": 6.0}, {"match_sd": 3.0}, {"day_sd": 0.4}, {"day_sd": 90.0}])
def test_form_is_that_of_the_ladder(kind, forms):
    ladder = Ladder(chart("npl_10"), opponents=KINDS[kind], **forms)
    pairs = opponent_pairs_of(ladder)
    wins = pairs.wins()[pairs.places(), pairs.ahead] @ pairs.chance
    np.testing.assert_allclose(wins, ladder.wins, atol=1e-11)


def test_pairs_on_a_wide_scale_are_the_ladders_too():
    ladder = Ladder(elo_system(16), opponents=EQUAL_SKILL)
    pairs = opponent_pairs_of(ladder)
    moves = pairs.mean_of(pairs.table.moves[..., 0])
    np.testing.assert_allclose(moves, ladder.kernel @ ladder.steps, atol=1e-8)


def test_two_kinds_of_form_add_their_variances():
    both = opponent_pairs_of(Ladder("npl", day_sd=3.0, match_sd=4.0))
    one = opponent_pairs_of(Ladder("npl", day_sd=5.0))
    # Except that two deviations are rounded instead of one.
    np.testing.assert_allclose(both.wins(), one.wins(), atol=1e-3)
