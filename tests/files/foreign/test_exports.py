"""Tournaments as other programs save them; every file is made here by hand."""

import json

import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.results_file import read_results
from evenbreak.ratings.fit import fit


@pytest.fixture
def read(tmp_path):
    def read_content(data, name="export.txt", encoding="utf-8"):
        path = tmp_path / name
        text = data if isinstance(data, str) else json.dumps(data, indent=1)
        path.write_bytes(text.encode(encoding))
        return read_results(path)

    return read_content


def refused(read, data):
    with pytest.raises(DataError) as caught:
        read(data)
    (problem,) = caught.value.problems
    return problem.rpartition("export.txt")[2]


def matches(file):
    results = file.results
    counts = zip(results.score_a, results.score_b, *results.races, strict=True)
    return [
        (results.players[a], results.players[b], *map(int, numbers))
        for a, b, numbers in zip(results.player_a, results.player_b, counts, strict=True)
    ]


# CueScore


def cue(a, b, score, *, race=7, starts=(0, 0), status="finished", **more):
    return {
        "matchId": 1,
        "matchno": 1,
        "round": 1,
        "roundName": "Round 1",
        "playerA": {"playerId": 11, "name": a},
        "playerB": {"playerId": 12, "name": b},
        "scoreA": score[0],
        "scoreB": score[1],
        "raceTo": race,
        "handicapA": starts[0],
        "handicapB": starts[1],
        "table": {"name": "3"},
        "starttime": "2024-09-03T19:30:00",
        "stoptime": "2024-09-03T20:15:00",
        "matchstatus": status,
        **more,
    }


def cuescore(*played, **more):
    top = {"tournamentId": 5, "name": "Club Cup", "format": 2, "defaultRaceTo": 7, **more}
    return {**top, "matches": list(played)}


def test_a_match_of_cuescore(read):
    file = read(cuescore(cue("Ann  Lee", "Bo", (7, 5))))
    assert matches(file) == [("Ann Lee", "Bo", 7, 5, 7, 7)]
    assert str(file.results.date[0]) == "2024-09-03"
    assert list(file.results.event) == ["Club Cup"]
    assert file.warnings == ()


def test_a_time_of_cuescore_that_is_no_date_is_counted(read):
    one = cue("Ann", "Bo", (7, 5), starttime="last Tuesday", stoptime=None)
    file = read(cuescore(one, cue("Ann", "Bo", (7, 2), starttime="?")))
    assert [str(date) for date in file.results.date] == ["NaT", "2024-09-03"]
    assert any("1 match" in warning and "date" in warning for warning in file.warnings)


@pytest.mark.parametrize(
    ("score", "starts", "left"),
    [
        ((7, 5), (2, 0), (5, 5, 5, 7)),
        ((7, 5), (0, 2), (7, 3, 7, 5)),
        ((6, 7), (2, 1), (4, 6, 5, 6)),
        ((7, 5), (-2, 0), (9, 5, 9, 7)),
        ((7, 5), ("2", "0"), (5, 5, 5, 7)),
        ((7, 5), (None, None), (7, 5, 7, 7)),
    ],
)
def test_a_head_start_is_in_score_and_race_and_is_taken_out_of_both(read, score, starts, left):
    file = read(cuescore(cue("Ann", "Bo", score, starts=starts)))
    assert matches(file) == [("Ann", "Bo", *left)]
    assert len(file.warnings) == any(str(start) not in ("0", "None") for start in starts)


def test_head_starts_come_out_right_in_the_ratings(read, tmp_path):
    # Ann starts at 2 in races to 7, so 7-5 was 5 games each: the two are equal.
    file = read(cuescore(*[cue("Ann", "Bo", (7, 5), starts=(2, 0)) for _ in range(20)]))
    ratings = fit(file.results)
    assert ratings.rating[0] == pytest.approx(ratings.rating[1], abs=1e-9)
    by_hand = tmp_path / "hand.csv"
    rows = "Ann,Bo,5,5,5,7\n" * 20
    by_hand.write_text(f"player_a,player_b,score_a,score_b,race_a,race_b\n{rows}")
    assert ratings.rating == pytest.approx(fit(read_results(by_hand).results).rating)


def test_what_was_not_played_in_cuescore_is_left_out_and_counted(read):
    file = read(
        cuescore(
            cue("Ann", "Bo", (7, 5)),
            cue("Ann", "Walk Over", (7, 0)),
            cue("Ann", "BYE", (0, 0)),
            cue("Ann", "", (0, 0), status="waiting"),
            cue("", "", (0, 0), status="waiting"),
            cue("Ann", "Cy", (3, 2), status="playing"),
            cue("Di", "Cy", (0, 0)),
            cue("Di", "Bo", (7, 0), starts=(0, 2)),
            cue("Di", "Cy", (None, None)),
        )
    )
    assert len(file.results) == 3
    assert list(file.results.forfeit) == [False, True, True]
    (warning,) = file.warnings
    assert "read 3 matches; left out: 3 byes, 2 matches that were not finished, 1 match" in warning
    assert "2 forfeits" in warning
    assert file.lines.tolist() == [1, 7, 8]


