import numpy as np
import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.why import why_answer
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings import Beginning, Levels, Results, fit
from leagues import two_groups

TO_SEVEN = OfferedRaces(race_to=7)
SEASON = Results.from_names(
    ["Ann", "Bo", "Ann", "Cy", "Bo"],
    ["Bo", "Cy", "Cy", "Ann", "Ann"],
    [7, 7, 7, 0, 7],
    [5, 4, 1, 0, 6],
    date=["2025-01-01", "2025-01-02", "2025-01-03", "2025-01-04", "2025-01-05"],
    forfeit=[False, False, False, True, False],
)


def why(season, pair=(0, 1), **how):
    file = ResultsFile(season, "season.csv", (), (), "")
    return why_answer(file, fit(season, **how), pair, TO_SEVEN, lambda other: fit(other, **how))


@pytest.mark.parametrize("how", [{}, {"half_life": 2.0, "as_of": "2025-01-05"}])
def test_a_match_is_worth_what_the_rating_loses_without_it(how):
    answer = why(SEASON, **how).to_dict()
    full = fit(SEASON, **how)
    rows = [(match["player"], match["date"]) for match in answer["matches"]]
    days = ["2025-01-01", "2025-01-03", "2025-01-05"]
    assert rows == [("Ann", day) for day in days] + [
        ("Bo", day) for day in ("2025-01-01", "2025-01-02", "2025-01-05")
    ]
    for match in answer["matches"]:
        without = fit(SEASON.select(SEASON.date != np.datetime64(match["date"])), **how)
        place = full.players.index(match["player"])
        assert match["worth"] == full.rating[place] - without.rating[place]
    first = answer["matches"][0]
    assert (first["opponent"], first["score"], first["result"]) == ("Bo", "7-5", "won")


def test_one_more_match_is_rated_exactly():
    answer = why(SEASON).to_dict()
    assert [one["winner"] for one in answer["one_more"]] == ["Ann", "Bo"]
    for one in answer["one_more"]:
        won, lost = map(int, one["score"].split("-"))
        score = (won, lost) if one["winner"] == "Ann" else (lost, won)
        then = fit(
            Results.from_names(
                ["Ann", "Bo", "Ann", "Bo", "Ann"],
                ["Bo", "Cy", "Cy", "Ann", "Bo"],
                [7, 7, 7, 7, score[0]],
                [5, 4, 1, 6, score[1]],
            )
        )
        assert (one["rating_a"], one["rating_b"]) == pytest.approx(tuple(then.rating[:2]))
    better, worse = answer["one_more"]
    assert better["rating_a"] > worse["rating_a"]
    assert better["rating_b"] < worse["rating_b"]
    assert answer["race_a"] >= answer["race_b"]


def test_players_who_never_met_anybody_in_common_have_matches_but_no_race():
    season = two_groups()
    answer = why(season, pair=(season.players.index("Ann"), season.players.index("Cy")))
    data = answer.to_dict()
    assert data["race_a"] is None
    assert data["one_more"] == []
    assert {match["player"] for match in data["matches"]} == {"Ann", "Cy"}
    assert "compared" in answer.sentences[0]


def test_a_match_known_by_its_winner_has_no_score():
    season = Results.from_names(
        ["Ann", "Bo"],
        ["Bo", "Ann"],
        [7, 0],
        [5, 0],
        race_a=[7, 7],
        race_b=[7, 7],
        winner=[1, 1],
        unscored=[False, True],
    )
    rows = [row for row in why(season).to_dict()["matches"] if row["player"] == "Ann"]
    assert [(row["score"], row["result"]) for row in rows] == [("7-5", "won"), (None, "lost")]


def test_a_rating_brought_along_is_one_of_the_sources():
    begin = Levels(beginning=Beginning(["Ann"], [90.0], [8.0]))
    sources = why(SEASON, levels=begin).to_dict()["sources"]
    assert [(one["player"], one["source"]) for one in sources] == [
        *(("Ann", source) for source in ("prior", "brought", "results")),
        *(("Bo", source) for source in ("prior", "results")),
    ]
    brought = sources[1]
    assert (brought["rating"], brought["standard_error"]) == pytest.approx((90.0, 8.0))
    assert 0.0 < brought["weight"] < 1.0
