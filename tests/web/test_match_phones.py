"""Whose phone is whose, and who may answer for whom: one phone never answers for both sides."""

import random

import pytest

from evenbreak.files.store.desk import Sides, disputes, phone_entries
from evenbreak.files.store.tournament import add_events, read_tournament
from evenbreak.tournaments.evening.events import Event, Renamed, Result
from evenbreak.web.codes import LETTERS
from tries import tries
from web.conftest import Hall, begun
from web.phones import Phone, Shown, answering, two_phones

SEEDS = tries("taps of one address", 4)


class Player:
    """A browser at an address that says it is one of the players of a match."""

    def __init__(self, hall: Hall, address: str, match: str = "W1.1") -> None:
        self.phone = Phone(hall.site, address=address)
        self.match, self.pair = match, hall.state.pair(match)

    def claims(self, side: int) -> Shown:
        return self.phone.claims(self.pair[side])

    def sends(self, a: int, b: int) -> Shown:
        return self.phone.taps(self.match, a, b)


def said(hall: Hall) -> Sides:
    """Return what the players of the first match say."""
    return hall.site.night.phones().sides("W1.1", hall.state.pair("W1.1"))


def test_two_phones_at_different_addresses_agree(hall: Hall) -> None:
    one, other = Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")
    assert (one.claims(0).status, other.claims(1).status) == (200, 200)
    assert "counts once" in one.sends(3, 1).words
    assert f"{one.pair[0]} says you lost 1-3" in other.phone.open("/me").words
    assert "You both agree" in other.sends(3, 1).words
    assert hall.state.counted["W1.1"].score == (3, 1)


@pytest.mark.slow
@pytest.mark.parametrize("private_tab", [False, True])
def test_one_phone_cannot_confirm_itself(hall: Hall, *, private_tab: bool) -> None:
    one = Player(hall, "127.0.0.2")
    other = Player(hall, "127.0.0.2") if private_tab else one
    one.claims(0)
    one.sends(3, 0)
    other.claims(1)
    shown = other.sends(3, 0)
    assert "W1.1" not in hall.state.counted
    # A private tab can't be told from a second phone behind one address: the director looks.
    assert ("Ask the director to confirm it" in shown.words) is private_tab
    assert (said(hall).agree, said(hall).apart) == (private_tab, False)
    assert hall.director.send("/desk/result", match="W1.1", a=3, b=0).status == 200


@pytest.mark.slow
def test_a_name_belongs_to_the_first_phone_that_claims_it_all_evening(hall: Hall) -> None:
    owner, thief = Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")
    owner.claims(0)
    owner.sends(3, 1)
    assert thief.claims(0).status == 409
    assert thief.sends(1, 3).status == 403
    assert said(hall).scores == {owner.pair[0]: (3, 1)}
    other = Player(hall, "127.0.0.4")
    other.claims(1)
    assert "You both agree" in other.sends(3, 1).words
    hall.director.send("/desk/result", match="W1.2", a=3, b=0)
    assert thief.claims(0).status == 409  # in the next match too
    assert "Quarterfinals" in owner.phone.open("/me").words


def test_the_director_or_the_code_takes_a_name_from_a_thief(hall: Hall) -> None:
    thief, owner = Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")
    name = owner.pair[0]
    thief.claims(0)
    thief.sends(0, 3)
    assert owner.claims(0).status == 409
    assert owner.phone.send("/desk/release", player=name).status == 403
    assert hall.director.send("/desk/release", player=name).status == 200
    assert not said(hall).proposed  # what the thief sent is void
    assert thief.claims(0).status == 200
    assert name in owner.phone.claims_by_code(name).words
    assert thief.sends(0, 3).status == 403
    assert thief.claims(0).status == 409
    history = hall.director.open("/desk/history").words
    for line in (f"This phone is {name}'s", "sent", "127.0.0.2", "127.0.0.3"):
        assert line in history


