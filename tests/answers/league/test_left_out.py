from evenbreak.answers.league.report import left_out
from evenbreak.ratings.results import Results
from leagues import league, sheet_of, two_groups


def items(season, *, shown=None, **how):
    """Return what is left out, without the reasons."""
    listed, in_table = shown or (None, None)
    sheet = sheet_of(season, **how)
    return [item.what for item in left_out(sheet, listed=listed, in_table=in_table)]


def test_forfeits_and_empty_scores_are_counted():
    season = Results.from_names(
        *(["Ann"] * 4, ["Bo"] * 4, [7, 0, 0, 0], [5, 0, 0, 0]),
        forfeit=[False, True, True, False],
    )
    assert items(season) == ["2 forfeited matches", "1 match at 0-0"]


def test_later_matches_are_counted():
    season = Results.from_names(
        *(["Ann"] * 2, ["Bo"] * 2, [7, 7], [5, 5]), date=["2024-09-03", "2024-09-10"]
    )
    assert items(season, as_of="2024-09-05") == ["1 later match"]


def test_players_without_results_are_named():
    names = [f"P{k}" for k in range(8)]
    season = Results.from_names(["Ann", *names], ["Bo", *["Ann"] * 8], [7] + [0] * 8, [5] + [0] * 8)
    sheet = sheet_of(season, players=["Ann", "Bo"])
    (idle,) = (item for item in left_out(sheet) if "without a result" in item.what)
    assert (idle.what[:9], list(idle.names)) == ("8 players", names)


def test_players_known_by_the_winner_alone_have_a_result():
    season = Results.from_names(
        *(["Ann", "Bo"], ["Bo", "Cy"], [7, 0], [5, 0]),
        race_a=[7, 7],
        race_b=[7, 7],
        winner=[1, 1],
        unscored=[False, True],
    )
    assert items(season) == []


def test_players_who_are_not_paired_are_counted():
    assert items(league(3), top=2) == ["the races for 1 rated player"]


def test_groups_are_counted_whether_they_are_paired_or_not():
    assert items(two_groups()) == ["the races for 4 pairs"]
    assert "comparisons between 2 groups of players" in items(two_groups(), players=["Ann", "Bo"])


def test_what_a_list_or_table_cuts_off_is_counted():
    assert items(league(5), shown=(4, 3)) == [
        "1 of 5 rated players",
        "the races for 2 of 5 paired players",
    ]
    assert items(league(5), shown=(5, 5)) == []