@pytest.mark.parametrize("score", [(5, 3), (9, 5), (6, 6)])
def test_a_score_that_does_not_end_its_race_is_read_without_it(read, score):
    file = read(cuescore(cue("Ann", "Bo", score)))
    assert matches(file) == [("Ann", "Bo", *score, 0, 0)]
    assert "doesn't complete its race" in file.warnings[0]


def test_the_race_of_the_tournament_is_that_of_its_matches(read):
    match = cue("Ann", "Bo", (7, 5))
    del match["raceTo"]
    assert matches(read(cuescore(match))) == [("Ann", "Bo", 7, 5, 7, 7)]
    assert matches(read(cuescore(match, defaultRaceTo=None))) == [("Ann", "Bo", 7, 5, 0, 0)]


@pytest.mark.parametrize(
    ("match", "told"),
    [
        (cue("Ann", "Bo", (7, 1), starts=(0, 2)), ":1: match 1 (Ann, Bo) has a head start of 0-2"),
        (cue("Ann", "Bo", (7, 5), starts=(7, 0)), "a head start of 7-0"),
        (cue("Ann", "Bo", (7, "x")), ":1: match 1 has scoreB 'x'"),
        (cue("Ann", "Bo", (7, 2.5)), "has scoreB 2.5"),
        (cue("Ann", "Bo", (7, True)), "has scoreB True"),
        (
            cue("Ann", "Bo", (float("inf"), 1)),
            "match 1 has scoreA inf, which isn't a whole number",
        ),
        (cue(7, "Bo", (7, 5)), "has no name for player A"),
        (cue("An\ud800", "Bo", (7, 5)), "can't be printed"),
        (cue("Ann", "Ann", (7, 5)), "'Ann' is on both sides"),
        (
            cue("Ann", "Bo", (7, 5), status="waiting"),
            "has no matches that were played; left out: 1",
        ),
        (None, "doesn't have the expected structure"),
        ([], "doesn't have the expected structure"),
    ],
)
def test_what_is_wrong_in_a_cuescore_file_is_one_problem(read, match, told):
    assert told in refused(read, cuescore(match))


# Challonge


def challonge(*played, people=None, **more):
    if people is None:
        people = [{"id": 1, "seed": 1, "name": "Ann"}, {"id": 2, "seed": 2, "name": "Bo"}]
    tournament = {
        "id": 9,
        "name": "Weekly",
        "participants": [{"participant": person} for person in people],
        "matches": [{"match": match} for match in played],
        **more,
    }
    return {"tournament": tournament}


def bout(scores, winner=1, **more):
    return {
        "identifier": "A",
        "round": 1,
        "player1_id": 1,
        "player2_id": 2,
        "winner_id": winner,
        "scores_csv": scores,
        "state": "complete",
        "completed_at": "2024-09-03T23:10:00.000-05:00",
        "player1_prereq_match_id": None,
        **more,
    }


def test_a_match_of_challonge(read):
    file = read(challonge(bout("7-5")))
    assert matches(file) == [("Ann", "Bo", 7, 5, 0, 0)]
    assert list(file.results.winner) == [1]
    assert str(file.results.date[0]) == "2024-09-03"
    assert file.warnings == ()


def test_participants_may_stand_bare_and_have_other_numbers_in_groups(read):
    people = [
        {"id": 1, "display_name": "Ann", "group_player_ids": [71]},
        {"id": 2, "name": "", "username": "Bo", "group_player_ids": [72]},
    ]
    data = challonge(people=people)
    data["tournament"]["participants"] = people
    data["tournament"]["matches"] = [bout("3-7", 72, player1_id=71, player2_id=72)]
    assert matches(read(data)) == [("Ann", "Bo", 3, 7, 0, 0)]


def test_sets_are_matches_of_their_own(read):
    file = read(challonge(bout("3-1,2-3, 3-1")))
    assert matches(file) == [("Ann", "Bo", *s, 0, 0) for s in ((3, 1), (2, 3), (3, 1))]
    assert file.lines.tolist() == [1, 1, 1]
    (warning,) = file.warnings
    assert "3 sets" in warning


def test_a_handicap_race_won_with_fewer_games_is_read_without_its_winner(read):
    file = read(challonge(bout("5-6", winner=1)))
    assert matches(file) == [("Ann", "Bo", 5, 6, 0, 0)]
    assert list(file.results.winner) == [0]
    assert "fewer games" in file.warnings[0]


def test_what_was_not_played_in_challonge_is_left_out_and_counted(read):
    file = read(
        challonge(
            bout("7-5"),
            bout("", state="open"),
            bout(None, state="pending", player2_id=None),
            bout("", player2_id=None),
            bout(""),
            bout("0-0"),
            bout("0--1"),
            bout("7-0", forfeited=True, completed_at=None),
        )
    )
    assert list(file.results.forfeit) == [False, True, True]
    (warning,) = file.warnings
    assert (
        "left out: 1 bye, 2 matches that were not finished, 2 matches finished without" in warning
    )
    assert "2 forfeits" in warning


