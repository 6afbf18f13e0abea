"""Who may score for whom: one phone, however it is opened, never scores for both sides."""

import random

import pytest

from evenbreak.files.store.tournament import read_tournament
from tries import tries
from web.conftest import Hall, begun
from web.phones import Phone, Shown, running, two_phones

SEEDS = tries("taps of one address", 4)


class Player:
    """A browser at an address that scores a match for one side."""

    def __init__(self, hall: Hall, address: str, match: str = "W1.1") -> None:
        self.phone = Phone(hall.site, address=address)
        self.to = f"/m/{hall.site.match_token(match)}"
        self.pair = dict(zip(("player_a", "player_b"), hall.state.pair(match), strict=True))

    def claims(self, side: int) -> Shown:
        return self.phone.send(f"{self.to}/me", me=side)

    def sends(self, a: int, b: int, **more: object) -> Shown:
        return self.phone.send(f"{self.to}/score", a=a, b=b, **self.pair, **more)


def test_two_phones_at_different_addresses_agree(hall: Hall) -> None:
    one, other = Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")
    assert (one.claims(0).status, other.claims(1).status) == (200, 200)
    assert "counts once" in one.sends(3, 1).words
    assert "Both of you agree" in other.sends(3, 1).words
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
    assert ("ask the director to confirm" in shown.words) is private_tab
    desk = hall.director.open("/desk").words
    assert ("One person may have entered both" in desk) is private_tab
    assert hall.director.send("/desk/result", match="W1.1", a=3, b=0).status == 200


def test_a_side_belongs_to_the_first_phone_that_claims_it(hall: Hall) -> None:
    owner, thief = Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")
    owner.claims(0)
    owner.sends(3, 1)
    for refused in (thief.claims(0), thief.sends(1, 3, me=0)):
        assert refused.status == 409
        assert "ask the director" in refused.words
    one, two = hall.state.pair("W1.1")
    assert f"reports {one} 3, {two} 1" in hall.director.open("/desk").words
    other = Player(hall, "127.0.0.4")
    other.claims(1)
    assert "Both of you agree" in other.sends(3, 1).words


def test_the_director_alone_releases_a_side(hall: Hall) -> None:
    thief, owner = Player(hall, "127.0.0.2"), Player(hall, "127.0.0.3")
    thief.claims(0)
    thief.sends(0, 3)
    assert owner.claims(0).status == 409
    assert owner.phone.send(f"{owner.to}/release", me=0).status == 403
    assert "Release" not in owner.phone.open(owner.to).words
    assert "Release" in hall.director.open(owner.to).words
    assert hall.director.send(f"{owner.to}/release", me=0).status == 200
    assert " reports " not in hall.director.open("/desk").words  # what the thief sent is void
    assert owner.claims(0).status == 200
    assert thief.claims(0).status == 409
    history = hall.director.open("/desk/history").words
    for line in ("released", "sent", "127.0.0.2", "127.0.0.3"):
        assert line in history


def test_a_phone_that_waits_in_a_match_that_nobody_is_in_any_more_is_told_so(hall: Hall) -> None:
    for match in ("W1.1", "W1.2"):
        hall.director.send("/desk/result", match=match, a=3, b=0)
    one = Player(hall, "127.0.0.2", "W2.1")
    assert hall.director.send("/desk/undo", entry=hall.state.numbers[-1]).status == 200
    for shown in (one.claims(0), one.sends(1, 0), hall.director.send(f"{one.to}/release", me=0)):
        assert shown.status == 409
        assert "W2.1 is not being played now" in shown.words


@pytest.mark.slow
def test_claims_and_proposals_outlast_a_restart_and_hold_for_every_server(hall: Hall) -> None:
    owner = Player(hall, "127.0.0.2")
    owner.claims(0)
    owner.sends(3, 1)
    with running(hall.site.path) as again:
        thief, other = two_phones(again)
        assert thief.send(f"{owner.to}/me", me=0).status == 409
        assert other.send(f"{owner.to}/me", me=1).status == 200
        shown = other.send(f"{owner.to}/score", a=3, b=1, **owner.pair)
        assert "Both of you agree" in shown.words


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
                    lambda tab=tab, side=side: tab.sends(3, 1, me=side),
                ]
            )()
        assert hall.state.counted == {}, seed


@pytest.mark.slow
def test_many_matches_of_honest_phones_are_entered_without_the_director(tmp_path) -> None:
    with running(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, [f"P{k}" for k in range(8)])
        hall = Hall(site, director, Phone(site))
        for k, match in enumerate(list(hall.state.standing.to_play)):
            for side in (0, 1):
                player = Player(hall, f"127.0.1.{2 * k + side + 1}", match)
                player.sends(3, 2, me=side)
        assert len(read_tournament(site.path).counted) == 4
