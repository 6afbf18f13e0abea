"""What a set brings, against the engine of single matches."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Race, Rack
from evenbreak.handicaps import Fairest, Gap, chart
from evenbreak.matches import final_scores, live_odds
from evenbreak.ratings import SCALES, Roster
from evenbreak.teams import Points, law_in_play, set_laws

US = Roster(["Ann", "Bo", "Cy"], [600.0, 520.0, 480.0])
THEM = Roster(["Di", "Ed"], [560.0, 540.0])
FARGO = SCALES["fargo"]


def test_the_lead_in_games_is_that_of_the_final_scores() -> None:
    law = set_laws(US, THEM, Fairest(7), count="games")
    p = FARGO.win_probability(600.0 - 560.0)
    reach = law.shape[3] // 2
    ends = final_scores(Race(7, 5, Rack(p))).probability
    expected = np.zeros((2, 2 * reach + 1))
    for (a, b), chance in ends.items():
        expected[0 if a == 7 else 1, reach + a - b] += chance
    assert law[0, 0] == pytest.approx(expected, abs=1e-14)


def test_one_sided_long_races_stay_chances() -> None:
    law = set_laws(Roster(["Ann"], [843.0]), Roster(["Bo"], [250.0]), 13)
    assert law.max() == 1.0


def test_points_are_those_of_apa() -> None:
    law = set_laws(US, THEM, 3, count=Points())[0, 0]
    p = FARGO.win_probability(40.0)
    shutout, hill = p**3, 6 * p**3 * (1 - p) ** 2
    assert law[0, 3 + 3] == pytest.approx(shutout)
    assert law[0, 3 + 1] == pytest.approx(hill)
    assert law[0, 3 + 2] == pytest.approx(law[0].sum() - shutout - hill)


def test_uncertain_ratings_are_averaged_over() -> None:
    unsure = Roster(US.players, US.rating, [30.0, 40.0, 0.0])
    law = set_laws(unsure, THEM, chart("npl_10"), scale="npl")
    assert law[0, 1, 0].sum() == pytest.approx(_chart_chance(60.0, 30.0), abs=1e-8)


def _chart_chance(points: float, error: float) -> float:
    m, n = chart("npl_10").race(points)
    return Gap(points, error, scale="npl").win(m, n)


def test_a_pair_plays_like_the_mean_of_its_two_players() -> None:
    pairs = set_laws(US, THEM, 5, size=2)
    assert pairs.shape == (3, 1, 2, 3)
    mean = set_laws(Roster(["Ann and Cy"], [540.0]), Roster(["Di and Ed"], [550.0]), 5)
    assert pairs[1] == pytest.approx(mean[0])


def test_a_match_in_play_is_worth_its_live_odds() -> None:
    one, other = Roster(["Ann"], [600.0]), Roster(["Di"], [560.0])
    law = law_in_play(one, other, 7, (3, 5), count="games")
    match = Race(7, 7, Rack(FARGO.win_probability(40.0)))
    live = live_odds(match, [1, 1, 1, 2, 2, 2, 2, 2]).now.p_win_1
    assert law[0].sum() == pytest.approx(live, abs=1e-12)
    assert law.sum() == pytest.approx(1.0)
    assert law[0, 7 + 2] > 0.0  # 7:5
    assert law[1, 7 - 4] > 0.0  # 3:7
    assert not law[0, 7 + 3 :].any()  # never 7:4


def test_a_score_moves_ratings_that_are_uncertain() -> None:
    sure = law_in_play(Roster(["Ann"], [500.0]), Roster(["Di"], [500.0]), 9, (6, 0))
    unsure = law_in_play(Roster(["Ann"], [500.0], [100.0]), Roster(["Di"], [500.0]), 9, (6, 0))
    assert unsure[0].sum() > sure[0].sum()


def test_what_cannot_be_played_is_refused() -> None:
    with pytest.raises(InputError, match="'Bo' has no rating"):
        set_laws(Roster(["Ann", "Bo"], [600.0, np.nan]), THEM, 5)
    with pytest.raises(InputError, match="ends a race"):
        law_in_play(Roster(["Ann"], [600.0]), Roster(["Di"], [560.0]), 5, (5, 3))
    with pytest.raises(InputError, match="a win must count more"):
        Points(win=1, hill=1)
