"""Evenings on which something is drawn later: Swiss rounds, redrawn qualifiers, tied groups."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from evenbreak.answers.tournament import night as tournament_night
from evenbreak.answers.tournament.moves import happened
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.swiss import swiss_standings
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import (
    KINDS,
    Drawn,
    Entrant,
    Event,
    LaterDraw,
    Opened,
    Plan,
    Result,
    Undone,
)
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.later_draws import can_draw, stage_to_draw
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.plan import pairings, swiss_of
from evenbreak.tournaments.evening.settling import break_ties, tied_groups

AT = "2025-03-01T19:00:00"


class Night:
    """An evening that is played with pseudo-random results."""

    def __init__(self, plan: Plan, players: int, seed: int = 1) -> None:
        self.rng = np.random.default_rng(seed)
        entrants = tuple(Entrant(f"P{k}", 600.0 - 10.0 * k) for k in range(players))
        self.events = [Event(AT, Opened(plan, entrants))]
        self.draw()

    @property
    def state(self) -> Evening:
        return evening(self.events)

    def add(self, *what) -> None:
        self.events += [Event(AT, one) for one in what]

    def draw(self) -> None:
        self.add(*moves.draw_next(self.state, self.rng))

    def play(self, match: str | None = None) -> None:
        state = self.state
        name = match or str(self.rng.choice(state.standing.to_play))
        need = state.needed(name, state.pair(name))
        score = (need[0], 0) if self.rng.random() < 0.5 else (0, need[1])
        self.add(moves.result(state, name, score))

    def play_round(self) -> None:
        while self.state.standing.to_play:
            self.play()


def test_a_swiss_from_round_to_round() -> None:
    pytest.importorskip("caissify_pairings", reason="needs the extra 'swiss'")
    night = Night(Plan("swiss", 3, rounds=3), 7)
    assert [match.name for match in night.state.bracket.matches] == ["R1.1", "R1.2", "R1.3"]
    with pytest.raises(InputError, match="the next draw must wait"):
        night.draw()
    for number in (2, 3):
        night.play_round()
        assert can_draw(night.state)
        assert stage_to_draw(night.state) == f"R{number}"
        night.draw()
    night.add(Undone())
    assert len(night.state.bracket.matches) == 6
    night.draw()
    night.play_round()
    assert not can_draw(night.state)
    assert len(night.state.counted) == 9
    rounds = pairings(night.state.later, night.state.counted)
    assert all(p.winner or p.second is None for pairs in rounds for p in pairs)
    met = [frozenset(p[:2]) for pairs in rounds for p in pairs]
    assert len(set(met)) == 12
    answer = tournament_night.night_answer(Outlook(night.state, AT))
    standings = next(part for part in answer.parts if getattr(part, "name", "") == "standings")
    assert sum(row[1] for row in standings.rows) == 12


def test_a_correction_leaves_the_rounds_that_were_paired() -> None:
    pytest.importorskip("caissify_pairings", reason="needs the extra 'swiss'")
    night = Night(Plan("swiss", 3, rounds=2), 4)
    night.play_round()
    night.draw()
    before = night.state.bracket
    first, earlier = night.state.counted["R1.1"], night.state
    night.add(moves.correct(night.state, "R1.1", first.score[::-1]))
    said = happened(earlier, night.state, night.state.events[-1])
    assert "Round 2 was paired using the earlier result" in " ".join(said)
    assert night.state.bracket == before
    assert night.state.counted["R1.1"].winner == first.loser
    ahead = Outlook(night.state, AT)
    assert ahead.finish().bands[0] > 0.0
    assert ahead.odds.title.sum() == pytest.approx(1.0)


def test_players_who_went_home_are_not_paired_in_a_swiss() -> None:
    pytest.importorskip("caissify_pairings", reason="needs the extra 'swiss'")
    night = Night(Plan("swiss", 3, rounds=3), 8)
    gone = [night.state.pair(f"R1.{k}")[0] for k in (1, 2)]
    for name in gone:
        night.add(moves.drop(night.state, name))
    night.play_round()
    night.draw()
    seats = [name for name in night.state.later["R2"] if name is not None]
    assert sorted([*seats, *gone]) == sorted(night.state.order)
    ahead = Outlook(night.state, AT)
    assert ahead.odds.title.sum() == pytest.approx(1.0)
    assert ahead.finish().bands[0] > 0.0
    night.play_round()
    night.draw()
    night.play_round()
    assert not night.state.standing.to_play
    standings = swiss_standings(
        swiss_of(night.state.plan, night.state.order),
        pairings(night.state.later, night.state.counted),
    )
    assert {row.player: row.score for row in standings if row.player in gone} == dict.fromkeys(
        gone, 0
    )


def test_without_the_extra_a_swiss_is_refused(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "caissify_pairings", None)
    with pytest.raises(InputError, match="pip install"):
        Night(Plan("swiss", 3), 6)


def test_qualifiers_are_redrawn() -> None:
    night = Night(Plan("double", 3, qualifiers=4, placement="redraw"), 8)
    night.play_round()
    assert {name[0] for name in night.state.counted} == {"W", "L"}
    assert stage_to_draw(night.state) == "K1"
    waiting = Outlook(night.state, AT)
    assert waiting.odds.title.sum() == pytest.approx(1.0)
    night.draw()
    assert stage_to_draw(night.state) is None
    sources = night.state.later["K1"]
    assert sorted(sources) == ["L2.1", "L2.2"]
    assert night.state.bracket.match("K1.1").slots[1].match == sources[0]
    night.play_round()
    assert Outlook(night.state, AT).odds.title.max() == 1.0
    with pytest.raises(InputError, match="already"):
        night.draw()


def test_a_tied_group_waits_for_the_tie_to_be_broken() -> None:
    night = Night(Plan("groups", 1, groups=2, qualifiers=1), 6)
    state = night.state
    scores = {"A:1.1": (1, 0), "A:2.1": (0, 1), "A:3.1": (1, 0)}  # each beats one
    scores |= dict.fromkeys(("B:1.1", "B:2.1", "B:3.1"), (0, 1))
    for name, score in scores.items():
        pair = state.pair(name)
        night.add(Result(name, pair, score, pair[score[1]]))
    assert tied_groups(night.state) == ["A"]
    said = tournament_night.night_answer(Outlook(night.state, AT)).sentences[0]
    assert "tiebreak" in said
    night.add(break_ties(night.state, night.rng).ranked)
    assert tied_groups(night.state) == []
    assert night.state.standing.to_play == ("F",)


def test_nobody_is_called_to_two_tables() -> None:
    night = Night(Plan("groups", 3, groups=2, tables=5), 8)
    calls = tournament_night.next_calls(Outlook(night.state, AT))
    players = [name for _, match in calls for name in night.state.pair(match)]
    assert len(players) == len(set(players)) == 8
    night.add(*[moves.call(night.state, match, table) for table, match in calls])
    busy = night.state.on_tables["A:1.1"].call.players[0]
    with pytest.raises(InputError, match=f"{busy} is playing match 1"):
        moves.call(night.state, "A:2.1", None)


def test_events_are_plain_data() -> None:
    drawn = LaterDraw("R1", ("Ann", "Bo", "Cy", None))
    assert KINDS.read("later draw", KINDS.text(drawn)) == drawn
    assert isinstance(Night(Plan("single", 3), 4).events[1].what, Drawn)
