"""What moves refer to, and what they reject: matches, players, scores."""

from __future__ import annotations

import math
import re
from difflib import get_close_matches

from evenbreak.errors import InputError
from evenbreak.ratings.results_frame import folded, without_accents
from evenbreak.tournaments.brackets.bracket import some_of
from evenbreak.tournaments.evening.chip_night import chips_of
from evenbreak.tournaments.evening.events import Entrant, race_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.plan import refuse_bye
from evenbreak.words import listed, say

ENDINGS = ("time", "conceded")
"""Why a race wasn't played out."""

_NUMBERED = re.compile(r"(?:#|match|rack|partie)?\s*(\d+)")
"""A match by its number, in lower case and as people write it."""


def known_match(state: Evening, text: str, *, over: bool = False) -> str:
    """Return a match's name, given its number or its name.

    '12', '#12' and 'match 12' are the same. In a chip tournament, a bare number is a table's, and
    means the current or last rack there.
    """
    wanted = " ".join(text.split()).casefold()
    names = {name.casefold(): name for name in state.bracket.by_name}
    chips = state.plan.form == "chips"
    if chips:
        racks = state.chip_night.racks.values()
        names |= {str(r.table): r.name for r in racks if (r.name in state.counted) == over}
    if wanted not in names and (number := _NUMBERED.fullmatch(wanted)):
        called = {state.number_of(name): name for name in state.bracket.by_name}
        if not (chips and wanted.isdigit()) and int(number[1]) in called:
            return called[int(number[1])]
        wanted = f"r{number[1]}" if chips and not wanted.isdigit() else wanted
    if wanted in names:
        return names[wanted]
    if chips and wanted.upper() in state.records:
        raise InputError(
            "{match} doesn't count: a player had no chips left",
            match=say("rack {n}", n=int(wanted[1:])),
        )
    raise InputError(
        "there's no match {text!r}; the matches are {matches}",
        text=text,
        matches=some_of([str(n) for n in sorted(map(state.number_of, state.bracket.by_name))]),
    )


def typed(state: Evening, match: str) -> str:
    """Return what to type for a match in a command: its number, or a rack's name."""
    return match if state.plan.form == "chips" else str(state.number_of(match) or match)


def known_player(state: Evening, text: str) -> str:
    """Return a player's name, however it was capitalized and spaced.

    The beginning of a first or last name is enough if no one else's starts the same way. Accents
    may be left out.
    """
    exact = " ".join(text.split()).casefold()
    wanted = without_accents(text)
    plain = {name: without_accents(name) for name in state.entrants}
    for found in (
        [name for name in plain if name.casefold() == exact],
        [name for name, one in plain.items() if one == wanted],
        [name for name, one in plain.items() if wanted and f" {wanted}" in f" {one}"],
    ):
        if len(found) == 1:
            return found[0]
        if found:
            raise InputError("{text!r} could be {players}", text=text, players=some_of(found))
    near = get_close_matches(wanted, list(plain.values()), 1)
    if near:
        raise InputError(
            "{player!r} isn't in this tournament; did you mean {near}?",
            player=text,
            near=next(name for name, one in plain.items() if one == near[0]),
        )
    raise InputError("{player!r} isn't in this tournament", player=text)


def check_entrant(state: Evening, entrant: Entrant, besides: str = "") -> None:
    """Reject an entrant who lacks a unique name or a valid rating."""
    refuse_bye(entrant.name)
    if not math.isfinite(entrant.rating):
        raise InputError(
            "the rating of {player} must be a finite number; it is {rating}",
            player=entrant.name,
            rating=entrant.rating,
        )
    names = {folded(name): name for name in state.entrants if name != besides}
    if folded(entrant.name) in names:
        raise InputError("{player} has already entered", player=names[folded(entrant.name)])
    if state.plan.form == "chips":
        chips_of(state.plan, entrant)  # refuses a rating below the chart


def entered(state: Evening, name: str) -> str:
    """Return a name given in full, which never stands for someone else's longer name."""
    if name in state.entrants:
        return name
    full = known_player(state, name)
    if without_accents(full) != without_accents(name):
        raise InputError(
            "{player!r} isn't a full name; if you mean {full}, write that", player=name, full=full
        )
    return full


def games_in(
    state: Evening, name: str, pair: tuple[str, str], score: tuple[int, int] | str
) -> tuple[int, int]:
    """Return a result's score; in a chip tournament it may be the winner's name."""
    if not isinstance(score, str):
        return score
    if state.plan.form != "chips":
        raise InputError(
            "{score!r} isn't a score. Write each player's games, such as 7-5.", score=score
        )
    winner = known_player(state, score)
    refuse_stranger(state, winner, name, pair)
    return (1, 0) if winner == pair[0] else (0, 1)


def refuse_stranger(state: Evening, player: str, match: str, pair: tuple[str, str]) -> None:
    """Reject a player who isn't in a match."""
    if player not in pair:
        names = {"player": player, "match": state.match_words(match), "a": pair[0], "b": pair[1]}
        raise InputError("{player} isn't in {match}, which is {a} against {b}", **names)


def undecided(state: Evening, match: str) -> str:
    """Return the name of a playable match; reject any other."""
    name = known_match(state, match)
    if (before := state.counted.get(name)) is not None:
        raise InputError(
            "{match} already has a result: {result}",
            match=state.match_words(name),
            result=state.result_words(before),
        )
    refuse_waiting(state, name)
    return name


def refuse_waiting(state: Evening, name: str) -> None:
    """Reject a match that can't be played now."""
    if name in state.standing.to_play:
        return
    if name in state.standing.winners:
        raise InputError("{match} isn't needed", match=state.match_words(name))
    slots = zip(state.bracket.match(name).slots, state.standing.seats[name], strict=True)
    waits = [slot.match for slot, seat in slots if seat is None and not isinstance(slot, int)]
    raise InputError(
        "{match} isn't ready: it's waiting for {waits}",
        match=state.match_words(name),
        waits=listed([state.match_words(one) for one in dict.fromkeys(waits)]),
    )


def winner_of(
    state: Evening,
    name: str,
    pair: tuple[str, str],
    score: tuple[int, int],
    *,
    ended: str = "",
    stated: str = "",
) -> str:
    """Return the winner; reject a score that doesn't finish the race, unless it was cut short.

    If time ran out, the player who needs fewer games wins; the winner must be stated for a tie or a
    conceded match.
    """
    one, other = score
    m, n = state.needed(name, pair)
    if stated:
        refuse_stranger(state, stated, name, pair)
    if ended and one < m and other < n:
        if ended not in ENDINGS or state.plan.form == "chips":
            raise InputError("a rack can't end early. Enter who won it.")
        if stated:
            return stated
        if ended == "time" and m - one != n - other:
            return pair[m - one > n - other]
        raise InputError(
            "say who won {match}, {player_a} or {player_b}",
            match=state.match_words(name),
            player_a=pair[0],
            player_b=pair[1],
        )
    winner = pair[0] if one == m and other < n else pair[1] if other == n and one < m else ""
    if winner and stated in ("", winner):
        return winner
    raise InputError(
        "{a}-{b} can't be the final score of {match}, {player_a} against {player_b}: it's a {race}",
        a=one,
        b=other,
        match=state.match_words(name),
        player_a=pair[0],
        player_b=pair[1],
        race=race_words((m, n)),
    )
