"""The JSON in a request's body, with limits on its content."""

from __future__ import annotations

import json
import re
from collections import Counter
from typing import Any, NoReturn

import msgspec

from evenbreak.web.api.problem import ProblemError

_DEEPEST = 8
_LARGEST = 10**40


def object_in(body: bytes) -> dict[str, Any]:
    """Return the JSON object in a body; an empty body is an empty object.

    Raises ProblemError if it is something else, has a duplicate name, or is too deep or too large.

    >>> object_in(b'{"score": [7, 5]}'), object_in(b"")
    ({'score': [7, 5]}, {})
    """
    try:
        found = msgspec.json.decode(body or b"{}", type=dict[str, Any])
        _check(found)
    except msgspec.ValidationError as error:
        if "Number out of range" in str(error) or "Integer value" in str(error):
            _refuse_number()
        raise ProblemError(
            "The body isn't a JSON object, such as {example}.", example="{}"
        ) from None
    except msgspec.DecodeError as error:
        at = re.search(r"\(byte (\d+)\)", str(error))
        before = body[: int(at[1])] if at else body
        raise ProblemError(
            "The body isn't JSON: line {line}, column {column}.",
            line=before.count(b"\n") + 1,
            column=len(before) - before.rfind(b"\n"),
        ) from None
    except UnicodeDecodeError:
        raise ProblemError("The body isn't in UTF-8.") from None
    except RecursionError:
        _refuse_depth()
    json.loads(body or b"{}", object_pairs_hook=_once)
    return found


def _once(pairs: list[tuple[str, Any]]) -> None:
    name, times = Counter(name for name, _ in pairs).most_common(1)[0] if pairs else ("", 1)
    if times > 1:
        raise ProblemError(
            "{field!r} is in the body twice. Give it once.", parameter=name[:40], field=name[:40]
        )


def _refuse_number() -> NoReturn:
    raise ProblemError("The body has a number that is too large.")


def _refuse_depth() -> NoReturn:
    raise ProblemError("Lists in the body are nested more than {most} deep.", most=_DEEPEST)


def _check(value: Any, deeper: int = _DEEPEST) -> None:
    """Reject deep nesting, and numbers that no one could mean."""
    if not deeper:
        _refuse_depth()
    if isinstance(value, int | float) and abs(value) >= _LARGEST:
        _refuse_number()
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    for part in parts:
        _check(part, deeper - 1)
