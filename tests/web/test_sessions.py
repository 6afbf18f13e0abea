"""Who is let in, and how long: on every server of a file, and not a moment after they leave."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from evenbreak.web.site import Site
from web.conftest import Hall, begun
from web.phones import Phone, answering
from web.test_kills import begun as begun_by_command


class Copy(Phone):
    """A phone with the cookies that another one has now, at any server of its file."""

    def __init__(self, phone: Phone, site: Site) -> None:
        super().__init__(site)
        self.kept = phone.token()
        for cookie in phone.jar:
            self.jar.set_cookie(cookie)


@pytest.fixture
def servers(hall: Hall) -> Iterator[tuple[Site, Site]]:
    """Two servers on one file."""
    with answering(hall.site.path) as other:
        yield hall.site, other


@pytest.mark.slow
def test_a_new_pin_reaches_every_server_at_once(servers: tuple[Site, Site]) -> None:
    for one, other in (servers, servers[::-1]):
        old = one.pin
        changer, second, elsewhere = (Phone(site, director=True) for site in (one, one, other))
        assert changer.send("/desk/pin").status == 200
        new = one.pin
        assert new != old
        assert other.pin == new
        assert changer.open("/desk").status == 200
        for phone in (second, elsewhere):
            assert phone.open("/desk").status == 403
            assert phone.send("/desk/save").status == 403
        assert Phone(other).send("/pin", pin=old).status == 403
        assert Phone(other).send("/pin", pin=new).status == 200


@pytest.mark.slow
def test_a_cookie_is_good_for_nothing_once_its_owner_has_left(servers: tuple[Site, Site]) -> None:
    one = servers[0]
    stays, leaves = Phone(one, director=True), Phone(one, director=True)
    copies = [Copy(leaves, site) for site in servers]
    assert [copy.open("/desk").status for copy in copies] == [200, 200]
    assert leaves.send("/leave").status == 200
    assert [copy.open("/desk").status for copy in copies] == [403, 403]
    assert [copy.send("/desk/save").status for copy in copies] == [403, 403]
    assert stays.open("/desk").status == 200
    with answering(one.path) as again:
        assert Copy(copies[0], again).open("/desk").status == 403
    assert leaves.send("/pin", pin=one.pin).status == 200
    assert leaves.open("/desk").status == 200
    assert copies[0].open("/desk").status == 403


@pytest.mark.slow
def test_who_leaves_before_the_tournament_begins_has_left_too(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        leaves, director = Phone(site, director=True), Phone(site, director=True)
        copy = Copy(leaves, site)
        leaves.send("/leave")
        begun(director, ["Ann", "Bo"])
        assert copy.open("/desk").status == 403


def test_what_happened_before_the_tournament_begins_is_kept_with_it(tmp_path: Path) -> None:
    site = Site(tmp_path / "tonight.db")
    site.change_pin()
    site.end_visit("visit")
    pin = site.pin
    begun_by_command(site.path, 4)
    assert (site.pin, Site(site.path).pin) == (pin, pin)
    assert Site(site.path).has_ended("visit")
    assert not Site(site.path).has_ended("another")
