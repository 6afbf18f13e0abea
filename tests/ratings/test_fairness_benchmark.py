"""The open benchmark of fairness: it judges anybody's engine, and nobody beats the truth."""

import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from scipy.special import betainc, expit

from evenbreak.ratings import Results, walk_forward
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
HANDICAP = """
from evenbreak.handicaps.systems.none import NoHandicap

class Handicap(NoHandicap):
    def __init__(self):
        super().__init__(name="my handicap")
"""


@pytest.fixture
def fairness(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """Return the script, with a stranger's engine in the folder."""
    (tmp_path / "mine.py").write_text(MINE + HANDICAP)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [str(ROOT / "benchmarks"), *sys.path])
    for name in ("engines", "fairness", "synthetic_seasons", "mine"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    import fairness

    return fairness


def test_the_engine_of_a_stranger_is_judged_and_the_truth_is_best(fairness):
    seasons = fairness.simulated(3, 5, matches=240, players=16)[:3]
    kinds = [fairness.engine_of("mine:Share"), *(k for k in fairness.ENGINES if k.name == "Elo")]
    mine, elo, truth = fairness.judged_engines(kinds, seasons)
    assert (mine["name"], elo["name"], truth["name"]) == ("Share", "Elo", "the true chances")
    assert "doubt" in mine["settings"]
    assert mine["game_behind"] == 0.0
    for other in (mine, elo):
        for name in ("game_log_loss", "match_log_loss", "brier", "from_even"):
            assert truth[name] < other[name], name
    assert truth["from_even_behind"] < -2.0 * truth["from_even_behind_error"] < 0.0
    lines = fairness.table([mine, elo, truth]).splitlines()
    assert [line[:5] for line in lines[2:5]] == ["| Sha", "| Elo", "| the"]


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
            return np.array([betainc(m, n, self.known(played)) for m, n in races])

    def everything(_, played):
        share = played.score_a.sum() / (played.score_a + played.score_b).sum()
        return np.full(len(played), share)

    def own_result(_, played):
        return np.clip(played.score_a / (played.score_a + played.score_b), 0.02, 0.98)

    def next_night(_, played):  # only what comes next week, and only of the second half
        night = np.unique(played.date, return_inverse=True)[1]
        a_won = np.bincount(night, played.score_a > played.score_b)
        return 0.4 + 0.2 * np.append(a_won, 0)[np.where(night > 25, night + 1, -1)] / len(played)

    for known in (everything, own_result, next_night):
        Cheat.known = known
        with pytest.raises(SystemExit, match="Cheat knows results of night"):
            fairness.judge(Cheat, season)


def test_turned_results_are_those_of_the_other_winner(fairness):
    ours = {"race_a": [7, 7, -1, 7], "race_b": [5, 5, -1, 5]}
    played = Results.from_names(["A"] * 4, ["B"] * 4, [7, 6, 4, 7], [2, 5, 7, 4], **ours)
    other = fairness.turned(played, np.array([True, True, True, False]))
    assert other.score_a.tolist() == [2, 7, 7, 7]
    assert other.score_b.tolist() == [5, 4, 4, 4]


def test_leagues_are_clusters_and_blocks_of_nights_of_a_single_season(fairness):
    seasons = fairness.simulated(4, 9, matches=100, players=10)[:4]
    kinds = [fairness.engine_of("mine:Share"), fairness.Truth]
    judged = [[fairness.judge(kind, season)[1] for season in seasons] for kind in kinds]
    for part in judged[0]:
        assert len(np.unique(part.cluster)) == fairness.BLOCKS
        assert (np.diff(part.cluster) >= 0).all()  # blocks of nights that follow each other
    behind = fairness.mean_of(judged[1][0].uneven, judged[1][0].won * 0 + 1, judged[1][0].cluster)
    alone = list(fairness.judged_engines(kinds[:1], seasons[:1]))[1]
    assert alone["from_even_error"] == behind.error

    # A ratio's error by hand: what each league's sum is beyond its share.
    together = list(fairness.judged_engines(kinds[:1], seasons))[1]
    apart = [truth.uneven - mine.uneven for mine, truth in zip(*judged, strict=True)]
    mean = sum(each.sum() for each in apart) / sum(map(len, apart))
    beyond = np.array([each.sum() - mean * len(each) for each in apart])
    error = np.sqrt((beyond**2).sum() * 4 / 3) / sum(map(len, apart))
    np.testing.assert_allclose(together["from_even_behind"], mean, rtol=1e-9)
    np.testing.assert_allclose(together["from_even_behind_error"], error, rtol=1e-9)


def test_settings_are_chosen_where_none_can_be_bettered_and_edges_are_marked(fairness):
    values = {"step": (0.1, 0.2, 0.4), "fade": (0.0, 1.0, 2.0), "age": (1.0, 2.0)}
    kind = SimpleNamespace(settings=values)

    def loss(way):
        return (way["step"] - 0.4) ** 2 + way["fade"] + (way["age"] - 2.0) ** 2

    way = fairness.chosen(kind, loss)
    assert way == {"step": 0.4, "fade": 0.0, "age": 2.0}
    assert fairness.edges(kind, way) == ["step 0.4", "age 2"]  # nothing is less than no fading
    row = {"season": "a season", "name": "Kind", "edges": "step 0.4 in 2 of 3"}
    assert fairness.table([row]).splitlines()[2].startswith("| Kind * |")
    assert fairness.table([row]).endswith("Kind: step 0.4 in 2 of 3")


def test_an_engine_that_knows_its_error_averages_over_it(fairness):
    engine = next(kind for kind in fairness.ENGINES if kind.name == "Elo")(2)
    drawn = expit(0.7 + 0.5 * np.random.default_rng(1).normal(size=200_000))
    for race in ((1, 1), (7, 5)):
        seen = betainc(*race, drawn)
        engine.apart = lambda *_: (0.7, 0.5)
        assert abs(engine.chance(0, 1, race) - seen.mean()) < 4.0 * seen.std() / 447.0
        engine.apart = lambda *_: (0.7, 0.0)
        assert engine.chance(0, 1, race) == betainc(*race, expit(0.7))


@pytest.mark.slow
def test_systems_are_judged_by_how_even_they_make_matches(fairness):
    names = ["npl", "none", "mine:Handicap"]
    rows = {row["name"]: row for row in fairness.judged_systems(names, 40, 1)}
    assert rows["my handicap"] == rows["none"] | {"name": "my handicap"}
    assert rows["npl"]["p_even"] > rows["none"]["p_even"] + 0.1
    assert abs(rows["npl"]["p_better_wins"] - 0.5) < abs(rows["none"]["p_better_wins"] - 0.5)
