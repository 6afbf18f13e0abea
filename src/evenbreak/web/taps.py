"""A tap on the score, from a player's phone or a table's tablet, and what it enters.

A form counts from the score that its page showed: if someone has scored since then, it is rejected,
so that a phone that was offline can't take a game away.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from starlette.requests import Request

from evenbreak.files.store.desk import ENTERED, PROPOSED, Act, Phones, by_phone, enter
from evenbreak.files.store.tournament import add_events, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import BY_ITSELF, Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.evening_view import match_view
from evenbreak.web.forms import Form
from evenbreak.web.guard import MovedOnError, RefusalError
from evenbreak.web.night import Night
from evenbreak.web.page import site_of
from evenbreak.web.sessions import address_of, phone_of, phones_of
from evenbreak.web.site import night_of
from evenbreak.words import Sentence, say, tally


@dataclass(frozen=True)
class Tap:
    """A tap, as sent by a page's form.

    `score` is the new score and `seen` is the one on the page, both with the first player's games
    first.
    """

    match: str
    pair: tuple[str, str]
    score: tuple[int, int]
    seen: str
    key: str

    @property
    def games(self) -> dict[str, int]:
        """Each player's games."""
        return dict(zip(self.pair, self.score, strict=True))

    def ends(self, state: Evening) -> bool:
        """Return whether it ends the match."""
        needs = state.needed(self.match, self.pair)
        return any(won == need for won, need in zip(self.score, needs, strict=True))


def tap_in(request: Request, form: Form, state: Evening) -> Tap:
    """Return a form's tap; reject one for a match that is over or now has other players."""
    site, match = site_of(request), form.text("match")
    if site.taps.full(match):
        raise RefusalError("Too many taps. Wait a moment.", status=429)
    site.taps.count(match)
    pair = form.text("player_a"), form.text("player_b")
    _check_pair(state, match, pair)
    needs = state.needed(match, pair)
    score = form.whole("a", 0, needs[0]), form.whole("b", 0, needs[1])
    return Tap(match, pair, score, form.text("seen"), form.key(request.url.path))


def note(
    request: Request,
    night: Night,
    key: str | None,
    decide: Callable[[Phones], Act | None],
    by: str = "",
) -> Phones:
    """Store what a phone (or `by` someone else) does, and return the resulting state of phones.

    A form that comes in again, by its `key`, adds nothing.
    """
    return enter(
        night.path,
        night.state(),
        decide,
        at=site_of(request).clock(),
        by=by or by_phone(phone_of(request), address_of(request)),
        event=night.event,
        form=key,
    )


def score(request: Request, tap: Tap, by: str, check: Callable[[Evening], None]) -> None:
    """Enter the score of a match in play."""

    def decide(now: Evening) -> list[Event]:
        _check(now, tap)
        check(now)
        if "{}:{}".format(*tap.score) == tap.seen:
            return []
        return [Event(site_of(request).clock(), moves.score(now, tap.match, tap.score))]

    night = night_of(request)
    add_events(night.path, decide, event=night.event, by=by, form=tap.key)


def result(request: Request, tap: Tap, by: str, check: Callable[[Evening], None]) -> None:
    """Enter a result tapped for both players by someone they both trust."""

    def decide(now: Evening) -> list[Event]:
        _check(now, tap)
        check(now)
        return _result(request, now, tap)

    night, calls = night_of(request), site_of(request).next_calls
    add_events(night.path, decide, event=night.event, by=by, form=tap.key, more=calls)


def _result(request: Request, now: Evening, tap: Tap) -> list[Event]:
    return [Event(site_of(request).clock(), moves.result(now, tap.match, tap.score))]


def propose(request: Request, tap: Tap, me: str) -> str:
    """Store a proposed result, and enter it if the opponent proposed the same from elsewhere."""
    night, phone = night_of(request), phone_of(request)
    moves.result(night.state(), tap.match, tap.score)  # refuses what cannot be a result

    def decide(phones: Phones) -> Act | None:
        _check(read_tournament(night.path, night.event), tap)
        if phones.of(phone) != me:
            raise RefusalError(
                "{name} uses another phone now. Open your page again.", status=409, name=me
            )
        last = phones.sides(tap.match, tap.pair).proposed.get(me)
        again = last is not None and (last.what.score, last.by) == (tap.games, sender)
        return None if again else Act(PROPOSED, me, tap.match, tap.games)

    sender = by_phone(phone, address_of(request))
    sides = note(request, night, tap.key, decide).sides(tap.match, tap.pair)
    if not (sides.agree and sides.apart):
        return ""  # the page says for whom it waits

    def settle(now: Evening) -> list[Event]:  # unless the other phone was faster
        return [] if _entered(now, tap) else _result(request, now, tap)

    calls = site_of(request).next_calls
    add_events(night.path, settle, event=night.event, by=phones_of(tap.pair), more=calls)
    note(request, night, None, lambda _: Act(ENTERED, match=tap.match), BY_ITSELF)
    return say("You both agree: the result is in.")


def _check(now: Evening, tap: Tap) -> None:
    """Reject a form made for an earlier score.

    This is checked while no one else can enter anything.
    """
    _check_pair(now, tap.match, tap.pair)
    a, b = match_view(now, tap.match).score or (0, 0)
    there = tally((a, b))
    if tap.seen != f"{a}:{b}":
        raise MovedOnError(
            "The score of {match} is {score} now. Check it, then tap again if a game is missing.",
            status=409,
            match=now.match_words(tap.match),
            score=there,
        )


def _check_pair(state: Evening, match: str, pair: tuple[str, str]) -> None:
    """Reject a form for a match that is over or now has other players."""
    if not state.drawn or match not in state.standing.to_play:
        words: Sentence | str = state.match_words(match) if state.drawn else match
        raise MovedOnError("{match} isn't being played now.", status=409, match=words)
    if state.pair(match) != pair:
        raise MovedOnError(
            "Other players are in {match} now. What was played is kept.",
            status=409,
            match=state.match_words(match),
        )


def _entered(state: Evening, tap: Tap) -> bool:
    """Return whether a match has this result."""
    there = state.counted.get(tap.match)
    return there is not None and not there.forfeit and there.games == tap.games
