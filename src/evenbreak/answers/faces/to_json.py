"""An answer as JSON: every number in full precision, every sentence, one object."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from datetime import date
from pathlib import Path
from typing import Any

from evenbreak.answers.kit.parts import Content, Part, Quantities, Table


def as_dict(answer: Content) -> dict[str, Any]:
    """Return the content of an answer's JSON.

    Quantities are stored by name, and a table is stored by name as a list of objects; a number that
    isn't finite is null. Then come `heading`, `sentences`, `details` (the further sentences),
    `warnings` and `schema_version`.
    """
    found: dict[str, Any] = {}
    for part in (*answer.parts, *answer.details, *([answer.csv] if answer.csv else [])):
        found |= _numbers(part)
    found |= {name: json_value(value) for name, value in answer.data.items()}
    return found | {
        "heading": answer.heading,
        "sentences": answer.sentences,
        "details": [part for part in answer.details if isinstance(part, str)],
        "warnings": list(answer.warnings),
        "schema_version": answer.schema_version,
    }


def to_json(answer: Content) -> str:
    """Return an answer as a JSON string."""
    import json

    return json.dumps(as_dict(answer), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _numbers(part: Part) -> dict[str, Any]:
    match part:
        case Quantities(of=listed, in_json=True):
            return {one.name: json_value(one.value) for one in listed}
        case Table(name=name) if name:
            return {name: json_value(part.to_dicts())}
    return {}


def json_value(value: Any) -> Any:
    """Return a value in JSON types: numpy's numbers as Python's, NaN and infinities as None.

    >>> json_value({"p": float("inf"), "rows": (1, 2.5)})
    {'p': None, 'rows': [1, 2.5]}
    """
    if value is None or isinstance(value, str | bool | int):
        return value
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(key): json_value(one) for key, one in value.items()}
    if hasattr(value, "_asdict"):
        return {key: json_value(one) for key, one in value._asdict().items()}
    if hasattr(value, "tolist"):
        return json_value(value.tolist())
    if isinstance(value, list | tuple):
        return [json_value(one) for one in value]
    if is_dataclass(value):
        return {one.name: json_value(getattr(value, one.name)) for one in fields(value) if one.repr}
    if isinstance(value, date | Path):
        return str(value)
    raise TypeError(f"{type(value).__name__} has no form in JSON")
