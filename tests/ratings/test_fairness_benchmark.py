"""The open benchmark of fairness: it judges anybody's engine, and nobody beats the truth."""

import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from scipy.special import betainc, expit

from evenbreak.ratings import walk_forward
from places import ROOT

MINE = """
from scipy.special import betainc

class Share:  # the share of games won, shrunk to a half
    settings = {"doubt": (5.0, 20.0)}

    def __init__(self, players, doubt):
        self.won, self.played, self.doubt = [0.0] * players, [0.0] * players, doubt

    def learn(self, night):
        for a, b, m, n in zip(night.player_a, night.player_b, night.score_a, night.score_b):
            for player, games in ((a, m), (b, n)):
                self.won[player] += games
                self.played[player] += m + n

    def chance(self, a, b, race):
        p, q = ((self.won[k] + self.doubt / 2) / (self.played[k] + self.doubt) for k in (a, b))
        return betainc(*race, p * (1 - q) / (p * (1 - q) + q * (1 - p)))
"""


@pytest.fixture
def fairness(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """Return the script, with a stranger's engine in the folder."""
    (tmp_path / "mine.py").write_text(MINE)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [str(ROOT / "benchmarks"), *sys.path])
    for name in ("engines", "fairness", "synthetic_seasons", "mine"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    import fairness

    return fairness


def test_the_engine_of_a_stranger_is_judged_and_the_truth_is_best(fairness):
    seasons = fairness.simulated(2, 5, matches=240, players=16)[:2]
    kinds = [fairness.engine_of("mine:Share"), *(k for k in fairness.ENGINES if k.name == "Elo")]
    mine, elo, truth = fairness.judged_engines(kinds, seasons)
    assert (mine["name"], elo["name"], truth["name"]) == ("Share", "Elo", "the true chances")
    assert "doubt" in mine["settings"]
    assert mine["game_behind"] == 0.0
    for other in (mine, elo):
        for name in ("game_log_loss", "match_log_loss", "brier", "race_off_even"):
            assert truth[name] < other[name], name
    assert truth["race_off_behind"] < -2.0 * truth["race_off_behind_error"] < 0.0
    assert fairness.table([mine, elo, truth]).count("\n") == 4


def test_the_true_chances_are_the_best_calibrated(fairness):
    rng = np.random.default_rng(3)
    x, night = rng.normal(0.0, 1.2, 6000), np.arange(6000) // 12
    won = (rng.random(6000) < expit(x)).astype(float)
    lines = {by: fairness.line_of(expit(by * x), won, night) for by in (0.6, 1.0, 1.6)}
    for by, (slope, gap) in lines.items():
        assert abs(slope.value - 1.0 / by) < 4.0 * slope.error
        assert (abs(gap.value) < 3.0 * gap.error) == (by == 1.0)
    off = {by: abs(slope.value - 1.0) for by, (slope, _) in lines.items()}
    assert min(off, key=off.__getitem__) == 1.0


def test_evenbreaks_engine_is_its_walk_and_whoever_looks_ahead_is_found_out(fairness):
    season = fairness.simulated(1, 2, matches=120, players=10)[0]
    found = walk_forward(season.played, prior_sd=0.5)
    engine = fairness.ENGINES[0](10, prior_sd=0.5)
    both = engine.walk(season.played, [(found.race_a, found.race_b), (found.race_a * 0 + 1,) * 2])
    np.testing.assert_allclose(both[0], found.p_match_integrated, atol=1e-6)
    np.testing.assert_allclose(both[1], found.p_game_integrated, atol=1e-6)

    class Cheat:
        def __init__(self, players: int) -> None: ...
        def walk(self, played, races):
            ahead = played.score_a.sum() / (played.score_a + played.score_b).sum()
            return np.array([betainc(m, n, np.full(len(played), ahead)) for m, n in races])

    with pytest.raises(SystemExit, match="Cheat knows of matches that come later"):
        fairness.judge(Cheat, season)


@pytest.mark.slow
def test_systems_are_judged_by_how_even_they_make_matches(fairness):
    rows = {row["name"]: row for row in fairness.judged_systems(["npl", "none"], 40, 1)}
    assert rows["npl"]["p_even"] > rows["none"]["p_even"] + 0.1
    assert abs(rows["npl"]["p_better_wins"] - 0.5) < abs(rows["none"]["p_better_wins"] - 0.5)
