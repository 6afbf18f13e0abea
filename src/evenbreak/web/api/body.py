"""The JSON in the body of a request, with limits on what can be in it."""

from __future__ import annotations

import json
from typing import Any, NoReturn

from evenbreak.web.api.problem import ProblemError

_DEEPEST = 8
_DIGITS = 40


def object_in(body: bytes) -> dict[str, Any]:
    """Return the JSON object in a body; an empty body is an empty object.

    >>> object_in(b'{"score": [7, 5]}'), object_in(b"")
    ({'score': [7, 5]}, {})

    Raises
    ------
    ProblemError
        if it is something else, or has what JSON has not: a name twice, NaN, numbers without end.
    """
    try:
        found = json.loads(
            body.decode() or "{}",
            object_pairs_hook=_object,
            parse_constant=_refuse_number,
            parse_int=_whole,
            parse_float=_number,
        )
    except json.JSONDecodeError as error:
        raise ProblemError(
            "The body is not JSON: line {line}, column {column}.",
            line=error.lineno,
            column=error.colno,
        ) from None
    except UnicodeDecodeError:
        raise ProblemError("The body is not in UTF-8.") from None
    except RecursionError:
        _refuse_depth()
    if not isinstance(found, dict):
        raise ProblemError("The body is not a JSON object, such as {example}.", example="{}")
    _check(found)
    return found


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, value in pairs:
        if name in found:
            shown = name[:_DIGITS].encode(errors="replace").decode()
            raise ProblemError(
                "{field!r} is in the body twice; give it once.", parameter=shown, field=shown
            )
        found[name] = value
    return found


def _whole(text: str) -> int:
    return int(text) if len(text) <= _DIGITS else _refuse_number(text)


def _number(text: str) -> float:
    number = float(text) if len(text) <= _DIGITS else 0.0
    return number if len(text) <= _DIGITS and abs(number) < 1e300 else _refuse_number(text)


def _refuse_number(text: str) -> NoReturn:
    raise ProblemError("{value} is not a number that can be used here.", value=text[:_DIGITS])


def _refuse_depth() -> NoReturn:
    raise ProblemError("The body has lists in lists without end.")


def _check(found: Any) -> None:
    """Refuse what is nested deeply, and halves of letters."""
    level = [found]
    for _ in range(_DEEPEST):
        texts = [one for one in level if isinstance(one, str)]
        texts += [name for one in level if isinstance(one, dict) for name in one]
        if any(map(_is_cut, texts)):
            raise ProblemError("The body has half a letter: a surrogate by itself.")
        lists = [one for one in level if isinstance(one, list)]
        lists += [[*one.values()] for one in level if isinstance(one, dict)]
        level = [part for one in lists for part in one]
        if not level:
            return
    _refuse_depth()


def _is_cut(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return True
    return False