@pytest.mark.parametrize(
    ("data", "told"),
    [
        ([{"match": bout("7-5")}], "holds no participants"),
        (challonge(bout("7-5"), people=[]), "holds no participants"),
        ({"tournament": {"participants": [{"id": 1}]}}, "holds no matches"),
        (challonge(bout("7:x")), "has the score '7:x'"),
        (challonge(bout("7-5", player1_id=99)), "number 99"),
        (challonge(bout("7-5"), people=[{"name": "Ann"}]), "doesn't have the expected structure"),
        (challonge(bout(7)), "doesn't have the expected structure"),
        (challonge(), "has no matches that were played"),
    ],
)
def test_what_is_wrong_in_a_challonge_file_is_one_problem(read, data, told):
    assert told in refused(read, data)


# brackets-manager


def side(number, score=None, result=None, **more):
    return {"id": number, "position": 1, "score": score, "result": result, **more}


def duel(one, two, status=4):
    return {
        "id": 0,
        "stage_id": 0,
        "number": 1,
        "status": status,
        "opponent1": one,
        "opponent2": two,
    }


def brackets(*played, plural=False):
    ending = "s" if plural else ""
    return {
        f"participant{ending}": [{"id": 0, "name": "Ann"}, {"id": 1, "name": "Bo"}],
        f"stage{ending}": [{"id": 0, "name": "Main", "type": "double_elimination"}],
        f"group{ending}": [],
        f"round{ending}": [],
        f"match{'es' * plural}": list(played),
    }


@pytest.mark.parametrize("plural", [False, True])
@pytest.mark.parametrize("status", [4, 5, "completed", "Archived"])
def test_a_match_of_brackets_manager(read, plural, status):
    file = read(brackets(duel(side(0, 7, "win"), side(1, 5, "loss"), status), plural=plural))
    assert matches(file) == [("Ann", "Bo", 7, 5, 0, 0)]
    assert list(file.results.winner) == [1]
    assert list(file.results.event) == ["Main"]
    assert file.warnings == ()


def test_what_was_not_played_in_brackets_manager_is_left_out_and_counted(read):
    file = read(
        brackets(
            duel(side(0, 7, "win"), side(1, 5, "loss")),
            duel(side(0), None),
            duel(None, None),
            duel({"id": None}, side(1), 1),
            duel(side(0, 3), side(1, 2), 3),
            duel(side(0, None, "win"), side(1, None, "loss")),
            duel(side(0, None, "win"), side(1, None, None, forfeit=True)),
            duel(side(0, 4, "win"), side(1, 5, "loss")),
        )
    )
    assert list(file.results.forfeit) == [False, True, False]
    (warning,) = file.warnings
    assert "left out: 2 byes, 2 matches that were not finished, 1 match finished" in warning
    assert "1 forfeit" in warning
    assert "fewer games" in warning


@pytest.mark.parametrize(
    ("match", "told"),
    [
        (duel(side(8, 7, "win"), side(1, 5)), "number 8"),
        (duel(side(0, -7, "win"), side(1, 5)), "has score -7"),
        (duel(7, side(1, 5)), "doesn't have the expected structure"),
    ],
)
def test_what_is_wrong_in_a_brackets_manager_file_is_one_problem(read, match, told):
    assert told in refused(read, brackets(match))


# any of them


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize("indent", [None, 4])
def test_encodings_and_names_of_files_do_not_matter(read, encoding, indent):
    text = json.dumps(cuescore(cue("Zoë", "Bo", (7, 5))), indent=indent, ensure_ascii=False)
    assert matches(read(text, "results.csv", encoding)) == [("Zoë", "Bo", 7, 5, 7, 7)]


@pytest.mark.parametrize(
    "data",
    [
        cuescore(cue("Ann", "Bo", (7, 5))),
        challonge(bout("7-5")),
        brackets(duel(side(0, 7, "win"), side(1, 5, "loss"))),
    ],
)
def test_a_file_that_was_cut_off_is_one_problem(read, data):
    text = json.dumps(data, indent=1)
    for length in range(6, len(text) - 1, 7):
        assert "is damaged JSON" in refused(read, text[:length])


@pytest.mark.parametrize("data", ["{}", "[]", '{"a": 1}', "[{}]", '[{"a": 1}]', '{"matches": 3}'])
def test_other_json_is_refused_by_name(read, data):
    assert "is JSON, but not a tournament saved from CueScore" in refused(read, data)


def test_a_csv_file_may_begin_with_a_bracket(read):
    file = read('[note],player_a,player_b,score_a,score_b\n"{x}",Ann,Bo,7,5\n')
    assert matches(file) == [("Ann", "Bo", 7, 5, 0, 0)]
