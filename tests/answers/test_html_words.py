import dataclasses

from evenbreak.answers.fair_pairs import RaceLimits, matchups_frame
from evenbreak.answers.frames import ratings_frame
from evenbreak.answers.html_words import about_model, how_sure, left_out_and_why, three_pairs
from evenbreak.answers.sheet_parts import sure_pairs
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results

LIMITS = RaceLimits(race_to=7)


def told(season, chosen=None, warnings=()):
    ratings = fit(season)
    chosen = range(len(ratings.players)) if chosen is None else chosen
    paired = matchups_frame(ratings, chosen, LIMITS)
    file = ResultsFile(season, "r.csv", warnings, (), "0" * 64)
    shown = len(ratings.players), len({*paired["player_a"], *paired["player_b"]})
    found = left_out_and_why(file, ratings, ratings_frame(ratings), paired, shown)
    return {item.what: item.why for item in found}


def test_forfeits_and_empty_scores_are_counted():
    season = Results.from_names(
        *(["Ann"] * 4, ["Bo"] * 4, [7, 0, 0, 0], [5, 0, 0, 0]),
        forfeit=[False, True, True, False],
    )
    assert list(told(season)) == ["2 forfeited matches", "1 match at 0-0"]


def test_many_players_without_games_are_cut():
    names = [f"P{k}" for k in range(8)]
    season = Results.from_names(["Ann", *names], ["Bo", *["Ann"] * 8], [7] + [0] * 8, [5] + [0] * 8)
    (idle,) = (what for what in told(season, [0, 1]) if "without a result" in what)
    assert idle.startswith("8 players without a result: ")
    assert idle.endswith(" and 3 more")


def test_who_is_not_paired_is_counted():
    season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 5])
    assert told(season, [0, 1]) == {"the races of 1 rated player": "not chosen to be paired"}


def test_groups_that_are_not_paired_are_told_too():
    season = Results.from_names(["Ann", "Cy"], ["Bo", "Di"], [7, 7], [5, 5])
    assert "comparisons between 2 groups of players" in told(season, [0, 1])
    assert "the races of 4 pairs" in told(season)


def test_one_pair_is_no_half_of_the_pairs():
    season = Results.from_names(["Ann"], ["Bo"], [7], [5])
    ratings = fit(season)
    pairs = sure_pairs(ratings, matchups_frame(ratings, [0, 1], LIMITS))
    _, sentence = how_sure(ratings, pairs)
    assert sentence.startswith("The difference of the two ratings is known to within ")
    assert f" {2 * pairs[0].error:.1f} points" in sentence
    assert [name for name, _ in three_pairs(pairs)] == [""]
    assert three_pairs([]) == []
    assert len(list(how_sure(ratings, []))) == 1


def test_the_model_is_the_one_that_was_used():
    ratings = fit(Results.from_names(["Ann"], ["Bo"], [7], [5]), scale="fargo", prior_sd=0.5)
    assert "1/(1 + 2^(−d/100))" in about_model(ratings)
    assert "early and late matches of the file alike, whoever breaks" in about_model(ratings)
    assert "500 ± 72.13 (normal prior" in about_model(ratings)
    aged = dataclasses.replace(ratings, half_life=90.0, break_advantage=12.34)
    assert "90 days old counting half, who breaks playing 12.3 points better" in about_model(aged)


def test_who_is_known_by_matches_won_alone_is_not_without_a_result():
    season = Results.from_names(
        ["Ann", "Bo"],
        ["Bo", "Cy"],
        [7, 0],
        [5, 0],
        race_a=[7, 7],
        race_b=[7, 7],
        winner=[1, 1],
        unscored=[False, True],
    )
    assert not fit(season).idle.any()
    assert told(season) == {}
    assert "on games, and on the chance of a race where only" in about_model(fit(season))
