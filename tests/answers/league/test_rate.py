"""The ratings of a league as an answer: numbers with their players, and what they rest on."""

import numpy as np
import pytest

from evenbreak.answers.league.prior import choice_words, prior_words
from evenbreak.answers.league.rate import rate_answer, unlinked_words
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings import PriorChoice, Results, fit


def answer_of(results, choice=None, *, pairs=(), **options):
    file = ResultsFile(results, "season.csv", ("season.csv:3: look at this",), (), "")
    return rate_answer(file, fit(results, **options), choice, pairs=pairs)


def groups(number):
    names = [f"p{k}" for k in range(2 * number)]
    return Results.from_names(names[::2], names[1::2], [7] * number, [7] * number)


@pytest.fixture
def winners_only():
    rng = np.random.default_rng(1)
    a = rng.integers(0, 6, 30)
    b = (a + rng.integers(1, 6, 30)) % 6
    ones, none = np.ones(30), np.zeros(30)
    return Results(
        tuple("FEDCBA"), a, b, none, none, race_a=ones, race_b=ones, winner=ones, unscored=ones
    )


def test_every_player_has_their_own_numbers(winners_only):
    ratings = fit(winners_only)
    players = answer_of(winners_only).to_dict()["players"]
    assert len(players) == 6
    for row in players:
        k = ratings.players.index(row["player"])
        assert row["races_won"] == (winners_only.player_a == k).sum()
        assert row["races_lost"] == (winners_only.player_b == k).sum()
        assert (row["rating"], row["quasi_error"]) == (ratings.rating[k], ratings.quasi_error[k])
    assert [row["rating"] for row in players] == sorted(
        (r["rating"] for r in players), reverse=True
    )


def test_the_first_sentence_names_the_highest_rating(winners_only):
    answer = answer_of(winners_only)
    best = answer.to_dict()["players"][0]
    assert best["player"] in answer.sentences[0]
    assert f"{best['rating']:.1f}" in answer.sentences[0]


def test_groups_follow_each_other_the_largest_first():
    season = Results.from_names(["A", "C", "D"], ["B", "D", "E"], [7, 7, 7], [2, 3, 6])
    players = answer_of(season).to_dict()["players"]
    assert [row["component"] for row in players] == [1, 1, 1, 2, 2]


def test_many_groups_are_listed_by_the_largest():
    assert list(unlinked_words(fit(groups(1)))) == []
    assert "(2, 2 and 2)" in next(unlinked_words(fit(groups(3))))
    assert "(2, 2, 2, 2, 2, 2 and 3 more)" in next(unlinked_words(fit(groups(9))))


def test_players_without_games_are_counted_apart():
    results = Results.from_names(["A", "A"], ["B", "C"], [7, 7], [5, 0], forfeit=[False, True])
    answer = answer_of(results)
    assert "2 players, 1 match, 12 games (left out: 1 forfeit)" in answer.heading
    assert any("1 player has no games" in sentence for sentence in answer.sentences)


@pytest.mark.parametrize(
    ("results", "shown"),
    [
        (groups(1), ["player", "rating", "±", "games", "won", "lost"]),
        (groups(2), ["player", "rating", "±", "games", "won", "lost", "group"]),
    ],
)
def test_columns_that_say_nothing_are_not_shown(results, shown):
    table = answer_of(results).parts[-1]
    assert [column.words for _, column in table.shown()] == shown


def test_a_pair_has_the_error_of_its_difference(winners_only):
    ratings = fit(winners_only)
    answer = answer_of(winners_only, pairs=[(0, 3), (3, 0)])
    one, other = answer.to_dict()["pairs"]
    assert one["standard_error"] == pytest.approx(ratings.difference_error("F", "C"))
    assert one["difference"] == -other["difference"]
    first, second = answer.sentences[0].split("\n")
    assert first == second  # whoever is named first, the stronger leads the sentence


def test_a_pair_that_nothing_links_has_no_numbers():
    answer = answer_of(groups(2), pairs=[(0, 2)])
    (pair,) = answer.to_dict()["pairs"]
    assert (pair["difference"], pair["standard_error"], pair["p_game_a"]) == (None, None, None)
    assert pair["note"] in answer.sentences[0]


def test_what_was_asked_for_is_said():
    season = Results.from_names(
        ["A", "B", "A", "A"], ["B", "C", "C", "B"], [7, 7, 0, 0], [5, 2, 0, 0],
        date=["2026-01-01", "2026-01-02", "2026-01-03", "2026-01-04"],
        forfeit=[False, False, True, False], break_format=[4, 5, 4, 4],
    )  # fmt: skip
    answer = answer_of(
        season,
        half_life=30,
        as_of="2026-01-04",
        break_advantage=3,
        anchor={"A": 90, "B": 80},
    )
    said = " ".join(answer.sentences)
    for figure in (
        "A has 90 and B has 80",
        "30 days",
        "worth 20 recent games",
        "3.0 points higher",
    ):
        assert figure in said
    data = answer.to_dict()
    assert (data["anchored_at"], data["half_life_days"]) == ({"A": 90, "B": 80}, 30)
    assert (data["forfeits_left_out"], data["empty_left_out"]) == (1, 1)
    assert data["played_by_weight"] == pytest.approx(19.8, abs=0.05)
    assert data["warnings"] == ["season.csv:3: look at this"]


LEARNED = (0.4, 0.6, True, 0.61)
"""The range of a prior, that it was learned, and the loss as it went."""


def test_a_prior_at_the_edge_of_those_tried_is_marked():
    ratings = fit(groups(1), prior_sd=0.5)
    inside = choice_words(
        ratings, PriorChoice(0.5, (0.3, 0.5, 1.0), (0.7, 0.6, 0.7), 1200, *LEARNED)
    )
    edge = choice_words(ratings, PriorChoice(0.5, (0.2, 0.3, 0.5), (0.8, 0.7, 0.6), 1200, *LEARNED))
    assert "21.6 points" in inside
    assert "1,200" in inside
    assert edge.startswith(inside)
    assert "largest" in edge
    assert "21.6 points" in prior_words(ratings)
