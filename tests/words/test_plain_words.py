"""Errors and helps are plain American English: words that read as translated are not there."""

import re
from functools import cache
from pathlib import Path

import evenbreak
from rows import each_of

SOURCES = Path(evenbreak.__file__).parent
BLOCK = re.compile(r'""".*?"""', re.DOTALL)
QUOTED = re.compile(r'"((?:[^"\\\n]|\\.)+ (?:[^"\\\n]|\\.)*)"')
"""A text with a blank: others are names of the program's own."""
NAMED = re.compile(r"\{[^}]*\}")

BETTER = {
    r"; give\b": "say what must be so, then what was given: X must be ...; you gave Y",
    r"; (leave|name|write|add|correct|choose|put) ": "a sentence of its own: ... . Leave it out.",
    r"\bwhom\b": "who",
    r"(?i)\b(every|some|any|no)body\b": "everyone, someone, anyone, no one",
    r"\b(is|are|was|were|does|do|did|has|have) not (a|an|one of|in|on) ": "isn't, don't, ...",
    r"\bis there already\b": "already exists",
    r"\bcannot\b": "can't",
    r"\btakes? \w+ as right\b|\btaken as right\b": "treat as exact",
    r"\b[Ff]orm of the day\b": "day-to-day form",
    r"\bunless given\b": "default: ...",
    r"\bcentre|\bcolour|\bfavourite|\bpractise|\bcatalogue\b": "center, color, favorite, practice",
    r"\bscore,?( is| such as)? (\{\}|\d):|\{\} is \{\}:\{\}, w|^\{\}:\{\} (can|ends|count)": "5-4",
    r"\bmend\b": "fix",
    r"\b(to begin with|begins? a tournament|has begun)\b": "start",
}
"""Words that a translator would use, and what a native speaker would say."""


@cache
def _said() -> dict[str, str]:
    """Return the texts of the sources in quotes by file and line."""
    said = {}
    for path in sorted(SOURCES.rglob("*.py")):
        if "source_text" not in path.relative_to(SOURCES).parts:
            text = BLOCK.sub(lambda block: "\n" * block[0].count("\n"), path.read_text("utf-8"))
            for n, line in enumerate(text.splitlines(), 1):
                if not line.lstrip().startswith("#"):
                    texts = NAMED.sub("{}", " | ".join(QUOTED.findall(line)))
                    said[f"{path.relative_to(SOURCES)}:{n}"] = texts
    return said


@each_of("words", list(BETTER))
def test_no_sentence_has_words_that_read_as_translated(words: str) -> None:
    pattern = re.compile(words)
    found = [f"{place}: {text}" for place, text in _said().items() if pattern.search(text)]
    assert not found, f"{BETTER[words]}\n" + "\n".join(found)
