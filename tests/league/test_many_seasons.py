"""Many replicas at once: against enumeration, exact chains, and sums that must hold."""

import dataclasses
from collections import defaultdict
from functools import cache, reduce
from operator import add

import numpy as np
import pytest
from scipy.special import chdtrc

from evenbreak.errors import AccuracyError
from evenbreak.games import Race, Rack
from evenbreak.handicaps import chart, system_of
from evenbreak.handicaps.systems.by_match import PlayedMatch
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.league import (
    FixedSchedule,
    LeaguePlayers,
    RandomPairing,
    RoundRobin,
    Season,
    Tally,
    run_chunk,
)
from evenbreak.league.many_seasons import _Chunk
from evenbreak.league.simulate import batching_of
from evenbreak.matches import final_scores

SEED = np.random.SeedSequence(20)


def chunks(season: Season, replicas: int, many: int) -> Tally:
    return reduce(add, (run_chunk(season, replicas, seed) for seed in SEED.spawn(many)))


def spread(tally: Tally, since: int) -> tuple[float, float]:
    """Return the sd of the rating errors from a week on, and its standard error."""
    players, error, square, _ = np.moveaxis(tally.weeks[:, since:].sum(axis=1), 1, 0)
    variance, off = tally.mean_and_error(square - error**2 / players, players)
    return float(np.sqrt(variance)), float(off / (2 * np.sqrt(variance)))


@cache
def scores(p: float, race: tuple[int, int]) -> dict:
    return final_scores(Race(*race, Rack(p))).probability


def enumerated(season: Season) -> dict:
    """Return the law of (ratings, matches won) after a season of fixed pairs, by its rules."""
    players = season.players
    law = {
        (tuple(players.rating.tolist()), tuple(players.played.tolist()), (0,) * len(players)): 1.0
    }
    for week in range(1, season.weeks + 1):
        rounds = season.schedule.pairs(week, np.random.default_rng(), len(players))
        matches = [
            (int(a), int(b)) for ones, twos in rounds for a, b in zip(ones, twos, strict=True)
        ]
        after = defaultdict(float)
        for (rating, played, won), chance in law.items():
            here = {(rating, played, won): chance}
            for pair in matches:
                here = one_match(season, rating, here, pair)
            for state, weight in here.items():
                after[state] += weight
        law = after
    return law


def one_match(season: Season, before: tuple, law: dict, pair: tuple[int, int]) -> dict:
    a, b = pair
    after: dict = defaultdict(float)
    race = season.chart.race(before[a] - before[b])
    p = season.system.scale.win_probability(season.players.skill[a] - season.players.skill[b])
    for (rating, played, won), chance in law.items():
        for (games_a, games_b), weight in scores(p, race).items():
            turn = 1 if games_a == race[0] else -1
            seen = PlayedMatch(
                (before[a], before[b])[::turn],
                (games_a, games_b)[::turn],
                race[::turn],
                (played[a], played[b])[::turn],
            )
            moves = season.system.rule(seen)[::turn]
            new, more, wins = list(rating), list(played), list(won)
            for player, move in zip(pair, moves, strict=True):
                new[player] += move
                more[player] += 1
            wins[a if turn == 1 else b] += 1
            after[tuple(new), tuple(more), tuple(wins)] += chance * weight
    return after


@pytest.mark.slow_after(4)
@pytest.mark.parametrize("play", ["matches", "racks"])
@pytest.mark.parametrize(
    ("system", "by", "played"),
    [
        ("npl", "npl_8", 1000),
        ("npl", "npl_8", 8),
        ("step 3 1", "npl_8", 0),
        ("margin", "npl_8", 0),
        ("elo 24", None, 0),
    ],
)
def test_every_state_is_as_frequent_as_enumerated(system: str, by, played: int, play: str) -> None:
    replicas = 20_000
    scale = system_of(system).scale.points_per_doubling
    club = LeaguePlayers.of(
        np.rint(np.array([2.0, 1.0, 2.2]) * scale),
        skill=np.rint(np.array([2.0, 1.3, 1.8]) * scale),
        played=played,
    )
    fixtures = FixedSchedule([1, 1, 2], [0, 2, 1], [1, 0, 2])  # player 0 twice in week 1
    season = Season(club, system, by, fixtures, weeks=2, play=play)
    chunk = _Chunk(season, replicas, np.random.Generator(np.random.SFC64(4)))
    for week in (1, 2):
        chunk.play(week)
    ended = chunk.ended()
    states = np.vstack([ended.rating, ended.wins]).T.tolist()
    seen = defaultdict(int)
    for state in states:
        seen[tuple(state)] += 1
    law = defaultdict(float)
    for (rating, _, won), chance in enumerated(season).items():
        law[rating + won] += chance
    assert set(seen) <= set(law)
    likely = {state: chance for state, chance in law.items() if chance * replicas > 5}
    off = [(seen[state] - c * replicas) ** 2 / (c * replicas) for state, c in likely.items()]
    assert len(likely) >= 6
    assert chdtrc(len(off) - 1, sum(off)) > 1e-4