@pytest.mark.slow
def test_two_scores_are_one_case_for_the_director_until_one_gives_way(hall: Hall) -> None:
    players = [Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")]
    for side, (one, score) in enumerate(zip(players, ((3, 1), (2, 3)), strict=True)):
        one.claims(side)
        one.sends(*score)
    (case,) = disputes(hall.state, hall.site.night.phones())
    assert (case.match, list(case.scores.values())) == ("W1.1", [(3, 1), (2, 3)])
    for one in players:
        assert "Two scores" in one.phone.open("/me").words
    assert "says you won 3-1" not in players[0].phone.send("/me/withdraw", match="W1.1").words
    players[0].sends(2, 3)
    assert hall.state.counted["W1.1"].score == (2, 3)
    kinds = [one.kind for one in phone_entries(hall.site.path)]
    assert kinds == [*("claimed", "proposed") * 2, "withdrawn", "proposed", "entered"]


def test_a_guessed_code_is_refused_and_guessing_is_slow(hall: Hall) -> None:
    luck, guesser = random.Random(0), Phone(hall.site, address="127.0.0.7")
    codes = set(hall.site.player_codes().values())
    assert len(codes) == 16
    statuses = []
    for _ in range(14):
        guess = "".join(luck.choices(LETTERS, k=5))
        assert guess not in codes
        statuses.append(guesser.open(f"/c/{guess}").status)
    assert statuses == [404] * 10 + [429] * 4
    assert guesser.open(f"/c/{codes.pop()}").status == 429
    assert phone_entries(hall.site.path) == []
    other = Phone(hall.site, address="127.0.0.8")
    code = codes.pop()
    assert "This is me" in other.open(f"/c/{code}").words
    assert phone_entries(hall.site.path) == []  # opening a page claims nothing
    assert other.send("/me/code", code=code).url.endswith("/me")
    assert other.open(f"/c/{code}").url.endswith("/me")  # and the code leads there from now on
    assert [one.kind for one in phone_entries(hall.site.path)] == ["claimed"]


@pytest.mark.slow
def test_a_phone_that_waits_in_a_match_that_nobody_is_in_any_more_is_told_so(hall: Hall) -> None:
    for match in ("W1.1", "W1.2"):
        hall.director.send("/desk/result", match=match, a=3, b=0)
    one = Player(hall, "127.0.0.2", "W2.1")
    one.claims(0)
    assert hall.director.send("/desk/undo", entry=hall.state.numbers[-1]).status == 200
    shown = one.sends(1, 0)
    assert shown.status == 409
    assert "9 isn't being played now" in shown.words


@pytest.mark.slow
def test_claims_and_proposals_outlast_a_restart_and_hold_for_every_server(hall: Hall) -> None:
    owner = Player(hall, "127.0.0.2")
    owner.claims(0)
    owner.sends(3, 1)
    with answering(hall.site.path) as again:
        thief, other = two_phones(again)
        assert thief.claims(owner.pair[0]).status == 409
        assert other.claims(owner.pair[1]).status == 200
        assert "You both agree" in other.taps("W1.1", 3, 1).words


def test_a_new_name_keeps_phone_and_code(hall: Hall) -> None:
    owner = Player(hall, "127.0.0.2")
    owner.claims(0)
    owner.sends(3, 1)
    code = hall.site.player_code(owner.pair[0])
    renamed = Event("2025-03-01T20:00:00", Renamed(owner.pair[0], "Someone Else"))
    add_events(hall.site.path, lambda _: [renamed])
    assert hall.site.player_code("Someone Else") == code
    assert "counts once" in owner.phone.open("/me").words


@pytest.mark.slow
def test_no_order_of_claims_and_scores_lets_one_address_decide(hall: Hall) -> None:
    for seed in range(SEEDS):
        luck = random.Random(seed)
        match = f"W1.{seed % 8 + 1}"
        tabs = [Player(hall, "127.0.0.2", match) for _ in range(2)]
        for _ in range(12):
            tab, side = luck.choice(tabs), luck.randrange(2)
            luck.choice(
                [
                    lambda tab=tab, side=side: tab.claims(side),
                    lambda tab=tab: tab.sends(3, 1),
                    lambda tab=tab: tab.phone.send("/me/leave"),
                ]
            )()
        assert hall.state.counted == {}, seed


@pytest.mark.slow
def test_a_table_s_tablet_taps_for_both_and_can_be_taken_back(hall: Hall) -> None:
    tablet = Phone(hall.site, director=True, address="127.0.0.5")
    match, tap = "W1.1", {"match": "W1.1", "a": 1, "b": 0}
    hall.director.send("/desk/call", match=match, table=4)
    assert hall.guest.send("/table/4/score", **tap).status == 403
    assert tablet.send("/table/4/tablet", give="yes").status == 200
    assert tablet.open("/desk").status == 403  # it is no director's any more
    assert "Start" in tablet.open("/table/4").words
    for score in ((1, 0), (1, 1), (2, 1)):
        assert tablet.send("/table/4/score", match=match, a=score[0], b=score[1]).status == 200
    assert tablet.send("/table/4/score", match="W1.2", a=1, b=0).status == 409
    shown = tablet.send("/table/4/score", match=match, a=3, b=1)
    assert "Just finished" in shown.words
    assert hall.state.counted[match].score == (3, 1)
    (result,) = [one for one in hall.state.events if isinstance(one.what, Result)]
    assert result.by_phones
    assert "The director knows" in tablet.send("/table/4/wrong", match=match).words
    assert hall.director.send("/table/4/tablet", give="no").status == 200
    hall.director.send("/desk/call", match="W1.2", table=4)
    assert tablet.send("/table/4/score", match="W1.2", a=1, b=0).status == 403


@pytest.mark.slow
def test_a_phone_can_be_claimed_before_the_draw(hall: Hall) -> None:
    one = Player(hall, "127.0.0.2")
    hall.director.send("/desk/undo", entry=2, sure="yes")
    assert not hall.state.drawn
    assert "You're in" in one.claims(0).words
    hall.director.send("/desk/draw")
    assert "Winners' round 1" in one.phone.open("/me").words


@pytest.mark.slow
def test_who_is_called_answers_and_the_desk_knows(hall: Hall) -> None:
    one = Player(hall, "127.0.0.2")
    one.claims(0)
    hall.director.send("/desk/call", match="W1.1", table=2)
    name = one.pair[0]
    assert "The desk knows" in one.phone.send("/me/coming", match="W1.1", minutes=5).words
    assert f"{name} needs 5 minutes" in hall.director.open("/desk").words
    assert "Tap for a game" in one.phone.send("/me/coming", match="W1.1").words
    assert f"{name} is coming" in hall.director.open("/desk").words
    hall.director.send("/desk/uncall", match="W1.1")
    hall.site.clock = lambda: "2031-03-01T20:00:00"
    hall.director.send("/desk/call", match="W1.1", table=3)
    assert "You're up: table 3" in one.phone.open("/me").words


@pytest.mark.slow
def test_a_table_s_page_leads_its_players_to_their_own(hall: Hall) -> None:
    hall.director.send("/desk/call", match="W1.1", table=2)
    one = Player(hall, "127.0.0.2")
    assert "Who are you?" in one.phone.open("/table/2").words
    shown = one.claims(0)
    assert "You're up" in shown.words
    assert one.phone.open("/table/2").url.endswith("/me")
    assert one.phone.open("/table/9").status == 400


@pytest.mark.slow
def test_many_matches_of_honest_phones_are_entered_without_the_director(tmp_path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, [f"P{k}" for k in range(8)])
        hall = Hall(site, director, Phone(site))
        for k, match in enumerate(list(hall.state.standing.to_play)):
            for side in (0, 1):
                player = Player(hall, f"127.0.1.{2 * k + side + 1}", match)
                player.claims(side)
                player.sends(3, 2)
        assert len(read_tournament(site.path).counted) == 4
