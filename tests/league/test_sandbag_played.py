"""What dumping brings, played under any system: what a chain says, within the error."""

import numpy as np
import pytest

from evenbreak.handicaps import Ladder, LevelLadder, system_of
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.league.sandbag_pay import sandbagging
from evenbreak.league.sandbag_played import dumping_played


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("name", ["npl", "step 3"])
def test_a_step_system_gives_what_its_chain_does(name):
    exact = sandbagging(Ladder(name, widest=120), dumped=8, earnest=15).rows
    for row in dumping_played(system_of(name), [3, 8], earnest=15, replicas=1500, seed=3):
        right = exact[row.dumped]
        assert abs(row.extra_wins - right.extra_wins) < 4.0 * row.error
        assert row.error < 0.06
        assert row.p_first == pytest.approx(right.p_first, abs=0.02)
        assert -row.published == pytest.approx(right.rating, abs=0.3)
        assert row.given_away == pytest.approx(right.given_away, abs=0.1)


@pytest.mark.slow_after(1)
def test_level_steps_give_what_their_chain_does():
    skills = level_skills("apa_8ball")
    ladder = LevelLadder(system_of("level-steps"), skills.points[3], (0, 0, 0, 1, 0, 0))
    exact = ladder.dumping(12, 15)
    for row in dumping_played(system_of("level-steps"), [4, 12], earnest=15, replicas=1500):
        right = exact[row.dumped]
        assert abs(row.extra_wins - right.extra_wins) < 4.0 * row.error
        assert row.published == pytest.approx(right.published, abs=0.05)
        assert row.p_in_a_row == pytest.approx(right.p_in_a_row, abs=0.02)


def test_where_nothing_is_published_nothing_is_gained():
    for row in dumping_played(system_of("none"), [0, 5], replicas=20):
        assert (row.extra_wins, row.published, row.p_first) == pytest.approx(
            (0.0, 0.0, 0.5), abs=1e-12
        )


def test_honest_players_gain_nothing_and_dumpers_fall_under_every_system():
    for name in ("fargo-like", "tap-like", "averages", "win-percent", "napa-like"):
        honest, dumps = dumping_played(system_of(name), [0, 12], earnest=4, replicas=30)
        assert (honest.extra_wins, honest.published) == (0.0, 0.0)
        assert dumps.published < 0.0


def test_the_error_is_how_far_reruns_differ():
    runs = [
        dumping_played(system_of("step 2"), [6], earnest=8, replicas=40, seed=seed)[0]
        for seed in range(30)
    ]
    spread = np.std([run.extra_wins for run in runs], ddof=1)
    assert 0.6 < spread / np.mean([run.error for run in runs]) < 1.6
