"""Tournaments saved from other programs: their brackets and results, match by match.

The files in saved/ come from brackets-manager, which played them out by itself.
"""

import json

import pytest

from evenbreak.answers.tournament.printed import tournament_matches_answer
from evenbreak.errors import DataError
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Plan
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.outlook import Outlook
from tournament_nights import AT, SAVED, imported, night

PLAN = Plan("imported", 5, scale="fargo", starter=500.0, tables=3)


@pytest.mark.parametrize("name", ["double12", "double8_all", "single8", "rr5"])
def test_brackets_manager_match_by_match(name: str) -> None:
    path = SAVED / f"brackets_manager_{name}.json"
    data = json.loads(path.read_text())
    state = imported(path)
    names = {one["id"]: one["name"] for one in data["participant"]}
    ready, decided = set(), []
    for one in data["match"]:
        sides = one["opponent1"], one["opponent2"]
        if None in sides or None in [side["id"] for side in sides]:
            continue
        pair = frozenset(names[side["id"]] for side in sides)
        if one["status"] in (2, 3):  # ready or running
            ready.add(pair)
        elif one["status"] >= 4:
            decided.append((pair, names[sides[sides[0]["result"] != "win"]["id"]]))
    assert {frozenset(state.pair(match)) for match in state.standing.to_play} == ready
    assert sorted((sorted(pair), won) for pair, won in decided) == sorted(
        (sorted(one.players), one.winner) for one in state.counted.values()
    )
    assert state.entrants["Player 1"].rating == 600.0
    assert {one.rating for one in state.entrants.values()} == {500.0, 600.0}


def cuescore(state: Evening) -> dict[str, object]:
    numbers = {match.name: k for k, match in enumerate(state.bracket.matches, 1)}
    matches = []
    for match in state.bracket.matches:
        seats = [
            {"playerId": 0, "name": ""} if k is None else {"playerId": k, "name": state.order[k]}
            for k in state.standing.seats[match.name]
        ]
        result = state.counted.get(match.name)
        score = (0, 0) if result is None else [result.games[one["name"]] for one in seats]
        onward = {
            slot.outcome: numbers[later.name]
            for later in state.bracket.matches
            for slot in later.slots
            if isinstance(slot, Source) and slot.match == match.name
        }
        day = f"2024-09-03T{19 + numbers[match.name] // 60}:{numbers[match.name] % 60:02d}"
        matches.append(
            {
                "matchId": 1000 + numbers[match.name],
                "matchno": numbers[match.name],
                "round": -match.round if match.side == "losers" else match.round,
                "playerA": seats[0],
                "playerB": seats[1],
                "scoreA": score[0],
                "scoreB": score[1],
                "raceTo": 5,
                "table": {"name": "Table 2"},
                "starttime": f"{day}:00" if result else "",
                "stoptime": f"{day}:30" if result else "",
                "matchstatus": "finished" if result else "waiting",
                "winnerNext": onward.get("winner", ""),
                "loserNext": onward.get("loser", ""),
            }
        )
    top = {"tournamentId": 5, "name": "Cup", "format": 2, "discipline": "8-Ball"}
    return {**top, "defaultRaceTo": 5, "matches": matches}


def challonge(state: Evening) -> dict[str, object]:
    ids = {match.name: 100 + k for k, match in enumerate(state.bracket.matches)}
    people = {name: 7 + k for k, name in enumerate(state.order)}
    matches = []
    for match in state.bracket.matches:
        if match.name == "F2" and None in state.standing.seats["F2"]:
            continue  # it is not there until it is needed
        one: dict[str, object] = {"id": ids[match.name], "identifier": match.name}
        one["round"] = -match.round if match.side == "losers" else match.round
        for k, (slot, seat) in enumerate(
            zip(match.slots, state.standing.seats[match.name], strict=True), 1
        ):
            one[f"player{k}_id"] = None if seat is None else people[state.order[seat]]
            if isinstance(slot, Source):
                one[f"player{k}_prereq_match_id"] = ids[slot.match]
                one[f"player{k}_is_prereq_match_loser"] = slot.outcome == "loser"
        result = state.counted.get(match.name)
        one["state"] = "complete" if result else "open"
        if result:
            a, b = (state.order[k] for k in state.standing.seats[match.name] if k is not None)
            one["scores_csv"] = f"{result.games[a]}-{result.games[b]}"
            one["winner_id"] = people[result.winner]
        matches.append({"match": one})
    persons = [
        {"participant": {"id": number, "seed": k, "name": name}}
        for k, (name, number) in enumerate(people.items(), 1)
    ]
    inside = {
        "name": "Cup",
        "tournament_type": "double elimination" if "L1.1" in ids else "single elimination",
        "grand_finals_modifier": None if "F2" in ids else "single match",
        "participants": persons,
        "matches": matches,
    }
    return {"tournament": inside}


