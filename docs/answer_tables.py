"""The tables of what answers hold, made from the schema of the answers.

The build of the pages puts them where a mark stands: `<!-- answer: odds -->`.
`docs/reference/make_schemas.py` writes the schema, with the meanings of `answers.toml`.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from evenbreak import answers

MARK = re.compile(r"^<!-- answer: ([^>]+) -->$", re.MULTILINE)
SCHEMAS = json.loads(Path(answers.__file__).with_name("answers.schema.json").read_text("utf-8"))
MEANINGS = tomllib.loads(
    Path(__file__).with_name("reference").joinpath("answers.toml").read_text("utf-8")
)
COMMON = {"heading", "sentences", "details", "warnings", "schema_version"}


def tables_of(name: str, shape: dict[str, Any]) -> Iterator[str]:
    """Yield the table of the keys of an object, and those of the objects within it."""
    within, rows, plain = [], [], []
    for key, value in shape["properties"].items():
        if not name and key in COMMON:
            continue
        inner = value if "properties" in value else value.get("items", {})
        if "properties" in inner:
            within.append((f"{name}.{key}".strip("."), inner))
        means = value.get("description", "")
        if means in {"", key.replace("_", " ")}:
            plain.append(f"`{key}`")
        else:
            rows.append(f"| `{key}` | {means} |")
    lines = [f"**`{name}`**", ""] if name else []
    lines += ["| key | meaning |", "|---|---|", *rows, ""] if rows else []
    lines += [f"{'Also' if rows else 'The keys'}: {', '.join(plain)}.", ""] if plain else []
    yield "\n".join(lines)
    for named, inner in within:
        yield from tables_of(named, inner)


def table_at(command: str) -> str:
    """Return what an answer holds, folded, and the values of those keys that have names."""
    parts = list(tables_of("", SCHEMAS["$defs"][command]))
    for name, values in MEANINGS.items():
        if name.startswith(f"{command}:"):
            lines = [f"Values of `{name.partition(':')[2]}`\n", "| value | meaning |", "|---|---|"]
            parts.append(
                "\n".join([*lines, *(f"| `{v}` | {of} |" for v, of in values.items()), ""])
            )
    body = "\n".join(parts)
    return f"<details><summary>JSON and CSV: what the keys mean</summary>\n\n{body}\n</details>\n"


def with_tables(text: str) -> str:
    """Return a page with its tables."""
    return MARK.sub(lambda found: table_at(found[1]), text)