def test_wins_by_cell_are_those_of_the_table() -> None:
    skill = np.random.default_rng(2).normal(70, 15, 64).round()
    season = Season(LeaguePlayers.of(skill, skill=skill), "npl", schedule=RandomPairing(), weeks=60)
    chunk = _Chunk(season, 500, np.random.Generator(np.random.SFC64(5)))
    for week in range(1, 61):
        chunk.play(week)
    lost, won = chunk.count.cells.reshape(-1, 2).T
    both = lost + won
    chance = season.lookup.wins[::2] / 2.0**32
    often = both * chance * (1 - chance) > 10
    z = (won - both * chance)[often] / np.sqrt(both * chance * (1 - chance))[often]
    assert both.sum() == 60 * 32 * 500
    assert often.sum() > 400
    assert np.abs(z).max() < 5.5
    assert abs((z**2).mean() - 1) < 5 * np.sqrt(2 / often.sum())


def spread_of_many(start: dict[int, float], weeks: int, since: int) -> float:
    """Return the sd of rating errors from a week on in a league of endlessly many equal players."""
    widest = 60
    law = np.zeros(2 * widest + 1)
    for error, share in start.items():
        law[error + widest] = share
    table = match_table(system_of("npl"), chart("npl_10"), widest=2 * widest)
    wins, errors = table.wins(0.5), np.arange(-widest, widest + 1)
    variances = []
    for _ in range(weeks):
        up = law * np.convolve(wins, law, "valid")
        law = np.roll(up, 1) + np.roll(law - up, -1)
        variances.append(law @ errors**2 - (law @ errors) ** 2)
    return float(np.sqrt(np.mean(variances[since - 1 :])))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("odd", "known"), [(True, 4.417), (False, 4.305)], ids=["both parities", "one parity"]
)
def test_a_closed_league_of_equal_players(odd: bool, known: float) -> None:
    # Ratings move by one a match and all play: with even starts all are even, or all odd, at any
    # time, and two of them never lie an odd number of points apart. The chart's races are even up
    # to 5 points: of all differences 5 is the last one that nothing pulls back, of even ones 4.
    # So the flat stretch is half a point shorter on either side, and ratings stray less.
    rating = 60 + (np.arange(2000) % 2 if odd else np.zeros(2000))
    season = Season(LeaguePlayers.of(rating, skill=60), "npl", "npl_10", RandomPairing(), weeks=600)
    exact = spread_of_many({0: 0.5, 1: 0.5} if odd else {0: 1.0}, 600, 200)
    assert exact == pytest.approx(known, abs=0.005)
    sd, error = spread(chunks(season, 2, 5), 200)
    assert error < 0.01
    assert abs(sd - exact) < 5 * error


def test_two_players_who_meet_only_each_other() -> None:
    # Their sum stays, so the difference moves by 2: the law of a chain on a line.
    differences = np.arange(-80, 81, 2)
    m, n = chart("npl_10").races(differences)
    up = np.array(
        [
            sum(c for (a, _), c in scores(0.5, race).items() if a == race[0])
            for race in zip(m.tolist(), n.tolist(), strict=True)
        ]
    )
    law = np.cumprod(np.append(1.0, up[:-1] / (1 - up[1:])))
    law /= law.sum()
    exact = np.sqrt(law @ (differences / 2) ** 2)
    assert exact == pytest.approx(3.04, abs=0.005)
    season = Season(LeaguePlayers.of([60, 60]), "npl", "npl_10", weeks=700)
    sd, error = spread(chunks(season, 400, 8), 300)
    assert error < 0.02
    # Both errors are seen, one the other's mirror, and their mean is 0 always.
    assert abs(sd - exact) < 5 * error