@pytest.mark.parametrize("program", [cuescore, challonge])
@pytest.mark.parametrize(
    ("players", "form", "plan"),
    [
        (8, "double", {"final": "single"}),
        (11, "double", {"qualifiers": 4}),
        (6, "single", {"third_place": True}),
        (8, "double", {}),
    ],
)
def test_what_was_saved_is_read(tmp_path, program, players, form, plan):
    path = tmp_path / "cup.json"
    for results in (0, 7, 99):
        state = night(players, form, results, **plan)
        if program is cuescore and "F2" in state.bracket.by_name:
            return  # it has no second finals
        path.write_text(json.dumps(program(state)))
        again = imported(path, race=0 if program is cuescore else 5)
        assert again.plan.race == 5

        assert _ready(again) == _ready(state)
        assert _decided(again) == _decided(state)
        assert [*map(str, again.bracket.places)] == [*map(str, state.bracket.places)]
        assert _title(again) == pytest.approx(_title(state))


def _ready(state: Evening) -> set[frozenset[str]]:
    return {frozenset(state.pair(name)) for name in state.standing.to_play}


def _decided(state: Evening) -> list[tuple[list[str], str, int]]:
    each = state.counted.values()
    return sorted((sorted(one.players), one.winner, one.games[one.loser]) for one in each)


def _title(state: Evening) -> dict[str, float]:
    return dict(zip(state.order, Outlook(state, AT).odds.title.tolist(), strict=True))


def test_times_tables_and_the_game_are_those_of_cuescore(tmp_path):
    path = tmp_path / "cup.json"
    path.write_text(json.dumps(cuescore(night(8, "double", 3, final="single"))))
    state = imported(path, race=0)
    assert (state.plan.discipline, state.plan.tables) == ("8-ball", 1)
    assert state.events[0].at == "2024-09-03T19:01:00"
    assert all(one.call.table == 1 for one in state.calls.values())
    assert len(state.calls) == 3


def test_head_starts_of_cuescore_are_taken_out(tmp_path):
    data = cuescore(night(4, "single", 99))
    for one, start, score in zip(data["matches"], (0, 2, 3), ((5, 1), (4, 5), (5, 3)), strict=True):
        one |= {"handicapA": 0, "handicapB": start, "scoreA": score[0], "scoreB": score[1]}
    one = data["matches"][1]
    data["matches"][2]["playerB"] = one["playerB"]
    path = tmp_path / "cup.json"
    path.write_text(json.dumps(data))
    state = imported(path, race=0)
    second, final = state.counted["W1.2"], state.counted["F"]
    assert (second.score, second.winner) == ((4, 3), second.players[1])
    assert (state.needed("W1.2", second.players), state.needed("W1.2", second.players[::-1])) == (
        (5, 3),
        (3, 5),
    )
    assert (final.score, final.race) == ((5, 0), (5, 2))
    rows = tournament_matches_answer(state, "cup").to_frame().set_index("match")
    row = rows.loc[state.number_of("W1.2")]
    assert [row[key] for key in ("score_a", "score_b", "race_a", "race_b")] == [4, 3, 5, 3]
    assert moves.correct(state, "W1.2", (5, 2)).winner == second.players[0]


def test_a_file_that_contradicts_itself_is_refused(tmp_path):
    data = json.loads((SAVED / "brackets_manager_double8_all.json").read_text())
    first = data["match"][0]
    for side in ("opponent1", "opponent2"):
        first[side]["result"] = {"win": "loss", "loss": "win"}[first[side]["result"]]
        first[side]["score"] = 5 - first[side]["score"]
    path = tmp_path / "cup.json"
    path.write_text(json.dumps(data))
    with pytest.raises(DataError, match="the matches before it send"):
        imported(path)
    path.write_text('{"a": 1}')
    with pytest.raises(DataError, match="CueScore"):
        imported(path)
    path.write_text('{"a": ')
    with pytest.raises(DataError, match="damaged"):
        imported(path)


def test_a_double_elimination_without_a_final_is_refused(tmp_path):
    data = json.loads((SAVED / "brackets_manager_double8_all.json").read_text())
    data["match"] = [one for one in data["match"] if one["group_id"] < 2]
    path = tmp_path / "cup.json"
    path.write_text(json.dumps(data))
    with pytest.raises(DataError, match="no grand final"):
        imported(path)
