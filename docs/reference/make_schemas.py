"""Write answers.schema.json: what the JSON of each command holds, read off its own answers.

    python docs/reference/make_schemas.py

The questions are those of tests/test_faces.py, which holds every answer to the schema.
What a key means is in answers.toml, or else what a person reads above the column.
"""

import json
import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
MEANINGS = Path(__file__).with_name("answers.toml")
SCHEMA = ROOT / "src" / "evenbreak" / "answers" / "answers.schema.json"
TYPES = {str: "string", bool: "boolean", int: "number", float: "number", type(None): "null"}
SAID = {
    "heading": "What the answer is about, in one line or two.",
    "sentences": "The answer in words, as text and pages show it.",
    "details": "More words, which text shows with --verbose.",
    "warnings": "What casts doubt on the answer.",
    "schema_version": "Rises when a key is renamed or removed.",
}


def schema_of(values: list[Any], said: dict[str, str]) -> dict[str, Any]:
    """Return the schema that all of some values keep to; of any number, it may not be finite."""
    kinds = {TYPES[type(v)] for v in values if type(v) in TYPES}
    names = sorted(kinds | ({"null"} if any(isinstance(v, float) for v in values) else set()))
    found: dict[str, Any] = {}
    lists = [v for v in values if isinstance(v, list)]
    objects = [v for v in values if isinstance(v, dict)]
    names += ["array"] if lists else []
    names += ["object"] if objects else []
    if lists:
        items = [item for one in lists for item in one]
        # Warnings are the lists that may be empty in every answer.
        found["items"] = schema_of(items, said) if items else {"type": "string"}
    if objects:
        keys = list(dict.fromkeys(key for one in objects for key in one))
        found["properties"] = {
            key: ({"description": said[key]} if key in said else {})
            | schema_of([one[key] for one in objects if key in one], said)
            for key in keys
        }
        always = [key for key in keys if all(key in one for one in objects)]
        found |= {"required": always} if always else {}
    return {"type": names[0] if len(names) == 1 else names} | found if names else found


def words_of(answer: Any) -> Iterator[tuple[str, str]]:
    """Yield what a person reads above a column or beside a quantity, by its name in JSON."""
    for part in (*answer.parts, *answer.details):
        for one in getattr(part, "columns", None) or getattr(part, "of", ()):
            if isinstance(one.name, str) and one.words and one.words.strip():
                yield one.name, " ".join(one.words.split())


def main() -> None:
    """Ask every question, and write what the answers have in common."""
    sys.path.insert(0, str(ROOT / "tests"))
    from test_faces import ASKED, command_of, faces_of

    answers: dict[str, list[Any]] = {}
    words: dict[str, dict[str, str]] = {}
    for name in ASKED:
        faces = faces_of(name)
        command = command_of(name)
        answers.setdefault(command, []).append(json.loads(faces.json))
        words.setdefault(command, {}).update(words_of(faces.answer))
    means = tomllib.loads(MEANINGS.read_text("utf-8"))
    found = {
        command: schema_of(answers[command], words[command] | means.get(command, {}) | SAID)
        for command in sorted(answers)
    }
    for one in found.values():  # a quantity may be one that there is none of
        for name, value in one["properties"].items():
            if value.get("type") == "number" and name not in SAID:
                value["type"] = ["null", "number"]
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers of evenbreak as JSON, by command",
        "$defs": found,
    }
    SCHEMA.write_text(text_of(schema), encoding="utf-8")


def text_of(schema: Any) -> str:
    """Return a schema as text, lists of types in one line each."""
    text = json.dumps(schema, indent=1, ensure_ascii=False) + "\n"
    lists = re.compile(r'\[\n\s+("[a-z]+"(?:,\n\s+"[a-z]+")*)\n\s+\]')
    return lists.sub(lambda found: "[" + " ".join(found[1].split()) + "]", text)


if __name__ == "__main__":
    main()