@pytest.mark.parametrize("play", ["matches", "racks"])
def test_what_one_wins_the_other_loses(play: str) -> None:
    rating = np.arange(20, 120, 7)
    season = Season(LeaguePlayers.of(rating), "npl", schedule=RandomPairing(3), weeks=9, play=play)
    tally = run_chunk(season, 50, SEED)
    assert tally.rating.sum() == 0
    assert tally.wins.sum() == tally.matches.sum() / 2 == tally.gaps[..., 0].sum()
    assert (tally.games is None) == (play == "matches")
    if play == "racks":
        assert tally.games.sum() == tally.gaps[..., 4].sum()


def test_unequal_steps_inflate_by_what_they_are_unequal() -> None:
    season = Season(LeaguePlayers.of([50, 60, 70, 80]), "step 2 1", weeks=11)
    tally = run_chunk(season, 100, SEED)
    assert tally.rating.sum() == tally.matches.sum() / 2


def test_both_ways_to_play_give_the_same() -> None:
    skill = np.array([50, 55, 60, 70, 80, 95])
    tallies = [
        chunks(Season(LeaguePlayers.of(skill), "npl", weeks=20, play=play), 200, 10)
        for play in ("matches", "racks")
    ]
    for column in (1, 2, 3, 4):
        (one, error_1), (two, error_2) = (
            tally.mean_and_error(tally.gaps[..., column], tally.gaps[..., 0]) for tally in tallies
        )
        some = tallies[0].gaps[..., 0].sum(axis=0) > 0
        some[0] = False
        assert some.sum() > 5
        assert (np.abs(one - two) < 5 * np.hypot(error_1, error_2))[some].all()


def test_skill_of_the_day() -> None:
    # One match, both at 50: the gap is that of two rounded normal numbers.
    season = Season(
        LeaguePlayers.of([60, 50], skill=[55, 50], day_sd=[8, 5]), "npl", "npl_8", weeks=1
    )
    points = np.arange(-60, 61)
    edges = np.arange(-60.5, 61)
    from scipy.special import ndtr

    one, two = (np.diff(ndtr(edges / sd)) for sd in (8, 5))
    gap = np.convolve(one, two[::-1])
    p = system_of("npl").scale.win_probability(5.0 + np.arange(-120, 121))
    wins = [sum(c for (a, _), c in scores(float(x), (4, 3)).items() if a == 4) for x in p]
    exact = gap @ np.array(wins)
    replicas = 200_000
    tally = run_chunk(season, replicas, SEED)
    assert len(points) == len(one)
    assert abs(tally.wins[0] / replicas - exact) < 4.5 * np.sqrt(exact * (1 - exact) / replicas)


def test_skills_drawn_anew_in_each_replica() -> None:
    season = Season(LeaguePlayers.of([60] * 10, skill_sd=6), "npl", weeks=1)
    tally = chunks(season, 1000, 5)
    at_start = tally.errors[0] / tally.errors[0].sum()
    variance = at_start @ tally.error_values**2
    assert abs(variance - 36 - 1 / 12) < 5 * 36 * np.sqrt(2 / 50_000)
    assert tally.fifths.sum(axis=0)[:, 0].tolist() == [10_000] * 5
    rates = tally.fifths.sum(axis=0)[:, 1] / 10_000
    assert (np.diff(rates) > 0).all()  # rated alike, the stronger win


def test_drift_leaves_ratings_behind() -> None:
    season = Season(LeaguePlayers.of([50, 60], drift=2.0), "npl", weeks=5)
    tally = run_chunk(season, 30, SEED)
    assert (tally.weeks[0, :, 1] / tally.weeks[0, :, 0]).tolist() == [0, -2, -4, -6, -8, -10]


def test_absent_players_miss_matches() -> None:
    season = Season(LeaguePlayers.of([50] * 8, absence=[0.5] + [0.0] * 7), "npl", weeks=40)
    tally = run_chunk(season, 500, SEED)
    many = 40 * 500
    assert abs(tally.matches[0] - many / 2) < 5 * np.sqrt(many / 4)
    assert tally.matches[1:].sum() - 7 * many == tally.matches[0] - many
    assert tally.wins.sum() * 2 == tally.matches.sum()
    assert tally.rating.sum() == 0


