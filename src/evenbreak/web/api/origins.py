"""Web pages elsewhere that may use the API from a browser (CORS): only those named.

Cookies don't count below /api: otherwise, a director's session would let any page enter things in
their name. A page elsewhere can read, and write with a token, only if `evenbreak serve
--allow-origin` names it; a request without an Origin doesn't come from a page. Chrome 104 to 141
ask in a preflight whether a private address may be asked at all (Private Network Access); since
142, Chrome asks its user instead.
"""

from __future__ import annotations

from collections.abc import Collection

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from evenbreak.web.guard import ROOT, turn_away

_HEADERS = b"authorization, content-type, idempotency-key, if-none-match, last-event-id"
_SHOWN = b"etag, retry-after"
_KEPT = b"600"  # seconds for which a browser need not ask again
_PREFLIGHT = b"access-control-request-method"
_PRIVATE = b"access-control-request-private-network"


class Origins:
    """Lets pages from some origins use the API, and strips cookies from all API requests."""

    def __init__(self, app: ASGIApp, *, origins: Collection[str] = ()) -> None:
        self.app = app
        self.origins = frozenset(one.encode() for one in origins)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer or reject a request."""
        if scope["type"] != "http" or not scope["path"].startswith(f"{ROOT}/"):
            await self.app(scope, receive, send)
            return
        given = [(name, value) for name, value in scope["headers"] if name != b"cookie"]
        scope = {**scope, "headers": given}
        head, origins = dict(given), [value for name, value in given if name == b"origin"]
        named = len(origins) == 1 and origins[0] in self.origins
        own = origins in ([], [b"http://" + head.get(b"host", b"")])
        allowed = [(b"vary", b"Origin")]
        if named:
            allowed += [
                (b"access-control-allow-origin", origins[0]),
                (b"access-control-expose-headers", _SHOWN),
            ]
        if not own and scope["method"] == "OPTIONS" and _PREFLIGHT in head and named:
            asked = [_PREFLIGHT, b"access-control-request-headers", _PRIVATE]
            allowed += [
                (b"vary", b", ".join(asked)),
                (b"access-control-allow-methods", b"GET, POST"),
                (b"access-control-allow-headers", _HEADERS),
                (b"access-control-max-age", _KEPT),
            ]
            if head.get(_PRIVATE) == b"true":
                allowed.append((b"access-control-allow-private-network", b"true"))
            await send({"type": "http.response.start", "status": 204, "headers": allowed})
            await send({"type": "http.response.body", "body": b""})
            return
        if not (own or named or scope["method"] in ("GET", "HEAD")):
            words = (
                "Pages elsewhere may use this only if evenbreak serve --allow-origin names them."
            )
            await turn_away(scope, send, 403, words, allowed)
            return

        async def answer(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", []), *allowed]
            await send(message)

        await self.app(scope, receive, answer)
