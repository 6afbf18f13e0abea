"""Who may write through the API: a client that sends one of the director's tokens in a header.

A token in an address or a cookie doesn't count. Wrong tokens are counted by address, like wrong
PINs. A correct token passes even then: no one can guess 160 bits, and a guest behind the same
router must not be able to stop the scoreboard.
"""

from __future__ import annotations

import asyncio

from starlette.requests import Request

from evenbreak.answers.tournament.programs import scope_words, scopes
from evenbreak.files.store.tokens import (
    DIRECTOR,
    MOVES_OF_SCORES,
    SCORES,
    Token,
    kept_tokens,
    token_in,
)
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.known import known_match
from evenbreak.web.api.problem import ProblemError
from evenbreak.web.page import site_of
from evenbreak.web.sessions import address_of
from evenbreak.words import say

_LONGEST = 200
_NONE = say("This needs a token. The director creates one under More, Other apps.")
_GONE = say("This token is unknown here, or it has been revoked.")
_NOT_FOR_THIS = {"www-authenticate": 'Bearer realm="evenbreak", error="insufficient_scope"'}
_MINUTE = {"retry-after": "60"}


async def check_token(request: Request, move: str) -> None:
    """Reject a request without a valid token for a move; remember whose token it is."""
    site, address, text = site_of(request), address_of(request), _sent(request)
    if not text:
        raise _unknown(_NONE)
    held = token_in(await asyncio.to_thread(lambda: site.tokens), text)
    if held is None:
        if site.wrong_tokens.full(address):
            raise ProblemError("Too many wrong tokens. Wait a minute.", status=429, headers=_MINUTE)
        site.wrong_tokens.count(address)
        raise _unknown(_GONE, "invalid_token")
    if not held.allows(move):
        needed = SCORES if move in MOVES_OF_SCORES else DIRECTOR
        plan = (await asyncio.to_thread(site.night.state)).plan if site.night.exists else None
        raise ProblemError(
            "This program's token is good for: {scope}. This needs a token for: {needed}.",
            scope=scope_words(held, plan) if plan else held.scope,
            needed=scopes(plan)[needed] if plan else needed,
            status=403,
            headers=_NOT_FOR_THIS,
        )
    if site.entries.full(held.name):
        raise ProblemError("Too many entries. Wait a minute.", status=429, headers=_MINUTE)
    site.entries.count(held.name)
    request.state.token = held, text


def check_still(request: Request, state: Evening, match: str | None) -> None:
    """Reject a token that has been revoked, or that is for a different table than the match's.

    This is checked while no one else can enter anything or revoke a token.
    """
    held, text = request.state.token
    still = token_in(kept_tokens(site_of(request).path), text)
    if still is None or still.scope != held.scope:
        raise _unknown(_GONE, "invalid_token")
    if held.table and state.drawn:
        on = state.on_tables.get(known_match(state, match or ""))
        if on is None or on.call.table != held.table:
            raise ProblemError(
                "{match} isn't on the table that this program's token is for ({scope}).",
                match=state.match_words(known_match(state, match or "")),
                scope=scope_words(held, state.plan),
                status=403,
                headers=_NOT_FOR_THIS,
            )


def token_of(request: Request) -> Token:
    """Return the token that came with a request."""
    held: Token = request.state.token[0]
    return held


def _sent(request: Request) -> str:
    """Return the token in a request's header; '' if there is none."""
    given = request.headers.getlist("authorization")
    kind, _, text = given[0].partition(" ") if len(given) == 1 else ("", "", "")
    return text.strip()[:_LONGEST] if kind.lower() == "bearer" else ""


def _unknown(words: str, error: str = "") -> ProblemError:
    how = f'Bearer realm="evenbreak", error="{error}"' if error else 'Bearer realm="evenbreak"'
    return ProblemError(words, status=401, headers={"www-authenticate": how})
