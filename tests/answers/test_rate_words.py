import numpy as np
import pytest

from evenbreak.answers.rate_frames import pairs_frame, rate_frame
from evenbreak.answers.rate_words import connection_words, pair_rows, rate_rows, rate_words
from evenbreak.ratings import PriorChoice, Results, fit


def groups(number):
    names = [f"p{k}" for k in range(2 * number)]
    scores = [7] * number
    return Results.from_names(names[::2], names[1::2], scores, scores)


def test_many_groups_are_told_by_their_largest():
    assert connection_words(fit(groups(1))) == []
    assert "of 2, 2 and 2:" in connection_words(fit(groups(3)))[0]
    assert "of 2, 2, 2, 2, 2 and 2:" in connection_words(fit(groups(6)))[0]
    assert "of 2, 2, 2, 2, 2, 2 and 3 more:" in connection_words(fit(groups(9)))[0]


def test_words_tell_what_the_ratings_rest_on():
    season = Results.from_names(
        ["A", "B", "A", "A"],
        ["B", "C", "C", "B"],
        [7, 7, 0, 0],
        [5, 2, 0, 0],
        date=["2026-01-01", "2026-01-02", "2026-01-03", "2026-01-04"],
        forfeit=[False, False, True, False],
        break_format=[4, 5, 4, 4],
    )
    ratings = fit(
        season, half_life=30, as_of="2026-01-04", break_advantage=3, anchor={"A": 90, "B": 80}
    )
    choice = PriorChoice(ratings.prior_sd, (ratings.prior_sd, 1.0), (0.6, 0.7), 1200)
    assert rate_words(ratings, choice) == [
        "3 players, 2 matches with 21 games; left out: 1 forfeit, 1 at 0-0.",
        "On an NPL-like scale (30 points double the odds).",
        "Before any result: standard deviation 30.0 points.",
        "Of 2 such deviations this one (the last tried) predicted 1,200 later results best.",
        "Anchored at A 90, B 80 on average.",
        "A match counts half after 30 days: all that was played counts as 19.8 new games.",
        "The breaker plays +3.0 points better, as given.",
    ]


def test_players_without_games_are_not_counted_among_those_who_played():
    ratings = fit(Results.from_names(["A", "A"], ["B", "C"], [7, 7], [5, 0], forfeit=[False, True]))
    assert rate_words(ratings)[0].startswith("2 players, 1 match with 12 games")
    assert connection_words(ratings) == [
        "1 player has no games that count; the rating is the prior's."
    ]


def test_columns_that_tell_nothing_are_not_shown():
    ratings = fit(Results.from_names(["A"], ["B"], [7], [5]))
    assert rate_rows(rate_frame(ratings))[0] == [
        "player",
        "rating",
        "give or take",
        "games",
        "won",
        "lost",
    ]
    assert rate_rows(rate_frame(fit(groups(2))))[0][-1] == "group"


def test_frames_put_numbers_with_their_players():
    rng = np.random.default_rng(1)
    a = rng.integers(0, 6, 30)
    b = (a + rng.integers(1, 6, 30)) % 6
    ones, none = np.ones(30), np.zeros(30)
    results = Results(
        tuple("FEDCBA"), a, b, none, none, race_a=ones, race_b=ones, winner=ones, unscored=ones
    )
    ratings = fit(results)
    for row in rate_frame(ratings).itertuples():
        k = ratings.players.index(row.player)
        assert (row.races_won, row.races_lost) == ((a == k).sum(), (b == k).sum())
        assert row.rating == ratings.rating[k]
    frame = pairs_frame(ratings, [(0, 3)])
    assert frame["standard_error"][0] == pytest.approx(ratings.difference_error("F", "C"))
    assert pair_rows(frame)[1][:2] == ["F", "C"]
