"""The ladder of levels: its long run by powers of the matrix, and by play."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import (
    LevelLadder,
    LevelSteps,
    MarkovSystem,
    broken_laws,
    level_chart,
    system_of,
)
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.matches import race_win_probability

SKILLS = level_skills("apa_8ball")


def matrix(ladder):
    size = len(ladder.system.states)
    chain = np.zeros((size, size))
    for state in range(size):
        for to, chance in ladder.moves(state).items():
            chain[to, state] += chance
    return chain


@pytest.mark.parametrize(("steps", "entry"), [(10, 3), (3, 1), (4, 4)])
def test_the_law_is_what_powers_of_the_matrix_settle_at(steps, entry):
    for strength in (50.0, 238.0, 400.0):
        ladder = LevelLadder(LevelSteps(steps, entry), strength, (1, 2, 3, 3, 2, 1))
        two = matrix(ladder) @ matrix(ladder)
        power = np.linalg.matrix_power((np.eye(len(two)) + two) / 2.0, 1 << 22)
        reached = ladder.law > 0
        law = power[:, ladder.start]
        law = (law + matrix(ladder) @ law) / 2.0
        np.testing.assert_allclose(ladder.law, law, atol=1e-9)
        assert ladder.law[reached].sum() == pytest.approx(1.0)


def test_the_chance_of_a_match_is_that_of_the_chart_s_race():
    ladder = LevelLadder(system_of("level-steps"), float(SKILLS.points[3]), (0, 0, 0, 0, 1, 0))
    state = int(ladder.system.first_state(4))
    p = 1.0 / (1.0 + 2.0 ** ((SKILLS.points[4] - SKILLS.points[3]) / 100.0))
    assert ladder.wins[state] == pytest.approx(float(race_win_probability(p, 3, 5)))


@pytest.mark.slow_after(1)
def test_the_system_played_match_by_match_is_where_the_chain_says():
    """2,000 players of level 5's strength after 40 matches against rightly rated players of 5."""
    many, nights, rng = 2000, 40, np.random.default_rng(8)
    system = system_of("level-steps")
    ladder = LevelLadder(system, float(SKILLS.points[3]), (0, 0, 0, 1, 0, 0), start_level=3)
    law = np.eye(len(system.states))[ladder.start]
    for _ in range(nights):
        law = matrix(ladder) @ law
    initial = ratings = np.array([np.full(many, 3.0), np.full(many, 5.0)])
    entries, parts, kept = Entries.of(level=initial), [], {}
    for night in range(1, nights + 1):
        m, n = system.race(ratings[0], ratings[1])
        won = rng.random(many) < race_win_probability(0.5, m, n)
        scores = np.where(won, m, 0), np.where(won, 0, n)
        zero, one = np.zeros(many, int), np.ones(many, int)
        parts.append((zero, one, *scores, m, n, ratings[0], ratings[1]))
        columns = [np.array(column) for column in zip(*parts, strict=True)]
        matches = Matches(np.arange(1, night + 1), *columns)
        history = History(entries, initial, ratings, night, matches, kept=kept)
        ratings = np.array([system.update(history)[0], initial[1]])
    for level in (3, 4, 5, 6):
        share = law[system.states == level].sum()
        error = np.sqrt(share * (1 - share) / many)
        assert abs((ratings[0] == level).mean() - share) < 4.0 * error + 1e-9


def test_matches_to_the_own_level():
    assert LevelLadder(system_of("level-steps"), 238.0, (1,) * 6).matches_to_level() == 0.0
    ladder = LevelLadder(system_of("level-steps"), 370.0, (1,) * 6, start_level=3)
    assert 30.0 < ladder.matches_to_level() < 60.0


def test_opponents_need_a_weight_for_each_level():
    with pytest.raises(InputError, match="a weight for each of the levels 2, 3, 4, 5, 6, 7"):
        LevelLadder(system_of("level-steps"), 238.0, (1, 1))


class Thirds(MarkovSystem):
    name, in_words, chart = "thirds", "a third of a level for each match", level_chart("apa_8ball")
    states = np.repeat(np.arange(2, 8), 3)

    def initial(self, entries):
        return np.where(np.isnan(entries.level), 3.0, entries.level)

    def first_state(self, levels):
        return (np.asarray(levels, dtype=int) - 2) * 3 + 1

    def move(self, state, *, won):
        return np.clip(np.asarray(state) + np.where(won, 1, -1), 0, 17)


def test_a_system_of_ones_own_in_finitely_many_states_has_a_long_run():
    assert broken_laws(Thirds()) == []
    ladder = LevelLadder(Thirds(), float(SKILLS.points[2]), (0, 0, 1, 0, 0, 0))
    up, down = ladder.wins[:-1], 1.0 - ladder.wins[1:]
    law = np.cumprod(np.concatenate([[1.0], up / down]))  # births and deaths in balance
    np.testing.assert_allclose(ladder.law, law / law.sum(), rtol=1e-9)
    assert Thirds().on_chart(level_chart("apa_8ball")).name == "thirds"
    with pytest.raises(InputError, match="thirds can't be played with the chart npl_10"):
        Thirds().on_chart(chart_of("npl_10"))