def test_comers_and_goers() -> None:
    club = LeaguePlayers.of([50, 60, 70, 80], joins=[1, 1, 3, 1], leaves=[0, 4, 0, 0])
    tally = run_chunk(Season(club, "npl", schedule=RandomPairing(), weeks=6), 10, SEED)
    # Three in weeks 1 and 2, four in 3 and 4, three again: 1 + 1 + 2 + 2 + 1 + 1 matches.
    assert tally.matches.sum() == 2 * 8 * 10
    assert tally.weeks[0, :, 0].tolist() == [30, 30, 30, 40, 40, 30, 30]
    by_turns = run_chunk(Season(club, "npl", schedule=RoundRobin(4), weeks=6), 10, SEED)
    assert by_turns.weeks[0, :, 0].tolist() == [30, 30, 30, 40, 40, 30, 30]
    assert by_turns.matches[2] == 40


def test_newcomers_take_longer_steps() -> None:
    club = LeaguePlayers.of([0, 60], skill=[0, 0], played=[0, 1_000_000])
    chunk = _Chunk(Season(club, "npl", weeks=40), 20, np.random.Generator(np.random.SFC64(1)))
    steps = []
    for week in range(1, 41):
        before = chunk.state.astype(np.int16)
        chunk.play(week)
        steps.append(np.abs(chunk.state.astype(np.int16) - before).T.tolist())
    assert steps == [[[3, 1]] * 20] * 10 + [[[2, 1]] * 20] * 20 + [[[1, 1]] * 20] * 10


def test_the_same_seed_gives_the_same_tally() -> None:
    season = Season(LeaguePlayers.of([50, 60, 70], day_sd=5), "npl", weeks=10)
    one, again = (run_chunk(season, 100, np.random.SeedSequence(3)) for _ in range(2))
    other = run_chunk(season, 100, np.random.SeedSequence(4))
    assert one.errors.tolist() == again.errors.tolist()
    assert one.errors.tolist() != other.errors.tolist()


def test_a_league_of_one_replica_in_many_blocks() -> None:
    season = Season(LeaguePlayers.of([50] * 40_001), "npl", schedule=RandomPairing(2), weeks=3)
    tally = run_chunk(season, 1, SEED)
    assert tally.matches.sum() == 6 * 40_000
    assert tally.wins.sum() == 3 * 40_000
    assert tally.wins_counts.sum() == 40_001
    assert tally.rating_counts is None  # a large table


def test_rating_errors_far_off_stand_at_the_ends() -> None:
    season = Season(LeaguePlayers.of([500, -500], skill=0), "npl", weeks=1)
    tally = run_chunk(season, 10, SEED)
    assert tally.errors[1, [0, -1]].tolist() == [10, 10]
    assert tally.errors.sum() == 40


@pytest.mark.parametrize("skill", [[1.5, 0.5], [900.0, 0.0], [0.49, 0.51]])
def test_gaps_of_any_size_are_looked_up(skill: list[float]) -> None:
    club = LeaguePlayers.of([60, 60], skill=skill, drift=[0.1, -0.1])
    tally = run_chunk(Season(club, "npl", weeks=8), 50, SEED)
    assert tally.gaps[..., 0].sum() == 400


def test_ratings_that_run_away_are_not_wrapped_round() -> None:
    season = Season(LeaguePlayers.of([15_000, 0]), "step 900 0", weeks=100)
    with pytest.raises(AccuracyError, match="a rating is beyond 16000 points"):
        run_chunk(season, 3, SEED)


