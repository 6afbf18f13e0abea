"""Sentences that keep their template and their values until an output format phrases them.

How to phrase a sentence:

- `say("{player} goes to {match}.", player=name, match=number)`: a template in plain English, never
  an f-string, and named values. The result is a `str` (the English text) that also knows its parts.
- A value is a name (any `str`: never translated, never parsed), a number, or a sentence. Numbers
  are formatted as the template asks, in the reader's locale: `{games:,}`, `{p:.1%}`; `Figure(p,
  ".1%", sign="<")` is a number shown by itself.
- `say_count("{n} game is left.", "{n} games are left.", n)` if a number decides the wording;
  `say_as("heading", "race")` if one English word has several meanings.
- `tally((5, 4))` is a score, "5-4"; `race((7, 5))` a race, "7:5".
- `listed(names)` is "a, b and c"; `joined(sentences, " ")` and `+` concatenate texts. `" ".join`
  and f-strings give plain text, which stays English.
- `Parameter("win_by")` names a parameter (`--win-by`, or the label of its field), as does a name in
  braces that has no value: `say("{win_by} is {value}", value=3)`; `Command("tournament result",
  "W1.2")` a command (or a page's equivalent), `FilePath(path)` a file.
- Errors work the same way: `raise InputError("{scale} is {value}; ...", value=scale)`.
- To phrase it for an output format: `in_face(text, face)`; plain text is unchanged. Never parse a
  sentence.
"""

from evenbreak.words.faces import PYTHON, Face
from evenbreak.words.sentence import (
    Command,
    Figure,
    FilePath,
    Parameter,
    Sentence,
    capital_in_face,
    in_face,
    joined,
    listed,
    ordinal,
    race,
    say,
    say_as,
    say_count,
    tally,
)

__all__ = [
    "PYTHON",
    "Command",
    "Face",
    "Figure",
    "FilePath",
    "Parameter",
    "Sentence",
    "capital_in_face",
    "in_face",
    "joined",
    "listed",
    "ordinal",
    "race",
    "say",
    "say_as",
    "say_count",
    "tally",
]
