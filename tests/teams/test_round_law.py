"""The total of a round: enumeration in fractions, laws, and the published example."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Roster
from evenbreak.teams import round_law

US, THEM = Roster(["Ann", "Bo"], [500, 400]), Roster(["Xi", "Yu"], [600, 500])


def enumerated(chances: list[Fraction], games: int) -> dict[int, Fraction]:
    """Return the law of the lead, one outcome of all games after another."""
    law: dict[int, Fraction] = {}
    each = [p for p in chances for _ in range(games)]
    for wins in itertools.product((True, False), repeat=len(each)):
        p = Fraction(1)
        for won, chance in zip(wins, each, strict=True):
            p *= chance if won else 1 - chance
        lead = sum(1 if won else -1 for won in wins)
        law[lead] = law.get(lead, Fraction(0)) + p
    return law


@pytest.mark.parametrize(("games", "everybody"), [(1, False), (3, False), (1, True), (2, True)])
def test_single_games_equal_enumeration(games: int, everybody: bool) -> None:
    # 100 Fargo points double the odds, so all chances are rational.
    gaps = {-100: Fraction(1, 3), 0: Fraction(1, 2), -200: Fraction(1, 5)}
    met = [(0, 0), (0, 1), (1, 0), (1, 1)] if everybody else [(0, 0), (1, 1)]
    chances = [gaps[int(US.rating[i] - THEM.rating[j])] for i, j in met]
    law = round_law(US, THEM, games=games, everybody=everybody)
    exact = enumerated(chances, games)
    for lead in range(-law.reach, law.reach + 1):
        p = float(exact.get(lead, 0))
        assert law.lead[lead + law.reach] == pytest.approx(p, rel=1e-13, abs=0)


def test_a_race_of_one_game_is_a_single_game() -> None:
    race, game = round_law(US, THEM, race=1), round_law(US, THEM, games=1)
    assert race.lead == pytest.approx(game.lead, rel=1e-13)


def test_races_equal_enumeration_of_their_scores() -> None:
    p = 1 / 3
    scores = {2: p**2, 1: 2 * p**2 * (1 - p), -1: 2 * p * (1 - p) ** 2, -2: (1 - p) ** 2}
    both: dict[int, float] = {}
    for (a, x), (b, y) in itertools.product(scores.items(), repeat=2):
        both[a + b] = both.get(a + b, 0.0) + x * y
    law = round_law(US, THEM, race=2)
    shown = {k - law.reach: value for k, value in enumerate(law.lead) if value}
    assert shown == pytest.approx(both, rel=1e-12)


@pytest.mark.parametrize("asked", [{"games": 2}, {"race": 3}, {"games": 1, "everybody": True}])
def test_swapping_the_teams_swaps_the_round(asked: dict) -> None:
    one, other = round_law(US, THEM, **asked), round_law(THEM, US, **asked)
    assert one.lead == pytest.approx(other.lead[::-1], rel=1e-12)
    assert one.mean == pytest.approx(-other.mean, rel=1e-12)
    assert one.fair_start == -other.fair_start


@pytest.mark.parametrize("start", [-3, 0, 0.5, 2])
def test_outcomes_of_a_start_sum_to_one(start: float) -> None:
    seen = round_law(US, THEM, games=2).with_start(start)
    assert sum(seen) == pytest.approx(1.0, abs=1e-12)
    assert (seen.tie == 0.0) == (start % 1 != 0 or start % 2 != 0)


def test_no_start_is_nearer_to_even_than_the_fair_one() -> None:
    law = round_law(US, THEM, race=5, everybody=True)
    best = law.with_start(law.fair_start).unfair
    assert all(law.with_start(start).unfair >= best - 1e-12 for start in range(-30, 31))


def test_equal_teams_need_no_start() -> None:
    assert round_law(US, US, games=3).fair_start == 0


def test_one_to_one_errors_are_averaged_exactly_and_everybodys_by_drawing() -> None:
    doubt = Roster(["Ann"], [500], [80.0])
    one = Roster(["Xi"], [600])
    exact = round_law(doubt, one, games=3)
    drawn = round_law(doubt, one, games=3, everybody=True)
    assert drawn.lead == pytest.approx(exact.lead, abs=2e-3)
    assert exact.lead != pytest.approx(
        round_law(Roster(["Ann"], [500]), one, games=3).lead, abs=0.01
    )


def test_one_players_error_is_the_same_in_all_their_matches() -> None:
    doubt = Roster(["Ann"], [500], [150.0])
    many = Roster(["Xi", "Yu", "Zo"], [500, 500, 500])
    lead = round_law(doubt, many, games=1, everybody=True).lead
    # Independent matches would be (1/8, 3/8, 3/8, 1/8).
    assert lead[0] > 0.18
    assert np.isclose(lead.sum(), 1.0)


@pytest.mark.parametrize(
    "asked",
    [{}, {"games": 2, "race": 5}, {"games": 0}, {"games": 1, "theirs": Roster(["X"], [500])}],
)
def test_a_wrong_question_is_refused(asked: dict) -> None:
    with pytest.raises(InputError):
        round_law(US, asked.pop("theirs", THEM), **asked)