def test_chunks_fit_the_cache_and_there_are_many_batches() -> None:
    season = Season(LeaguePlayers.of([50] * 64), "npl")
    parts = [tuple(batching_of(season, n)) for n in (1, 31, 64, 2000, 20_000, 10**6)]
    assert parts == [(1, 1024), (1, 1024), (3, 341), (100, 10), (1000, 1), (1024, 1)]
    large = dataclasses.replace(season, players=LeaguePlayers.of([50] * 10**5), schedule=None)
    assert batching_of(large, 100) == (1, 1)
    assert batching_of(dataclasses.replace(season, weeks=10_000), 2000) == (100, 1)


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("play", ["matches", "racks"])
@pytest.mark.parametrize("schedule", [RandomPairing(2), RoundRobin(7), None])
def test_batches_side_by_side_are_leagues_of_their_own(play: str, schedule) -> None:
    club = LeaguePlayers.of(
        [50, 60, 70, 80, 90, 55, 65],
        skill=[50, 60, 70, 80, 90, 80, 30],
        joins=[1, 1, 3, 1, 1, 1, 1],
        leaves=[0, 4, 0, 0, 0, 0, 0],
        absence=0.1,
        drift=0.5,
        day_sd=3.0,
        played=[0, 5, 10, 50, 50, 50, 50],
    )
    fixtures = schedule or FixedSchedule([1, 1, 4, 5, 5], [0, 1, 2, 5, 4], [1, 2, 3, 6, 0])
    season = Season(club, "npl", schedule=fixtures, weeks=6, play=play)
    one = run_chunk(season, 20, SEED, batches=60)
    many = chunks(season, 20, 60)
    assert one.replicas.tolist() == many.replicas.tolist()
    assert one.weeks[..., 0].tolist() == many.weeks[..., 0].tolist()
    for k, (above, below) in enumerate((("wins", 1200), ("wins", None), ("rating", 1200))):
        means = [getattr(t, above) / (below or t.matches) for t in (one, many)]
        off = np.hypot(one.player_errors()[k], many.player_errors()[k])
        assert (np.abs(means[0] - means[1]) <= 5 * off).all()
    assert one.gaps[..., 0].sum() == one.matches.sum() / 2
    assert one.fifths[..., 0].sum() == one.matches.sum()
    assert (one.gaps[..., 0].sum(axis=1) == one.fifths[..., 0].sum(axis=1) / 2).all()
    assert one.wins_counts.sum() == one.rating_counts.sum() == 7 * 1200
    assert (one.errors @ one.error_values).tolist() == one.weeks[..., 1].sum(axis=0).tolist()


def test_standard_errors_hold_where_replicas_share_their_opponents() -> None:
    # He who wins nearly all is met more often in one draw than in another.
    club = LeaguePlayers.of([60] * 8, skill=[150, *[60] * 7])
    season = Season(club, "npl", schedule=RandomPairing(), weeks=8)
    tallies = [run_chunk(season, 50, seed, batches=32) for seed in SEED.spawn(60)]
    for k, column in enumerate(
        (lambda t: t.wins / 1600, lambda t: t.wins / t.matches, lambda t: t.rating / 1600)
    ):
        means = np.array([column(tally) for tally in tallies])[:, 1:]
        stated = np.array([tally.player_errors()[k] for tally in tallies])[:, 1:]
        ratio = means.var(axis=0, ddof=1).mean() / (stated**2).mean()
        assert 0.7 < ratio < 1.4  # of 60 tallies, with 7 players who are hardly independent
        alone = np.mean([t.wins_squared / 1600 - (t.wins / 1600) ** 2 for t in tallies]) / 1600
        assert (stated[:, :] ** 2).mean() > (3 * alone if k == 0 else 0)


def test_a_player_has_the_errors_of_the_batches() -> None:
    season = Season(LeaguePlayers.of([50, 60, 70, 80], absence=0.3), "npl", weeks=6)
    seeds = SEED.spawn(40)
    each = [run_chunk(season, 20, seed) for seed in seeds]
    total = reduce(add, each)
    wins, matches, rating = (
        np.array([getattr(tally, name) for tally in each]) for name in ("wins", "matches", "rating")
    )
    points, chance, moved = total.player_errors()
    assert points == pytest.approx(wins.std(axis=0, ddof=1) / 20 / np.sqrt(40))
    assert moved == pytest.approx(rating.std(axis=0, ddof=1) / 20 / np.sqrt(40))
    assert chance == pytest.approx(total.mean_and_error(wins, matches)[1])
    assert np.isnan(each[0].player_errors()[0]).all()


class OwnDraw:
    """A schedule of one's own that draws as well: one round or two a week."""

    def pairs(self, week: int, rng: np.random.Generator, count: int) -> list:  # noqa: ARG002
        rounds = 1 + int(rng.integers(2))
        order = [rng.permutation(count) for _ in range(rounds)]
        return [(o[: count // 2], o[count // 2 :]) for o in order]


def test_a_schedule_of_ones_own_is_drawn_for_each_batch() -> None:
    season = Season(LeaguePlayers.of([50, 60, 70, 80]), "npl", schedule=OwnDraw(), weeks=5)
    tally = run_chunk(season, 3, SEED, batches=50)
    played = tally.weeks.shape[0], tally.fifths[..., 0].sum(axis=1) / 4 / 3
    assert played[0] == 50
    assert played[1].min() >= 5
    assert len(set(played[1].tolist())) > 2
    assert tally.wins.sum() * 2 == tally.matches.sum()
